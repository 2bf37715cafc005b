// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/motion/internal/tip_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace bathyal::workspace {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Damping, squared: of J Jᵀ's trace, and of the squared length of what is wanted.
constexpr double kDampingOfTrace = 1e-7, kDampingOfWanted = 0.1;
constexpr double kHeld = 1e-8;      // off a bound that holds a step back [m], [rad]
constexpr double kCentering = 0.1;  // of the most a coordinate may change, at the end of its range

/// 3 × n: angular velocity of the tool for a unit speed of each coordinate.
MatrixXd turn_jacobian(const Arm& arm, const RowFrames& frames) {
  MatrixXd jacobian = MatrixXd::Zero(3, arm.size());
  for (std::size_t k = 0; k < arm.joints().size(); ++k) {
    const Joint& joint = arm.joints()[k];
    if (joint.coordinate < 0 || joint.type != JointType::kRevolute) continue;
    jacobian.col(joint.coordinate) += joint.multiplier * frames.world_from_row[k].linear().col(2);
  }
  return jacobian;
}

/// The rotation vector that takes one direction to another; about any normal where they oppose.
Vec3 turn_between(const Vec3& from, const Vec3& to) {
  const Vec3 cross = from.cross(to);
  const double sine = cross.norm(), angle = std::atan2(sine, from.dot(to));
  if (sine > 1e-12) return angle / sine * cross;
  return angle * from.unitOrthogonal();
}

Task damped_task(MatrixXd jacobian, const Vec3& wanted) {
  const double damping =
      1e-12 + kDampingOfTrace * jacobian.squaredNorm() + kDampingOfWanted * wanted.squaredNorm();
  return {std::move(jacobian), wanted, damping};
}

}  // namespace

TipError tip_error(const Pose& tip, const TipTarget& target) {
  TipError error{target.pose.translation() - tip.translation(), Vec3::Zero()};
  if (target.task == InverseTask::kPositionAxis) {
    error.turn = turn_between(tip.linear() * target.axis, target.pose.linear() * target.axis);
  } else if (target.task == InverseTask::kPose) {
    const Eigen::AngleAxisd turn(target.pose.linear() * tip.linear().transpose());
    error.turn = turn.angle() * turn.axis();
  }
  return error;
}

void TipStepper::set(const VectorXd& q, double time) {
  q_ = q;
  posture_.set({q_.data(), static_cast<std::size_t>(q_.size())}, time);
}

LinearBounds TipStepper::bounds(const std::vector<NearPair>& pairs) const {
  const Arm& arm = bodies_->arm;
  const auto count = std::ssize(pairs);
  LinearBounds bounds{(arm.lower() - q_).cwiseMax(-rules_.change).cwiseMin(0.0),
                      (arm.upper() - q_).cwiseMin(rules_.change).cwiseMax(0.0),
                      MatrixXd(count, arm.size()), VectorXd(count)};
  for (Index i = 0; i < count; ++i) {
    const NearPair& pair = pairs[static_cast<std::size_t>(i)];
    bounds.rows.row(i) = pair.gradient.transpose();
    bounds.least[i] = -rules_.approach * (pair.distance - rules_.clearance);
  }
  return bounds;
}

TipStep TipStepper::step(const TipTarget& target, const TipError& wanted, double comfort) const {
  const Arm& arm = bodies_->arm;
  const std::vector<NearPair> pairs =
      near_pairs(*bodies_, posture_, rules_.influence, rules_.tip_contact);
  const LinearBounds limits = bounds(pairs);

  std::vector<Task> tasks;
  tasks.push_back(
      damped_task(point_jacobian(arm, posture_.frames(), static_cast<int>(arm.joints().size()),
                                 tip().translation()),
                  wanted.offset));
  if (target.task != InverseTask::kPosition) {
    MatrixXd turning = turn_jacobian(arm, posture_.frames());
    if (target.task == InverseTask::kPositionAxis) {
      const Vec3 axis = tip().linear() * target.axis;
      turning -= axis * (axis.transpose() * turning).eval();
    }
    tasks.push_back(damped_task(std::move(turning), wanted.turn));
  }
  Task ease{MatrixXd::Identity(arm.size() + std::ssize(pairs), arm.size()),
            VectorXd::Zero(arm.size() + std::ssize(pairs))};
  for (Index k = 0; k < arm.size(); ++k) {
    const double half = 0.5 * (arm.upper()[k] - arm.lower()[k]);
    if (!std::isfinite(half) || half == 0.0) continue;
    const double place = (q_[k] - 0.5 * (arm.upper()[k] + arm.lower()[k])) / half;
    ease.wanted[k] = -comfort * kCentering * rules_.change[k] * place * place * place;
  }
  for (Index i = 0; i < std::ssize(pairs); ++i) {
    const NearPair& pair = pairs[static_cast<std::size_t>(i)];
    ease.jacobian.row(arm.size() + i) = pair.gradient.transpose();
    ease.wanted[arm.size() + i] =
        comfort * std::min(kCentering * (rules_.influence - pair.distance), 0.002);
  }
  tasks.push_back(std::move(ease));

  TipStep step{prioritized(tasks, limits).x, {}, {}};
  for (Index i = 0; i < std::ssize(pairs); ++i) {
    const double over = limits.rows.row(i).dot(step.change) - std::min(limits.least[i], 0.0);
    if (over < kHeld && pairs[static_cast<std::size_t>(i)].gradient.norm() > kHeld)
      step.pairs.push_back(pairs[static_cast<std::size_t>(i)]);
  }
  for (Index k = 0; k < arm.size(); ++k) {
    const double after = q_[k] + step.change[k];
    if (after - arm.lower()[k] < kHeld || arm.upper()[k] - after < kHeld) {
      step.limits.push_back(static_cast<int>(k));
    }
  }
  return step;
}

}  // namespace bathyal::workspace
