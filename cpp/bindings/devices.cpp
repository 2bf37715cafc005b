// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <functional>
#include <memory>
#include <utility>
#include <variant>

#include "bathyal/base/error.hpp"
#include "bathyal/vehicle/device_presets.hpp"
#include "bathyal/vehicle/devices/thruster_fit.hpp"
#include "bindings.hpp"
#include "device_parts.hpp"
#include "devices_docs.hpp"

namespace bathyal::python {
namespace {

using Two = std::pair<double, double>;
using Three = std::tuple<double, double, double>;

ThrusterTable table_of(const ArrayLike& command, const ArrayLike& voltage, const ArrayLike& thrust,
                       const ArrayLike& power, const ArrayLike& speed) {
  ThrusterTable table;
  table.command = numbers_argument("command", command);
  table.voltage = numbers_argument("voltage", voltage);
  const auto columns = static_cast<Index>(table.command.size());
  const auto values = [&](std::string_view name, const py::object& object) {
    const auto rows = table_argument(name, object, columns);
    return std::vector<double>(rows.data(), rows.data() + rows.size());
  };
  table.thrust = values("thrust", thrust);
  table.power = values("power", power);
  table.speed = values("speed", speed);
  table.check();
  return table;
}

Three three(const ThrusterPoint& point) { return {point.thrust, point.power, point.speed}; }

Thruster thruster_of(Two thrust, Two speed, const ArrayLike& position, const ArrayLike& direction,
                     Two torque, Two shape, Two voltage_exponent, Two power_cubic,
                     Two power_quartic, double inflow, double torque_inflow, int spin,
                     double dead_zone, double nominal_voltage, double lag,
                     const std::optional<ThrusterTable>& table, const std::string& name) {
  ThrusterOptions options;
  options.name = name;
  options.position = vector_argument("position", position);
  options.direction = vector_argument("direction", direction);
  options.ahead = {thrust.first,           torque.first,      speed.first,        shape.first,
                   voltage_exponent.first, power_cubic.first, power_quartic.first};
  options.astern = {thrust.second,           torque.second,      speed.second,        shape.second,
                    voltage_exponent.second, power_cubic.second, power_quartic.second};
  options.inflow = inflow;
  options.torque_inflow = torque_inflow;
  options.spin = spin;
  options.dead_zone = dead_zone;
  options.nominal_voltage = nominal_voltage;
  options.lag = lag;
  if (table) options.table = std::make_shared<const ThrusterTable>(*table);
  return Thruster(options);
}

Thruster placed_thruster(const Thruster& thruster, const ArrayLike& position,
                         const ArrayLike& direction, const std::optional<std::string>& name) {
  ThrusterOptions options = thruster.options();
  options.position = vector_argument("position", position);
  options.direction = vector_argument("direction", direction);
  if (name) options.name = *name;
  return Thruster(options);
}

void bind_table(py::module_& module) {
  const auto rows = [](std::vector<double> ThrusterTable::*member) {
    return [member](const ThrusterTable& t) {
      return to_numpy(std::vector<double>(t.*member), {static_cast<py::ssize_t>(t.command.size())});
    };
  };
  py::class_<ThrusterTable>(module, "ThrusterTable", devices_docs::kTable)
      .def(py::init(&table_of), py::arg("command"), py::arg("voltage"), py::kw_only(),
           py::arg("thrust"), py::arg("power"), py::arg("speed"))
      .def(
          "at", [](const ThrusterTable& t, double c, double v) { return three(t.at(c, v)); },
          py::arg("command"), py::arg("voltage"),
          "(thrust [N], power [W], speed [1/s]), bilinear; beyond the ends as at the ends.")
      .def_property_readonly(
          "command",
          [](const ThrusterTable& t) { return to_numpy(std::vector<double>(t.command)); }, "(K,)")
      .def_property_readonly(
          "voltage",
          [](const ThrusterTable& t) { return to_numpy(std::vector<double>(t.voltage)); },
          "(L,) [V].")
      .def_property_readonly("thrust", rows(&ThrusterTable::thrust), "(L, K) [N].")
      .def_property_readonly("power", rows(&ThrusterTable::power), "(L, K) [W].")
      .def_property_readonly("speed", rows(&ThrusterTable::speed), "(L, K) [1/s].")
      .def("__repr__", [](const ThrusterTable& t) {
        return "ThrusterTable(" + std::to_string(t.command.size()) + " commands, " +
               std::to_string(t.voltage.size()) + " voltages)";
      });
}

Thruster t200_with(const std::optional<ThrusterTable>& table) {
  ThrusterOptions options = t200();
  if (table) options.table = std::make_shared<const ThrusterTable>(*table);
  return Thruster(options);
}

Thruster propeller(double diameter, Two thrust, Two torque, double speed, double water_density) {
  ThrusterOptions options;
  options.name = "propeller";
  set_propeller(options, diameter, thrust, torque, water_density);
  options.ahead.speed = options.astern.speed = speed;
  return Thruster(options);
}

void bind_thruster(py::module_& module) {
  const ThrusterOptions d;
  const ThrusterSide s;
  const auto both = [](double value) { return Two(value, value); };
  const auto pair = [](double ThrusterSide::*member) {
    return [member](const Thruster& t) {
      return Two(t.options().ahead.*member, t.options().astern.*member);
    };
  };
  py::class_<Thruster>(module, "Thruster", devices_docs::kThruster)
      .def(py::init(&thruster_of), py::kw_only(), py::arg("thrust"), py::arg("speed"),
           py::arg("position") = py::make_tuple(0.0, 0.0, 0.0),
           py::arg("direction") = py::make_tuple(1.0, 0.0, 0.0), py::arg("torque") = both(s.torque),
           py::arg("shape") = both(s.shape), py::arg("voltage_exponent") = both(s.voltage_exponent),
           py::arg("power_cubic") = both(s.power_cubic),
           py::arg("power_quartic") = both(s.power_quartic), py::arg("inflow") = d.inflow,
           py::arg("torque_inflow") = d.torque_inflow, py::arg("spin") = d.spin,
           py::arg("dead_zone") = d.dead_zone, py::arg("nominal_voltage") = d.nominal_voltage,
           py::arg("lag") = d.lag, py::arg("table") = py::none(), py::arg("name") = d.name)
      .def_static("t200", &t200_with, py::arg("table") = py::none(),
                  "Blue Robotics' T200: the law fitted to their bollard tests, or those tests.")
      .def_static(
          "t200_benchmark", [] { return Thruster(t200_benchmark()); },
          "The T200 of von Benzon and others (2022), at most 30.6 N at any voltage.")
      .def_static("propeller", &propeller, py::kw_only(), py::arg("diameter"), py::arg("thrust"),
                  py::arg("torque") = Two(0.0, 0.0), py::arg("speed"),
                  py::arg("water_density") = VehicleOptions().water_density,
                  "By the advance ratio J: K_T = thrust[0] + thrust[1] J, K_Q likewise; diameter "
                  "[m], speed at full command [1/s].")
      .def("placed", &placed_thruster, py::arg("position"), py::arg("direction"),
           py::arg("name") = py::none(), "The same thruster elsewhere on the vehicle.")
      .def(
          "steady", [](const Thruster& t, double c, double v) { return three(t.steady(c, v)); },
          py::arg("command"), py::arg("voltage"),
          "(thrust [N], power [W], speed [1/s]) that it settles at in still water.")
      .def("command_for", &Thruster::command_for, py::arg("thrust"), py::arg("voltage"),
           "The command whose steady thrust is `thrust` [N]; beyond what it can give, the nearest.")
      .def(
          "advanced",
          [](const Thruster& t, double speed, double command, double voltage, double time) {
            return t.advanced({speed}, t.drive(command, voltage), time).speed;
          },
          py::arg("speed"), py::arg("command"), py::arg("voltage"), py::arg("time"),
          "The propeller's speed [1/s] a time [s] after `speed`, under a command.")
      .def(
          "wrench",
          [](const Thruster& t, double speed, const OptionalArray& relative) {
            return six_to_numpy(t.wrench(speed, {}, six_argument("relative", relative)));
          },
          py::arg("speed"), py::arg("relative") = py::none(),
          "(6,) force and moment about the vehicle's origin by the law, at a propeller's speed "
          "[1/s] and a velocity (6,) through the water.")
      .def_property_readonly(
          "name", [](const Thruster& t) { return t.options().name; }, "As given.")
      .def_property_readonly(
          "position", [](const Thruster& t) { return to_numpy(t.options().position); }, "(3,) [m].")
      .def_property_readonly(
          "direction", [](const Thruster& t) { return to_numpy(t.options().direction); },
          "(3,) of length 1.")
      .def_property_readonly("thrust", pair(&ThrusterSide::thrust), "Of n², (ahead, astern).")
      .def_property_readonly("speed", pair(&ThrusterSide::speed), "At full command [1/s].")
      .def_property_readonly(
          "lag", [](const Thruster& t) { return t.options().lag; }, "Time constant [s].")
      .def("__repr__", [](const Thruster& t) { return "Thruster(" + t.options().name + ")"; });
}

void bind_fit(py::module_& module) {
  py::class_<ThrusterFit>(module, "ThrusterFit", "A law fitted to a table.")
      .def_property_readonly(
          "thruster", [](const ThrusterFit& f) { return Thruster(f.options); },
          "The law, without the table.")
      .def_readonly("rms_ahead", &ThrusterFit::rms_ahead, "Of the thrust by speed [N].")
      .def_readonly("rms_astern", &ThrusterFit::rms_astern, "The same astern [N].")
      .def_readonly("rms_command", &ThrusterFit::rms_command,
                    "Of the thrust by command and voltage, both ways [N].")
      .def_readonly("rms_power", &ThrusterFit::rms_power, "Of the power by speed [W].");
  module.def("fit_thruster", &fit_thruster, py::arg("table"),
             py::arg("nominal_voltage") = ThrusterOptions().nominal_voltage, devices_docs::kFit);
}

Battery battery_of(double capacity, double resistance, const ArrayLike& charge,
                   const ArrayLike& voltage, const std::string& name) {
  return Battery({name, capacity, resistance, numbers_argument("charge", charge),
                  numbers_argument("voltage", voltage)});
}

BatteryLoad battery_load(const Battery& battery,
                         const std::variant<double, std::function<double(double)>>& power,
                         double charge) {
  if (!(charge >= 0.0 && charge <= 1.0)) {
    throw_argument("charge", "a number from 0 to 1", to_text(charge));
  }
  return battery.solve({charge}, [&](double voltage) {
    const auto* constant = std::get_if<double>(&power);
    const double drawn =
        constant != nullptr ? *constant : std::get<std::function<double(double)>>(power)(voltage);
    if (!std::isfinite(drawn)) throw_argument("power", "a finite number", to_text(drawn));
    return drawn;
  });
}

void bind_battery(py::module_& module) {
  py::class_<BatteryLoad>(module, "BatteryLoad", "A battery's voltage and current at one moment.")
      .def_readonly("voltage", &BatteryLoad::voltage, "At the terminals [V].")
      .def_readonly("current", &BatteryLoad::current, "[A]")
      .def_readonly("collapsed", &BatteryLoad::collapsed,
                    "More power is asked for than it can give; then the most that it can.");
  py::class_<Battery>(module, "Battery", devices_docs::kBattery)
      .def(py::init(&battery_of), py::kw_only(), py::arg("capacity"), py::arg("resistance"),
           py::arg("charge"), py::arg("voltage"), py::arg("name") = BatteryOptions().name)
      .def_static(
          "lithium_ion_4s", [] { return Battery(lithium_ion_4s()); },
          "Four cells in series, 14.8 V, 18 A h; its curve and resistance are typical ones.")
      .def("solve", &battery_load, py::arg("power"), py::arg("charge") = 1.0, devices_docs::kSolve)
      .def("open_circuit", &Battery::open_circuit, py::arg("charge"),
           "Voltage without a load [V] at a share of the capacity; 0 for an empty one.")
      .def_property_readonly(
          "capacity", [](const Battery& b) { return b.options().capacity; }, "[A h]")
      .def_property_readonly(
          "resistance", [](const Battery& b) { return b.options().resistance; }, "[Ω]")
      .def("__repr__", [](const Battery& b) {
        return "Battery(" + b.options().name + ": " + to_text(b.options().capacity) + " A h)";
      });
}

Fin fin_of(const ArrayLike& position, const ArrayLike& forward, const ArrayLike& shaft, double area,
           double lift_slope, double drag, double induced_drag, double stall,
           const OptionalArray& published, double limit, double rate, double lag,
           double water_density, const std::string& name) {
  FinOptions options;
  options.name = name;
  options.position = vector_argument("position", position);
  options.forward = vector_argument("forward", forward);
  options.shaft = vector_argument("shaft", shaft);
  options.area = area;
  options.lift_slope = lift_slope;
  options.drag = drag;
  options.induced_drag = induced_drag;
  options.stall = stall;
  options.published = six_argument("published", published);
  options.limit = limit;
  options.rate = rate;
  options.lag = lag;
  options.water_density = water_density;
  return Fin(options);
}

void bind_fin(py::module_& module) {
  const FinOptions d;
  py::class_<Fin>(module, "Fin", devices_docs::kFin)
      .def(py::init(&fin_of), py::kw_only(), py::arg("position") = py::make_tuple(0.0, 0.0, 0.0),
           py::arg("forward") = py::make_tuple(1.0, 0.0, 0.0),
           py::arg("shaft") = py::make_tuple(0.0, 0.0, 1.0), py::arg("area") = d.area,
           py::arg("lift_slope") = d.lift_slope, py::arg("drag") = d.drag,
           py::arg("induced_drag") = d.induced_drag, py::arg("stall") = d.stall,
           py::arg("published") = py::none(), py::arg("limit") = d.limit, py::arg("rate") = d.rate,
           py::arg("lag") = d.lag, py::arg("water_density") = d.water_density,
           py::arg("name") = d.name)
      .def(
          "wrench",
          [](const Fin& f, double angle, const ArrayLike& relative) {
            return six_to_numpy(f.wrench(angle, six_argument("relative", relative)));
          },
          py::arg("angle"), py::arg("relative"),
          "(6,) force and moment about the vehicle's origin, at an angle [rad] and a velocity (6,) "
          "through the water.")
      .def("coefficients", &Fin::coefficients, py::arg("attack"),
           "(lift, drag) coefficients of a wing at an angle of attack [rad].")
      .def(
          "advanced",
          [](const Fin& f, double angle, double command, double time) {
            return f.advanced({angle}, command, time).angle;
          },
          py::arg("angle"), py::arg("command"), py::arg("time"),
          "The angle [rad] a time [s] after `angle`, under a command [rad].")
      .def_property_readonly(
          "name", [](const Fin& f) { return f.options().name; }, "As given.")
      .def("__repr__", [](const Fin& f) { return "Fin(" + f.options().name + ")"; });
}

}  // namespace

void bind_devices(py::module_& module) {
  bind_table(module);
  bind_thruster(module);
  bind_fit(module);
  bind_battery(module);
  bind_fin(module);
}

}  // namespace bathyal::python
