// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "bathyal/identify/model/arm_parameters.hpp"
#include "bathyal/identify/model/calibration_data.hpp"

namespace bathyal::diagnosis {

/// Sentences about parts of a fitted arm that cannot be where the fit has them: a tool longer than
/// the arm, a base farther from the measured positions than the arm reaches, a length that differs
/// from nominal by a quarter of the arm's.
std::vector<std::string> check_room(const Arm& nominal, const ArmState& fitted,
                                    const Measurement& measurement);

}  // namespace bathyal::diagnosis
