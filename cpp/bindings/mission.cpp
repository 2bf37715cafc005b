// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/mission/archive.hpp"
#include "bathyal/mission/mission_log.hpp"
#include "bathyal/mission/run.hpp"
#include "bathyal/mission/typical.hpp"
#include "bathyal/vehicle/vehicle_system.hpp"
#include "bathyal/world/world.hpp"
#include "behavior_tree.hpp"
#include "bindings.hpp"
#include "enum_names.hpp"
#include "mission_docs.hpp"

namespace bathyal::python {
namespace {

using DictValue = py::typing::Union<py::str, py::float_, ArrayLike, py::list, py::dict>;
using Dict = py::typing::Dict<py::str, DictValue>;
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

Condition condition_of(const std::string& text, const std::vector<std::string>& signals) {
  return {text, signals, mission_units(signals)};
}

std::optional<Condition> condition(const py::dict& dict, const char* key,
                                   const std::vector<std::string>& signals) {
  if (!dict.contains(key) || dict[key].is_none()) return std::nullopt;
  return condition_of(dict[key].cast<std::string>(), signals);
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
    const auto empty = table_argument("empty_wrench", dict["empty_wrench"], 6);
    for (Index i = 0; i < empty.rows(); ++i) {
      command.empty_wrench.emplace_back(empty.row(i).transpose());
    }
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

/// Names the row in what is wrong with it.
template <class Make>
void in_row(const char* list, std::size_t row, const Make& make) {
  try {
    make();
  } catch (const std::invalid_argument& error) {
    std::string text(list);
    text.append("[").append(std::to_string(row)).append("]: ").append(error.what());
    throw std::invalid_argument(text);
  }
}

std::shared_ptr<const MissionPlan> made(
    const std::string& name, const VehicleSystem& system,
    const py::typing::Optional<Vehicle>& vehicle, const std::vector<DropWeightOptions>& weights,
    double hotel_power, const World& world, const py::typing::List<SensorOptions>& sensors,
    const Dict& navigation, const ArrayLike& start, const Dicts& commands, const Dict& tree,
    const Dicts& guards, const Dicts& faults, double step, int steps_per_tick, double longest) {
  auto plan = std::make_shared<MissionPlan>();
  plan->name = name;
  plan->vehicle = system.options();
  if (!vehicle.is_none()) plan->vehicle.vehicle = vehicle.cast<Vehicle>().options();
  for (const DropWeightOptions& weight : weights) plan->vehicle.drop_weights.push_back(weight);
  plan->vehicle.hotel_power = hotel_power;
  if (!plan->vehicle.fins.empty()) plan->pilot.cruise = CruiseOptions();
  for (const py::handle sensor : sensors) plan->sensors.push_back(sensor.cast<SensorOptions>());
  plan->water = world.water();
  plan->navigation = typical_navigation();
  plan->navigation.gravity = plan->vehicle.vehicle.gravity;
  plan->navigation.mean_surface = plan->water.surface().value_or(0.0);
  put_navigation(plan->navigation, navigation);
  plan->weight_of_leak = plan->vehicle.vehicle.gravity;
  if (!world.objects().empty()) plan->scene = world.at(0.0).scene;
  plan->start.world_from_vehicle = pose_argument("start", start);
  const auto signals = mission_signals(plan->vehicle, plan->sensors);
  for (const py::handle item : commands) {
    plan->commands.push_back(command_of(item.cast<py::dict>(), signals));
  }
  plan->root = tree_of(tree);
  for (const py::handle item : guards) {
    in_row("always", plan->guards.size(), [&] {
      const auto dict = item.cast<py::dict>();
      plan->guards.push_back({text(dict, "name"), condition_of(text(dict, "when"), signals),
                              number(dict, "persist", 0.0), tree_of(dict["response"])});
    });
  }
  for (const py::handle item : faults) {
    in_row("faults", plan->faults.size(),
           [&] { plan->faults.push_back(fault_of(item.cast<py::dict>(), signals)); });
  }
  plan->step = step;
  plan->steps_per_tick = steps_per_tick;
  plan->longest = longest;
  plan->check();
  return plan;
}

/// A run, and its log where it has one.
class LoggedRun {
 public:
  LoggedRun(const std::shared_ptr<const MissionPlan>& plan, std::uint64_t seed,
            const std::optional<std::string>& log, const std::optional<std::string>& saved)
      : plan_(plan) {
    std::string of_run, of_log;
    if (saved) {
      ByteReader reader(*saved);
      reader(of_run, of_log);
      if (reader.left() != 0) throw Error("a saved run with other bytes behind it");
    }
    if (log && saved) log_.emplace(*log, *plan, of_log);
    if (log && !saved) log_.emplace(*log, *plan);
    run_.emplace(plan, seed, log_ ? &*log_ : nullptr);
    if (saved) run_->load(of_run);
  }

  MissionRun& run() { return *run_; }
  const MissionRun& run() const { return *run_; }
  std::vector<MissionEvent> events() const {
    return log_ ? log_->events() : std::vector<MissionEvent>();
  }
  std::string save() {
    std::string of_run = run_->save(), of_log = log_ ? log_->save() : std::string();
    ByteWriter bytes;
    bytes(of_run, of_log);
    return bytes.take();
  }
  void close() {
    if (log_) log_->close();
  }

 private:
  std::shared_ptr<const MissionPlan> plan_;
  std::optional<MissionLog> log_;
  std::optional<MissionRun> run_;
};

std::string_view text_of(const py::handle& object) {
  Py_ssize_t size = 0;
  const char* data = PyUnicode_AsUTF8AndSize(object.ptr(), &size);
  if (data == nullptr) throw py::error_already_set();
  return {data, static_cast<std::size_t>(size)};
}

std::string_view bytes_of(const py::handle& object) {
  if (!PyBytes_Check(object.ptr())) {
    throw py::type_error(std::string("expected bytes, got ") + Py_TYPE(object.ptr())->tp_name);
  }
  return {PyBytes_AS_STRING(object.ptr()),
          static_cast<std::size_t>(PyBytes_GET_SIZE(object.ptr()))};
}

std::uint64_t nanoseconds_of(const py::handle& object) {
  static_assert(sizeof(unsigned long) == 8);
  const unsigned long value = PyLong_AsUnsignedLong(object.ptr());
  if (value == static_cast<unsigned long>(-1) && PyErr_Occurred() != nullptr) {
    throw py::error_already_set();
  }
  return value;
}

py::dict messages_of(const py::bytes& bytes) {
  const std::string_view content = bytes_of(bytes);
  std::map<std::string, std::string> topics;
  const std::string reason = read_mcap(content, [&topics](const McapMessage& message) {
    std::string& all = topics[std::string(message.topic)];
    if (!all.empty()) all += ',';
    all.append(message.data);
  });
  py::dict found;
  for (const auto& [topic, all] : topics) {
    std::string text("[");
    found[py::str(topic)] = py::bytes(text.append(all).append("]"));
  }
  return py::dict(py::arg("topics") = found, py::arg("reason") = reason);
}

std::vector<std::pair<std::string, py::bytes>> mcap_messages(const py::bytes& content) {
  std::vector<std::pair<std::string, py::bytes>> all;
  read_mcap(std::string_view(content), [&all](const McapMessage& message) {
    all.emplace_back(message.topic, py::bytes(message.data.data(), message.data.size()));
  });
  return all;
}

using LoggedMessage = py::typing::Tuple<py::str, py::int_, py::bytes>;

void write_mcap(const std::string& path, const py::typing::List<LoggedMessage>& messages) {
  McapWriter writer(path);
  std::unordered_map<std::string_view, std::uint16_t> channels;  // by texts that the list holds
  for (const py::handle item : messages) {
    if (!py::isinstance<py::tuple>(item) || PyTuple_GET_SIZE(item.ptr()) != 3) {
      throw_argument("messages", "tuples of topic, time and data", Py_TYPE(item.ptr())->tp_name);
    }
    const std::string_view topic = text_of(PyTuple_GET_ITEM(item.ptr(), 0));
    auto known = channels.find(topic);
    if (known == channels.end()) {
      const std::uint16_t channel = writer.add_channel({0, std::string(topic), "json"});
      known = channels.emplace(topic, channel).first;
    }
    writer.write(known->second, nanoseconds_of(PyTuple_GET_ITEM(item.ptr(), 1)),
                 bytes_of(PyTuple_GET_ITEM(item.ptr(), 2)));
  }
  writer.close();
}

LiveInputs inputs_of(bool stop, const OptionalArray& wrench, const OptionalArray& thrusters,
                     const OptionalArray& fins, const MissionPlan& plan) {
  LiveInputs inputs;
  inputs.stop = stop;
  const auto numbers = [](const char* name, const py::object& given, std::size_t count) {
    std::vector<double> all;
    if (given.is_none()) return all;
    const Values values = values_argument(name, given);
    all.assign(values.data(), values.data() + values.rows());
    if (all.size() != count) {
      throw_argument(name, std::to_string(count) + " numbers", std::to_string(all.size()));
    }
    for (const double value : all) {
      if (!std::isfinite(value)) throw_argument(name, "finite numbers", "others");
    }
    return all;
  };
  inputs.wrench = numbers("wrench", wrench, 6);
  inputs.thrusters = numbers("thrusters", thrusters, plan.vehicle.thrusters.size());
  for (const double command : inputs.thrusters) {
    if (!(std::abs(command) <= 1.0)) {
      throw_argument("thrusters", "commands of -1 to 1", to_text(command));
    }
  }
  inputs.fins = numbers("fins", fins, plan.vehicle.fins.size());
  return inputs;
}

using Arrived =
    std::tuple<std::string, std::string, double, double, std::int64_t, bool, std::vector<double>>;

std::vector<Arrived> arrived_of(const LoggedRun& run) {
  std::vector<Arrived> all;
  for (const ArrivedReading& found : run.run().arrived()) {
    const SensorReading& r = found.reading;
    all.emplace_back(found.device, sensor_kind_name(r.kind), r.time, r.arrival, r.index, r.valid,
                     std::vector<double>(r.values.begin(), r.values.begin() + r.count));
  }
  return all;
}

}  // namespace

void bind_mission(py::module_& module) {
  const MissionPlan d;
  py::class_<MissionPlan, std::shared_ptr<MissionPlan>>(module, "MissionPlan", mission_docs::kPlan)
      .def(py::init([](const std::string& name, const VehicleSystem& system,
                       const py::typing::Optional<Vehicle>& vehicle,
                       const std::vector<DropWeightOptions>& weights, double hotel_power,
                       const World& world, const py::typing::List<SensorOptions>& sensors,
                       const Dict& navigation, const ArrayLike& start, const Dicts& commands,
                       const Dict& tree, const Dicts& guards, const Dicts& faults, double step,
                       int steps_per_tick, double longest) {
             return std::const_pointer_cast<MissionPlan>(
                 made(name, system, vehicle, weights, hotel_power, world, sensors, navigation,
                      start, commands, tree, guards, faults, step, steps_per_tick, longest));
           }),
           py::kw_only(), py::arg("name"), py::arg("system"), py::arg("vehicle"),
           py::arg("weights"), py::arg("hotel_power"), py::arg("world"), py::arg("sensors"),
           py::arg("navigation"), py::arg("start"), py::arg("commands"), py::arg("tree"),
           py::arg("guards"), py::arg("faults"), py::arg("step") = d.step,
           py::arg("steps_per_tick") = d.steps_per_tick, py::arg("longest") = d.longest)
      .def_property_readonly(
          "name", [](const MissionPlan& p) { return p.name; }, "As given.")
      .def_property_readonly("tick", &MissionPlan::tick, "[s]")
      .def_property_readonly(
          "thrusters",
          [](const MissionPlan& p) {
            std::vector<std::string> names;
            for (const ThrusterOptions& t : p.vehicle.thrusters) names.push_back(t.name);
            return names;
          },
          "Their names, in the order of commands.")
      .def_property_readonly(
          "fins",
          [](const MissionPlan& p) {
            std::vector<std::string> names;
            for (const FinOptions& f : p.vehicle.fins) names.push_back(f.name);
            return names;
          },
          "Their names, in the order of angles.")
      .def_property_readonly(
          "sensors", [](const MissionPlan& p) { return p.sensors; }, "In their order.")
      .def_property_readonly(
          "signals", [](const MissionPlan& p) { return mission_signals(p.vehicle, p.sensors); },
          "Names that conditions may use.");

  module.def("typical_sensors", &typical_sensors,
             "What a small vehicle carries, with errors of the middle class.");

  py::class_<LoggedRun>(module, "MissionRun", mission_docs::kRun)
      .def(py::init([](const std::shared_ptr<MissionPlan>& plan, std::uint64_t seed,
                       const std::optional<std::string>& log,
                       const std::optional<py::bytes>& state) {
             std::optional<std::string> saved;
             if (state) saved = std::string(*state);
             return std::make_unique<LoggedRun>(plan, seed, log, saved);
           }),
           py::arg("plan"), py::arg("seed"), py::kw_only(), py::arg("log") = py::none(),
           py::arg("state") = py::none())
      .def(
          "step",
          [](LoggedRun& r, int count, bool stop, const OptionalArray& wrench,
             const OptionalArray& thrusters, const OptionalArray& fins) {
            const LiveInputs inputs = inputs_of(stop, wrench, thrusters, fins, r.run().plan());
            const py::gil_scoped_release unlocked;
            bool on = true;
            for (int i = 0; on && i < count; ++i) on = r.run().step(inputs);
            return on;
          },
          py::arg("count") = 1, py::kw_only(), py::arg("stop") = false,
          py::arg("wrench") = py::none(), py::arg("thrusters") = py::none(),
          py::arg("fins") = py::none(), mission_docs::kStep)
      .def_property_readonly("arrived", &arrived_of, mission_docs::kArrived)
      .def_property_readonly(
          "number", [](const LoggedRun& r) { return r.run().state().number; }, "Of the next tick.")
      .def_property_readonly(
          "velocity",
          [](const LoggedRun& r) {
            return to_numpy(Eigen::VectorXd(r.run().state().vehicle.motion.velocity));
          },
          "(6,) of the vehicle over ground and of turn, in its frame, the true one [m/s, rad/s].")
      .def_property_readonly(
          "time", [](const LoggedRun& r) { return r.run().time(); }, "[s]")
      .def_property_readonly(
          "status",
          [](const LoggedRun& r) { return std::string(status_name(r.run().state().status)); },
          "running, done, failed, aborted, timeout or stopped.")
      .def_property_readonly(
          "signals",
          [](const LoggedRun& r) {
            std::map<std::string, double> all;
            const auto& names = r.run().signals();
            for (std::size_t i = 0; i < names.size(); ++i) {
              all[names[i]] = r.run().state().signals[i];
            }
            return all;
          },
          "What conditions see, by name; NaN is not known.")
      .def_property_readonly(
          "metrics", [](const LoggedRun& r) { return r.run().metrics(); }, "By name.")
      .def_property_readonly(
          "pose",
          [](const LoggedRun& r) {
            return to_numpy(r.run().state().vehicle.motion.world_from_vehicle);
          },
          "(4, 4) world_from_vehicle, the true one.")
      .def_property_readonly(
          "events",
          [](const LoggedRun& r) {
            std::vector<std::tuple<double, std::string, std::string>> all;
            for (const MissionEvent& event : r.events()) {
              all.emplace_back(event.time, event.kind, event.text);
            }
            return all;
          },
          "Of (time, kind, text), of a run with a log.")
      .def(
          "save", [](LoggedRun& r) { return py::bytes(r.save()); },
          "The state, from which another goes on with the same bytes, log included.")
      .def("close", &LoggedRun::close, "Ends the log.");
  module.def("mcap_messages", &mcap_messages, py::arg("content"), mission_docs::kMcapMessages);
  module.def("write_mcap", &write_mcap, py::arg("path"), py::arg("messages"),
             mission_docs::kWriteMcap);
  module.def("read_mcap", &messages_of, py::arg("bytes"), mission_docs::kReadMcap);
}

}  // namespace bathyal::python
