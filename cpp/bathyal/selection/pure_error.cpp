// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/pure_error.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include "bathyal/estimation/f_distribution.hpp"

namespace bathyal::selection {

PureError pure_error(const std::vector<Eigen::VectorXd>& values,
                     const std::vector<int>& replicate) {
  std::map<int, std::vector<std::size_t>> replicates;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i].size() > 0) replicates[replicate[i]].push_back(i);
  }
  PureError out;
  for (const auto& [number, members] : replicates) {
    if (members.size() < 2) continue;
    Eigen::MatrixXd same(values[members.front()].size(), static_cast<Index>(members.size()));
    for (std::size_t i = 0; i < members.size(); ++i)
      same.col(static_cast<Index>(i)) = values[members[i]];
    out.squares += (same.colwise() - same.rowwise().mean()).squaredNorm();
    out.dof += static_cast<double>(same.rows()) * static_cast<double>(members.size() - 1);
    ++out.sets;
  }
  return out;
}

PureErrorTest test_pure_error(const Model& model, const Eigen::MatrixXd& basis, double dof,
                              const Eigen::VectorXd& weights) {
  const Linearization& at = model.linearization();
  const Eigen::VectorXd residual = at.residual - basis * (basis.transpose() * at.residual);
  const std::vector<std::vector<Index>> rows = at.rows_by_observation(weights.size());
  std::vector<Eigen::VectorXd> values(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (weights[static_cast<Index>(i)] > 0.0) values[i] = residual(rows[i]);
  }
  const PureError pure = pure_error(values, model.observations().replicate);
  PureErrorTest out;
  out.dof = pure.dof;
  const double left = dof - out.dof;
  if (!pure.is_measured() || !(left > 0.0)) return out;
  out.variance = pure.squares / pure.dof;
  const double lack_of_fit = std::max(residual.squaredNorm() - pure.squares, 0.0);
  out.p = f_tail(lack_of_fit / left / out.variance, left, out.dof);
  out.explained = std::max(lack_of_fit - left * out.variance, 0.0);
  return out;
}

}  // namespace bathyal::selection
