// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "bathyal/identify/fit/arm_fit.hpp"

namespace bathyal {

/// One paragraph: the result, its uncertainty, what determines the scale, what is undetermined, and
/// every warning unless the caller reports them elsewhere.
std::string summarize(const ArmFit& fit, bool with_warnings = true);

}  // namespace bathyal
