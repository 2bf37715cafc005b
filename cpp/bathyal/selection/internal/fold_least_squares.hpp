// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/selection/folds.hpp"
#include "bathyal/selection/model.hpp"

namespace bathyal::selection {

/// Prediction errors of held-out rows.
struct HeldOutErrors {
  Eigen::VectorXd error;    ///< (M,) in units of noise; 0 of rows that are never held out
  Eigen::VectorXd by_fold;  ///< (folds,) sum of their squares
};

/// Least squares of a residual on columns, once for each fold held out: from Gram matrices, so that
/// any choice of columns is evaluated without a pass over the rows. A column that is determined by
/// one fold alone is 0 when that fold is held out. A column for an unknown that observations share
/// (a touched point) then predicts nothing of a fold that has all of them.
class FoldLeastSquares {
 public:
  /// All but `prior_precision`, (columns,), must outlive it.
  /// \pre columns are of length 1
  FoldLeastSquares(const Eigen::VectorXd& residual, const Eigen::MatrixXd& columns,
                   const Eigen::VectorXd& prior_precision, const std::vector<int>& observation,
                   const Folds& folds, int num_threads);

  /// (folds,) predicted residual sums of squares with the columns `which`.
  Eigen::VectorXd press(const std::vector<Index>& which) const;
  /// Log predictive density of the folds, each given the others, for unit noise and with the
  /// uncertainty of the values, up to a constant common to all choices of columns. Where a fold
  /// extrapolates, large errors are expected and weigh less, which PRESS alone ignores.
  double log_predictive_density(const std::vector<Index>& which) const;
  /// The errors themselves.
  HeldOutErrors errors(const std::vector<Index>& which) const;
  double rows() const { return rows_held_out_; }

 private:
  /// The fit to all folds but one.
  struct Others {
    Eigen::LLT<Eigen::MatrixXd> root;
    Eigen::VectorXd values;
  };
  Others others(const std::vector<Index>& which, std::size_t fold) const;
  double fold_press(const std::vector<Index>& which, const Eigen::VectorXd& values,
                    std::size_t fold) const;

  const Eigen::VectorXd& residual_;
  const Eigen::MatrixXd& columns_;
  int num_threads_;
  double rows_held_out_ = 0.0;
  std::vector<std::vector<Index>> rows_;       ///< of each fold
  Eigen::MatrixXd square_;                     ///< Gram matrix of [columns residual], all rows
  std::vector<Eigen::MatrixXd> fold_squares_;  ///< of each fold
};

/// p-value of gains (one of each fold) under random signs: all sign patterns are enumerated for up
/// to 16 folds, and 65536 are drawn for more.
double sign_flip_p(const Eigen::VectorXd& gains);

}  // namespace bathyal::selection
