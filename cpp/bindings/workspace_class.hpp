// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "arrays.hpp"
#include "bathyal/workspace/workspace.hpp"

// What each file of the room adds to the module and to the class Workspace, and what several of
// them use.

namespace bathyal::python {

/// ReachMap, Standpoint; the method and the function that make them.
void bind_reach(py::module_& module);
void add_reach(py::class_<Workspace>& cls);
void bind_best_standpoint(py::module_& module);

/// Capsule, Workspace and what it answers; after Hull and KeepOut.
void bind_workspace_class(py::module_& module);

/// MotionPlan; before the method that returns it.
void bind_motion_plan(py::module_& module);

/// Workspace.plan
void add_plan(py::class_<Workspace>& cls);

/// StaticTrim; before the method that returns it.
void bind_static_trim(py::module_& module);

/// Workspace.wrench, .momentum, .static_trim
void add_statics(py::class_<Workspace>& cls);

/// SamplingPhase, SamplingPlan, plan_sampling; after Workspace.
void bind_sampling(py::module_& module);

/// TipMove and FollowedPath; before the methods that return them.
void bind_tip_motions(py::module_& module);

/// Workspace.move and .follow
void add_follow(py::class_<Workspace>& cls);

inline JointView joint_view(const Rows& rows) {
  return {rows.table.data(), rows.table.rows(), rows.table.cols()};
}

/// One number for all coordinates, or (n,); nothing of None.
std::vector<double> coordinates_argument(std::string_view name, const py::object& object,
                                         Index size);

/// (n,) values of a posture; nothing of None.
std::vector<double> posture_argument(std::string_view name, const py::object& object, Index size);

/// Read-only array of text.
py::array text_array(const std::vector<std::string>& values);

/// One value of a single row, an array of several.
OneOrArray<py::str> texts(const std::vector<std::string>& values, bool single);

inline OneOrArray<py::float_> numbers_of_rows(std::vector<double> values, bool single) {
  if (single) return py::float_(values.front());
  return to_numpy(std::move(values));
}

inline TipContact tip_contact_argument(bool allowed) {
  return allowed ? TipContact::kAllowed : TipContact::kForbidden;
}

}  // namespace bathyal::python
