// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/uvms/arm_on_vehicle.hpp"
#include "bathyal/uvms/trim_hold.hpp"
#include "bindings.hpp"
#include "uvms_docs.hpp"
#include "vehicle_parts.hpp"

namespace bathyal::python {
namespace {

std::vector<double> coordinates_of(std::string_view name, const py::object& object, Index size) {
  if (object.is_none()) return std::vector<double>(static_cast<std::size_t>(size), 0.0);
  const Rows rows = rows_argument(name, object, size);
  if (!rows.single) throw_argument(name, "shape (" + std::to_string(size) + ",)", "more rows");
  return {rows.table.data(), rows.table.data() + size};
}

JointSpline spline_argument(const py::object& q, const std::vector<double>& time, Index size) {
  const Rows rows = rows_argument("q", q, size);
  if (rows.table.rows() == 1) {
    return JointSpline(std::vector<double>(rows.table.data(), rows.table.data() + size));
  }
  return JointSpline(time, JointView(rows.table.data(), rows.table.rows(), size));
}

/// One row, or those at the times.
WrenchRows wrench_rows(std::string_view name, const py::object& object,
                       const std::vector<double>& time) {
  WrenchRows all;
  if (object.is_none()) return all;
  const Rows rows = rows_argument(name, object, 6);
  for (Index i = 0; i < rows.table.rows(); ++i)
    all.rows.emplace_back(rows.table.row(i).transpose());
  if (all.rows.size() == 1) return all;
  if (time.size() != all.rows.size()) {
    throw_argument(name, "one row, or one for each of " + std::to_string(time.size()) + " times",
                   std::to_string(all.rows.size()) + " rows");
  }
  all.time = time;
  return all;
}

std::vector<double> times_argument(const py::object& object) {
  if (object.is_none()) return {};
  const Values values = values_argument("time", object);
  return {values.data(), values.data() + values.rows()};
}

py::array joints_to_numpy(const std::vector<double>& values, std::size_t rows) {
  return to_numpy(std::vector<double>(values),
                  {static_cast<py::ssize_t>(values.size() / std::max<std::size_t>(1, rows))});
}

Vec3 steady_current(const py::object& object) {
  return object.is_none() ? Vec3::Zero() : vector_argument("current", object);
}

Vec6 six_or_zero(std::string_view name, const py::object& object) {
  return object.is_none() ? Vec6::Zero() : vec6_argument(name, object);
}

ArmMotionRecord simulated_arm(const ArmOnVehicle& system, const StateLike& state,
                              const ArrayLike& q, const ThrustLike& thrust, double duration,
                              double step, const OptionalArray& current, const OptionalArray& time,
                              const OptionalArray& tip_wrench) {
  const std::vector<double> times = times_argument(time);
  const JointSpline motion = spline_argument(q, times, system.workspace().arm().size());
  ArmMotionOptions options;
  options.wrench = wrench_argument(thrust);
  options.tip_wrench = wrench_rows("tip_wrench", tip_wrench, times);
  options.current = steady_current(current);
  options.steps.duration = duration;
  options.steps.step = step;
  const VehicleState start = state_argument(state);
  const py::gil_scoped_release unlocked;
  return simulate_arm_motion(system, start, motion, options);
}

TrimHoldRecord held(const ArmOnVehicle& system, const StateLike& state, const ArrayLike& q,
                    const Allocation& allocation, const PoseHold& controller, double duration,
                    const OptionalArray& time, const OptionalArray& tip_wrench,
                    const OptionalArray& expected_wrench, double step, double period,
                    double voltage, const OptionalArray& current) {
  const std::vector<double> times = times_argument(time);
  const JointSpline motion = spline_argument(q, times, system.workspace().arm().size());
  TrimHoldOptions options;
  options.duration = duration;
  options.step = step;
  options.period = period;
  options.voltage = voltage;
  options.tip_wrench = wrench_rows("tip_wrench", tip_wrench, times);
  options.expected_wrench = wrench_rows("expected_wrench", expected_wrench, times);
  options.current = steady_current(current);
  const VehicleState start = state_argument(state);
  const py::gil_scoped_release unlocked;
  return hold_trim(system, allocation, controller, start, motion, options);
}

std::tuple<py::array, py::array, py::array> arm_accelerations(
    const ArmOnVehicle& system, const StateLike& state, const ArrayLike& q, const ArrayLike& rate,
    const OptionalArray& torque, const OptionalArray& acceleration, const OptionalArray& thrust,
    const OptionalArray& tip_wrench, const OptionalArray& current) {
  const Index size = system.workspace().arm().size();
  if (!torque.is_none() && !acceleration.is_none()) {
    throw_argument("torque", "None where accelerations are given", "both");
  }
  TreeJointMotion joints;
  system.set_joints(coordinates_of("q", q, size), coordinates_of("rate", rate, size),
                    coordinates_of("acceleration", acceleration, size), joints);
  TreeLoads loads;
  loads.wrench = six_or_zero("thrust", thrust);
  loads.tip_wrench = six_or_zero("tip_wrench", tip_wrench);
  loads.flow.velocity = steady_current(current);
  const bool driven = !torque.is_none();
  loads.drive = driven ? JointDrive::kEffort : JointDrive::kAcceleration;
  loads.joints =
      driven ? system.tree_efforts(coordinates_of("torque", torque, size)) : joints.acceleration;
  TreeAcceleration found;
  system.tree().accelerations({state_argument(state), joints.q, joints.rate}, loads, found);
  return {vec6_to_numpy(found.base), to_numpy(system.coordinate_values(found.joints)),
          to_numpy(system.coordinate_efforts(found.efforts))};
}

template <class Record, class Motion>
void add_motion(py::class_<Record>& cls, Motion motion) {
  cls.def_property_readonly(
         "time",
         [motion](const Record& r) {
           return to_numpy(std::vector<double>(motion(r).vehicle.time));
         },
         "(K,) [s].")
      .def_property_readonly(
          "pose", [motion](const Record& r) { return poses_to_numpy(motion(r).vehicle); },
          "(K, 4, 4) world_from_vehicle.")
      .def_property_readonly(
          "velocity", [motion](const Record& r) { return velocities_to_numpy(motion(r).vehicle); },
          "(K, 6) over ground, linear then angular, in the vehicle's frame [m/s, rad/s].")
      .def_property_readonly(
          "q",
          [motion](const Record& r) {
            return joints_to_numpy(motion(r).q, motion(r).vehicle.time.size());
          },
          "(K, n) coordinates of the arm [rad, m].")
      .def_property_readonly(
          "torque",
          [motion](const Record& r) {
            return joints_to_numpy(motion(r).effort, motion(r).vehicle.time.size());
          },
          "(K, n) that the drives give to carry the motion out [N m, N].")
      .def("__len__", [motion](const Record& r) { return motion(r).vehicle.time.size(); });
}

void bind_arm_motions(py::module_& module) {
  py::class_<ArmMotionRecord> motion(module, "ArmMotion",
                                     "How vehicle and arm moved, step by step.");
  add_motion(motion, [](const ArmMotionRecord& r) -> const ArmMotionRecord& { return r; });
  motion.def("__repr__", [](const ArmMotionRecord& r) {
    return "ArmMotion(" + std::to_string(r.vehicle.time.size()) + " states, to " +
           to_text(r.vehicle.time.back()) + " s)";
  });
  py::class_<TrimHoldRecord> hold(
      module, "TrimHold", "How a vehicle held its pose while its arm worked, step by step.");
  add_motion(hold, [](const TrimHoldRecord& r) -> const ArmMotionRecord& { return r.motion; });
  hold.def_property_readonly(
          "thrust",
          [](const TrimHoldRecord& r) {
            std::vector<double> values;
            for (const Vec6& row : r.thrust) values.insert(values.end(), row.begin(), row.end());
            return to_numpy(std::move(values), {6});
          },
          "(K, 6) of the thrusters on the vehicle about its origin [N, N m].")
      .def_readonly("saturated", &TrimHoldRecord::saturated, "Whether a thruster was at its limit.")
      .def("__repr__", [](const TrimHoldRecord& r) {
        return "TrimHold(" + std::to_string(r.motion.vehicle.time.size()) + " states, to " +
               to_text(r.motion.vehicle.time.back()) + " s" + (r.saturated ? ", saturated)" : ")");
      });
}

}  // namespace

void bind_uvms(py::module_& module) {
  bind_arm_motions(module);
  const LinkWaterOptions water;
  const TrimHoldOptions hold;
  py::class_<ArmOnVehicle>(module, "ArmOnVehicle", uvms_docs::kArmOnVehicle)
      .def(py::init([](const Vehicle& vehicle, const Workspace& workspace, double added_mass,
                       double drag, int strips) {
             return ArmOnVehicle(vehicle, workspace, {added_mass, drag, strips});
           }),
           py::arg("vehicle"), py::arg("workspace"), py::kw_only(),
           py::arg("added_mass") = water.added_mass, py::arg("drag") = water.drag,
           py::arg("strips") = water.strips)
      .def_property_readonly(
          "vehicle", [](const ArmOnVehicle& s) { return s.tree().vehicle(); }, "As given.")
      .def_property_readonly("workspace", &ArmOnVehicle::workspace, "As given.")
      .def("simulate", &simulated_arm, py::arg("state"), py::arg("q"), py::arg("thrust"),
           py::arg("duration"), py::arg("step") = hold.step, py::arg("current") = py::none(),
           py::kw_only(), py::arg("time") = py::none(), py::arg("tip_wrench") = py::none(),
           uvms_docs::kSimulateArm)
      .def("hold", &held, py::arg("state"), py::arg("q"), py::arg("allocation"),
           py::arg("controller"), py::arg("duration"), py::kw_only(), py::arg("time") = py::none(),
           py::arg("tip_wrench") = py::none(), py::arg("expected_wrench") = py::none(),
           py::arg("step") = hold.step, py::arg("period") = hold.period,
           py::arg("voltage") = hold.voltage, py::arg("current") = py::none(), uvms_docs::kHold)
      .def("acceleration", &arm_accelerations, py::arg("state"), py::arg("q"), py::arg("rate"),
           py::kw_only(), py::arg("torque") = py::none(), py::arg("acceleration") = py::none(),
           py::arg("thrust") = py::none(), py::arg("tip_wrench") = py::none(),
           py::arg("current") = py::none(), uvms_docs::kArmAcceleration)
      .def("__repr__", [](const ArmOnVehicle& s) {
        return "ArmOnVehicle(" + s.tree().vehicle().options().name + ", " +
               s.workspace().arm().name() + ": " + std::to_string(s.workspace().arm().size()) +
               " coordinates)";
      });
}

}  // namespace bathyal::python
