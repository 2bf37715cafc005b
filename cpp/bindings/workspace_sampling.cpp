// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/sampling/sampling.hpp"

#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/base/text.hpp"
#include "workspace_class.hpp"
#include "workspace_sampling_docs.hpp"

namespace bathyal::python {
namespace {

py::array copied(const std::vector<double>& values, std::vector<py::ssize_t> tail = {}) {
  return to_numpy(std::vector<double>(values), std::move(tail));
}

/// Rows of all phases, those that two of them share once.
py::array rows_of_phases(const SamplingPlan& plan) {
  if (plan.phases.empty()) return to_numpy(JointMatrix(0, 0));
  JointMatrix q(static_cast<Index>(plan.time.size()), plan.phases.front().q.cols());
  for (const SamplingPhase& phase : plan.phases) {
    q.middleRows(static_cast<Index>(phase.first), phase.q.rows()) = phase.q;
  }
  return to_numpy(q);
}

void bind_sampling_phase(py::module_& module) {
  using Phase = SamplingPhase;
  py::class_<Phase>(module, "SamplingPhase", workspace_docs::kSamplingPhase)
      .def_readonly("name", &Phase::name,
                    "\"approach\", \"press\", \"grab\", \"lift\" or \"transport\".")
      .def_property_readonly(
          "q", [](const Phase& p) { return to_numpy(p.q); }, "(K, n) [rad] or [m].")
      .def_property_readonly(
          "time", [](const Phase& p) { return copied(p.time); },
          "(K,) of the rows, rising over all phases [s].")
      .def_property_readonly(
          "tip", [](const Phase& p) { return to_numpy(p.tip); },
          "(K, 4, 4) vehicle_from_tool of each row.")
      .def_property_readonly(
          "retreat", [](const Phase& p) { return to_numpy(p.retreat); },
          "(R, n) from the last row to where the arm is safe: of \"approach\" its start, of "
          "\"press\", \"grab\" and \"transport\" the place before contact, of \"lift\" the "
          "transport posture. Free of contact, as the phase is.")
      .def_property_readonly(
          "retreat_time", [](const Phase& p) { return copied(p.retreat_time); },
          "(R,) of the rows of `retreat`, from 0 [s].")
      .def_readonly("first", &Phase::first,
                    "Which row of the whole plan's `time` and `wrench` is this phase's first.")
      .def("__repr__", [](const Phase& p) {
        return "SamplingPhase(" + p.name + ", " + bathyal::to_text(p.time.back() - p.time.front()) +
               " s)";
      });
}

void bind_sampling_plan(py::module_& module) {
  using Plan = SamplingPlan;
  py::class_<Plan>(module, "SamplingPlan", workspace_docs::kSamplingPlan)
      .def_property_readonly(
          "status", [](const Plan& p) { return std::string(bathyal::to_text(p.status)); },
          "\"planned\", or why there is none: \"start\" (it, or the transport posture, touches or "
          "is outside the limits), \"forbidden\" (the target is inside hull or keep-out, or deeper "
          "under the bottom than `depth`), \"no_bottom\" (within a standoff of the target), "
          "\"unreachable\", \"collision\" (only by touching what must not be), \"no_approach\", "
          "\"no_transport\" (no motion found), \"no_retreat\" (something moves in its way).")
      .def_readonly("reason", &Plan::reason, "Why there is no plan, a sentence; empty if there is.")
      .def_readonly("phases", &Plan::phases, "List of five SamplingPhases; empty without a plan.")
      .def_property_readonly("q", &rows_of_phases,
                             "(T, n) rows of all phases, those that two of them share once.")
      .def_property_readonly(
          "time", [](const Plan& p) { return copied(p.time); }, "(T,) of the rows of `q` [s].")
      .def_property_readonly(
          "wrench", [](const Plan& p) { return copied(p.wrench, {6}); },
          "(T, 6) force and moment on the vehicle by arm, what it holds and bottom, in the "
          "vehicle's "
          "frame about its origin [N, N m]; in the last row of the grab without the sample.")
      .def_property_readonly(
          "contact_force", [](const Plan& p) { return copied(p.contact_force); },
          "(T,) of the bottom on the tip, against `direction` [N].")
      .def_property_readonly(
          "contact", [](const Plan& p) { return to_numpy(p.contact); },
          "(3,) where the tip meets the bottom, in the world [m].")
      .def_property_readonly(
          "direction", [](const Plan& p) { return to_numpy(p.direction); },
          "(3,) unit vector into the bottom, in the world.")
      .def_readonly("depth", &Plan::depth, "That the tip is pressed into the bottom [m].")
      .def("__bool__", [](const Plan& p) { return p.status == SamplingStatus::kPlanned; })
      .def("__repr__", [](const Plan& p) {
        if (p.status != SamplingStatus::kPlanned) {
          return "SamplingPlan(" + std::string(bathyal::to_text(p.status)) + ": " + p.reason + ")";
        }
        return "SamplingPlan(planned, " + bathyal::to_text(p.time.back() - p.time.front()) + " s)";
      });
}

using Capsules = std::vector<Capsule>;
using OptionalBody = std::optional<RigidBody>;

SamplingPlan plan_sampling_python(
    const Workspace& ws, const ArrayLike& target, const OptionalArray& q_start,
    const OptionalArray& q_transport, const OptionalBody& tool, Capsules tool_capsules,
    const OptionalArray& tool_pose, const OptionalBody& sample, Capsules sample_capsules,
    const OptionalArray& direction, std::optional<bool> align, const ArrayLike& tool_axis,
    double standoff, double depth, double stiffness, double force_limit, double grab_time,
    double press_speed, double line_tolerance, const OptionalArray& velocity,
    const OptionalArray& acceleration, const OptionalArray& jerk, double step, double time,
    int max_checks, std::uint64_t seed, bool inertia, const ArrayLike& gravity,
    double water_density, int num_threads) {
  const Index size = ws.arm().size();
  SamplingOptions options;
  const Vec3 place = vector_argument("target", target);
  options.q_start = posture_argument("q_start", q_start, size);
  options.q_transport = posture_argument("q_transport", q_transport, size);
  options.tool = {std::move(tool_capsules), tool.value_or(RigidBody{})};
  if (!tool_pose.is_none()) options.tool_pose = pose_argument("tool_pose", tool_pose);
  options.sample = {std::move(sample_capsules), sample.value_or(RigidBody{})};
  if (!direction.is_none()) options.direction = vector_argument("direction", direction);
  options.align = align;
  options.tool_axis = vector_argument("tool_axis", tool_axis);
  options.standoff = standoff;
  options.depth = depth;
  options.stiffness = stiffness;
  options.force_limit = force_limit;
  options.grab_time = grab_time;
  options.press_speed = press_speed;
  options.line_tolerance = line_tolerance;
  options.limits = {coordinates_argument("velocity", velocity, size),
                    coordinates_argument("acceleration", acceleration, size),
                    coordinates_argument("jerk", jerk, size)};
  options.step = step;
  options.time = time;
  options.max_checks = max_checks;
  options.seed = seed;
  options.inertia = inertia;
  options.gravity = vector_argument("gravity", gravity);
  options.water_density = water_density;
  options.num_threads = num_threads;
  const py::gil_scoped_release release;
  return plan_sampling(ws, place, options);
}

}  // namespace

void bind_sampling(py::module_& module) {
  const SamplingOptions defaults;
  const auto vector = [](const Vec3& v) { return py::make_tuple(v.x(), v.y(), v.z()); };
  bind_sampling_phase(module);
  bind_sampling_plan(module);
  module.def(
      "plan_sampling", &plan_sampling_python, py::arg("ws"), py::arg("target"), py::kw_only(),
      py::arg("q_start") = py::none(), py::arg("q_transport") = py::none(),
      py::arg("tool") = py::none(), py::arg("tool_capsules") = py::list(),
      py::arg("tool_pose") = py::none(), py::arg("sample") = py::none(),
      py::arg("sample_capsules") = py::list(), py::arg("direction") = py::none(),
      py::arg("align") = py::none(), py::arg("tool_axis") = vector(defaults.tool_axis),
      py::arg("standoff") = defaults.standoff, py::arg("depth") = defaults.depth,
      py::arg("stiffness") = defaults.stiffness, py::arg("force_limit") = defaults.force_limit,
      py::arg("grab_time") = defaults.grab_time, py::arg("press_speed") = defaults.press_speed,
      py::arg("line_tolerance") = defaults.line_tolerance, py::arg("velocity") = py::none(),
      py::arg("acceleration") = py::none(), py::arg("jerk") = py::none(),
      py::arg("step") = defaults.step, py::arg("time") = defaults.time,
      py::arg("max_checks") = defaults.max_checks, py::arg("seed") = defaults.seed,
      py::arg("inertia") = defaults.inertia, py::arg("gravity") = vector(defaults.gravity),
      py::arg("water_density") = defaults.water_density,
      py::arg("num_threads") = defaults.num_threads, workspace_docs::kPlanSampling);
}

}  // namespace bathyal::python
