// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/examine.hpp"

namespace bathyal {

void examine(const Measurement&, const ArmSystem&, const Arm&, ArmFit&) {}

}  // namespace bathyal
