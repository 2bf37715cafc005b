// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/mission/pilot.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/base/check.hpp"

namespace bathyal {
namespace {

constexpr double kSteepest = 0.2;  ///< climb over way of a cruise that changes its depth
constexpr double kRamp = 0.5;      ///< further off its height it is on a way of its own [m]

double wrapped(double angle) { return std::remainder(angle, 2.0 * M_PI); }

double heading_of(const Pose& pose) { return std::atan2(pose.linear()(1, 0), pose.linear()(0, 0)); }

double moved_towards(double from, double to, double most) {
  return from + std::clamp(to - from, -most, most);
}

}  // namespace

void PilotOptions::check() const {
  if (cruise) cruise->check();
  hold.check();
  check_positive("lookahead", lookahead);
  check_not_negative("los_integral", los_integral);
  check_positive("climb_speed", climb_speed);
  check_positive("turn_speed", turn_speed);
  check_positive("most_ahead", most_ahead);
}

Pilot::Pilot(const VehicleSystem& system, PilotOptions options)
    : options_((options.check(), std::move(options))), thrusters_(system.thrusters()) {
  if (options_.cruise) {
    cruise_.emplace(system, *options_.cruise);
  } else {
    allocation_.emplace(system.thrusters(), options_.allocation);
    hold_.emplace(system.vehicle(), options_.hold);
  }
}

std::vector<int> Pilot::lost_axes(const std::vector<int>& failed) const {
  return allocation_ ? allocation_->rank(failed).lost : std::vector<int>();
}

void Pilot::begin(PilotState& state, const VehicleState& estimated) const {
  state.along = 0.0;
  state.drift = 0.0;
  if (state.begun) return;
  state.z = estimated.world_from_vehicle.translation().z();
  state.heading = heading_of(estimated.world_from_vehicle);
  state.begun = true;
}

void Pilot::step(PilotState& state, const VehicleState& estimated, const PilotTarget& target,
                 const Vec3& current, double voltage, const std::vector<int>& failed,
                 const Vec6& extra, double time, VehicleCommands& commands) const {
  if (cruise_) {
    step_cruise(state, estimated, target, current, voltage, time, commands);
  } else {
    step_hold(state, estimated, target, current, voltage, failed, extra, time, commands);
  }
}

void Pilot::step_hold(PilotState& state, const VehicleState& estimated, const PilotTarget& target,
                      const Vec3& current, double voltage, const std::vector<int>& failed,
                      const Vec6& extra, double time, VehicleCommands& commands) const {
  const Eigen::Vector2d line = target.to - target.from;
  const double length = line.norm();
  const Eigen::Vector2d course =
      length > 0.0 ? Eigen::Vector2d(line / length) : Eigen::Vector2d(Eigen::Vector2d::UnitX());
  const Eigen::Vector2d place = estimated.world_from_vehicle.translation().head<2>();
  double pace = 0.0;
  if (target.moves) {
    const double passed = (place - target.from).dot(course);
    const double next = std::min(
        {state.along + target.speed * time, std::max(passed, 0.0) + options_.most_ahead, length});
    if (next > state.along && next < length) pace = target.speed;
    state.along = std::max(state.along, next);
  } else {
    state.along = length;
  }
  const double wanted = target.heading.value_or(
      target.moves && length > 0.5 ? std::atan2(course.y(), course.x()) : state.heading);
  state.heading =
      wrapped(state.heading + std::clamp(wrapped(wanted - state.heading),
                                         -options_.turn_speed * time, options_.turn_speed * time));
  state.z = moved_towards(state.z, target.z, options_.climb_speed * time);

  PoseTarget aim;
  const Eigen::Vector2d point = target.from + state.along * course;
  aim.world_from_vehicle = Eigen::Translation3d(point.x(), point.y(), state.z) *
                           Eigen::AngleAxisd(state.heading, Vec3::UnitZ());
  aim.velocity.head<3>() = estimated.world_from_vehicle.linear().transpose() *
                           Vec3(pace * course.x(), pace * course.y(), 0.0);
  const Vec6 wrench = hold_->step(state.hold, estimated, aim, current, time) - extra;
  AllocationResult result;
  allocation_->allocate(wrench, voltage, failed, result);
  state.hold.shortfall = result.achieved - wrench;
  for (const int row : failed) result.command[static_cast<std::size_t>(row)] = 0.0;
  commands.thrusters = result.command;
}

void Pilot::step_cruise(PilotState& state, const VehicleState& estimated, const PilotTarget& target,
                        const Vec3& current, double voltage, double time,
                        VehicleCommands& commands) const {
  const CruiseOptions& options = cruise_->options();
  const Eigen::Vector2d place = estimated.world_from_vehicle.translation().head<2>();
  const Eigen::Vector2d line = target.to - target.from;
  const double length = line.norm();
  CruiseTarget aim;
  aim.speed = target.speed;
  const Eigen::Vector2d ahead = target.to - place;
  if (target.moves && length > 1e-6) {
    const Eigen::Vector2d course = line / length;
    const Eigen::Vector2d off = place - target.from;
    const double aside = course.x() * off.y() - course.y() * off.x();
    const double pushed = aside + options_.los_integral * state.drift;
    const double span = options_.lookahead;
    aim.heading = std::atan2(course.y(), course.x()) - std::atan2(pushed, span);
    state.drift += time * span * aside / (pushed * pushed + span * span);
  } else {
    aim.heading = ahead.norm() > options_.lookahead ? std::atan2(ahead.y(), ahead.x())
                                                    : heading_of(estimated.world_from_vehicle);
  }
  Vec6 relative = estimated.velocity;
  relative.head<3>() -= estimated.world_from_vehicle.linear().transpose() * current;
  // Asked for more than its way allows, a slow vehicle noses down until its planes stall.
  const double ahead_speed = std::max(0.1, relative.x());
  const double slope = std::min(kSteepest, options_.climb_speed / ahead_speed);
  const double z = estimated.world_from_vehicle.translation().z();
  state.z = std::clamp(moved_towards(state.z, target.z, slope * ahead_speed * time),
                       z - options_.most_ahead, z + options_.most_ahead);
  aim.z = state.z;
  const double off = target.z - state.z;
  aim.climb = std::abs(off) > kRamp ? std::copysign(slope, off) : target.climb;
  const CruiseOutput output = cruise_->step(state.cruise, estimated, relative, aim, time);
  commands.fins[static_cast<std::size_t>(options.rudder)] = output.rudder;
  commands.fins[static_cast<std::size_t>(options.stern_plane)] = output.stern_plane;
  const auto row = static_cast<std::size_t>(options.propeller);
  commands.thrusters[row] = thrusters_[row].command_for(output.thrust, voltage);
}

}  // namespace bathyal
