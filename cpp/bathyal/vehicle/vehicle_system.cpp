// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/vehicle/vehicle_system.hpp"

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/vehicle/internal/flat_motion.hpp"

namespace bathyal {
namespace vehicle_system {  // a lambda keeps them: not without a name

constexpr std::size_t kMostThrusters = 32;

/// A thruster in water that moves through it at a stage of a step: what its inflow takes.
struct InflowLoss {
  std::size_t thruster = 0;
  std::array<double, 3> speed{};  // at the start, half of the step, and its end
};

/// The thrusters through a step: at its start, half of it, and its end.
struct ThrusterCourse {
  std::array<Vec6, 3> still;  // force and moment of all, less what inflow takes
  std::array<InflowLoss, kMostThrusters> losses;
  std::size_t loss_count = 0;
  std::array<double, kMostThrusters> end_speed{};
};

}  // namespace vehicle_system

namespace {

using namespace vehicle_system;

Vec6 relative_velocity(const VehicleState& motion, const Flow& flow) {
  Vec6 relative = motion.velocity;
  relative.head<3>() -= motion.world_from_vehicle.linear().transpose() * flow.velocity;
  return relative;
}

void check_count(std::string_view name, std::size_t expected, std::size_t given) {
  if (given != expected) {
    throw_argument(name, std::to_string(expected) + " numbers, one a device",
                   std::to_string(given));
  }
}

void check_all(const std::string& kind, const auto& devices) {
  for (std::size_t i = 0; i < devices.size(); ++i) {
    try {
      devices[i].check();
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(kind + " " + std::to_string(i) + " (" + devices[i].name +
                                  "): " + error.what());
    }
  }
}

}  // namespace

void VehicleSystemOptions::check() const {
  vehicle.check();
  if (thrusters.size() > kMostThrusters) {
    throw_argument("thrusters", "32 at most", std::to_string(thrusters.size()));
  }
  check_all("thruster", thrusters);
  check_all("fin", fins);
  if (battery) battery->check();
  check_positive("supply_voltage", supply_voltage);
  check_not_negative("hotel_power", hotel_power);
  check_all("drop weight", drop_weights);
  if (tether) tether->check();
}

VehicleSystem::VehicleSystem(VehicleSystemOptions options)
    : options_((options.check(), std::move(options))), vehicle_(options_.vehicle) {
  for (const ThrusterOptions& thruster : options_.thrusters) thrusters_.emplace_back(thruster);
  for (const FinOptions& fin : options_.fins) fins_.emplace_back(fin);
  if (options_.battery) battery_.emplace(*options_.battery);
  for (const Thruster& thruster : thrusters_) tables_ = tables_ || thruster.options().table;
}

VehicleSystemState VehicleSystem::rest() const {
  VehicleSystemState state;
  state.thrusters.resize(thrusters_.size());
  state.fins.resize(fins_.size());
  state.drop_weights.resize(options_.drop_weights.size());
  return state;
}

void VehicleSystem::check_commands(const VehicleSystemState& state,
                                   const VehicleCommands& commands) const {
  check_count("commands.thrusters", thrusters_.size(), commands.thrusters.size());
  check_count("commands.fins", fins_.size(), commands.fins.size());
  check_count("state.thrusters", thrusters_.size(), state.thrusters.size());
  check_count("state.fins", fins_.size(), state.fins.size());
  check_count("state.drop_weights", options_.drop_weights.size(), state.drop_weights.size());
  if (!commands.drop.empty()) {
    check_count("commands.drop", options_.drop_weights.size(), commands.drop.size());
  }
  for (const double command : commands.thrusters) check_finite("commands.thrusters", command);
  for (const double command : commands.fins) check_finite("commands.fins", command);
}

BatteryLoad VehicleSystem::supply(const VehicleSystemState& state,
                                  const VehicleCommands& commands) const {
  // by the law, what a thruster draws depends on its speed alone, by a table on the voltage as well
  double fixed = options_.hotel_power;
  for (std::size_t i = 0; i < thrusters_.size(); ++i) {
    if (!thrusters_[i].options().table) {
      fixed += thrusters_[i].power(state.thrusters[i].speed, {});
    }
  }
  const auto drawn = [&](double voltage) {
    double power = fixed;
    if (!tables_) return power;
    for (std::size_t i = 0; i < thrusters_.size(); ++i) {
      if (!thrusters_[i].options().table) continue;
      power += thrusters_[i].power(state.thrusters[i].speed,
                                   thrusters_[i].drive(commands.thrusters[i], voltage));
    }
    return power;
  };
  if (battery_) return battery_->solve(state.battery, drawn);
  const double power = drawn(options_.supply_voltage);
  return {options_.supply_voltage, power / options_.supply_voltage, false};
}

Vec6 VehicleSystem::carried(const VehicleSystemState& state, const VehicleState& motion,
                            const Flow& flow) const {
  Vec6 sum = Vec6::Zero();
  for (std::size_t i = 0; i < options_.drop_weights.size(); ++i) {
    sum += drop_weight_wrench(options_.drop_weights[i], state.drop_weights[i], options_.vehicle,
                              motion.world_from_vehicle);
  }
  if (options_.tether) {
    sum += tether_wrench(*options_.tether, motion.world_from_vehicle, flow.velocity);
  }
  return sum;
}

Vec6 VehicleSystem::device_wrench(const VehicleSystemState& state, const VehicleCommands& commands,
                                  const Flow& flow) const {
  check_commands(state, commands);
  const double voltage = supply(state, commands).voltage;
  const Vec6 relative = relative_velocity(state.motion, flow);
  Vec6 sum = carried(state, state.motion, flow);
  for (std::size_t i = 0; i < thrusters_.size(); ++i) {
    sum += thrusters_[i].wrench(state.thrusters[i].speed,
                                thrusters_[i].drive(commands.thrusters[i], voltage), relative);
  }
  for (std::size_t i = 0; i < fins_.size(); ++i) {
    sum += fins_[i].wrench(state.fins[i].angle, relative);
  }
  return sum;
}

vehicle_system::ThrusterCourse VehicleSystem::thruster_course(const VehicleSystemState& state,
                                                              const VehicleCommands& commands,
                                                              double voltage, double time) const {
  ThrusterCourse course;
  course.still.fill(Vec6::Zero());
  double lag = 0.0, share = 0.0;  // of a half step that is left; thrusters mostly have one lag
  for (std::size_t i = 0; i < thrusters_.size(); ++i) {
    const Thruster& thruster = thrusters_[i];
    const ThrusterDrive drive = thruster.drive(commands.thrusters[i], voltage);
    if (thruster.options().lag != lag) {
      lag = thruster.options().lag;
      share = std::exp(-0.5 * time / lag);
    }
    const double start = state.thrusters[i].speed, off = lag > 0.0 ? start - drive.speed : 0.0;
    const std::array<double, 3> speed{start, drive.speed + share * off,
                                      drive.speed + share * share * off};
    for (std::size_t k = 0; k < 3; ++k) course.still[k] += thruster.still_wrench(speed[k], drive);
    if (thruster.meets_inflow()) course.losses[course.loss_count++] = {i, speed};
    course.end_speed[i] = speed[2];
  }
  return course;
}

void VehicleSystem::advance(VehicleSystemState& state, const VehicleCommands& commands,
                            const StepConditionsFunction& around, double time) const {
  check_commands(state, commands);
  check_positive("step", time);
  const BatteryLoad load = supply(state, commands);
  for (std::size_t i = 0; i < commands.drop.size(); ++i) {
    if (commands.drop[i] != 0) state.drop_weights[i].released = 1;
  }
  const ThrusterCourse course = thruster_course(state, commands, load.voltage, time);
  const auto rate = [&](const vehicle::FlatMotion& flat, int part) {
    const VehicleState motion = vehicle::motion_of(flat);
    const StepConditions here = around(0.5 * part * time, motion);
    const Vec6 relative = relative_velocity(motion, here.flow);
    const auto stage = static_cast<std::size_t>(part);
    Vec6 wrench = here.wrench + carried(state, motion, here.flow) + course.still[stage];
    for (std::size_t k = 0; k < course.loss_count; ++k) {
      const InflowLoss& loss = course.losses[k];
      wrench += thrusters_[loss.thruster].inflow_wrench(loss.speed[stage], relative);
    }
    for (std::size_t i = 0; i < fins_.size(); ++i) {
      const FinState fin = fins_[i].advanced(state.fins[i], commands.fins[i], 0.5 * part * time);
      wrench += fins_[i].wrench(fin.angle, relative);
    }
    return vehicle::rate_of(flat, motion, vehicle_.acceleration(motion, wrench, here.flow));
  };
  const vehicle::FlatMotion flat = vehicle::flat_of(state.motion);
  const vehicle::FlatMotion k1 = rate(flat, 0);
  const vehicle::FlatMotion k2 = rate(flat + 0.5 * time * k1, 1);
  const vehicle::FlatMotion k3 = rate(flat + 0.5 * time * k2, 1);
  const vehicle::FlatMotion k4 = rate(flat + time * k3, 2);
  const vehicle::FlatMotion next = flat + time / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  if (!next.allFinite()) throw Error("the motion runs away: its numbers are not finite");
  state.motion = vehicle::motion_of(next);
  for (std::size_t i = 0; i < thrusters_.size(); ++i)
    state.thrusters[i].speed = course.end_speed[i];
  for (std::size_t i = 0; i < fins_.size(); ++i) {
    state.fins[i] = fins_[i].advanced(state.fins[i], commands.fins[i], time);
  }
  if (battery_) state.battery = battery_->drained(state.battery, load.current, time);
}

void VehicleSystem::step(VehicleSystemState& state, const VehicleCommands& commands,
                         const Flow& flow, double time) const {
  advance(
      state, commands, [&](double, const VehicleState&) { return StepConditions{flow}; }, time);
}

void VehicleSystem::step(VehicleSystemState& state, const VehicleCommands& commands,
                         const StepConditionsFunction& conditions, double time) const {
  if (!conditions) throw_argument("conditions", "a function", "none");
  advance(state, commands, conditions, time);
}

}  // namespace bathyal
