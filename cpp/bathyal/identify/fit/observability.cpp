// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/fit/observability.hpp"

#include <numeric>

#include "bathyal/identify/model/nearest_pose.hpp"

namespace bathyal {
namespace {

constexpr double kEqualNoise = 1e-3;     ///< [m] and [rad]: what a singular value of 1 stands for
constexpr double kHeldDirection = 1e-3;  ///< in units of the columns' scale

/// Directions of the free columns as those of all, of which the others take no part.
Eigen::MatrixXd among_all(const Eigen::MatrixXd& rows, const std::vector<int>& free, Index count) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(count, rows.cols());
  all(free, Eigen::all) = rows;
  return all;
}

/// An orthonormal basis of all that is orthogonal to the independent columns of `directions`.
Eigen::MatrixXd complement(const Eigen::MatrixXd& directions) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(directions);
  return Eigen::MatrixXd(qr.householderQ()).rightCols(directions.rows() - directions.cols());
}

/// The residual by which a touch misses its point or its plane.
Vec3 miss_of(const Measurement& m, Index row, const Vec3& tip, const Eigen::Matrix3Xd& centers,
             const std::vector<PlaneGuess>& planes) {
  if (m.point[row] >= 0) return centers.col(m.point[row]) - tip;
  const PlaneGuess& plane = planes[m.plane[row]];
  return (plane.offset - plane.normal.dot(tip - plane.center)) * plane.normal;
}

}  // namespace

Observability observe(const ArmSystem& system, const Eigen::VectorXd& x) {
  const auto count = static_cast<Index>(system.arm_columns().columns.size());
  std::vector<int> all(static_cast<std::size_t>(count));
  std::iota(all.begin(), all.end(), 0);
  ArmSystem data = system;
  data.set_joints(exact_joints(system, x));
  data.set_criterion(Criterion::kCentroid, false);
  data.set_free(all);
  data.set_equal_noise(kEqualNoise);
  data.set_use_priors(false);
  data.set_linear_rows({});
  const Eigen::MatrixXd jacobian = triangle_of(data.jacobian(x), system.num_threads());

  const std::vector<int>& free = system.free();
  const Eigen::MatrixXd unseen = unseen_of(jacobian(Eigen::all, free));

  // Of what the data do not see, priors hold what moves any of them.
  const Eigen::MatrixXd told = system.linear_jacobian().rowwise().normalized() * unseen;
  const Eigen::MatrixXd blind = unseen * unseen_of(told);
  return {reveal_rank(jacobian), among_all(unseen, free, count), among_all(blind, free, count)};
}

std::vector<LinearRow> rows_to_hold(const Eigen::MatrixXd& blind,
                                    const std::vector<Column>& columns) {
  std::vector<LinearRow> rows;
  for (Index k = 0; k < blind.cols(); ++k) {
    LinearRow row{blind.col(k), kHeldDirection};
    for (Index i = 0; i < blind.rows(); ++i) row.coefficients[i] /= columns[i].scale;
    rows.push_back(std::move(row));
  }
  return rows;
}

Eigen::MatrixXd free_covariance(const ArmSystem& system, const Eigen::VectorXd& x,
                                const Eigen::MatrixXd& blind) {
  ArmSystem exact = system;
  exact.set_joints(exact_joints(system, x));
  // Pair residuals are correlated; those about a centroid lose one touch to it, and no more.
  exact.set_criterion(Criterion::kCentroid, false);
  exact.set_linear_rows({});
  const Eigen::MatrixXd jacobian = triangle_of(exact.jacobian(x), system.num_threads());
  if (blind.cols() == 0) return inverse_square(jacobian);
  const Eigen::MatrixXd left = complement(blind(system.free(), Eigen::all));
  return left * inverse_square(jacobian * left) * left.transpose();
}

RowMatrix exact_joints(const ArmSystem& system, const Eigen::VectorXd& x) {
  const Measurement& m = system.measurement();
  RowMatrix q = m.q;
  if (m.tracked) return q;
  const Eigen::Matrix3Xd centers = system.centroids(x);
  const TipWalk walk(system.arm_columns(), x, {});
  WalkFrames frames;
  for (Index i = 0; i < q.rows(); ++i) {
    const auto miss = [&](const Vec3& tip) {
      return miss_of(m, i, tip, centers, walk.state().planes);
    };
    q.row(i) =
        nearest_pose(walk, m.q.row(i), m.action_row(i), m.tool[i], m.station[i], frames, miss);
  }
  return q;
}

}  // namespace bathyal
