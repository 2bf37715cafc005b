// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/checks/internal/residual_structure.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "bathyal/estimation/f_distribution.hpp"
#include "bathyal/identify/fit/observability.hpp"

namespace bathyal {
namespace {

constexpr Index kMaxComparedPoses = 2000;
constexpr Index kFunctions = 2;           ///< of one joint
constexpr Index kMoves = 3 * kFunctions;  ///< each along three axes
constexpr double kBeside = 1e-3;          ///< what is left of a move once the arm took its part
constexpr double kWorthAsking = 0.01;     ///< which joint it is
constexpr double kLeastFreedom = 5.0;     ///< left for the noise

/// What follows joint j alone, at each of its values.
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

  std::array<double, kFunctions> operator()(Index joint, double q) const {
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

/// Takes from each row of a touched point what the point's centre takes: the weighted mean.
void center(const ArmSystem& system, Eigen::MatrixXd& moves) {
  const Measurement& m = system.measurement();
  std::vector<double> total(static_cast<std::size_t>(m.points()), 0.0);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(3 * m.points(), moves.cols());
  for (Index i = 0; i < m.rows(); ++i) {
    if (m.point[i] < 0) continue;
    total[m.point[i]] += system.weight(i);
    sum.middleRows(3 * m.point[i], 3) += system.weight(i) * moves.middleRows(3 * i, 3);
  }
  for (Index i = 0; i < m.rows(); ++i) {
    if (m.point[i] < 0) continue;
    moves.middleRows(3 * i, 3) -= sum.middleRows(3 * m.point[i], 3) / total[m.point[i]];
  }
}

/// (3 N, moves) what errors that follow the joints do to the residuals, as these are weighed.
Eigen::MatrixXd joint_moves(const ArmSystem& system, const Eigen::VectorXd& x, const RowMatrix& q) {
  const Measurement& m = system.measurement();
  const ArmState state = state_at(system.arm_columns(), x);
  const JointFunctions functions(state.arm, q);
  Eigen::MatrixXd moves(3 * m.rows(), kMoves * m.q.cols());
  for (Index i = 0; i < m.rows(); ++i) {
    const Eigen::Matrix3d axes = state.bases[m.station[i]].linear();
    for (Index j = 0; j < m.q.cols(); ++j) {
      const auto values = functions(j, q(i, j));
      for (Index f = 0; f < kFunctions; ++f) {
        moves.block<3, 3>(3 * i, kMoves * j + 3 * f) = values[f] * axes;
      }
    }
  }
  center(system, moves);
  for (Index i = 0; i < m.rows(); ++i) {
    moves.middleRows(3 * i, 3) *= std::sqrt(system.weight(i));
    if (m.tracked || m.plane[i] < 0) continue;
    const Eigen::RowVectorXd along =
        state.planes[m.plane[i]].normal.transpose() * moves.middleRows(3 * i, 3);
    moves.middleRows(3 * i, 3).setZero();
    moves.row(3 * i) = along;
  }
  for (Index c = 0; c < moves.cols(); ++c) {
    const double length = moves.col(c).norm();
    if (length > 0.0) moves.col(c) /= length;
  }
  return moves;
}

struct Explained {
  double squares = 0.0;
  double functions = 0.0;
};

/// Moves taken one by one, by what each still adds to those before, from their `square` and how
/// much each goes `along` the residuals. What is asked of a move is far above what a square loses.
Explained explain(Eigen::MatrixXd square, Eigen::VectorXd along) {
  Explained out;
  for (Index step = 0; step < along.size(); ++step) {
    Index next = 0;
    const double pivot = square.diagonal().maxCoeff(&next);
    if (!(pivot > kBeside * kBeside)) break;
    const Eigen::VectorXd column = square.col(next) / std::sqrt(pivot);
    const double taken = along[next] / std::sqrt(pivot);
    out.squares += taken * taken;
    out.functions += 1.0;
    square.noalias() -= column * column.transpose();
    along -= taken * column;
  }
  return out;
}

/// Share of the variance that is gone with the functions.
double share_of(const Explained& explained, double squares, double freedom) {
  const double left = (squares - explained.squares) / (freedom - explained.functions);
  return squares > 0.0 ? std::clamp(1.0 - left * freedom / squares, 0.0, 1.0) : 0.0;
}

double rows_trusted(const Measurement& m, const std::vector<double>& trust) {
  double rows = free_position_rows(m);
  for (Index i = 0; i < m.rows(); ++i) {
    if (trust[i] < 1e-6) rows -= !m.tracked && m.plane[i] >= 0 ? 1.0 : 3.0;
  }
  return rows;
}

/// An orthonormal basis of what the arm's columns can do to the positions. Touches about their
/// centres are what a growing arm does to them: left in, the arm's size would take all residuals
/// with it. It is held.
Eigen::MatrixXd arm_space(Eigen::MatrixXd jacobian, const Eigen::VectorXd& residuals,
                          bool hold_size) {
  constexpr double kDependent = 1e-9;
  constexpr double kWeak = 1e-4;  // what moves so little has no part in residuals of this size
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

JointStructure test(ArmSystem& system, const Eigen::VectorXd& x) {
  const Measurement& m = system.measurement();
  const Index rows = 3 * m.rows();
  JointStructure out;
  if (system.columns() == 0 || rows <= system.columns()) return out;
  Eigen::VectorXd residuals(system.rows());
  Eigen::MatrixXd jacobian(system.rows(), system.columns());
  system.evaluate(system.scaled(x).data(), residuals.data(), jacobian.data());
  residuals.conservativeResize(rows);
  RowMatrix q = m.q;
  if (!m.tracked && slides(system.arm_columns().arm)) {
    // At joints as they were recorded, travel and an arm that shrinks by as much would together
    // make the residuals of touches, and these would pass for something that follows the joint.
    q = exact_joints(system, x);
    system.set_joints(q);
    jacobian = system.jacobian(x);
  }
  const Eigen::MatrixXd basis = arm_space(jacobian.topRows(rows), residuals, !m.tracked);
  const Eigen::VectorXd left = residuals - basis * (basis.transpose() * residuals);

  const Eigen::MatrixXd moves = joint_moves(system, x, q);
  const Eigen::MatrixXd inside = basis.transpose() * moves;
  Eigen::MatrixXd square = Eigen::MatrixXd::Zero(moves.cols(), moves.cols());
  square.selfadjointView<Eigen::Lower>().rankUpdate(moves.transpose());
  square.selfadjointView<Eigen::Lower>().rankUpdate(inside.transpose(), -1.0);
  square.triangularView<Eigen::StrictlyUpper>() = square.transpose();
  const Eigen::VectorXd along = moves.transpose() * left;

  const double freedom = rows_trusted(m, system.trust()) - static_cast<double>(basis.cols());
  const double squares = left.squaredNorm();
  const Explained all = explain(square, along);
  const double below = freedom - all.functions;
  if (all.functions < 1.0 || below < kLeastFreedom) return out;
  const double noise = std::max(squares - all.squares, 0.0) / below;
  out.p = noise > 0.0 ? f_tail(all.squares / all.functions / noise, all.functions, below) : 1.0;
  out.share = share_of(all, squares, freedom);
  if (out.p > kWorthAsking) return out;
  for (int j = 0; j < m.q.cols(); ++j) {
    const Index at = kMoves * j;
    const Explained alone =
        explain(square.block(at, at, kMoves, kMoves), along.segment(at, kMoves));
    const double share = share_of(alone, squares, freedom);
    if (share > out.joint_share) {
      out.coordinate = j;
      out.joint_share = share;
    }
  }
  return out;
}

}  // namespace

JointStructure find_structure(const ArmSystem& system, const Eigen::VectorXd& x,
                              const std::vector<double>& trust) {
  const Measurement& all = system.measurement();
  if (all.rows() <= kMaxComparedPoses) {
    ArmSystem asked = system;
    asked.set_criterion(Criterion::kCentroid, false);
    asked.set_trust(trust);
    return test(asked, x);
  }
  const Index stride = (all.rows() + kMaxComparedPoses - 1) / kMaxComparedPoses;
  std::vector<int> rows;
  std::vector<double> some_trust;
  for (Index i = 0; i < all.rows(); i += stride) {
    rows.push_back(static_cast<int>(i));
    some_trust.push_back(trust[i]);
  }
  Measurement some = some_of(all, rows);
  some.distances.clear();  // a point may have lost its touches
  some.known_points.clear();
  ArmSystem asked(system.arm_columns(), some, Criterion::kCentroid, false, 1);
  asked.set_free(system.free());
  asked.set_trust(std::move(some_trust));
  asked.set_noise(system.noise(), x);
  return test(asked, x);
}

}  // namespace bathyal
