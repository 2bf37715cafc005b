// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/internal/cross_validation.hpp"

#include <algorithm>
#include <numeric>

namespace bathyal::selection {
namespace {

Eigen::MatrixXd columns_of(const Eigen::MatrixXd& basis, const CandidateSet& candidates) {
  Eigen::MatrixXd out(basis.rows(), basis.cols() + candidates.prior_precision().size());
  out.leftCols(basis.cols()) = basis;
  Index at = basis.cols();
  for (int m = 0; m < candidates.size(); ++m) {
    out.middleCols(at, candidates.width(m)) = candidates.columns(m);
    at += candidates.width(m);
  }
  return out;
}

Eigen::VectorXd prior_precision_of(const Eigen::MatrixXd& basis, const CandidateSet& candidates) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(basis.cols() + candidates.prior_precision().size());
  out.tail(candidates.prior_precision().size()) = candidates.prior_precision();
  return out;
}

}  // namespace

BlockCrossValidation::BlockCrossValidation(const WorkingPoint& working_point,
                                           const std::vector<int>& terms, const Folds& folds)
    : BlockCrossValidation(working_point, working_point.candidate_set(terms), folds) {}

BlockCrossValidation::BlockCrossValidation(const WorkingPoint& working_point,
                                           const CandidateSet& candidates, const Folds& folds)
    : columns_(columns_of(working_point.nuisance().basis, candidates)),
      prior_precision_(prior_precision_of(working_point.nuisance().basis, candidates)),
      fit_(working_point.model().linearization().residual, columns_, prior_precision_,
           working_point.model().linearization().observation, folds, working_point.num_threads()),
      basis_(static_cast<std::size_t>(working_point.nuisance().basis.cols())) {
  std::iota(basis_.begin(), basis_.end(), Index{0});
  auto at = static_cast<Index>(basis_.size());
  for (int m = 0; m < candidates.size(); ++m) {
    terms_.push_back(candidates.term_index(m));
    own_.emplace_back(static_cast<std::size_t>(candidates.width(m)));
    std::iota(own_.back().begin(), own_.back().end(), at);
    at += candidates.width(m);
  }
}

void BlockCrossValidation::drop(std::size_t place) {
  terms_.erase(terms_.begin() + static_cast<std::ptrdiff_t>(place));
  own_.erase(own_.begin() + static_cast<std::ptrdiff_t>(place));
}

double BlockCrossValidation::log_predictive_density_of(const std::vector<int>& terms) const {
  std::vector<Index> which = basis_;
  for (std::size_t i = 0; i < own_.size(); ++i) {
    if (std::find(terms.begin(), terms.end(), terms_[i]) == terms.end()) continue;
    which.insert(which.end(), own_[i].begin(), own_[i].end());
  }
  return fit_.log_predictive_density(which);
}

std::vector<Index> BlockCrossValidation::all_but(std::size_t without) const {
  std::vector<Index> which = basis_;
  for (std::size_t i = 0; i < own_.size(); ++i) {
    if (i != without) which.insert(which.end(), own_[i].begin(), own_[i].end());
  }
  return which;
}

}  // namespace bathyal::selection
