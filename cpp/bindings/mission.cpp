// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/mission/run.hpp"
#include "bathyal/vehicle/device_presets.hpp"
#include "bathyal/world/world.hpp"
#include "behavior_tree.hpp"
#include "bindings.hpp"
#include "enum_names.hpp"
#include "mission_docs.hpp"

namespace bathyal::python {
namespace {

using Dict = py::typing::Dict<py::str, py::object>;
using Dicts = py::typing::List<Dict>;

double number(const py::dict& dict, const char* key, double otherwise) {
  return dict.contains(key) && !dict[key].is_none() ? dict[key].cast<double>() : otherwise;
}

std::optional<double> optional_number(const py::dict& dict, const char* key) {
  if (!dict.contains(key) || dict[key].is_none()) return std::nullopt;
  return dict[key].cast<double>();
}

std::string text(const py::dict& dict, const char* key) {
  return dict.contains(key) ? dict[key].cast<std::string>() : std::string();
}

std::optional<Condition> condition(const py::dict& dict, const char* key,
                                   const std::vector<std::string>& signals) {
  if (!dict.contains(key) || dict[key].is_none()) return std::nullopt;
  return Condition(dict[key].cast<std::string>(), signals);
}

const EnumNames<CommandKind>& command_kinds() {
  static const EnumNames<CommandKind> names{
      {"wait", CommandKind::kWait},       {"dive", CommandKind::kDive},
      {"follow", CommandKind::kFollow},   {"hold", CommandKind::kHold},
      {"sample", CommandKind::kSample},   {"mark", CommandKind::kMark},
      {"surface", CommandKind::kSurface}, {"drop_weight", CommandKind::kDropWeight},
      {"check", CommandKind::kCheck},     {"stop", CommandKind::kStop}};
  return names;
}

MissionCommand command_of(const py::dict& dict, const std::vector<std::string>& signals) {
  MissionCommand command;
  command.kind = enum_argument("kind", text(dict, "kind"), command_kinds());
  command.name = text(dict, "name");
  if (dict.contains("points")) {
    const auto rows = table_argument("points", dict["points"], 2);
    for (Index i = 0; i < rows.rows(); ++i) {
      command.points.emplace_back(rows(i, 0), rows(i, 1), 0.0);
    }
  }
  command.depth = optional_number(dict, "depth");
  command.altitude = optional_number(dict, "altitude");
  command.heading = optional_number(dict, "heading");
  command.speed = number(dict, "speed", command.speed);
  command.time = number(dict, "time", command.time);
  command.tolerance = number(dict, "tolerance", command.tolerance);
  command.condition = condition(dict, "condition", signals);
  if (dict.contains("wrench")) {
    const auto times = values_argument("wrench_time", dict["wrench_time"]);
    command.wrench_time.assign(times.data(), times.data() + times.rows());
    const auto rows = table_argument("wrench", dict["wrench"], 6);
    for (Index i = 0; i < rows.rows(); ++i) command.wrench.emplace_back(rows.row(i).transpose());
  }
  return command;
}

TreeNode tree_of(const py::object& object) {
  return tree_argument(object, [](const py::dict& leaf) {
    return leaf.contains("command") ? leaf["command"].cast<int>() : -1;
  });
}

MissionFault fault_of(const py::dict& dict, const std::vector<std::string>& signals) {
  MissionFault fault;
  fault.device = text(dict, "device");
  fault.kind = fault_kind(text(dict, "kind"));
  fault.size = number(dict, "size", fault.size);
  fault.at = number(dict, "at", fault.at);
  fault.when = condition(dict, "when", signals);
  fault.rate = number(dict, "rate", fault.rate);
  fault.lasts = number(dict, "lasts", fault.lasts);
  return fault;
}

void put_navigation(NavigationOptions& options, const py::dict& dict) {
  const std::map<std::string, double NavigationOptions::*> fields{
      {"gyro_noise", &NavigationOptions::gyro_noise},
      {"log_noise", &NavigationOptions::log_noise},
      {"log_walk", &NavigationOptions::log_walk},
      {"log_scale", &NavigationOptions::log_scale},
      {"gate", &NavigationOptions::gate},
      {"lag", &NavigationOptions::lag}};
  for (const auto& [key, value] : dict) {
    const auto found = fields.find(key.cast<std::string>());
    if (found == fields.end()) {
      throw_argument("navigation", "fields of the filter", key.cast<std::string>());
    }
    options.*found->second = value.cast<double>();
  }
}

std::shared_ptr<MissionPlan> made(const std::string& name, const std::string& devices,
                                  const py::typing::Optional<Vehicle>& vehicle, const World& world,
                                  const py::typing::List<SensorOptions>& sensors,
                                  const Dict& navigation, const ArrayLike& start,
                                  const Dicts& commands, const Dict& tree, const Dicts& guards,
                                  const Dicts& faults, const Dicts& weights, double hotel_power,
                                  double step, int steps_per_tick, double longest) {
  auto plan = std::make_shared<MissionPlan>();
  plan->name = name;
  const EnumNames<bool> presets{{"bluerov2_heavy", false}, {"remus100", true}};
  const bool torpedo = enum_argument("devices", devices, presets);
  plan->vehicle = torpedo ? remus100_system(true) : bluerov2_heavy_system();
  if (torpedo) plan->pilot.cruise = CruiseOptions();
  if (!vehicle.is_none()) plan->vehicle.vehicle = vehicle.cast<Vehicle>().options();
  plan->vehicle.hotel_power = hotel_power;
  for (const py::handle item : weights) {
    const auto dict = item.cast<py::dict>();
    DropWeightOptions weight;
    weight.name = text(dict, "name");
    weight.mass = number(dict, "mass", 0.0);
    weight.volume = number(dict, "volume", 0.0);
    if (dict.contains("position")) weight.position = vector_argument("position", dict["position"]);
    plan->vehicle.drop_weights.push_back(weight);
  }
  for (const py::handle sensor : sensors) plan->sensors.push_back(sensor.cast<SensorOptions>());
  plan->navigation.gravity = plan->vehicle.vehicle.gravity;
  plan->navigation.mean_surface = world.water().surface().value_or(0.0);
  put_navigation(plan->navigation, navigation);
  plan->weight_of_leak = plan->vehicle.vehicle.gravity;
  plan->water = world.water();
  if (!world.objects().empty()) plan->scene = world.at(0.0).scene;
  plan->start.world_from_vehicle = pose_argument("start", start);
  const auto signals = mission_signals(plan->vehicle, plan->sensors);
  for (const py::handle item : commands) {
    plan->commands.push_back(command_of(item.cast<py::dict>(), signals));
  }
  plan->root = tree_of(tree);
  for (const py::handle item : guards) {
    const auto dict = item.cast<py::dict>();
    plan->guards.push_back({text(dict, "name"), Condition(text(dict, "when"), signals),
                            number(dict, "persist", 0.0), tree_of(dict["response"])});
  }
  for (const py::handle item : faults) {
    plan->faults.push_back(fault_of(item.cast<py::dict>(), signals));
  }
  plan->step = step;
  plan->steps_per_tick = steps_per_tick;
  plan->longest = longest;
  plan->check();
  return plan;
}

/// A run's record in memory: rows of numbers by time, events.
class MemorySink final : public MissionSink {
 public:
  static constexpr int kColumns = 26;

  void tick(const MissionTick& tick) override {
    const VehicleState& truth = tick.truth->motion;
    put(tick.time);
    put_state(truth);
    put_state(tick.estimated);
    for (const double value :
         {tick.depth, tick.altitude, tick.load.voltage, tick.load.current,
          tick.truth->battery.charge, tick.position_std, tick.target.to.x(), tick.target.to.y(),
          tick.target.z, 0.0, 0.0}) {
      put(value);
    }
    for (const double value : tick.commands->thrusters) commands.push_back(value);
    thrusters = tick.commands->thrusters.size();
  }
  void reading(const SensorOptions& /*sensor*/, const SensorReading& /*reading*/) override {}
  void event(const MissionEvent& event) override { events.push_back(event); }

  std::vector<double> rows, commands;
  std::size_t thrusters = 0;
  std::vector<MissionEvent> events;

 private:
  void put(double value) { rows.push_back(value); }
  void put_state(const VehicleState& state) {
    const Eigen::Quaterniond turn(state.world_from_vehicle.linear());
    for (const double value : state.world_from_vehicle.translation()) put(value);
    for (const double value : turn.coeffs()) put(value);
  }
};

}  // namespace

void bind_mission(py::module_& module) {}

}  // namespace bathyal::python
