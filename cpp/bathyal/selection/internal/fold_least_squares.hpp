// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/selection/folds.hpp"
#include "bathyal/selection/model.hpp"

namespace bathyal {

/// Errors of rows that were foretold by a fit to the other blocks.
struct HeldOutErrors {
  Eigen::VectorXd error;     ///< (M,) in units of noise; 0 of rows that are never held out
  Eigen::VectorXd of_block;  ///< (blocks,) sum of their squares
};

/// Least squares of a misfit by columns, once for each block left out: by inner products, so that
/// any choice of the columns is asked without looking at the rows again. A column that a block
/// alone tells stays at 0 when it is left out. Where units share something that the rows are told
/// about (a touched point), a block that holds all of them is foretold as it is.
class HoldOut {
 public:
  /// All but `held_by` must outlive it: (columns,) 1 / variance of values before the data.
  /// \pre columns are of length 1
  HoldOut(const Eigen::VectorXd& misfit, const Eigen::MatrixXd& columns,
          const Eigen::VectorXd& held_by, const std::vector<int>& unit, const Blocks& blocks,
          int num_threads);

  /// (blocks,) sums of squared errors by the columns `which`.
  Eigen::VectorXd squares(const std::vector<Index>& which) const;
  /// ln of how likely the blocks are by what the others foretell, noise of 1 and the uncertainty of
  /// the values counted, but for what all choices of columns have in common. A block beyond what
  /// the others cover is foretold badly, and is known to be: squares alone would blame the columns.
  double density(const std::vector<Index>& which) const;
  /// The errors themselves.
  HeldOutErrors errors(const std::vector<Index>& which) const;
  double rows() const { return held_; }

 private:
  /// Inner products of all blocks but one.
  struct Others {
    Eigen::LLT<Eigen::MatrixXd> root;
    Eigen::VectorXd values;
  };
  Others others(const std::vector<Index>& which, std::size_t block) const;
  double squares_of(const std::vector<Index>& which, const Eigen::VectorXd& values,
                    std::size_t block) const;

  const Eigen::VectorXd& misfit_;
  const Eigen::MatrixXd& columns_;
  int num_threads_;
  double held_ = 0.0;
  std::vector<std::vector<Index>> rows_;  ///< of each block
  Eigen::MatrixXd square_;                ///< of [columns misfit], all rows
  std::vector<Eigen::MatrixXd> squares_;  ///< of each block
};

/// Probability that gains (one of each block) as large would come of signs thrown at random: all of
/// them are tried up to 16 blocks, and 65536 of more.
double sign_flip_p(const Eigen::VectorXd& gains);

}  // namespace bathyal
