// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "bathyal/identify/model/arm_residuals.hpp"
#include "bathyal/selection/model.hpp"

// Rows other than measurements: known distances and points, priors, linear constraints; and the
// noise that weights them.

namespace bathyal {

/// Residuals of the known distances and points, and the derivative of each by the centroids.
void ArmResiduals::known_residuals(const Eigen::Matrix3Xd& centers, Eigen::VectorXd& residuals,
                                   Eigen::MatrixXd& by_center) const {
  residuals.resize(known_rows());
  by_center.setZero(known_rows(), 3 * m_.points());
  Index row = 0;
  for (const KnownDistance& known : m_.distances) {
    const Vec3 apart = centers.col(known.second) - centers.col(known.first);
    const double length = apart.norm();
    // Coinciding centroids have no direction: any one separates them.
    const Vec3 unit = length > 0.0 ? Vec3(apart / length) : Vec3(Vec3::UnitX());
    residuals[row] = length - known.distance;
    by_center.row(row).segment<3>(3 * known.second) = unit.transpose();
    by_center.row(row).segment<3>(3 * known.first) = -unit.transpose();
    ++row;
  }
  for (const KnownPoint& known : m_.known_points) {
    residuals.segment<3>(row) = centers.col(known.label) - known.position;
    by_center.block<3, 3>(row, 3 * known.label).setIdentity();
    row += 3;
  }
}

Eigen::VectorXd ArmResiduals::scales() const {
  Eigen::VectorXd out(columns());
  for (Index c = 0; c < columns(); ++c) out[c] = parameters_.parameters[free_[c]].scale;
  return out;
}

Eigen::MatrixXd ArmResiduals::linear_jacobian() const {
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(columns());
  return linear_rows_at(start.data()).leftCols(columns()) * scales().asDiagonal();
}

/// [J r] of priors and constraints; J in the units of the parameters.
Eigen::MatrixXd ArmResiduals::linear_rows_at(const double* y) const {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(rows() - data_rows(), columns() + 1);
  Index row = 0;
  for (Index c = 0; use_priors_ && c < columns(); ++c) {
    const Parameter& column = parameters_.parameters[free_[c]];
    if (column.prior_std == Parameter::kNoPrior) continue;
    out(row, c) = 1.0 / column.prior_std;
    out(row, columns()) = column.scale * y[c] / column.prior_std;
    ++row;
  }
  for (const LinearConstraint& linear : linear_) {
    for (Index c = 0; c < columns(); ++c) {
      if (free_[c] >= linear.coefficients.size()) continue;
      const double factor = linear.coefficients[free_[c]] / linear.std;
      out(row, c) = factor;
      out(row, columns()) += factor * parameters_.parameters[free_[c]].scale * y[c];
    }
    ++row;
  }
  return out;
}

void ArmResiduals::set_noise(const Noise& noise, const Eigen::VectorXd& x) {
  noise_ = noise;
  if (known_rows() == 0) return;
  Eigen::VectorXd residuals;
  Eigen::MatrixXd by_center;
  known_residuals(centroids(x), residuals, by_center);
  Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(3 * m_.points(), 3 * m_.points());
  const std::vector<Eigen::Matrix3d> precisions = centroid_precisions();
  for (Index p = 0; p < m_.points(); ++p) {
    spread.block<3, 3>(3 * p, 3 * p) =
        noise_.position * noise_.position * precisions[static_cast<std::size_t>(p)].inverse();
  }
  Eigen::MatrixXd covariance = by_center * spread * by_center.transpose();
  const auto distances = static_cast<Index>(m_.distances.size());
  covariance.diagonal().head(distances).array() += m_.distance_std * m_.distance_std;
  covariance.diagonal().tail(known_rows() - distances).array() += m_.point_std * m_.point_std;
  const Eigen::LLT<Eigen::MatrixXd> root(covariance);
  whitening_ = root.matrixL().solve(Eigen::MatrixXd::Identity(known_rows(), known_rows()));
}

void ArmResiduals::set_equal_noise(double unit) {
  noise_ = {unit, unit};
  whitening_ = Eigen::MatrixXd::Identity(known_rows(), known_rows()) / unit;
}

bool ArmResiduals::is_excluded(Index row) const {
  return observation_weights_[row] < 2.0 * selection::kExcludedWeight;
}

Eigen::Array2d ArmResiduals::free_rows() const {
  Eigen::Array2d rows(free_position_rows(m_), static_cast<double>(rotation_rows()));
  for (Index i = 0; i < m_.rows(); ++i) {
    if (is_excluded(i)) rows -= Eigen::Array2d(axes(i), m_.has_rotation() ? 3.0 : 0.0);
  }
  return rows;
}

double median_noise(const ArmResiduals& system, const Eigen::VectorXd& distances) {
  std::vector<double> sorted(distances.begin(), distances.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const auto estimated = static_cast<double>(system.columns());
  const double rows = free_position_rows(system.measurement());
  const auto all = static_cast<double>(3 * system.measurement().rows());
  const double share = rows > estimated ? std::sqrt(all / (rows - estimated)) : 1.0;
  return *middle / kMedianOfNorm * share;
}

}  // namespace bathyal
