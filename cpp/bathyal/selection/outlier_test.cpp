// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/outlier_test.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/estimation/f_distribution.hpp"
#include "bathyal/selection/decisions.hpp"

namespace bathyal::selection {
namespace {

/// Variance in units of the noise below which residuals are rounding, and have no outliers.
constexpr double kRounding = 1e-6;

}  // namespace

std::vector<ObservationTest> test_observations(const Linearization& at,
                                               const Eigen::MatrixXd& basis,
                                               const Eigen::VectorXd& weights, double dof) {
  std::vector<std::vector<Index>> rows = at.rows_by_observation(weights.size());
  for (std::vector<Index>& own : rows) {  // a touch of a plane has two rows that measure nothing
    std::erase_if(own, [&](Index r) {
      return at.residual[r] == 0.0 && (at.jacobian.row(r).array() == 0.0).all();
    });
  }
  const Eigen::VectorXd unexplained_residual =
      at.residual - basis * (basis.transpose() * at.residual);
  const double squares = unexplained_residual.squaredNorm();
  std::vector<ObservationTest> out(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Eigen::MatrixXd part = basis(rows[i], Eigen::all);
    const auto k = static_cast<Index>(rows[i].size());
    const Eigen::MatrixXd spread = Eigen::MatrixXd::Identity(k, k) - part * part.transpose();
    const Eigen::VectorXd own = unexplained_residual(rows[i]);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(spread);
    const bool used = weights[static_cast<Index>(i)] > 0.0;
    double distance = 0.0, width = 0.0, square = 0.0;
    for (Index c = 0; c < k; ++c) {
      const double left = eigen.eigenvalues()[c];
      if (left < 1e-6) continue;  // not predicted by any other row
      const double along = eigen.eigenvectors().col(c).dot(own);
      distance += along * along / left;
      square += std::pow(used ? along / left : along, 2);
      width += 1.0;
    }
    if (!used) {
      distance /= kExcludedWeight;
      square /= kExcludedWeight;
    }
    const double others = used ? squares - distance : squares;
    const double free = used ? dof - width : dof;
    if (width == 0.0 || !(free > 0.0)) continue;
    const double variance = std::max({others, 1e-12 * squares, kRounding * free}) / free;
    out[i] = {distance / width / variance, f_tail(distance / width / variance, width, free), width,
              distance, std::sqrt(square)};
  }
  return out;
}

Eigen::VectorXd exclude_outliers(const Linearization& at, const Eigen::MatrixXd& basis,
                                 const Eigen::VectorXd& weights, double dof) {
  const std::vector<ObservationTest> tests = test_observations(at, basis, weights, dof);
  const double threshold = Decisions::kOutlierLevel / static_cast<double>(weights.size());
  Eigen::VectorXd out = weights;
  Index outliers = 0;
  for (Index i = 0; i < weights.size(); ++i) {
    const bool belongs = tests[static_cast<std::size_t>(i)].p > threshold;
    if (!belongs) ++outliers;
    if (belongs && !(weights[i] > 0.0)) out[i] = 1.0;
    if (!belongs) out[i] = 0.0;
  }
  return static_cast<double>(outliers) >
                 Decisions::kMaxOutliers * static_cast<double>(weights.size())
             ? weights
             : out;
}

}  // namespace bathyal::selection
