// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/motion/internal/plan_goal.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "bathyal/base/error.hpp"
#include "bathyal/workspace/internal/postures.hpp"

namespace bathyal::workspace {
namespace {

constexpr std::uint64_t kGoalStream = 1;
constexpr int kFirstStarts = 64;  // to find out whether a goal can be reached at all
constexpr int kStarts = 4;        // to find one more posture
constexpr int kMostRounds = 8;    // of as many postures as are asked for

JointRow row_of(const std::vector<double>& q) {
  return Eigen::Map<const JointRow>(q.data(), static_cast<Index>(q.size()));
}

bool inside_limits(const Arm& arm, const JointRow& q) {
  const JointMatrix row = q;
  return within_limits(arm, view_of(row))[0];
}

GoalPostures of_joints(PlanCheck& check, const JointRow& q) {
  if (!inside_limits(check.arm(), q)) {
    return {{}, PlanStatus::kGoalOutsideLimits, "The goal is outside the joint limits."};
  }
  if (!check.is_free(q)) {
    return {{},
            PlanStatus::kGoalInCollision,
            "At the goal " + contact_text(check.workspace(), check.clearance(q)) + "."};
  }
  return {{q}, PlanStatus::kSolved, ""};
}

struct Aim {
  Pose target;  ///< vehicle_from_tool
  InverseOptions options;
};

Aim aim_of(const PlanCheck& check, const PlanGoal& goal) {
  const PlanOptions& plan = check.options();
  const Pose vehicle_from_world =
      check.workspace().surroundings().world_from_vehicle.at(plan.time).inverse();
  Aim aim;
  aim.target = Pose::Identity();
  if (const Pose* pose = std::get_if<Pose>(&goal)) {
    aim.target = vehicle_from_world * *pose;
  } else {
    aim.target.translation() = vehicle_from_world * std::get<Vec3>(goal);
    aim.options.task = InverseTask::kPosition;
  }
  aim.options.seed = plan.seed;
  aim.options.num_threads = 1;
  return aim;
}

ReachedPostures postures(const Arm& arm, const Aim& aim, const JointMatrix& starts,
                         int max_starts) {
  InverseOptions options = aim.options;
  options.max_starts = max_starts;
  return reached_postures(arm, aim.target, starts, options);
}

GoalPostures not_reached(InverseStatus status) {
  if (status == InverseStatus::kLimit) {
    return {{},
            PlanStatus::kGoalOutsideLimits,
            "The goal is reached only by postures outside the joint limits."};
  }
  return {{}, PlanStatus::kUnreachable, "No posture was found that reaches the goal."};
}

/// By whole turns as near to `start` as the limits allow: turning joints without limits.
void unwind(const Arm& arm, const JointRow& start, JointRow& q) {
  for (const Joint& joint : arm.joints()) {
    const Index k = joint.coordinate;
    const bool turns = k >= 0 && joint.type == JointType::kRevolute && joint.follows.empty() &&
                       !std::isfinite(arm.lower()[k]) && !std::isfinite(arm.upper()[k]);
    const bool alone =
        std::ranges::count_if(arm.joints(), [&](const Joint& j) { return j.coordinate == k; }) == 1;
    if (turns && alone && std::abs(joint.multiplier) == 1.0) {
      constexpr double kTurn = 2.0 * std::numbers::pi;
      q[k] -= kTurn * std::round((q[k] - start[k]) / kTurn);
    }
  }
}

GoalPostures of_aim(PlanCheck& check, const JointRow& start, const Aim& aim) {
  const Arm& arm = check.arm();
  const int wanted = check.options().goal_postures;
  GoalPostures found;
  JointRow touching;
  const auto take = [&](JointRow q) {
    unwind(arm, start, q);
    if (check.is_free(q)) {
      found.q.push_back(std::move(q));
    } else {
      touching = std::move(q);
    }
  };
  const JointMatrix from_start = start;
  const ReachedPostures first = postures(arm, aim, from_start, kFirstStarts);
  if (first.q.rows() == 0) return not_reached(first.status);
  take(first.q.row(0));
  RandomStream random(check.options().seed, kGoalStream);
  for (int round = 0; round < kMostRounds && std::ssize(found.q) < wanted; ++round) {
    if (round > 0 && (!found.q.empty() || check.spent())) break;
    JointMatrix starts(wanted, start.size());
    for (Index i = 0; i < wanted; ++i) starts.row(i) = drawn_posture(arm, start, random);
    const JointMatrix more = postures(arm, aim, starts, kStarts).q;
    for (Index i = 0; i < more.rows() && std::ssize(found.q) < wanted; ++i) take(more.row(i));
  }
  if (found.q.empty()) {
    return {{},
            PlanStatus::kGoalInCollision,
            "Every posture found that reaches the goal touches something; in one of them " +
                contact_text(check.workspace(), check.clearance(touching)) + "."};
  }
  std::ranges::stable_sort(found.q, {}, [&](const JointRow& q) { return (q - start).norm(); });
  return found;
}

}  // namespace

void check_goal(const Arm& arm, const PlanGoal& goal) {
  if (const auto* joints = std::get_if<std::vector<double>>(&goal)) {
    check_joint_values(arm, JointView(joints->data(), 1, static_cast<Index>(joints->size())),
                       "goal");
  } else if (const Pose* pose = std::get_if<Pose>(&goal)) {
    check_rigid("pose", *pose);
  } else if (!std::get<Vec3>(goal).allFinite()) {
    throw_argument("point", "finite coordinates", "one that is not");
  }
}

GoalPostures goal_postures(PlanCheck& check, const JointRow& start, const PlanGoal& goal) {
  if (const auto* joints = std::get_if<std::vector<double>>(&goal)) {
    return of_joints(check, row_of(*joints));
  }
  return of_aim(check, start, aim_of(check, goal));
}

}  // namespace bathyal::workspace
