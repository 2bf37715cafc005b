// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "bathyal/identify/fit/arm_fit.hpp"

namespace bathyal {

/// One paragraph in plain words: what was found, how surely, what the size rests on, what could not
/// be told, and every warning unless these are told elsewhere.
std::string summarize(const ArmFit& fit, bool with_warnings = true);

}  // namespace bathyal
