// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/mission/plan.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "bathyal/base/check.hpp"

namespace bathyal {
namespace {

void check_leaves(const TreeNode& node, std::size_t count) {
  if (node.kind == NodeKind::kLeaf &&
      (node.leaf < 0 || static_cast<std::size_t>(node.leaf) >= count)) {
    throw_argument("tree", "leaves that are commands", std::to_string(node.leaf));
  }
  for (const TreeNode& child : node.children) check_leaves(child, count);
}

bool of_sensor(FaultKind kind) { return kind <= FaultKind::kNoise; }

bool of_drive(FaultKind kind) {
  return kind == FaultKind::kOff || kind == FaultKind::kStuck || kind == FaultKind::kDead ||
         kind == FaultKind::kWeak || kind == FaultKind::kReversed;
}

/// Kinds that are a matter of how much need a size; of some it is a share.
void check_size(const MissionFault& fault) {
  const std::string name = "fault " + std::string(fault_name(fault.kind)) + " size";
  check_finite(name, fault.size);
  switch (fault.kind) {
    case FaultKind::kIntermittent:
    case FaultKind::kWeak:
      check_range(name, fault.size, 0.0, 1.0);
      [[fallthrough]];
    case FaultKind::kWrong:
    case FaultKind::kBias:
    case FaultKind::kDrift:
      if (fault.size == 0.0) throw_argument(name, "another than 0", "0");
      return;
    case FaultKind::kSlow:
    case FaultKind::kDelayed:
    case FaultKind::kNoise:
    case FaultKind::kSag:
    case FaultKind::kLeak:
      check_positive(name, fault.size);
      return;
    case FaultKind::kGarbage:
      check_not_negative(name, fault.size);
      return;
    default:
      if (fault.size != 0.0) throw_argument(name, "none", to_text(fault.size));
  }
}

void check_fault(const MissionPlan& plan, const MissionFault& fault) {
  const auto named = [&fault](const auto& devices) {
    return std::any_of(devices.begin(), devices.end(),
                       [&fault](const auto& d) { return d.name == fault.device; });
  };
  const bool drive = named(plan.vehicle.thrusters) || named(plan.vehicle.fins);
  const bool battery = plan.vehicle.battery && fault.device == plan.vehicle.battery->name;
  const bool arm = fault.device == "arm" && std::any_of(plan.commands.begin(), plan.commands.end(),
                                                        [](const MissionCommand& c) {
                                                          return c.kind == CommandKind::kSample;
                                                        });
  const bool fits = (named(plan.sensors) && of_sensor(fault.kind)) ||
                    (drive && of_drive(fault.kind)) || (battery && fault.kind == FaultKind::kSag) ||
                    (fault.device == "hull" && fault.kind == FaultKind::kLeak) ||
                    (arm && (fault.kind == FaultKind::kStuck || fault.kind == FaultKind::kLost));
  const bool known = named(plan.sensors) || drive || battery || fault.device == "hull" || arm;
  if (!known) throw_argument("fault device", "a device of the vehicle", fault.device);
  if (!fits)
    throw_argument("fault kind", "one that the device may have", "another of " + fault.device);
  check_size(fault);
  if (std::isnan(fault.at) || fault.at < 0.0) {
    throw_argument("fault at", "a time of 0 or more", to_text(fault.at));
  }
  check_not_negative("fault rate", fault.rate);
  if (!(fault.lasts > 0.0)) throw_argument("fault lasts", "above 0", to_text(fault.lasts));
}

}  // namespace

void MissionCommand::check() const {
  const std::string at = name.empty() ? std::string("command") : name;
  for (const Vec3& point : points) {
    if (!point.allFinite()) throw_argument(at + " points", "finite numbers", "others");
  }
  for (const auto& value : {depth, altitude, heading}) {
    if (value) check_finite(at + " depth, altitude, heading", *value);
  }
  if (depth && altitude) throw_argument(at, "depth or altitude", "both");
  check_positive(at + " speed", speed);
  check_not_negative(at + " time", time);
  check_positive(at + " tolerance", tolerance);
  if (kind == CommandKind::kFollow && points.empty()) throw_argument(at, "points", "none");
  if (kind == CommandKind::kDive && !depth && !altitude) {
    throw_argument(at, "a depth or an altitude", "none");
  }
  if (kind == CommandKind::kCheck && !condition) throw_argument(at, "a condition", "none");
  if (kind == CommandKind::kSample &&
      (wrench_time.size() < 2 || wrench.size() != wrench_time.size() ||
       !std::is_sorted(wrench_time.begin(), wrench_time.end()))) {
    throw_argument(at, "a wrench at two rising times or more", "others");
  }
  if (!empty_wrench.empty() && empty_wrench.size() != wrench.size()) {
    throw_argument(at + " empty_wrench", std::to_string(wrench.size()) + " rows",
                   std::to_string(empty_wrench.size()));
  }
}

void MissionPlan::check() const {
  vehicle.check();
  pilot.check();
  std::set<std::string> names;
  for (const SensorOptions& sensor : sensors) {
    sensor.check();
    if (!names.insert(sensor.name).second) {
      throw_argument("sensors", "names that differ", sensor.name);
    }
  }
  for (const ThrusterOptions& thruster : vehicle.thrusters) {
    if (!names.insert(thruster.name).second) {
      throw_argument("thrusters", "names that differ", thruster.name);
    }
  }
  for (const MissionCommand& command : commands) command.check();
  root.check();
  check_leaves(root, commands.size());
  for (const MissionGuard& guard : guards) {
    guard.response.check();
    check_leaves(guard.response, commands.size());
    check_not_negative("guard persist", guard.persist);
  }
  for (std::size_t i = 0; i < faults.size(); ++i) {
    try {
      check_fault(*this, faults[i]);
    } catch (const std::invalid_argument& error) {
      std::string text("faults[");
      throw std::invalid_argument(
          text.append(std::to_string(i)).append("]: ").append(error.what()));
    }
  }
  check_positive("step", step);
  check_range("steps_per_tick", steps_per_tick, 1, 1000);
  check_positive("longest", longest);
  if (!leak_position.allFinite()) throw_argument("leak_position", "finite numbers", "others");
  check_not_negative("weight_of_leak", weight_of_leak);
  check_rigid("start", start.world_from_vehicle);
  if (!start.velocity.allFinite()) throw_argument("start", "a finite velocity", "another");
  const Vec3 place = start.world_from_vehicle.translation();
  if (scene && scene->cast(place, -Vec3::UnitZ()).mesh < 0 &&
      scene->cast(place, Vec3::UnitZ()).mesh >= 0) {
    throw_argument("start", "a place above the bottom",
                   "z = " + to_text(place.z()) + " m below it");
  }
  const double largest = Environment(water, scene, contact).largest_step(Vehicle(vehicle.vehicle));
  if (step > largest) {
    throw_argument("step", "at most " + to_text(largest) + " s, the limit of contact",
                   to_text(step));
  }
}

std::vector<std::string> mission_signals(const VehicleSystemOptions& vehicle,
                                         const std::vector<SensorOptions>& sensors) {
  std::vector<std::string> names{"time",    "depth",   "altitude", "x",     "y",
                                 "z",       "heading", "roll",     "pitch", "speed",
                                 "battery", "voltage", "current",  "leak",  "position_std",
                                 "dvl_age", "fault"};
  for (const SensorOptions& sensor : sensors) names.push_back("fault." + sensor.name);
  for (const ThrusterOptions& thruster : vehicle.thrusters) {
    names.push_back("fault." + thruster.name);
  }
  for (const FinOptions& fin : vehicle.fins) names.push_back("fault." + fin.name);
  names.emplace_back("fault.battery");
  names.emplace_back("fault.hull");
  names.emplace_back("fault.arm");
  return names;
}

std::vector<std::string> mission_units(const std::vector<std::string>& signals) {
  std::vector<std::string> units{"s",   "m",   "m", "m", "m", "m",  "rad", "rad",
                                 "rad", "m/s", "1", "V", "A", "kg", "m",   "s"};
  units.resize(signals.size(), "1");  // faults
  return units;
}

}  // namespace bathyal
