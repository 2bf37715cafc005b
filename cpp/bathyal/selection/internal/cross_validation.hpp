// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include "bathyal/selection/internal/fold_least_squares.hpp"
#include "bathyal/selection/working_point.hpp"

namespace bathyal::selection {

/// Block cross-validation of terms given the base model. Terms are numbered by their position in
/// `terms()`; those that are collinear with the base model are left out.
class BlockCrossValidation {
 public:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  /// `working_point` and `folds` must outlive it, and the model must not be fitted meanwhile.
  BlockCrossValidation(const WorkingPoint& working_point, const std::vector<int>& terms,
                       const Folds& folds);
  BlockCrossValidation(const BlockCrossValidation&) = delete;
  BlockCrossValidation& operator=(const BlockCrossValidation&) = delete;

  const std::vector<int>& terms() const { return terms_; }
  void drop(std::size_t place);

  // Of all terms, or of all but one.
  double log_predictive_density(std::size_t without = kNone) const {
    return fit_.log_predictive_density(all_but(without));
  }
  double press(std::size_t without = kNone) const { return fit_.press(all_but(without)).sum(); }
  /// Of those of `terms` that it has.
  double log_predictive_density_of(const std::vector<int>& terms) const;
  HeldOutErrors errors() const { return fit_.errors(all_but(kNone)); }
  HeldOutErrors errors_of_base() const { return fit_.errors(basis_); }
  double rows() const { return fit_.rows(); }

 private:
  BlockCrossValidation(const WorkingPoint& working_point, const CandidateSet& candidates,
                       const Folds& folds);
  std::vector<Index> all_but(std::size_t without) const;

  Eigen::MatrixXd columns_;
  Eigen::VectorXd prior_precision_;
  FoldLeastSquares fit_;
  std::vector<Index> basis_;
  std::vector<int> terms_;
  std::vector<std::vector<Index>> own_;  ///< columns of each
};

}  // namespace bathyal::selection
