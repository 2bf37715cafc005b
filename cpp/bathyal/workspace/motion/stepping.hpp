// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bathyal/arm/inverse.hpp"
#include "bathyal/workspace/workspace.hpp"

// The tip moved straight to where it is sent, step by step, as far as it gets. What lies in the way
// is slid along; a way round, where there is one, is the planner's.

namespace bathyal {

enum class MoveMethod {
  /// Least squares with damping within joint limits and rates, by strict priorities: clearance,
  /// position of the tip, its axis or orientation, and away from limits in what these leave free.
  kDamped,
  /// Δq = J⁺ ΔX, ΔX a k-th of the way to the target (Maevskiy, Zanin 2020), each intermediate
  /// posture checked: a forbidden one ends the motion.
  kPseudoInverse
};

enum class MoveStatus {
  kReached,
  kStuck,       ///< no step brings the tip nearer, by what is near or by a singular posture
  kBlocked,     ///< the next step, or the start itself, touches something
  kAtLimit,     ///< held by a joint's limit, or sent beyond it
  kUnreachable  ///< inverse kinematics finds no posture for the target, with limits or without
};

/// "reached", "stuck", "blocked", "at_limit" or "unreachable".
std::string_view to_text(MoveStatus status);

struct MoveOptions {
  MoveMethod method = MoveMethod::kDamped;
  InverseTask task = InverseTask::kPose;  ///< what of the target's pose must be met
  Vec3 axis = Vec3::UnitZ();  ///< of kPositionAxis, in the tool's frame; any length but zero
  /// [m] above 0; when nothing is said 1e-4, and 1e-2 for kPseudoInverse as in the paper.
  std::optional<double> position_tolerance = std::nullopt;
  /// [rad] above 0; when nothing is said 1e-3, and 1e-2 for kPseudoInverse.
  std::optional<double> angle_tolerance = std::nullopt;
  int steps = 100;            ///< k of kPseudoInverse, 1 to 10⁶
  double speed = 0.25;        ///< of the tip at most [m/s], above 0
  double angular_rate = 0.5;  ///< of the tool at most [rad/s], above 0
  double period = 0.02;       ///< between steps of kDamped [s], above 0; slowed where it must be
  double clearance = 0.005;   ///< kept by kDamped [m], 0 or more
  double influence = 0.1;     ///< below this distance approaching is slowed [m], above clearance
  double approach = 0.5;      ///< greatest speed of approach at `influence` [m/s], above 0
  int max_steps = 5000;       ///< of kDamped, 1 to 10⁶
  /// Of each coordinate [rad/s], [m/s]; none: its rate limit, 1 rad/s or 0.25 m/s without one.
  std::vector<double> velocity{};
  std::vector<double> acceleration{};  ///< none: default_acceleration
  TipContact tip_contact = TipContact::kForbidden;
  double time = 0.0;  ///< at which it begins [s]; the target is taken as it lies then

  /// \throw std::invalid_argument
  void check(const Arm& arm) const;
};

struct Move {
  MoveStatus status = MoveStatus::kReached;
  JointMatrix path;             ///< (K, n), from the start on; all of it free of contact
  std::vector<double> time;     ///< (K,) from `options.time` on [s]
  double position_error = 0.0;  ///< that remains at the end [m]
  double angle_error = 0.0;     ///< [rad]
  int link = -1;                ///< that is in the way, of kBlocked and kStuck,
  int obstacle = -1;            ///< of what, an index into ws.obstacles(), or -1, and
  int other_link = -1;          ///< of the arm's own
  int coordinate = -1;          ///< that is at its limit, of kAtLimit
  std::string reason;           ///< a short sentence; empty when it was reached
};

/// Moves the tip from where it is at `q_start` towards a target in the world, on a straight line
/// as long as nothing is in its way. Rates and accelerations hold by finite differences between the
/// rows, from rest to rest.
///
/// A start that touches something or lies outside the limits gives a path of one row. Of a motion
/// that comes to a halt the rows up to the nearest point are given.
/// \throw std::invalid_argument as check_joint_values, for a target that is not finite or rigid.
Move move_tip(const Workspace& ws, std::span<const double> q_start, const Pose& world_from_tool,
              const MoveOptions& options = {});

}  // namespace bathyal
