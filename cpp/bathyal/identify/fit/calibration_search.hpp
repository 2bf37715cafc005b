// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/identify/fit/calibration_problem.hpp"
#include "bathyal/identify/fit/observability.hpp"

namespace bathyal {

struct SearchResult {
  Eigen::VectorXd x;            ///< values of all columns
  std::vector<double> history;  ///< sum of squares [m²] at the start and after each step
  bool converged = true;
  std::vector<int> pruned;  ///< columns put back to nominal
};

/// Finds the columns that fit the data best, and with them the noise, the trust in each row (where
/// a robust loss is asked for) and the columns to prune; all but the columns' values and the pruned
/// ones is left in `problem.system`. For use inside the room.
SearchResult search(ArmProblem& problem, const Observability& seen);

}  // namespace bathyal
