// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "bathyal/base/error.hpp"
#include "bathyal/control/allocation.hpp"
#include "bathyal/control/cruise.hpp"
#include "bathyal/control/guidance.hpp"
#include "bathyal/control/pose_hold.hpp"
#include "bindings.hpp"
#include "control_docs.hpp"
#include "device_parts.hpp"

namespace bathyal::python {
namespace {

std::array<double, 6> six_or(std::string_view name, const py::object& object,
                             const std::array<double, 6>& otherwise) {
  if (object.is_none()) return otherwise;
  const Vec6 given = six_argument(name, object);
  std::array<double, 6> values{};
  std::copy(given.begin(), given.end(), values.begin());
  return values;
}

void bind_allocation(py::module_& module) {
  const AllocationOptions d;
  py::class_<AllocationResult>(module, "AllocationResult", "What thrusters are asked for.")
      .def_property_readonly(
          "thrust", [](const AllocationResult& r) { return to_numpy(std::vector(r.thrust)); },
          "(m,) [N].")
      .def_property_readonly(
          "command", [](const AllocationResult& r) { return to_numpy(std::vector(r.command)); },
          "(m,), −1 to 1; the dead zone is passed over.")
      .def_property_readonly(
          "achieved", [](const AllocationResult& r) { return six_to_numpy(r.achieved); },
          "(6,) what the thrusts give in still water [N, N m].")
      .def_readonly("saturated", &AllocationResult::saturated, "One is at its limit.");
  py::class_<Allocation>(module, "Allocation", control_docs::kAllocation)
      .def(py::init([d](const std::vector<Thruster>& thrusters, const OptionalArray& weights,
                        double effort) {
             return Allocation(thrusters, {six_or("weights", weights, d.weights), effort});
           }),
           py::arg("thrusters"), py::kw_only(), py::arg("weights") = py::none(),
           py::arg("effort") = d.effort)
      .def_property_readonly(
          "matrix",
          [](const Allocation& a) {
            const Eigen::MatrixXd& m = a.matrix();
            std::vector<double> values;
            for (Eigen::Index i = 0; i < 6; ++i) {
              for (Eigen::Index j = 0; j < m.cols(); ++j) values.push_back(m(i, j));
            }
            return to_numpy(std::move(values), {static_cast<py::ssize_t>(m.cols())});
          },
          "(6, m) force and moment about the vehicle's origin of 1 N of each.")
      .def(
          "rank",
          [](const Allocation& a, const std::vector<int>& failed) {
            const AllocationRank found = a.rank(failed);
            std::vector<std::string> names;
            for (const int axis : found.lost) {
              names.emplace_back(kAxisNames[static_cast<std::size_t>(axis)]);
            }
            return std::pair(found.rank, names);
          },
          py::arg("failed") = std::vector<int>{}, control_docs::kRank)
      .def(
          "allocate",
          [](const Allocation& a, const ArrayLike& wrench, double voltage,
             const std::vector<int>& failed) {
            AllocationResult result;
            a.allocate(six_argument("wrench", wrench), voltage, failed, result);
            return result;
          },
          py::arg("wrench"), py::arg("voltage"), py::arg("failed") = std::vector<int>{},
          control_docs::kAllocate);
}

VehicleState measured_state(const ArrayLike& pose, const ArrayLike& velocity) {
  VehicleState state;
  state.world_from_vehicle = given_pose_argument("pose", pose);
  check_rigid("pose", state.world_from_vehicle);
  state.velocity = six_argument("velocity", velocity);
  return state;
}

void bind_pose_hold(py::module_& module) {
  const PoseHoldOptions d;
  py::class_<PoseHoldState>(module, "PoseHoldState", "What `PoseHold` keeps from step to step.")
      .def(py::init<>(), "At its start.")
      .def_property(
          "integral", [](const PoseHoldState& s) { return six_to_numpy(s.integral); },
          [](PoseHoldState& s, const ArrayLike& v) { s.integral = six_argument("integral", v); },
          "(6,) accelerations, the linear ones in the world [m/s², rad/s²].")
      .def_property(
          "shortfall", [](const PoseHoldState& s) { return six_to_numpy(s.shortfall); },
          [](PoseHoldState& s, const ArrayLike& v) { s.shortfall = six_argument("shortfall", v); },
          "(6,) to be set to what was given less what was asked for, so that nothing winds up "
          "[N, N m].");
  py::class_<PoseHold>(module, "PoseHold", control_docs::kPoseHold)
      .def(py::init([d](const Vehicle& vehicle, const OptionalArray& frequency, double damping,
                        double integral, const FreeAxes& axes) {
             return PoseHold(
                 vehicle, {six_or("frequency", frequency, d.frequency), damping, integral, axes});
           }),
           py::arg("vehicle"), py::kw_only(), py::arg("frequency") = py::none(),
           py::arg("damping") = d.damping, py::arg("integral") = d.integral,
           py::arg("axes") = d.axes)
      .def(
          "step",
          [](const PoseHold& hold, PoseHoldState& state, const ArrayLike& pose,
             const ArrayLike& velocity, const OptionalArray& target,
             const OptionalArray& target_velocity, const OptionalArray& current, double time) {
            PoseTarget aim;
            aim.world_from_vehicle = pose_argument("target", target);
            check_rigid("target", aim.world_from_vehicle);
            aim.velocity = six_argument("target_velocity", target_velocity);
            return six_to_numpy(hold.step(state, measured_state(pose, velocity), aim,
                                          vector_or_zero("current", current), time));
          },
          py::arg("state"), py::arg("pose"), py::arg("velocity"), py::kw_only(),
          py::arg("target") = py::none(), py::arg("target_velocity") = py::none(),
          py::arg("current") = py::none(), py::arg("time"), control_docs::kPoseStep);
}

void bind_cruise(py::module_& module) {
  const CruiseOptions d;
  py::class_<CruiseState>(module, "CruiseState", "What `CruiseControl` keeps from step to step.")
      .def(py::init<>(), "At its start.")
      .def_readwrite("heading", &CruiseState::heading, "Integral of the error [rad s].")
      .def_readwrite("depth", &CruiseState::depth, "The same of the depth [m s].")
      .def_readwrite("speed", &CruiseState::speed, "The same of the speed [m].");
  py::class_<CruiseControl>(module, "CruiseControl", control_docs::kCruise)
      .def(py::init([](const VehicleSystem& system, double speed, double heading_frequency,
                       double depth_frequency, double speed_frequency, double damping,
                       double integral, double most_pitch, int rudder, int stern_plane,
                       int propeller) {
             return CruiseControl(
                 system, {speed, heading_frequency, depth_frequency, speed_frequency, damping,
                          integral, most_pitch, rudder, stern_plane, propeller});
           }),
           py::arg("system"), py::kw_only(), py::arg("speed") = d.speed,
           py::arg("heading_frequency") = d.heading_frequency,
           py::arg("depth_frequency") = d.depth_frequency,
           py::arg("speed_frequency") = d.speed_frequency, py::arg("damping") = d.damping,
           py::arg("integral") = d.integral, py::arg("most_pitch") = d.most_pitch,
           py::arg("rudder") = d.rudder, py::arg("stern_plane") = d.stern_plane,
           py::arg("propeller") = d.propeller)
      .def(
          "step",
          [](const CruiseControl& control, CruiseState& state, const ArrayLike& pose,
             const ArrayLike& velocity, double speed, double heading, double z, double climb,
             double time) {
            const VehicleState measured = measured_state(pose, velocity);
            const CruiseOutput output =
                control.step(state, measured, measured.velocity, {speed, heading, z, climb}, time);
            return std::tuple(output.rudder, output.stern_plane, output.thrust);
          },
          py::arg("state"), py::arg("pose"), py::arg("velocity"), py::kw_only(), py::arg("speed"),
          py::arg("heading"), py::arg("z"), py::arg("climb") = CruiseTarget().climb,
          py::arg("time"), control_docs::kCruiseStep);
}

LineOfSightOptions line_of(const ArrayLike& points, double lookahead, double integral,
                           double acceptance) {
  LineOfSightOptions options;
  const auto rows = table_argument("points", points, 2);
  for (Index i = 0; i < rows.rows(); ++i) options.points.emplace_back(rows(i, 0), rows(i, 1));
  options.lookahead = lookahead;
  options.integral = integral;
  options.acceptance = acceptance;
  options.check();
  return options;
}

void bind_guidance(py::module_& module) {
  const LineOfSightOptions d;
  const BottomFollowOptions b;
  py::class_<LineOfSightState>(module, "LineOfSightState",
                               "What `LineOfSight` keeps from step to step.")
      .def(py::init<>(), "At its start.")
      .def_readonly("leg", &LineOfSightState::leg, "From point `leg` to the next.")
      .def_readonly("integral", &LineOfSightState::integral, "[m]")
      .def_property_readonly(
          "arrived", [](const LineOfSightState& s) { return s.arrived != 0; },
          "Past the last point.");
  py::class_<LineOfSightOptions>(module, "LineOfSight", control_docs::kLine)
      .def(py::init(&line_of), py::arg("points"), py::kw_only(), py::arg("lookahead") = d.lookahead,
           py::arg("integral") = d.integral, py::arg("acceptance") = d.acceptance)
      .def(
          "step",
          [](const LineOfSightOptions& options, LineOfSightState& state, const ArrayLike& position,
             double time) {
            const LineOfSightOutput output =
                line_of_sight(options, state, vector_argument("position", position), time);
            return std::pair(output.heading, output.cross_track);
          },
          py::arg("state"), py::arg("position"), py::arg("time"),
          "(heading to steer [rad], offset to port of the leg [m]) at a (3,) position of the "
          "world, a time [s] since the last step.");
  module.def(
      "follow_bottom",
      [](const ArrayLike& position, double heading, const BottomFunction& bottom, double altitude,
         double lookahead, double lead, double steepest, double spacing) {
        const BottomFollowOutput output =
            follow_bottom({altitude, lookahead, lead, steepest, spacing},
                          vector_argument("position", position), heading, bottom);
        return std::pair(output.z, output.climb);
      },
      py::arg("position"), py::arg("heading"), py::arg("bottom"), py::kw_only(),
      py::arg("altitude") = b.altitude, py::arg("lookahead") = b.lookahead,
      py::arg("lead") = b.lead, py::arg("steepest") = b.steepest, py::arg("spacing") = b.spacing,
      control_docs::kFollow);
}

}  // namespace

void bind_control(py::module_& module) {
  bind_allocation(module);
  bind_pose_hold(module);
  bind_cruise(module);
  bind_guidance(module);
}

}  // namespace bathyal::python
