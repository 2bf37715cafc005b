// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/identify/fit/calibration_problem.hpp"
#include "bathyal/identify/fit/observability.hpp"

namespace bathyal {

struct CalibrationResult {
  Eigen::VectorXd x;            ///< values of all parameters
  std::vector<double> history;  ///< sum of squares [m²] at the start and after each step
  bool converged = true;
  std::vector<int> pruned;  ///< parameters reset to nominal
};

/// Estimates the parameters, the noise, the observation weights (for a robust loss) and the
/// parameters to prune; all but the values and the pruned parameters is left in `problem.system`.
CalibrationResult search(CalibrationProblem& problem, const Observability& observability);

}  // namespace bathyal
