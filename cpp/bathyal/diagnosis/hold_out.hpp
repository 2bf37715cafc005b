// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/diagnosis/blocks.hpp"
#include "bathyal/diagnosis/subject.hpp"

namespace bathyal {

/// Errors of rows that were foretold by a fit to the other blocks.
struct HeldOutErrors {
  Eigen::VectorXd error;       ///< (M,) in units of noise; 0 of rows that are never held out
  Eigen::VectorXd of_block;    ///< (blocks,) sum of their squares
  double rows = 0.0;           ///< that were held out
};

/// Least squares of `misfit` by `columns`, once for each block left out. Columns that a block alone
/// tells stay at 0 when it is left out. Where units share something that the rows are told about
/// (a touched point), a block that holds all of them is foretold as it is.
HeldOutErrors hold_out(const Eigen::VectorXd& misfit, const Eigen::MatrixXd& columns,
                       const std::vector<int>& unit, const Blocks& blocks, int num_threads);

/// Probability that gains (one of each block) as large would come of signs thrown at random: all of
/// them are tried up to 16 blocks, and 65536 of more.
double sign_flip_p(const Eigen::VectorXd& gains);

}  // namespace bathyal
