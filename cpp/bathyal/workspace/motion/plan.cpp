// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/motion/plan.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/workspace/motion/internal/path_search.hpp"
#include "bathyal/workspace/motion/internal/plan_check.hpp"
#include "bathyal/workspace/motion/internal/plan_goal.hpp"
#include "bathyal/workspace/motion/internal/way_out.hpp"

namespace bathyal {
namespace {

using workspace::JointRow;
using workspace::PlanCheck;
using workspace::Postures;

constexpr int kAttempts = 6;  // of search and timing, until the timed motion is free
constexpr int kMovingAttempts = 24;
constexpr int kRoundings = 12;     // of one path
constexpr double kSmaller = 0.25;  // of a corner that touches
constexpr double kLeastTolerance = 1e-3;

JointMatrix matrix_of(const Postures& path) {
  JointMatrix rows(static_cast<Index>(path.size()), path.front().size());
  for (std::size_t i = 0; i < path.size(); ++i) rows.row(static_cast<Index>(i)) = path[i];
  return rows;
}

/// Makes the corners smaller between which a motion touches; false where they are stops already.
bool round_less(std::vector<double>& tolerance, double along) {
  bool changed = false;
  const auto first = static_cast<std::size_t>(std::max(0.0, std::floor(along - 0.5)));
  for (std::size_t i = first; i < std::min(first + 3, tolerance.size()); ++i) {
    if (tolerance[i] == 0.0) continue;
    tolerance[i] *= kSmaller;
    if (tolerance[i] < kLeastTolerance) tolerance[i] = 0.0;
    changed = true;
  }
  return changed;
}

/// Times a path and checks the rows: false where no rounding makes them free. Where they touch is
/// then asked for at that time, too.
bool time_and_check(PlanCheck& check, const Postures& path, Plan& plan) {
  const JointMatrix rows = matrix_of(path);
  TimingOptions timing = check.options().timing;
  timing.row_tolerance.assign(path.size(), timing.tolerance);
  for (int i = 0; i < kRoundings; ++i) {
    TimedMotion motion = time_motion(check.arm(), view_of(rows), check.options().limits, timing);
    const auto inside = within_limits(check.arm(), view_of(motion.q));
    if (!std::ranges::all_of(inside, [](bool yes) { return yes; })) return false;
    const MotionCheck contact = check.motion(motion.q, motion.time);
    if (contact.free) {
      plan.path = std::move(motion.q);
      plan.time = std::move(motion.time);
      return true;
    }
    const auto row = static_cast<std::size_t>(contact.contact);
    if (check.late() || !round_less(timing.row_tolerance, motion.along[row])) {
      if (check.workspace().moves()) {
        check.also_at(check.options().time + motion.time[row]);
        check.also_at(check.options().time + motion.time.back());
      }
      return false;
    }
  }
  return false;
}

Plan refused(PlanStatus status, std::string reason) {
  Plan plan;
  plan.status = status;
  plan.reason = std::move(reason);
  return plan;
}

Plan search(PlanCheck& check, const JointRow& start, const Postures& goals) {
  const int attempts = check.workspace().moves() ? kMovingAttempts : kAttempts;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    Postures path = workspace::find_path(check, start, goals, attempt);
    if (path.empty()) break;
    path = workspace::shortened(check, std::move(path), attempt);
    Plan plan;
    if (time_and_check(check, path, plan)) {
      plan.status = PlanStatus::kSolved;
      return plan;
    }
  }
  if (check.late()) {
    return refused(PlanStatus::kTimeLimit, "No path was found before the safety stop after " +
                                               to_text(check.options().max_seconds) + " s.");
  }
  return refused(PlanStatus::kNoPath,
                 "No path was found within " + std::to_string(check.used()) + " checks.");
}

Plan plan_from(PlanCheck& check, const JointRow& start, const PlanGoal& goal) {
  const JointMatrix row = start;
  if (!within_limits(check.arm(), view_of(row))[0]) {
    Plan plan = refused(PlanStatus::kStartOutsideLimits, "The start is outside the joint limits.");
    plan.way_out = workspace::way_out_to_limits(check, start);
    return plan;
  }
  if (!check.is_free(start)) {
    Plan plan = refused(
        PlanStatus::kStartInCollision,
        "At the start " + workspace::contact_text(check.workspace(), check.clearance(start)) + ".");
    plan.way_out = workspace::way_out_of_contact(check, start);
    return plan;
  }
  const workspace::GoalPostures goals = workspace::goal_postures(check, start, goal);
  if (goals.q.empty()) return refused(goals.status, goals.reason);
  return search(check, start, goals.q);
}

void check_count(std::string_view name, int value, int low, int high) {
  check_range(name, value, low, high);
}

}  // namespace

void PlanOptions::check() const {
  check_count("max_checks", max_checks, 1, 100'000'000);
  check_positive("max_seconds", max_seconds);
  timing.check();
  if (!timing.row_tolerance.empty()) throw_argument("row_tolerance", "none", "some");
  check_finite("time", time);
  check_count("goal_postures", goal_postures, 1, 1000);
  check_count("shortcuts", shortcuts, 0, 1'000'000);
}

std::string_view to_text(PlanStatus status) {
  switch (status) {
    case PlanStatus::kSolved:
      return "solved";
    case PlanStatus::kStartInCollision:
      return "start_in_collision";
    case PlanStatus::kStartOutsideLimits:
      return "start_outside_limits";
    case PlanStatus::kGoalInCollision:
      return "goal_in_collision";
    case PlanStatus::kGoalOutsideLimits:
      return "goal_outside_limits";
    case PlanStatus::kUnreachable:
      return "unreachable";
    case PlanStatus::kNoPath:
      return "no_path";
    case PlanStatus::kTimeLimit:
      return "time_limit";
  }
  return "";
}

Plan plan_motion(const Workspace& workspace, std::span<const double> q_start, const PlanGoal& goal,
                 const PlanOptions& options) {
  const Arm& arm = workspace.arm();
  const JointView start(q_start.data(), 1, static_cast<Index>(q_start.size()));
  check_joint_values(arm, start, "q_start");
  workspace::check_goal(arm, goal);
  options.check();
  PlanOptions full = options;
  full.limits = complete_limits(arm, options.limits);
  PlanCheck check(workspace, full);
  Plan plan = plan_from(check, start.row(0), goal);
  plan.checks = check.used();
  return plan;
}

}  // namespace bathyal
