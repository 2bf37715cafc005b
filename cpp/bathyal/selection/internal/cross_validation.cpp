// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/internal/cross_validation.hpp"

#include <algorithm>
#include <numeric>

namespace bathyal {
namespace {

Eigen::MatrixXd columns_of(const Eigen::MatrixXd& basis, const Pool& pool) {
  Eigen::MatrixXd out(basis.rows(), basis.cols() + pool.held_by().size());
  out.leftCols(basis.cols()) = basis;
  Index at = basis.cols();
  for (int m = 0; m < pool.size(); ++m) {
    out.middleCols(at, pool.width(m)) = pool.columns(m);
    at += pool.width(m);
  }
  return out;
}

Eigen::VectorXd held_by_of(const Eigen::MatrixXd& basis, const Pool& pool) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(basis.cols() + pool.held_by().size());
  out.tail(pool.held_by().size()) = pool.held_by();
  return out;
}

}  // namespace

FormsHeldOut::FormsHeldOut(const Vantage& vantage, const std::vector<int>& forms,
                           const Blocks& blocks)
    : FormsHeldOut(vantage, vantage.pool_of(forms), blocks) {}

FormsHeldOut::FormsHeldOut(const Vantage& vantage, const Pool& pool, const Blocks& blocks)
    : columns_(columns_of(vantage.ground().basis, pool)),
      held_by_(held_by_of(vantage.ground().basis, pool)),
      held_(vantage.subject().linearization().misfit, columns_, held_by_,
            vantage.subject().linearization().unit, blocks, vantage.num_threads()),
      basis_(static_cast<std::size_t>(vantage.ground().basis.cols())) {
  std::iota(basis_.begin(), basis_.end(), Index{0});
  auto at = static_cast<Index>(basis_.size());
  for (int m = 0; m < pool.size(); ++m) {
    forms_.push_back(pool.form(m));
    own_.emplace_back(static_cast<std::size_t>(pool.width(m)));
    std::iota(own_.back().begin(), own_.back().end(), at);
    at += pool.width(m);
  }
}

void FormsHeldOut::drop(std::size_t place) {
  forms_.erase(forms_.begin() + static_cast<std::ptrdiff_t>(place));
  own_.erase(own_.begin() + static_cast<std::ptrdiff_t>(place));
}

double FormsHeldOut::density_of(const std::vector<int>& forms) const {
  std::vector<Index> which = basis_;
  for (std::size_t i = 0; i < own_.size(); ++i) {
    if (std::find(forms.begin(), forms.end(), forms_[i]) == forms.end()) continue;
    which.insert(which.end(), own_[i].begin(), own_[i].end());
  }
  return held_.density(which);
}

std::vector<Index> FormsHeldOut::all_but(std::size_t without) const {
  std::vector<Index> which = basis_;
  for (std::size_t i = 0; i < own_.size(); ++i) {
    if (i != without) which.insert(which.end(), own_[i].begin(), own_[i].end());
  }
  return which;
}

}  // namespace bathyal
