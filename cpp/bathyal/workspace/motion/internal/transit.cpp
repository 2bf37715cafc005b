// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/motion/internal/transit.hpp"

#include <algorithm>

#include "bathyal/workspace/motion/internal/tip_motion.hpp"
#include "bathyal/workspace/motion/plan.hpp"

namespace bathyal::workspace {
namespace {

using Eigen::VectorXd;

constexpr double kTurn = 0.05;                      // of the tool that is let go on the way [rad]
constexpr double kNear = 2e-3;                      // of the tip [m]
constexpr double kAcrossClearance = 3;              // times that on the path
constexpr int kMostChecks = 4000;                   // of the planner
constexpr double kLowerLifts[] = {1.0, 0.5, 0.25};  // times `lift`, where it cannot be had

/// The rows of both, the second beginning where the first ends.
JointMatrix joined(const JointMatrix& one, const JointMatrix& other) {
  JointMatrix all(one.rows() + other.rows() - 1, one.cols());
  all << one, other.bottomRows(other.rows() - 1);
  return all;
}

VectorXd last_row(const JointMatrix& rows) { return rows.bottomRows(1).transpose(); }

}  // namespace

Transit::Transit(const Workspace& ws, const PathFollower& follower, const FollowOptions& options)
    : ws_(ws), follower_(follower), options_(options) {}

std::optional<JointMatrix> Transit::moved(const VectorXd& q, const TipTarget& target,
                                          TipContact contact) const {
  MoveOptions options;
  options.task = target.task;
  options.position_tolerance = kNear;
  options.angle_tolerance = kTurn;
  options.speed = options_.transit_speed;
  options.angular_rate = options_.transit_rate;
  options.period = 0.05;
  options.velocity = options_.velocity;
  options.clearance =
      contact == TipContact::kAllowed ? options_.clearance : kAcrossClearance * options_.clearance;
  options.influence = std::max(options_.influence, 2.0 * options.clearance);
  options.max_steps = 1000;
  options.tip_contact = contact;
  options.time = options_.time;
  TipMotion motion =
      damped_motion(ws_, {q.data(), static_cast<std::size_t>(q.size())}, target, options);
  if (motion.end != TipMotion::End::kReached) return std::nullopt;
  return std::move(motion.rows);
}

std::optional<JointMatrix> Transit::lifted(const VectorXd& q, std::int32_t sample) const {
  for (const double share : kLowerLifts) {
    auto up = moved(q, follower_.lifted(sample, share * options_.lift), follower_.tip_contact());
    if (!up) continue;
    const VectorXd top = last_row(*up);
    if (ws_.check_motion(JointView(top.data(), 1, top.size())).free) return up;
  }
  return std::nullopt;
}

std::optional<JointMatrix> Transit::stepped(const VectorXd& q, std::int32_t from,
                                            std::int32_t to) const {
  const auto up = lifted(q, from);
  if (!up) return std::nullopt;
  const auto across =
      moved(last_row(*up), follower_.lifted(to, options_.lift), TipContact::kForbidden);
  if (!across) return std::nullopt;
  const auto down = moved(last_row(*across), follower_.target(to), follower_.tip_contact());
  if (!down) return std::nullopt;
  return joined(joined(*up, *across), *down);
}

std::optional<JointMatrix> Transit::planned(const VectorXd& q, std::int32_t from,
                                            const VectorXd& end, std::int32_t to) const {
  const auto up = lifted(q, from), back = lifted(end, to);
  if (!up || !back) return std::nullopt;
  JointMatrix across(2, q.size());
  across << last_row(*up).transpose(), last_row(*back).transpose();
  if (!ws_.check_motion(view_of(across)).free) {
    PlanOptions options;
    options.seed = options_.seed;
    options.max_checks = kMostChecks;
    options.limits.velocity = options_.velocity;
    options.limits.acceleration = options_.acceleration;
    options.time = options_.time;
    const std::vector<double> goal(across.data() + q.size(), across.data() + 2 * q.size());
    Plan plan =
        plan_motion(ws_, {across.data(), static_cast<std::size_t>(q.size())}, goal, options);
    if (plan.status != PlanStatus::kSolved) return std::nullopt;
    across = std::move(plan.path);
    across.row(0) = up->bottomRows(1);
    across.bottomRows(1) = back->bottomRows(1);
  }
  const JointMatrix down = back->colwise().reverse();
  return joined(joined(*up, across), down);
}

}  // namespace bathyal::workspace
