// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "bathyal/workspace/motion/motion_timing.hpp"
#include "bathyal/workspace/workspace.hpp"

namespace bathyal {

/// Where to: coordinates of the arm, the tool's pose in the world, or its tip's point there. Poses
/// and points are reached to the tolerances of `inverse`.
using PlanGoal = std::variant<std::vector<double>, Pose, Vec3>;

struct PlanOptions {
  std::uint64_t seed = 0;
  /// Postures and straight motions looked at for contact, 1 to 10⁸.
  int max_checks = 20000;
  double max_seconds = 60.0;  ///< a safety stop, above 0 [s]; what it stops depends on the machine
  MotionLimits limits = {};
  TimingOptions timing = {};  ///< `row_tolerance` must be empty
  TipContact tip_contact = TipContact::kForbidden;
  /// Of the start [s]. A goal in the world is meant at this time, too.
  double time = 0.0;
  int goal_postures = 12;  ///< that are tried for a pose or a point, 1 to 1000
  int shortcuts = 60;      ///< that are tried, 0 to 10⁶

  /// \throw std::invalid_argument
  void check() const;
};

enum class PlanStatus {
  kSolved,
  kStartInCollision,
  kStartOutsideLimits,
  kGoalInCollision,    ///< of a pose or a point: every posture found touches
  kGoalOutsideLimits,  ///< of a pose or a point: reached, but by no posture within the limits
  kUnreachable,        ///< in no posture
  kNoPath,             ///< found within the checks
  kTimeLimit           ///< the safety stop
};

/// "solved", "start_in_collision", "start_outside_limits", "goal_in_collision",
/// "goal_outside_limits", "unreachable", "no_path", "time_limit"
std::string_view to_text(PlanStatus status);

struct Plan {
  PlanStatus status = PlanStatus::kNoPath;
  JointMatrix path;          ///< (K, n), straight in joint space between rows; without rows: none
  std::vector<double> time;  ///< (K,) of the rows, from 0 at the start [s]
  std::string reason;        ///< one sentence; empty of a plan that is solved
  int checks = 0;            ///< used
  /// Of a start that touches or is outside the limits: from it on a short straight line to a
  /// posture that is free, if one was found, along which no clearance falls below that at the
  /// start; (2, n), or no rows.
  JointMatrix way_out;
};

/// A motion from rest at `q_start` to rest at the goal that touches nothing.
///
/// The straight motion first; then two trees of straight motions that grow from the start and from
/// the goal's postures towards each other (RRT-Connect: Kuffner, LaValle 2000), each motion as far
/// as `check_motion` finds it free; then shortcuts between points drawn along the path (Geraerts,
/// Overmars 2007), and `time_motion`. The rows handed out are checked again, against limits and by
/// `check_motion` at their times; where a rounded corner touches its tolerance is made smaller, at
/// last 0. Where things move, straight motions are checked as if all were at rest as at `time`, and
/// at the times at which earlier motions met something and ended.
///
/// Postures are drawn within the limits; of joints without limits within half a turn of start and
/// goal. Postures of a pose or point come out by whole turns as near to the start as limits allow;
/// joint values of a goal are taken as they are. The same seed gives the same bytes, unless the
/// safety stop ends the search.
/// \throw std::invalid_argument for a start or goal of another length, values that are not finite,
///        a pose that is not rigid, and as PlanOptions::check and complete_limits.
Plan plan_motion(const Workspace& workspace, std::span<const double> q_start, const PlanGoal& goal,
                 const PlanOptions& options = {});

}  // namespace bathyal
