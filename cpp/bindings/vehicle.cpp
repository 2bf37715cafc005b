// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/vehicle/vehicle.hpp"

#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/vehicle/presets.hpp"
#include "bathyal/vehicle/simulate.hpp"
#include "bindings.hpp"
#include "rigid_body.hpp"
#include "vehicle_docs.hpp"

namespace bathyal::python {
namespace {

using TermTuple = std::tuple<int, int, int, bool, double>;
using FreeList = std::optional<std::array<bool, 6>>;
using StateLike = py::typing::Union<ArrayLike, py::typing::Tuple<ArrayLike, ArrayLike>>;
using ThrustLike =
    py::typing::Union<ArrayLike, py::typing::Callable<ArrayLike(py::float_, py::array, py::array)>>;
using CurrentLike =
    py::typing::Union<ArrayLike, py::typing::Callable<ArrayLike(py::array, py::float_)>, py::none>;

Vec6 vec6_argument(std::string_view name, const py::object& object) {
  const Values values = values_argument(name, object);
  if (values.rows() != 6) {
    throw_argument(name, "real numbers of shape (6,)", std::to_string(values.rows()) + " numbers");
  }
  return Eigen::Map<const Vec6>(values.data());
}

Mat6 mat6_argument(std::string_view name, const py::object& object) {
  if (object.is_none()) return Mat6::Zero();
  return square_argument(name, object, 6);
}

py::array vec6_to_numpy(const Vec6& values) {
  return to_numpy(std::vector<double>(values.begin(), values.end()));
}

py::array mat6_to_numpy(const Mat6& matrix) {
  std::vector<double> values;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) values.push_back(matrix(i, j));
  }
  return to_numpy(std::move(values), {6});
}

Vehicle made(double mass, const ArrayLike& inertia, const ArrayLike& center_of_mass, double volume,
             const OptionalArray& added_mass, const OptionalArray& linear_drag,
             const std::vector<TermTuple>& terms, double gravity, double water_density,
             const std::string& name) {
  VehicleOptions options;
  options.name = name;
  options.body = rigid_body_arguments(mass, center_of_mass, inertia, volume, py::none());
  options.added_mass = mat6_argument("added_mass", added_mass);
  options.linear_drag = mat6_argument("linear_drag", linear_drag);
  for (const auto& [row, a, b, absolute, coefficient] : terms) {
    options.terms.push_back({row, a, b, absolute, coefficient});
  }
  options.gravity = gravity;
  options.water_density = water_density;
  return Vehicle(std::move(options));
}

VehicleState state_argument(const py::object& object) {
  VehicleState state;
  if (py::isinstance<py::tuple>(object) || py::isinstance<py::list>(object)) {
    const auto parts = py::reinterpret_borrow<py::sequence>(object);
    if (parts.size() == 2) {
      state.world_from_vehicle = pose_argument("state", parts[0]);
      state.velocity = vec6_argument("state", parts[1]);
      return state;
    }
  }
  state.world_from_vehicle = pose_argument("state", object);
  return state;
}

/// A constant, or what a function gives, which is called with the interpreter's lock held.
WrenchFunction wrench_argument(const py::object& object) {
  if (PyCallable_Check(object.ptr()) == 0) {
    const Vec6 wrench = vec6_argument("thrust", object);
    return [wrench](double, const VehicleState&) { return wrench; };
  }
  return [object](double time, const VehicleState& state) {
    const py::gil_scoped_acquire locked;
    return vec6_argument(
        "thrust", object(time, to_numpy(state.world_from_vehicle), vec6_to_numpy(state.velocity)));
  };
}

FlowFunction flow_argument(const py::object& object) {
  if (object.is_none()) return {};
  if (PyCallable_Check(object.ptr()) == 0) {
    const Vec3 current = vector_argument("current", object);
    return [current](const Vec3&, double) { return Flow{current, Vec3::Zero()}; };
  }
  return [object](const Vec3& point, double time) {
    const py::gil_scoped_acquire locked;
    const py::array place = to_numpy(std::vector<double>(point.begin(), point.end()));
    return Flow{vector_argument("current", object(place, time)), Vec3::Zero()};
  };
}

VehicleMotionRecord simulated(const Vehicle& vehicle, const StateLike& state,
                              const ThrustLike& thrust, double duration, double step,
                              const CurrentLike& current, const FreeList& free) {
  SimulateOptions options;
  options.duration = duration;
  options.step = step;
  options.free = free.value_or(kAllFree);
  const VehicleState start = state_argument(state);
  const WrenchFunction wrench = wrench_argument(thrust);
  const FlowFunction flow = flow_argument(current);
  const py::gil_scoped_release unlocked;
  return simulate(vehicle, start, wrench, flow, options);
}

void bind_motion(py::module_& module) {
  py::class_<VehicleMotionRecord>(module, "VehicleMotion", "How a vehicle moved, step by step.")
      .def_property_readonly(
          "time",
          [](const VehicleMotionRecord& m) { return to_numpy(std::vector<double>(m.time)); },
          "(K,) [s].")
      .def_property_readonly(
          "pose",
          [](const VehicleMotionRecord& m) {
            std::vector<Pose> poses;
            for (const VehicleState& state : m.state) poses.push_back(state.world_from_vehicle);
            return to_numpy(poses);
          },
          "(K, 4, 4) world_from_vehicle.")
      .def_property_readonly(
          "velocity",
          [](const VehicleMotionRecord& m) {
            std::vector<double> values;
            for (const VehicleState& state : m.state) {
              values.insert(values.end(), state.velocity.begin(), state.velocity.end());
            }
            return to_numpy(std::move(values), {6});
          },
          "(K, 6) over ground, linear then angular, in the vehicle's frame [m/s, rad/s].")
      .def("__len__", [](const VehicleMotionRecord& m) { return m.time.size(); })
      .def("__repr__", [](const VehicleMotionRecord& m) {
        return "VehicleMotion(" + std::to_string(m.time.size()) + " states, to " +
               to_text(m.time.back()) + " s)";
      });
}

}  // namespace

void bind_vehicle(py::module_& module) {
  bind_motion(module);
  const auto field = [](auto VehicleOptions::*member) {
    return [member](const Vehicle& v) { return v.options().*member; };
  };
  py::class_<Vehicle>(module, "Vehicle", vehicle_docs::kVehicle)
      .def(py::init(&made), py::kw_only(), py::arg("mass"), py::arg("inertia"),
           py::arg("center_of_mass"), py::arg("volume"), py::arg("added_mass") = py::none(),
           py::arg("linear_drag") = py::none(), py::arg("terms") = std::vector<TermTuple>{},
           py::arg("gravity") = 9.80665, py::arg("water_density") = 1025.0,
           py::arg("name") = "vehicle")
      .def_static(
          "remus100", [](bool equal) { return Vehicle(remus100(equal)); },
          py::arg("equal_cross_flow") = false, "`bathyal.vehicles.remus100`.")
      .def_static(
          "bluerov2_heavy", [] { return Vehicle(bluerov2_heavy()); },
          "`bathyal.vehicles.bluerov2_heavy`.")
      .def_property_readonly("name", field(&VehicleOptions::name), "As given.")
      .def_property_readonly(
          "mass", [](const Vehicle& v) { return v.options().body.mass; }, "[kg]")
      .def_property_readonly(
          "volume", [](const Vehicle& v) { return v.options().body.volume; }, "[m³]")
      .def_property_readonly(
          "center_of_mass",
          [](const Vehicle& v) {
            const Vec3& center = v.options().body.center_of_mass;
            return to_numpy(std::vector<double>(center.begin(), center.end()));
          },
          "(3,) [m]")
      .def_property_readonly(
          "inertia", [](const Vehicle& v) { return to_numpy(v.options().body.inertia); },
          "(3, 3) about the centre of mass [kg m²].")
      .def_property_readonly(
          "added_mass", [](const Vehicle& v) { return mat6_to_numpy(v.options().added_mass); },
          "(6, 6)")
      .def_property_readonly(
          "linear_drag", [](const Vehicle& v) { return mat6_to_numpy(v.options().linear_drag); },
          "(6, 6) D of the force −D ν.")
      .def_property_readonly(
          "terms",
          [](const Vehicle& v) {
            std::vector<TermTuple> all;
            for (const ForceTerm& t : v.options().terms) {
              all.emplace_back(t.row, t.a, t.b, t.absolute, t.coefficient);
            }
            return all;
          },
          "Of (row, a, b, absolute, coefficient).")
      .def_property_readonly("gravity", field(&VehicleOptions::gravity), "[m/s²]")
      .def_property_readonly("water_density", field(&VehicleOptions::water_density), "[kg/m³]")
      .def_property_readonly(
          "mass_matrix", [](const Vehicle& v) { return mat6_to_numpy(v.mass_matrix()); },
          "(6, 6) of body and added mass about the origin.")
      .def("simulate", &simulated, py::arg("state"), py::arg("thrust"), py::arg("duration"),
           py::arg("step") = 0.01, py::arg("current") = py::none(), py::arg("free") = py::none(),
           vehicle_docs::kSimulate)
      .def("__repr__", [](const Vehicle& v) {
        return "Vehicle(" + v.options().name + ": " + to_text(v.options().body.mass) + " kg)";
      });
  module.def(
      "ellipsoid_added_mass",
      [](const ArrayLike& half_axes, double water_density) {
        return mat6_to_numpy(
            ellipsoid_added_mass(vector_argument("half_axes", half_axes), water_density));
      },
      py::arg("half_axes"), py::arg("water_density") = 1025.0, vehicle_docs::kEllipsoid);
}

}  // namespace bathyal::python
