// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/motion/internal/plan_goal.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "bathyal/arm/inverse.hpp"
#include "bathyal/base/error.hpp"

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
  std::vector<double> target;  ///< vehicle_from_tool, 16 numbers
  InverseOptions options;
};

Aim aim_of(const PlanCheck& check, const PlanGoal& goal) {
  const PlanOptions& plan = check.options();
  const Pose vehicle_from_world =
      check.workspace().surroundings().world_from_vehicle.at(plan.time).inverse();
  Aim aim;
  Pose tool = Pose::Identity();
  if (const Pose* pose = std::get_if<Pose>(&goal)) {
    tool = vehicle_from_world * *pose;
  } else {
    tool.translation() = vehicle_from_world * std::get<Vec3>(goal);
    aim.options.task = InverseTask::kPosition;
  }
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> matrix = tool.matrix();
  aim.target.assign(matrix.data(), matrix.data() + 16);
  aim.options.seed = plan.seed;
  aim.options.num_threads = 1;
  return aim;
}

/// The postures that are reached from the rows of `starts`.
InverseResult postures(const Arm& arm, const Aim& aim, const JointMatrix& starts, int max_starts) {
  std::vector<double> targets;
  for (Index i = 0; i < starts.rows(); ++i) {
    targets.insert(targets.end(), aim.target.begin(), aim.target.end());
  }
  InverseOptions options = aim.options;
  options.max_starts = max_starts;
  return inverse(arm, targets, view_of(starts), options);
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
  const InverseResult first = postures(arm, aim, from_start, kFirstStarts);
  if (first.status[0] != InverseStatus::kReached) return not_reached(first.status[0]);
  take(first.q.row(0));
  RandomStream random(check.options().seed, kGoalStream);
  for (int round = 0; round < kMostRounds && std::ssize(found.q) < wanted; ++round) {
    if (round > 0 && (!found.q.empty() || check.spent())) break;
    JointMatrix starts(wanted, start.size());
    for (Index i = 0; i < wanted; ++i) starts.row(i) = drawn_posture(arm, start, random);
    const InverseResult more = postures(arm, aim, starts, kStarts);
    for (Index i = 0; i < wanted && std::ssize(found.q) < wanted; ++i) {
      if (more.status[static_cast<std::size_t>(i)] == InverseStatus::kReached) take(more.q.row(i));
    }
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

JointRow drawn_posture(const Arm& arm, const JointRow& middle, RandomStream& random) {
  JointRow q = middle;
  const double length = chain_length(arm);
  for (const Joint& joint : arm.joints()) {
    const Index k = joint.coordinate;
    if (k < 0 || !joint.follows.empty()) continue;
    const double reach = joint.type == JointType::kPrismatic ? length : std::numbers::pi;
    const double low = arm.lower()[k], high = arm.upper()[k];
    q[k] = random.uniform(std::isfinite(low) ? low : std::min(middle[k], high) - reach,
                          std::isfinite(high) ? high : std::max(middle[k], low) + reach);
  }
  return q;
}

}  // namespace bathyal::workspace
