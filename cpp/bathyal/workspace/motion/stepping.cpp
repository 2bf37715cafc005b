// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/motion/stepping.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "bathyal/base/check.hpp"
#include "bathyal/workspace/motion/internal/row_timing.hpp"
#include "bathyal/workspace/motion/internal/tip_motion.hpp"
#include "bathyal/workspace/motion/motion_timing.hpp"

namespace bathyal {
namespace {

using workspace::TipMotion;

void check_values(std::string_view name, const std::vector<double>& values, const Arm& arm) {
  if (values.empty()) return;
  if (std::cmp_not_equal(values.size(), arm.size())) {
    throw_argument(name, std::to_string(arm.size()) + " values", std::to_string(values.size()));
  }
  for (const double value : values) check_positive(name, value);
}

std::string contact_text(const Workspace& ws, const Move& move) {
  if (move.link < 0) return "";
  return link_name(ws.arm(), move.link) + " against " +
         (move.obstacle >= 0 ? ws.obstacles()[static_cast<std::size_t>(move.obstacle)]
                             : link_name(ws.arm(), move.other_link));
}

std::string reason_of(const Workspace& ws, const Move& move) {
  const std::string at = contact_text(ws, move);
  switch (move.status) {
    case MoveStatus::kReached:
      return "";
    case MoveStatus::kStuck:
      return at.empty() ? "no step brings the tip nearer" : "held off by " + at;
    case MoveStatus::kBlocked:
      return (move.path.rows() == 1 ? "contact at the start: " : "contact: ") + at;
    case MoveStatus::kAtLimit:
      return move.coordinate < 0
                 ? "reached beyond joint limits only"
                 : "coordinate " + std::to_string(move.coordinate) +
                       (move.path.rows() == 1 ? " starts outside its limits" : " is at its limit");
    case MoveStatus::kUnreachable:
      return "the target is out of reach";
  }
  return "";
}

/// Whether inverse kinematics, from several starts, says that a target that was not reached cannot
/// be.
InverseStatus inverse_status(const Workspace& ws, const workspace::TipTarget& target,
                             std::span<const double> q_start) {
  InverseOptions options;
  options.task = target.task;
  options.axis = target.axis;
  options.num_threads = 1;
  const JointView start(q_start.data(), 1, ws.arm().size());
  return inverse(ws.arm(), row_major(target.pose), start, options).status[0];
}

void explain(const Workspace& ws, const TipMotion& motion, const workspace::TipTarget& target,
             std::span<const double> q_start, Move& move) {
  move.link = motion.link, move.obstacle = motion.obstacle, move.other_link = motion.other_link;
  if (motion.end == TipMotion::End::kReached) {
    move.status = MoveStatus::kReached;
  } else if (motion.end == TipMotion::End::kContact) {
    move.status = MoveStatus::kBlocked;
  } else if (motion.end == TipMotion::End::kBeyondLimit) {
    move.status = MoveStatus::kAtLimit;
    move.coordinate = motion.coordinate;
  } else {
    const InverseStatus status = inverse_status(ws, target, q_start);
    if (status == InverseStatus::kOutOfReach) {
      move.status = MoveStatus::kUnreachable;
    } else if (motion.link < 0 && (motion.coordinate >= 0 || status == InverseStatus::kLimit)) {
      move.status = MoveStatus::kAtLimit;
      move.coordinate = motion.coordinate;
    } else {
      move.status = MoveStatus::kStuck;
    }
  }
}

/// Times of the rows, and the last look at them: a motion that touches something at these times
/// ends in the row before.
void time_and_verify(const Workspace& ws, const MoveOptions& options, Move& move) {
  const std::vector<double> velocity =
      options.velocity.empty() ? default_limits(ws.arm()).velocity : options.velocity;
  const std::vector<double> acceleration =
      options.acceleration.empty() ? default_acceleration(ws.arm()) : options.acceleration;
  for (;;) {
    const std::vector<double> least =
        workspace::tip_durations(ws.arm(), move.path, options.speed, options.angular_rate);
    move.time = workspace::row_times(move.path, velocity, acceleration, least);
    for (double& time : move.time) time += options.time;
    const MotionCheck check = ws.check_motion(
        view_of(move.path), {.time = move.time, .tip_contact = options.tip_contact});
    if (check.free || move.path.rows() == 1) break;
    move.path.conservativeResize(static_cast<Index>(check.contact) + 1, Eigen::NoChange);
    move.status = MoveStatus::kBlocked;
    move.link = check.link, move.obstacle = check.obstacle, move.other_link = check.other_link;
  }
}

}  // namespace

std::string_view to_text(MoveStatus status) {
  switch (status) {
    case MoveStatus::kReached:
      return "reached";
    case MoveStatus::kStuck:
      return "stuck";
    case MoveStatus::kBlocked:
      return "blocked";
    case MoveStatus::kAtLimit:
      return "at_limit";
    case MoveStatus::kUnreachable:
      return "unreachable";
  }
  return "unknown";
}

void MoveOptions::check(const Arm& arm) const {
  if (!axis.allFinite() || !(axis.norm() > 0.0)) {
    throw_argument("axis", "a finite vector other than zero", "zero, nan or inf");
  }
  if (position_tolerance) check_positive("position_tolerance", *position_tolerance);
  if (angle_tolerance) check_positive("angle_tolerance", *angle_tolerance);
  check_range("steps", steps, 1, 1e6);
  check_positive("speed", speed);
  check_positive("angular_rate", angular_rate);
  check_positive("period", period);
  check_not_negative("clearance", clearance);
  check_positive("influence", influence);
  if (!(influence > clearance)) {
    throw_argument("influence", "more than the clearance, " + to_text(clearance),
                   to_text(influence));
  }
  check_positive("approach", approach);
  check_range("max_steps", max_steps, 1, 1e6);
  check_values("velocity", velocity, arm);
  check_values("acceleration", acceleration, arm);
  check_finite("time", time);
}

Move move_tip(const Workspace& ws, std::span<const double> q_start, const Pose& world_from_tool,
              const MoveOptions& options) {
  options.check(ws.arm());
  check_joint_values(ws.arm(), {q_start.data(), 1, static_cast<Index>(q_start.size())}, "q_start");
  check_rigid("pose", world_from_tool);
  const Pose vehicle_from_world = ws.surroundings().world_from_vehicle.at(options.time).inverse();
  const workspace::TipTarget target{vehicle_from_world * world_from_tool, options.task,
                                    options.axis.normalized()};
  const TipMotion motion = options.method == MoveMethod::kDamped
                               ? workspace::damped_motion(ws, q_start, target, options)
                               : workspace::pseudo_inverse_motion(ws, q_start, target, options);
  Move move;
  move.path = motion.rows;
  explain(ws, motion, target, q_start, move);
  time_and_verify(ws, options, move);
  const workspace::TipError error = workspace::tip_error(
      row_frames(ws.arm(), {move.path.data() + (move.path.rows() - 1) * move.path.cols(),
                            static_cast<std::size_t>(move.path.cols())})
          .world_from_tool,
      target);
  move.position_error = error.distance();
  move.angle_error = error.angle();
  move.reason = reason_of(ws, move);
  return move;
}

}  // namespace bathyal
