// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/receiver.hpp"

namespace bathyal {

void ReceiverOptions::check() const {}

}  // namespace bathyal
