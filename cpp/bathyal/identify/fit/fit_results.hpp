// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/identify/fit/arm_fit.hpp"
#include "bathyal/identify/fit/calibration_search.hpp"

namespace bathyal {

/// The result of an identification without warnings and outliers.
ArmFit make_arm_fit(const CalibrationProblem& problem, const Observability& observability,
                    const CalibrationResult& found);

}  // namespace bathyal
