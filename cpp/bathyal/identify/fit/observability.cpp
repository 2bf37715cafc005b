// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/fit/observability.hpp"

#include <numeric>

#include "bathyal/identify/model/nearest_pose.hpp"

namespace bathyal {
namespace {

constexpr double kEqualNoise = 1e-3;     ///< [m] and [rad]: unit of the singular values
constexpr double kConstraintStd = 1e-3;  ///< in units of the parameter scales

/// Directions of the free parameters among all parameters.
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

Observability observe(const ArmResiduals& system, const Eigen::VectorXd& x) {
  const auto count = static_cast<Index>(system.arm_parameters().parameters.size());
  std::vector<int> all(static_cast<std::size_t>(count));
  std::iota(all.begin(), all.end(), 0);
  ArmResiduals data = system;
  data.set_joints(consistent_joints(system, x));
  data.set_criterion(Criterion::kCentroid, false);
  data.set_free(all);
  data.set_equal_noise(kEqualNoise);
  data.set_use_priors(false);
  data.set_linear_constraints({});
  const Eigen::MatrixXd jacobian = qr_factor(data.jacobian(x), system.num_threads());

  const std::vector<int>& free = system.free();
  const Eigen::MatrixXd null_space = null_space_of(jacobian(Eigen::all, free));

  // Of what the data do not observe, priors determine what changes any of them.
  const Eigen::MatrixXd by_priors = system.linear_jacobian().rowwise().normalized() * null_space;
  const Eigen::MatrixXd undetermined = null_space * null_space_of(by_priors);
  return {numerical_rank(jacobian), among_all(null_space, free, count),
          among_all(undetermined, free, count)};
}

std::vector<LinearConstraint> undetermined_constraints(const Eigen::MatrixXd& undetermined,
                                                       const std::vector<Parameter>& parameters) {
  std::vector<LinearConstraint> rows;
  for (Index k = 0; k < undetermined.cols(); ++k) {
    LinearConstraint row{undetermined.col(k), kConstraintStd};
    for (Index i = 0; i < undetermined.rows(); ++i) row.coefficients[i] /= parameters[i].scale;
    rows.push_back(std::move(row));
  }
  return rows;
}

Eigen::MatrixXd free_covariance(const ArmResiduals& system, const Eigen::VectorXd& x,
                                const Eigen::MatrixXd& undetermined) {
  ArmResiduals consistent = system;
  consistent.set_joints(consistent_joints(system, x));
  // Pair residuals are correlated; those about a centroid lose exactly one touch.
  consistent.set_criterion(Criterion::kCentroid, false);
  consistent.set_linear_constraints({});
  const Eigen::MatrixXd jacobian = qr_factor(consistent.jacobian(x), system.num_threads());
  if (undetermined.cols() == 0) return covariance_from_qr(jacobian);
  const Eigen::MatrixXd basis = complement(undetermined(system.free(), Eigen::all));
  return basis * covariance_from_qr(jacobian * basis) * basis.transpose();
}

RowMatrix consistent_joints(const ArmResiduals& system, const Eigen::VectorXd& x) {
  const Measurement& m = system.measurement();
  RowMatrix q = m.q;
  if (m.tracked) return q;
  const Eigen::Matrix3Xd centers = system.centroids(x);
  const ChainDerivatives chain(system.arm_parameters(), x, {});
  ChainFrames frames;
  for (Index i = 0; i < q.rows(); ++i) {
    const auto miss = [&](const Vec3& tip) {
      return miss_of(m, i, tip, centers, chain.state().planes);
    };
    q.row(i) = nearest_pose(chain, m.q.row(i), m.perturbation_row(i), m.tool[i], m.station[i],
                            frames, miss);
  }
  return q;
}

}  // namespace bathyal
