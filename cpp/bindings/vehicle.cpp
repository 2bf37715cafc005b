// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/vehicle/vehicle.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/vehicle/from_mesh.hpp"
#include "bathyal/vehicle/presets.hpp"
#include "bathyal/vehicle/simulate.hpp"
#include "bathyal/world/world.hpp"
#include "bindings.hpp"
#include "rigid_body.hpp"
#include "vehicle_docs.hpp"
#include "vehicle_parts.hpp"

namespace bathyal::python {

Vec6 vec6_argument(std::string_view name, const py::object& object) {
  const Values values = values_argument(name, object);
  if (values.rows() != 6) {
    throw_argument(name, "real numbers of shape (6,)", std::to_string(values.rows()) + " numbers");
  }
  const Vec6 result = Eigen::Map<const Vec6>(values.data());
  if (!result.allFinite()) throw_argument(name, "finite numbers", "others");
  return result;
}

py::array vec6_to_numpy(const Vec6& values) {
  return to_numpy(std::vector<double>(values.begin(), values.end()));
}

py::array poses_to_numpy(const VehicleMotionRecord& motion) {
  std::vector<Pose> poses;
  for (const VehicleState& state : motion.state) poses.push_back(state.world_from_vehicle);
  return to_numpy(poses);
}

py::array velocities_to_numpy(const VehicleMotionRecord& motion) {
  std::vector<double> values;
  for (const VehicleState& state : motion.state) {
    values.insert(values.end(), state.velocity.begin(), state.velocity.end());
  }
  return to_numpy(std::move(values), {6});
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

namespace {

using TermTuple = std::tuple<int, int, int, bool, double>;
using FreeLike = py::typing::Optional<py::typing::Iterable<py::bool_>>;
using OptionalWorld = py::typing::Optional<World>;
using KeywordValue =
    py::typing::Union<py::float_, py::str, ArrayLike, py::typing::List<TermTuple>, py::none>;
using FlowLike =
    py::typing::Union<ArrayLike, py::typing::Callable<ArrayLike(py::array, py::float_)>, py::none>;

Mat6 mat6_argument(std::string_view name, const py::object& object) {
  if (object.is_none()) return Mat6::Zero();
  return square_argument(name, object, 6);
}

py::array mat6_to_numpy(const Mat6& matrix) {
  std::vector<double> values;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) values.push_back(matrix(i, j));
  }
  return to_numpy(std::move(values), {6});
}

std::vector<VehiclePart> parts_argument(const py::object& object) {
  std::vector<VehiclePart> parts;
  if (object.is_none()) return parts;
  const auto rows = table_argument("parts", object, 5);
  for (Index i = 0; i < rows.rows(); ++i) {
    parts.push_back({Vec3(rows(i, 0), rows(i, 1), rows(i, 2)), rows(i, 3), rows(i, 4)});
  }
  return parts;
}

Vehicle made(double mass, const ArrayLike& inertia, const ArrayLike& center_of_mass, double volume,
             const OptionalArray& added_mass, const OptionalArray& linear_drag,
             const OptionalArray& quadratic_drag, const std::vector<TermTuple>& terms,
             const OptionalArray& parts, double gravity, double water_density,
             const std::string& name, bool z_down) {
  VehicleOptions options;
  options.name = name;
  options.body =
      rigid_body_arguments(mass, center_of_mass, inertia, volume, py::make_tuple(0.0, 0.0, 0.0));
  options.added_mass = mat6_argument("added_mass", added_mass);
  options.linear_drag = mat6_argument("linear_drag", linear_drag);
  if (!quadratic_drag.is_none()) {
    const Vec6 drag = vec6_argument("quadratic_drag", quadratic_drag);
    for (int i = 0; i < 6; ++i) options.terms.push_back({i, i, i, true, -drag[i]});
  }
  for (const auto& [row, a, b, absolute, coefficient] : terms) {
    options.terms.push_back({row, a, b, absolute, coefficient});
  }
  options.parts = parts_argument(parts);
  options.gravity = gravity;
  options.water_density = water_density;
  return Vehicle(z_down ? from_z_down(std::move(options)) : std::move(options));
}

py::list terms_of(const Vehicle& vehicle) {
  py::list all;
  for (const ForceTerm& t : vehicle.options().terms) {
    all.append(py::make_tuple(t.row, t.a, t.b, t.absolute, t.coefficient));
  }
  return all;
}

py::array parts_of(const Vehicle& vehicle) {
  std::vector<double> values;
  for (const VehiclePart& part : vehicle.options().parts) {
    values.insert(values.end(), part.center.begin(), part.center.end());
    values.push_back(part.radius);
    values.push_back(part.volume);
  }
  return to_numpy(std::move(values), {5});
}

py::array center_of_mass_of(const Vehicle& vehicle) {
  const Vec3& center = vehicle.options().body.center_of_mass;
  return to_numpy(std::vector<double>(center.begin(), center.end()));
}

/// The keywords that make it anew.
py::dict keywords_of(const Vehicle& vehicle) {
  const VehicleOptions& options = vehicle.options();
  py::dict all;
  all["mass"] = options.body.mass;
  all["inertia"] = to_numpy(options.body.inertia);
  all["center_of_mass"] = center_of_mass_of(vehicle);
  all["volume"] = options.body.volume;
  all["added_mass"] = mat6_to_numpy(options.added_mass);
  all["linear_drag"] = mat6_to_numpy(options.linear_drag);
  all["terms"] = terms_of(vehicle);
  all["parts"] = options.parts.empty() ? py::object(py::none()) : py::object(parts_of(vehicle));
  all["gravity"] = options.gravity;
  all["water_density"] = options.water_density;
  all["name"] = options.name;
  return all;
}

Vehicle from_keywords(const py::dict& all) {
  return py::type::of<Vehicle>()(**all).cast<Vehicle>();
}

py::list terms_but_own_axis(const Vehicle& vehicle) {
  VehicleOptions options = vehicle.options();
  std::erase_if(options.terms,
                [](const ForceTerm& t) { return t.row == t.a && t.a == t.b && t.absolute; });
  return terms_of(Vehicle(std::move(options)));
}

Vehicle replaced(const Vehicle& vehicle, const py::KWArgs<KeywordValue>& changes) {
  py::dict all = keywords_of(vehicle);
  if (changes.contains("quadratic_drag")) all["terms"] = terms_but_own_axis(vehicle);
  all["quadratic_drag"] = py::none();
  for (const auto& [key, value] : changes) {
    if (!all.contains(key)) {
      std::string names;
      for (const auto& entry : all) {
        names += (names.empty() ? "" : ", ") + entry.first.cast<std::string>();
      }
      throw_argument(key.cast<std::string>(), "one of " + names, "a name that is not known");
    }
    all[key] = value;
  }
  return from_keywords(all);
}

py::tuple from_mesh(const TriangleMesh& mesh, std::optional<double> mass,
                    const OptionalArray& center_of_mass, const OptionalArray& inertia,
                    const OptionalArray& drag_coefficient, double gravity, double water_density) {
  FromMeshOptions options;
  options.mass = mass;
  if (!center_of_mass.is_none()) {
    options.center_of_mass = vector_argument("center_of_mass", center_of_mass);
  }
  if (!inertia.is_none()) options.inertia = square_argument("inertia", inertia, 3);
  if (!drag_coefficient.is_none()) {
    options.drag_coefficient = vector_argument("drag_coefficient", drag_coefficient);
  }
  options.gravity = gravity;
  options.water_density = water_density;
  const VehicleFromMesh found = vehicle_from_mesh(mesh, options);
  return py::make_tuple(Vehicle(found.options), to_numpy(found.vehicle_from_mesh));
}

/// The acceleration at a place is the change over one step about the moment, within the times that
/// are simulated: over the steps of Runge–Kutta's method it adds up to the whole change, jumps too.
FlowFunction flow_argument(const py::object& object, const SimulateOptions& options) {
  if (object.is_none()) return {};
  if (PyCallable_Check(object.ptr()) == 0) {
    const Vec3 current = vector_argument("current", object);
    return [current](const Vec3&, double) { return Flow{current, Vec3::Zero()}; };
  }
  return [object, options](const Vec3& point, double time) {
    const py::gil_scoped_acquire locked;
    const py::array place = to_numpy(std::vector<double>(point.begin(), point.end()));
    const auto velocity = [&](double t) { return vector_argument("current", object(place, t)); };
    const double before = std::max(0.0, time - 0.5 * options.step);
    const double after = std::min(options.duration, time + 0.5 * options.step);
    Flow flow{velocity(time)};
    if (after > before) flow.acceleration = (velocity(after) - velocity(before)) / (after - before);
    return flow;
  };
}

FreeAxes free_argument(const py::object& object) {
  if (object.is_none()) return kAllFree;
  FreeAxes free{};
  std::size_t count = 0;
  if (py::isinstance<py::iterable>(object)) {
    for (const py::handle value : object) {
      const bool fits = PyBool_Check(value.ptr()) != 0 ||
                        py::str(py::type::of(value).attr("__name__")).cast<std::string>() == "bool";
      if (!fits) throw_argument("free", "six bools", py::repr(value).cast<std::string>());
      if (count < free.size()) free[count] = py::bool_(py::reinterpret_borrow<py::object>(value));
      ++count;
    }
  }
  if (count != free.size()) throw_argument("free", "six bools", std::to_string(count) + " of them");
  return free;
}

/// As the world is at time 0.
std::shared_ptr<const Environment> environment_of(const OptionalWorld& given) {
  if (given.is_none()) return nullptr;
  const auto world = given.cast<std::shared_ptr<World>>();
  std::optional<Scene> scene;
  if (!world->objects().empty()) {
    const py::gil_scoped_release unlocked;
    scene = world->at(0.0).scene;
  }
  return std::make_shared<Environment>(world->water(), scene);
}

VehicleMotionRecord simulated(const Vehicle& vehicle, const StateLike& state,
                              const ThrustLike& thrust, double duration, double step,
                              const FlowLike& current, const FreeLike& free,
                              const OptionalWorld& world) {
  SimulateOptions options;
  options.duration = duration;
  options.step = step;
  options.free = free_argument(free);
  const VehicleState start = state_argument(state);
  const WrenchFunction wrench = wrench_argument(thrust);
  const FlowFunction flow = flow_argument(current, options);
  options.environment = environment_of(world);
  const py::gil_scoped_release unlocked;
  return simulate(vehicle, start, wrench, flow, options);
}

void bind_motion(py::module_& module) {
  py::class_<VehicleMotionRecord>(module, "VehicleMotion", "How a vehicle moved, step by step.")
      .def_property_readonly(
          "time",
          [](const VehicleMotionRecord& m) { return to_numpy(std::vector<double>(m.time)); },
          "(K,) [s].")
      .def_property_readonly("pose", &poses_to_numpy, "(K, 4, 4) world_from_vehicle.")
      .def_property_readonly(
          "velocity", &velocities_to_numpy,
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
           py::arg("linear_drag") = py::none(), py::arg("quadratic_drag") = py::none(),
           py::arg("terms") = std::vector<TermTuple>{}, py::arg("parts") = py::none(),
           py::arg("gravity") = 9.80665, py::arg("water_density") = 1025.0,
           py::arg("name") = "vehicle", py::arg("z_down") = false)
      .def_static("from_mesh", &from_mesh, py::arg("mesh"), py::kw_only(),
                  py::arg("mass") = py::none(), py::arg("center_of_mass") = py::none(),
                  py::arg("inertia") = py::none(), py::arg("drag_coefficient") = py::none(),
                  py::arg("gravity") = 9.80665, py::arg("water_density") = 1025.0,
                  vehicle_docs::kFromMesh)
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
      .def_property_readonly("center_of_mass", &center_of_mass_of, "(3,) [m]")
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
          "terms", [](const Vehicle& v) { return terms_of(v).cast<std::vector<TermTuple>>(); },
          "Of (row, a, b, absolute, coefficient).")
      .def_property_readonly("parts", &parts_of,
                             "(P, 5) centre [m], radius [m] and share of the volume.")
      .def_property_readonly("gravity", field(&VehicleOptions::gravity), "[m/s²]")
      .def_property_readonly("water_density", field(&VehicleOptions::water_density), "[kg/m³]")
      .def_property_readonly(
          "mass_matrix", [](const Vehicle& v) { return mat6_to_numpy(v.mass_matrix()); },
          "(6, 6) of body and added mass about the origin.")
      .def("simulate", &simulated, py::arg("state"), py::arg("thrust"), py::arg("duration"),
           py::arg("step") = 0.01, py::arg("current") = py::none(), py::arg("free") = py::none(),
           py::kw_only(), py::arg("world") = py::none(), vehicle_docs::kSimulate)
      .def(
          "acceleration",
          [](const Vehicle& v, const StateLike& state, const ArrayLike& thrust,
             const OptionalArray& current) {
            Flow flow;
            if (!current.is_none()) flow.velocity = vector_argument("current", current);
            return vec6_to_numpy(
                v.acceleration(state_argument(state), vec6_argument("thrust", thrust), flow));
          },
          py::arg("state"), py::arg("thrust"), py::arg("current") = py::none(),
          vehicle_docs::kAcceleration)
      .def("replace", &replaced, vehicle_docs::kReplace)
      .def(py::pickle([](const Vehicle& v) { return keywords_of(v); },
                      [](const py::dict& all) { return from_keywords(all); }))
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
