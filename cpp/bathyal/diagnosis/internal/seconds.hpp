// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace bathyal::diagnosis {

/// "12.1 s": four digits, enough to tell the periods of a scan apart.
std::string seconds(double seconds);

}  // namespace bathyal::diagnosis
