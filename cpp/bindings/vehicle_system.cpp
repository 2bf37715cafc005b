// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/vehicle/vehicle_system.hpp"

#include <pybind11/stl.h>

#include <optional>

#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/vehicle/device_presets.hpp"
#include "bindings.hpp"
#include "device_parts.hpp"
#include "devices_docs.hpp"

namespace bathyal::python {
namespace {

DropWeightOptions drop_weight_of(double mass, double volume, const ArrayLike& position,
                                 const std::string& name) {
  DropWeightOptions weight{name, vector_argument("position", position), mass, volume};
  weight.check();
  return weight;
}

TetherOptions tether_of(const ArrayLike& anchor, const ArrayLike& attachment, double length,
                        double weight, double diameter, double drag, double stiffness,
                        double water_density) {
  TetherOptions tether{vector_argument("anchor", anchor),
                       vector_argument("attachment", attachment),
                       length,
                       weight,
                       diameter,
                       drag,
                       stiffness,
                       water_density};
  tether.check();
  return tether;
}

void bind_carried(py::module_& module) {
  const DropWeightOptions w;
  const TetherOptions d;
  py::class_<DropWeightOptions>(
      module, "DropWeight",
      "Ballast that is held until it is let go. Of mass [kg] and volume [m³] at a (3,) position "
      "[m] only the weight in water counts, not the inertia.")
      .def(py::init(&drop_weight_of), py::kw_only(), py::arg("mass"), py::arg("volume") = w.volume,
           py::arg("position") = py::make_tuple(0.0, 0.0, 0.0), py::arg("name") = w.name)
      .def_readonly("name", &DropWeightOptions::name, "As given.")
      .def_readonly("mass", &DropWeightOptions::mass, "[kg]");
  py::class_<TetherOptions>(module, "Tether", devices_docs::kTether)
      .def(py::init(&tether_of), py::kw_only(), py::arg("anchor"),
           py::arg("attachment") = py::make_tuple(0.0, 0.0, 0.0), py::arg("length"),
           py::arg("weight") = d.weight, py::arg("diameter") = d.diameter, py::arg("drag") = d.drag,
           py::arg("stiffness") = d.stiffness, py::arg("water_density") = d.water_density)
      .def(
          "wrench",
          [](const TetherOptions& t, const ArrayLike& pose, const OptionalArray& current) {
            return six_to_numpy(tether_wrench(t, given_pose_argument("pose", pose),
                                              vector_or_zero("current", current)));
          },
          py::arg("pose"), py::arg("current") = py::none(),
          "(6,) force and moment about the origin of a vehicle at a (4, 4) pose, in its frame, in "
          "a "
          "current (3,) of the world [m/s].")
      .def_readonly("length", &TetherOptions::length, "[m]");
}

VehicleSystem system_of(const Vehicle& vehicle, const std::vector<Thruster>& thrusters,
                        const std::vector<Fin>& fins, const std::optional<Battery>& battery,
                        double supply_voltage, double hotel_power,
                        const std::vector<DropWeightOptions>& drop_weights,
                        const std::optional<TetherOptions>& tether) {
  VehicleSystemOptions options;
  options.vehicle = vehicle.options();
  for (const Thruster& thruster : thrusters) options.thrusters.push_back(thruster.options());
  for (const Fin& fin : fins) options.fins.push_back(fin.options());
  if (battery) options.battery = battery->options();
  options.supply_voltage = supply_voltage;
  options.hotel_power = hotel_power;
  options.drop_weights = drop_weights;
  options.tether = tether;
  return VehicleSystem(options);
}

VehicleCommands commands_of(const VehicleSystem& system, const OptionalArray& thrusters,
                            const OptionalArray& fins, const std::vector<bool>& drop) {
  VehicleCommands commands{numbers_argument("thrusters", thrusters),
                           numbers_argument("fins", fins),
                           {drop.begin(), drop.end()}};
  if (thrusters.is_none()) commands.thrusters.assign(system.thrusters().size(), 0.0);
  if (fins.is_none()) commands.fins.assign(system.fins().size(), 0.0);
  return commands;
}

void step_system(const VehicleSystem& system, VehicleSystemState& state,
                 const OptionalArray& thrusters, const OptionalArray& fins,
                 const std::vector<bool>& drop, const OptionalArray& current,
                 const OptionalArray& wrench, double step, int steps) {
  check_not_negative("steps", steps);
  const VehicleCommands commands = commands_of(system, thrusters, fins, drop);
  const StepConditions around{{vector_or_zero("current", current), Vec3::Zero()},
                              six_argument("wrench", wrench)};
  const StepConditionsFunction conditions = [&](double, const VehicleState&) { return around; };
  VehicleSystemState next = state;  // an error in the middle leaves the caller's as it was
  {
    const py::gil_scoped_release unlocked;
    for (int k = 0; k < steps; ++k) system.step(next, commands, conditions, step);
  }
  state = next;
}

void bind_state(py::module_& module) {
  py::class_<VehicleSystemState>(module, "VehicleSystemState",
                                 "All that changes in time of a vehicle and its devices.")
      .def_property(
          "pose", [](const VehicleSystemState& s) { return to_numpy(s.motion.world_from_vehicle); },
          [](VehicleSystemState& s, const ArrayLike& pose) {
            const Pose given = given_pose_argument("pose", pose);
            check_rigid("pose", given);
            s.motion.world_from_vehicle = given;
          },
          "(4, 4) world_from_vehicle.")
      .def_property(
          "velocity", [](const VehicleSystemState& s) { return six_to_numpy(s.motion.velocity); },
          [](VehicleSystemState& s, const ArrayLike& velocity) {
            s.motion.velocity = six_argument("velocity", velocity);
          },
          "(6,) over ground, in the vehicle's frame [m/s, rad/s].")
      .def_property(
          "thruster_speed",
          [](const VehicleSystemState& s) {
            std::vector<double> values;
            for (const ThrusterState& one : s.thrusters) values.push_back(one.speed);
            return to_numpy(std::move(values));
          },
          [](VehicleSystemState& s, const ArrayLike& speed) {
            const std::vector<double> values = numbers_argument("thruster_speed", speed);
            if (values.size() != s.thrusters.size()) {
              throw_argument("thruster_speed", std::to_string(s.thrusters.size()) + " numbers",
                             std::to_string(values.size()));
            }
            for (const double value : values) check_finite("thruster_speed", value);
            for (std::size_t i = 0; i < values.size(); ++i) s.thrusters[i].speed = values[i];
          },
          "(m,) of the propellers [1/s].")
      .def_property_readonly(
          "fin_angle",
          [](const VehicleSystemState& s) {
            std::vector<double> values;
            for (const FinState& one : s.fins) values.push_back(one.angle);
            return to_numpy(std::move(values));
          },
          "(n,) [rad].")
      .def_property(
          "charge", [](const VehicleSystemState& s) { return s.battery.charge; },
          [](VehicleSystemState& s, double charge) {
            check_range("charge", charge, 0.0, 1.0);
            s.battery.charge = charge;
          },
          "Share of the battery's capacity that is left.")
      .def_property_readonly(
          "released",
          [](const VehicleSystemState& s) {
            std::vector<bool> values;
            for (const DropWeightState& one : s.drop_weights) values.push_back(one.released != 0);
            return values;
          },
          "Which drop weights are gone.")
      .def("__copy__", [](const VehicleSystemState& s) { return VehicleSystemState(s); })
      .def(
          "__deepcopy__",
          [](const VehicleSystemState& s, const py::dict&) { return VehicleSystemState(s); },
          py::arg("memo"))
      .def("__repr__", [](const VehicleSystemState& s) {
        return "VehicleSystemState(" + std::to_string(s.thrusters.size()) + " thrusters, " +
               std::to_string(s.fins.size()) + " fins)";
      });
}

void bind_system(py::module_& module) {
  const VehicleSystemOptions d;
  py::class_<VehicleSystem>(module, "VehicleSystem", devices_docs::kSystem)
      .def(py::init(&system_of), py::arg("vehicle"), py::kw_only(),
           py::arg("thrusters") = std::vector<Thruster>{}, py::arg("fins") = std::vector<Fin>{},
           py::arg("battery") = py::none(), py::arg("supply_voltage") = d.supply_voltage,
           py::arg("hotel_power") = d.hotel_power,
           py::arg("drop_weights") = std::vector<DropWeightOptions>{},
           py::arg("tether") = py::none())
      .def_static(
          "bluerov2_heavy",
          [](bool benchmark) { return VehicleSystem(bluerov2_heavy_system(benchmark)); },
          py::kw_only(), py::arg("benchmark_thrusters") = false,
          "BlueROV2 Heavy with eight T200 (or `Thruster.t200_benchmark`) and a battery of 18 A h.")
      .def_static(
          "remus100", [](bool equal) { return VehicleSystem(remus100_system(equal)); },
          py::kw_only(), py::arg("equal_cross_flow") = false,
          "REMUS 100 with propeller, rudder (positive: to port) and stern plane (positive: bow "
          "down) of Prestero (2001).")
      .def_property_readonly("vehicle", &VehicleSystem::vehicle, "Its equations of motion.")
      .def_property_readonly("thrusters", &VehicleSystem::thrusters, "In the order of commands.")
      .def_property_readonly("fins", &VehicleSystem::fins, "In the order of commands.")
      .def("rest", &VehicleSystem::rest, "At rest at the world's origin, the battery full.")
      .def("step", &step_system, py::arg("state"), py::kw_only(), py::arg("thrusters") = py::none(),
           py::arg("fins") = py::none(), py::arg("drop") = std::vector<bool>{},
           py::arg("current") = py::none(), py::arg("wrench") = py::none(), py::arg("step") = 0.01,
           py::arg("steps") = 1, devices_docs::kStep)
      .def(
          "supply",
          [](const VehicleSystem& s, const VehicleSystemState& state,
             const OptionalArray& thrusters) {
            return s.supply(state, commands_of(s, thrusters, py::none(), {}));
          },
          py::arg("state"), py::kw_only(), py::arg("thrusters") = py::none(),
          "Voltage and current under (m,) commands, at a state.")
      .def(
          "wrench",
          [](const VehicleSystem& s, const VehicleSystemState& state,
             const OptionalArray& thrusters, const OptionalArray& current) {
            return six_to_numpy(
                s.device_wrench(state, commands_of(s, thrusters, py::none(), {}),
                                {vector_or_zero("current", current), Vec3::Zero()}));
          },
          py::arg("state"), py::kw_only(), py::arg("thrusters") = py::none(),
          py::arg("current") = py::none(),
          "(6,) force and moment of all devices at a state, about the vehicle's origin.")
      .def("__repr__", [](const VehicleSystem& s) {
        return "VehicleSystem(" + s.options().vehicle.name + ": " +
               std::to_string(s.thrusters().size()) + " thrusters, " +
               std::to_string(s.fins().size()) + " fins)";
      });
}

}  // namespace

void bind_vehicle_system(py::module_& module) {
  bind_carried(module);
  bind_state(module);
  bind_system(module);
}

}  // namespace bathyal::python
