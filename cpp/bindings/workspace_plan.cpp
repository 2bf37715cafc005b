// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <utility>

#include "bathyal/base/error.hpp"
#include "bathyal/workspace/motion/plan.hpp"
#include "workspace_class.hpp"
#include "workspace_plan_docs.hpp"

namespace bathyal::python {
namespace {

PlanGoal plan_goal_argument(const Workspace& ws, const OptionalArray& goal,
                            const OptionalArray& pose, const OptionalArray& point) {
  const int given = int(!goal.is_none()) + int(!pose.is_none()) + int(!point.is_none());
  if (given != 1) {
    throw_argument("goal", "one of `goal`, `pose` and `point`", given == 0 ? "none" : "several");
  }
  if (!pose.is_none()) return pose_argument("pose", pose);
  if (!point.is_none()) return vector_argument("point", point);
  const Values values = values_argument("goal", goal);
  if (values.rows() != ws.arm().size()) {
    throw_argument("goal", std::to_string(ws.arm().size()) + " values",
                   std::to_string(values.rows()));
  }
  return std::vector<double>(values.data(), values.data() + values.rows());
}

std::vector<double> plan_start_argument(const Workspace& ws, const ArrayLike& q_start) {
  const Values values = values_argument("q_start", q_start);
  if (values.rows() != ws.arm().size()) {
    throw_argument("q_start", std::to_string(ws.arm().size()) + " values",
                   std::to_string(values.rows()));
  }
  return {values.data(), values.data() + values.rows()};
}

/// None where there are no rows.
py::typing::Optional<py::array> rows_or_none(const JointMatrix& rows) {
  if (rows.rows() == 0) return py::none();
  return to_numpy(rows);
}

}  // namespace

void bind_motion_plan(py::module_& module) {
  py::class_<Plan>(module, "MotionPlan", workspace_docs::kMotionPlan)
      .def_property_readonly(
          "status", [](const Plan& p) { return std::string(to_text(p.status)); },
          "\"solved\", or why there is no path: \"start_in_collision\", \"start_outside_limits\", "
          "\"goal_in_collision\" (of a pose or point: in every posture found), "
          "\"goal_outside_limits\", \"unreachable\" (by no posture), \"no_path\" (found within the "
          "checks), \"time_limit\" (the safety stop).")
      .def_property_readonly(
          "path", [](const Plan& p) { return rows_or_none(p.path); },
          "(K, n) [rad] or [m], straight in joint space between rows; None where there is none.")
      .def_property_readonly(
          "time", [](const Plan& p) { return to_numpy(std::vector<double>(p.time)); },
          "(K,) of the rows, from 0 at the start, in equal steps [s].")
      .def_readonly("reason", &Plan::reason, "Why there is no path, a sentence; empty if there is.")
      .def_readonly("checks", &Plan::checks, "Postures and straight motions looked at.")
      .def_property_readonly(
          "way_out", [](const Plan& p) { return rows_or_none(p.way_out); },
          "(2, n) from a start that touches or is outside the limits on a short straight line to a "
          "posture that is free; None where none is needed, or found.")
      .def("__bool__", [](const Plan& p) { return p.status == PlanStatus::kSolved; })
      .def("__repr__", [](const Plan& p) {
        if (p.status != PlanStatus::kSolved) {
          return "MotionPlan(" + std::string(to_text(p.status)) + ": " + p.reason + ")";
        }
        return "MotionPlan(solved, " + std::to_string(p.path.rows()) + " rows, " +
               to_text(p.time.back()) + " s)";
      });
}

void add_plan(py::class_<Workspace>& cls) {
  const PlanOptions defaults;
  cls.def(
      "plan",
      [](const Workspace& ws, const ArrayLike& q_start, const OptionalArray& goal,
         const OptionalArray& pose, const OptionalArray& point, std::uint64_t seed, int max_checks,
         double max_seconds, const OptionalArray& velocity, const OptionalArray& acceleration,
         const OptionalArray& jerk, double step, double tolerance, bool tip_contact, double time) {
        const std::vector<double> start = plan_start_argument(ws, q_start);
        const PlanGoal aim = plan_goal_argument(ws, goal, pose, point);
        PlanOptions options;
        options.seed = seed;
        options.max_checks = max_checks;
        options.max_seconds = max_seconds;
        const Index size = ws.arm().size();
        options.limits = {coordinates_argument("velocity", velocity, size),
                          coordinates_argument("acceleration", acceleration, size),
                          coordinates_argument("jerk", jerk, size)};
        options.timing.step = step;
        options.timing.tolerance = tolerance;
        options.tip_contact = tip_contact_argument(tip_contact);
        options.time = time;
        const py::gil_scoped_release release;
        return plan_motion(ws, start, aim, options);
      },
      py::arg("q_start"), py::arg("goal") = py::none(), py::kw_only(), py::arg("pose") = py::none(),
      py::arg("point") = py::none(), py::arg("seed") = defaults.seed,
      py::arg("max_checks") = defaults.max_checks, py::arg("max_seconds") = defaults.max_seconds,
      py::arg("velocity") = py::none(), py::arg("acceleration") = py::none(),
      py::arg("jerk") = py::none(), py::arg("step") = defaults.timing.step,
      py::arg("tolerance") = defaults.timing.tolerance,
      py::arg("tip_contact") = defaults.tip_contact == TipContact::kAllowed,
      py::arg("time") = defaults.time, workspace_docs::kPlan);
}

}  // namespace bathyal::python
