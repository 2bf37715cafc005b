// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/checks/internal/residual_structure.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "bathyal/estimation/f_distribution.hpp"
#include "bathyal/identify/checks/internal/limits.hpp"
#include "bathyal/identify/fit/observability.hpp"

namespace bathyal::identify {
namespace {

constexpr Index kMaxComparedPoses = 2000;
constexpr Index kFunctionsPerJoint = 2;                ///< of one joint
constexpr Index kRegressors = 3 * kFunctionsPerJoint;  ///< each along three axes
constexpr double kCollinear = 1e-3;                    ///< independent share of a regressor

/// The functions of joint j alone, at each of its values.
class JointFunctions {
 public:
  JointFunctions(const Arm& arm, const RowMatrix& q)
      : low_(q.colwise().minCoeff()),
        high_(q.colwise().maxCoeff()),
        slides_(static_cast<std::size_t>(arm.size()), false) {
    for (const Joint& joint : arm.joints()) {
      if (joint.type == JointType::kPrismatic) slides_[joint.coordinate] = true;
    }
  }

  std::array<double, kFunctionsPerJoint> operator()(Index joint, double q) const {
    if (!slides_[joint]) return {std::cos(q), std::sin(q)};
    const double range = high_[joint] - low_[joint];
    const double u = range > 0.0 ? 2.0 * (q - low_[joint]) / range - 1.0 : 0.0;
    return {u, 1.5 * u * u - 0.5};
  }

 private:
  Eigen::RowVectorXd low_;
  Eigen::RowVectorXd high_;
  std::vector<bool> slides_;
};

/// Subtracts the weighted mean over its point from each row of a touched point.
void center(const ArmResiduals& system, Eigen::MatrixXd& regressors) {
  const Measurement& m = system.measurement();
  std::vector<double> total(static_cast<std::size_t>(m.points()), 0.0);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(3 * m.points(), regressors.cols());
  for (Index i = 0; i < m.rows(); ++i) {
    if (m.point[i] < 0) continue;
    total[m.point[i]] += system.weight(i);
    sum.middleRows(3 * m.point[i], 3) += system.weight(i) * regressors.middleRows(3 * i, 3);
  }
  for (Index i = 0; i < m.rows(); ++i) {
    if (m.point[i] < 0) continue;
    regressors.middleRows(3 * i, 3) -= sum.middleRows(3 * m.point[i], 3) / total[m.point[i]];
  }
}

/// (3 N, regressors) effect of errors that depend on the joints on the weighted residuals.
Eigen::MatrixXd joint_regressors(const ArmResiduals& system, const Eigen::VectorXd& x,
                                 const RowMatrix& q) {
  const Measurement& m = system.measurement();
  const ArmState state = state_at(system.arm_parameters(), x);
  const JointFunctions functions(state.arm, q);
  Eigen::MatrixXd regressors(3 * m.rows(), kRegressors * m.q.cols());
  for (Index i = 0; i < m.rows(); ++i) {
    const Eigen::Matrix3d axes = state.bases[m.station[i]].linear();
    for (Index j = 0; j < m.q.cols(); ++j) {
      const auto values = functions(j, q(i, j));
      for (Index f = 0; f < kFunctionsPerJoint; ++f) {
        regressors.block<3, 3>(3 * i, kRegressors * j + 3 * f) = values[f] * axes;
      }
    }
  }
  center(system, regressors);
  for (Index i = 0; i < m.rows(); ++i) {
    regressors.middleRows(3 * i, 3) *= std::sqrt(system.weight(i));
    if (m.tracked || m.plane[i] < 0) continue;
    const Eigen::RowVectorXd along =
        state.planes[m.plane[i]].normal.transpose() * regressors.middleRows(3 * i, 3);
    regressors.middleRows(3 * i, 3).setZero();
    regressors.row(3 * i) = along;
  }
  for (Index c = 0; c < regressors.cols(); ++c) {
    const double length = regressors.col(c).norm();
    if (length > 0.0) regressors.col(c) /= length;
  }
  return regressors;
}

struct Explained {
  double squares = 0.0;
  double functions = 0.0;
};

/// Regressors added one at a time, each by its component orthogonal to those before, from their
/// Gram matrix `square` and their products with the residuals, `along`. The tolerance is far above
/// the rounding errors of a Gram matrix.
Explained explain(Eigen::MatrixXd square, Eigen::VectorXd along) {
  Explained out;
  for (Index step = 0; step < along.size(); ++step) {
    Index next = 0;
    const double pivot = square.diagonal().maxCoeff(&next);
    if (!(pivot > kCollinear * kCollinear)) break;
    const Eigen::VectorXd column = square.col(next) / std::sqrt(pivot);
    const double component = along[next] / std::sqrt(pivot);
    out.squares += component * component;
    out.functions += 1.0;
    square.noalias() -= column * column.transpose();
    along -= component * column;
  }
  return out;
}

/// An orthonormal basis of the column space of the Jacobian of the positions. Deviations of touches
/// from their centroids are themselves a change of scale: with the scale included, it would absorb
/// all residuals, so it is fixed.
Eigen::MatrixXd parameter_space(Eigen::MatrixXd jacobian, const Eigen::VectorXd& residuals,
                                bool hold_size) {
  constexpr double kDependent = 1e-9;
  constexpr double kWeak = 1e-4;  // what regressors so little has no part in residuals of this size
  const Index columns = jacobian.cols();
  const Eigen::HouseholderQR<Eigen::MatrixXd> first(jacobian);
  Eigen::MatrixXd triangle = first.matrixQR().topRows(columns).triangularView<Eigen::Upper>();
  if (hold_size) {
    Eigen::VectorXd turned = residuals;
    turned.applyOnTheLeft(first.householderQ().adjoint());
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(triangle);
    qr.setThreshold(kDependent);
    const Eigen::VectorXd growth = qr.solve(turned.head(columns));
    if ((triangle * growth).squaredNorm() > 0.5 * turned.squaredNorm()) {
      const Eigen::RowVectorXd share = growth.transpose() / growth.squaredNorm();
      triangle -= (triangle * growth) * share;
      jacobian -= (jacobian * growth) * share;
    }
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> second;
  second.setThreshold(kWeak);
  second.compute(triangle);
  const Index rank = second.rank();
  Eigen::MatrixXd basis = (jacobian * second.colsPermutation()).leftCols(rank);
  second.matrixR()
      .topLeftCorner(rank, rank)
      .triangularView<Eigen::Upper>()
      .solveInPlace<Eigen::OnTheRight>(basis);
  return basis;
}

bool slides(const Arm& arm) {
  return std::any_of(arm.joints().begin(), arm.joints().end(),
                     [](const Joint& joint) { return joint.type == JointType::kPrismatic; });
}

ResidualStructure test(ArmResiduals& system, const Eigen::VectorXd& x) {
  const Measurement& m = system.measurement();
  const Index rows = 3 * m.rows();
  ResidualStructure out;
  if (system.columns() == 0 || rows <= system.columns()) return out;
  Eigen::VectorXd residuals(system.rows());
  Eigen::MatrixXd jacobian(system.rows(), system.columns());
  system.evaluate(system.scaled(x).data(), residuals.data(), jacobian.data());
  residuals.conservativeResize(rows);
  RowMatrix q = m.q;
  if (!m.tracked && slides(system.arm_parameters().arm)) {
    // At joints as they were recorded, travel and an arm that shrinks by as much would together
    // make the residuals of touches, and these would pass for something that follows the joint.
    q = consistent_joints(system, x);
    system.set_joints(q);
    jacobian = system.jacobian(x);
  }
  const Eigen::MatrixXd basis = parameter_space(jacobian.topRows(rows), residuals, !m.tracked);
  const Eigen::VectorXd projected = residuals - basis * (basis.transpose() * residuals);

  const Eigen::MatrixXd regressors = joint_regressors(system, x, q);
  const Eigen::MatrixXd within = basis.transpose() * regressors;
  Eigen::MatrixXd square = Eigen::MatrixXd::Zero(regressors.cols(), regressors.cols());
  square.selfadjointView<Eigen::Lower>().rankUpdate(regressors.transpose());
  square.selfadjointView<Eigen::Lower>().rankUpdate(within.transpose(), -1.0);
  square.triangularView<Eigen::StrictlyUpper>() = square.transpose();
  const Eigen::VectorXd along = regressors.transpose() * projected;

  const double dof = system.free_rows()[0] - static_cast<double>(basis.cols());
  const double squares = projected.squaredNorm();
  const Explained all = explain(square, along);
  if (all.functions < 1.0 || dof - all.functions < Limits::kStructureDof) return out;
  const FTest together = f_test(all.squares, all.functions, squares, dof);
  out.p = together.p;
  out.share = together.share;
  if (out.p > Limits::kJointP) return out;
  for (int j = 0; j < m.q.cols(); ++j) {
    const Index at = kRegressors * j;
    const Explained alone =
        explain(square.block(at, at, kRegressors, kRegressors), along.segment(at, kRegressors));
    if (alone.functions < 1.0) continue;
    const double share = f_test(alone.squares, alone.functions, squares, dof).share;
    if (share > out.joint_share) {
      out.coordinate = j;
      out.joint_share = share;
    }
  }
  return out;
}

}  // namespace

ResidualStructure test_residual_structure(const ArmResiduals& system, const Eigen::VectorXd& x,
                                          const std::vector<double>& weights) {
  const Measurement& all = system.measurement();
  if (all.rows() <= kMaxComparedPoses) {
    ArmResiduals tested = system;
    tested.set_criterion(Criterion::kCentroid, false);
    tested.set_observation_weights(weights);
    return test(tested, x);
  }
  const Index stride = (all.rows() + kMaxComparedPoses - 1) / kMaxComparedPoses;
  std::vector<int> rows;
  std::vector<double> some_weights;
  for (Index i = 0; i < all.rows(); i += stride) {
    rows.push_back(static_cast<int>(i));
    some_weights.push_back(weights[i]);
  }
  Measurement sample = subset(all, rows);
  sample.distances.clear();  // a point may have lost its touches
  sample.known_points.clear();
  ArmResiduals tested(system.arm_parameters(), sample, Criterion::kCentroid, false, 1);
  tested.set_free(system.free());
  tested.set_observation_weights(std::move(some_weights));
  tested.set_noise(system.noise(), x);
  return test(tested, x);
}

}  // namespace bathyal::identify
