// SPDX-License-Identifier: BSD-3-Clause
#include "workspace_class.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include "bathyal/base/error.hpp"
#include "bathyal/base/text.hpp"
#include "bindings.hpp"
#include "enum_names.hpp"
#include "hooks.hpp"
#include "trajectory.hpp"
#include "warnings.hpp"
#include "workspace_answers.hpp"
#include "workspace_class_docs.hpp"

namespace bathyal::python {

py::array text_array(const std::vector<std::string>& values) {
  std::size_t longest = 1;
  py::list list;
  for (const std::string& value : values) {
    longest = std::max(longest, value.size());
    list.append(value);
  }
  const py::object array = py::module_::import("numpy").attr("array")(
      list, py::arg("dtype") = "<U" + std::to_string(longest));
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

OneOrArray<py::str> texts(const std::vector<std::string>& values, bool single) {
  if (single) return py::str(values.front());
  return text_array(values);
}

std::vector<double> posture_argument(std::string_view name, const py::object& object, Index size) {
  if (object.is_none()) return {};
  const Values values = values_argument(name, object);
  if (values.rows() != size) {
    throw_argument(name, std::to_string(size) + " values", std::to_string(values.rows()));
  }
  return {values.data(), values.data() + values.rows()};
}

std::vector<double> coordinates_argument(std::string_view name, const py::object& object,
                                         Index size) {
  if (object.is_none()) return {};
  const py::array given = array_argument(name, object, "a number or (n,) real numbers");
  const bool single = given.ndim() == 0;
  const Values values =
      values_argument(name, single ? given.attr("reshape")(1) : py::object(given));
  if (!single && values.rows() != size) {
    throw_argument(name, "a number or " + std::to_string(size) + " values",
                   std::to_string(values.rows()));
  }
  if (single) return std::vector<double>(static_cast<std::size_t>(size), values.data()[0]);
  return {values.data(), values.data() + values.rows()};
}

namespace {

using CapsuleLists = std::map<std::string, std::vector<Capsule>>;
using LinkPairs = std::vector<std::pair<std::string, std::string>>;

/// Reads the mesh of a shape by the package's hook; none where it cannot.
std::optional<Points> mesh_corners(const Shape& shape) {
  const py::object found = hook(Hook::kMeshVertices)(shape);
  if (found.is_none()) return std::nullopt;
  return points_argument("mesh " + shape.file, found);
}

std::vector<LinkCapsule> arm_capsules(const Arm& arm, const OptionalArray& radii,
                                      const std::optional<CapsuleLists>& capsules) {
  if (!radii.is_none() && capsules) throw_argument("capsules", "none, with `radii`", "both");
  if (capsules) {
    std::vector<std::vector<Capsule>> shapes(arm.links().size());
    for (const auto& [link, list] : *capsules) {
      shapes[static_cast<std::size_t>(link_index(arm, link, "capsules"))] = list;
    }
    std::vector<LinkCapsule> given = capsules_of_links(arm, shapes);
    if (given.empty()) throw_argument("capsules", "one Capsule or more", "none");
    return given;
  }
  if (!radii.is_none()) {
    return capsules_of_rows(
        arm, coordinates_argument("radii", radii, static_cast<Index>(arm.links().size())));
  }
  ArmCapsules found = capsules_of_shapes(arm, mesh_corners);
  for (const std::string& warning : found.warnings) warn_user(warning);
  return std::move(found.capsules);
}

Vec6 pose_std_argument(const OptionalArray& given) {
  if (given.is_none()) return Vec6::Zero();
  const Values values = values_argument("vehicle_pose_std", given);
  if (values.rows() != 6) {
    throw_argument("vehicle_pose_std", "6 values: x y z [m], rotation about x y z [rad]",
                   std::to_string(values.rows()));
  }
  return values.view();
}

Workspace make_workspace(const Arm& arm, const OptionalArray& mount, std::optional<Hull> hull,
                         std::optional<Scene> scene, std::vector<KeepOut> keepouts,
                         const PoseLike& vehicle_pose, const OptionalArray& vehicle_pose_std,
                         std::optional<RigidBody> vehicle_body, const OptionalArray& radii,
                         const std::optional<CapsuleLists>& capsules, const LinkPairs& allowed) {
  Surroundings around;
  around.vehicle_from_base = pose_argument("mount", mount);
  around.world_from_vehicle = trajectory_argument("vehicle_pose", vehicle_pose);
  around.vehicle_pose_std = pose_std_argument(vehicle_pose_std);
  around.hull = std::move(hull);
  around.scene = std::move(scene);
  around.keepouts = std::move(keepouts);
  around.vehicle_body = std::move(vehicle_body);
  around.capsules = arm_capsules(arm, radii, capsules);
  for (const auto& [one, other] : allowed) {
    around.allowed.emplace_back(link_index(arm, one, "allowed"), link_index(arm, other, "allowed"));
  }
  const Workspace made = [&] {
    const py::gil_scoped_release release;
    return Workspace(arm, std::move(around));
  }();
  for (const std::string& warning : made.warnings()) warn_user(warning);
  return made;
}

std::vector<double> times_argument(const ArrayLike& time, Index rows) {
  return coordinates_argument("time", time, rows);
}

void add_queries(py::class_<Workspace>& cls) {
  const MotionOptions motion;
  cls.def(
      "clearance",
      [](const Workspace& ws, const ArrayLike& q, const ArrayLike& time, bool tip_contact,
         int num_threads) {
        const Rows rows = rows_argument("q", q, ws.arm().size());
        const std::vector<double> times = times_argument(time, rows.table.rows());
        ClearanceRows found{ws, {}, rows.single};
        const py::gil_scoped_release release;
        found.rows =
            ws.clearance(joint_view(rows), times, tip_contact_argument(tip_contact), num_threads);
        return found;
      },
      py::arg("q"), py::kw_only(), py::arg("time") = 0.0, py::arg("tip_contact") = false,
      py::arg("num_threads") = 0, workspace_docs::kClearance);
  cls.def(
      "check_motion",
      [](const Workspace& ws, const ArrayLike& q_path, const OptionalArray& time, bool stopping,
         const OptionalArray& acceleration, bool tip_contact) {
        const Rows rows = rows_argument("q_path", q_path, ws.arm().size());
        MotionOptions options;
        options.stopping = stopping;
        options.tip_contact = tip_contact_argument(tip_contact);
        std::vector<double> times;
        if (!time.is_none()) {
          const Values values = values_argument("time", time);
          times.assign(values.data(), values.data() + values.rows());
        }
        const std::vector<double> braking =
            coordinates_argument("acceleration", acceleration, ws.arm().size());
        options.time = times;
        options.acceleration = braking;
        NamedMotionCheck found;
        {
          const py::gil_scoped_release release;
          found.check = ws.check_motion(joint_view(rows), options);
        }
        found.link = name_of_link(ws, found.check.link);
        found.against = found.check.obstacle >= 0 ? obstacle_name(ws, found.check.obstacle)
                                                  : name_of_link(ws, found.check.other_link);
        return found;
      },
      py::arg("q_path"), py::kw_only(), py::arg("time") = py::none(),
      py::arg("stopping") = motion.stopping, py::arg("acceleration") = py::none(),
      py::arg("tip_contact") = false, workspace_docs::kCheckMotion);
  cls.def(
      "check_target",
      [](const Workspace& ws, const ArrayLike& points, double time, std::uint64_t seed,
         int num_threads) {
        const Points targets = points_argument("points", points);
        const py::gil_scoped_release release;
        return TargetRows{ws.check_target(targets.view(), time, seed, num_threads),
                          ws.arm().size()};
      },
      py::arg("points"), py::kw_only(), py::arg("time") = 0.0, py::arg("seed") = 0,
      py::arg("num_threads") = 0, workspace_docs::kCheckTarget);
  cls.def(
      "place_capsules",
      [](const Workspace& ws, const ArrayLike& q) {
        const Rows rows = rows_argument("q", q, ws.arm().size());
        std::vector<double> values;
        for (const Capsule& c : ws.placed_capsules(joint_view(rows))) {
          values.insert(values.end(), c.start.begin(), c.start.end());
          values.insert(values.end(), c.end.begin(), c.end.end());
          values.push_back(c.radius);
        }
        const auto count = static_cast<py::ssize_t>(ws.surroundings().capsules.size());
        return to_numpy(std::move(values), rows.single, {count, 7});
      },
      py::arg("q"), workspace_docs::kPlaceCapsules);
}

void add_variants(py::class_<Workspace>& cls) {
  cls.def(
      "attach",
      [](const Workspace& ws, const std::vector<Capsule>& capsules,
         const std::optional<RigidBody>& body) {
        const py::gil_scoped_release release;
        return ws.attach(capsules, body.value_or(RigidBody{}));
      },
      py::arg("capsules"), py::arg("body") = py::none(), workspace_docs::kAttach);
  cls.def("detach", &Workspace::detach, py::call_guard<py::gil_scoped_release>(),
          "Another workspace without what was attached; ValueError where nothing was.");
  cls.def("with_tip_depth", &Workspace::with_tip_depth, py::arg("tip_depth"),
          py::call_guard<py::gil_scoped_release>(), workspace_docs::kWithTipDepth);
  cls.def(
      "with_vehicle_pose",
      [](const Workspace& ws, const PoseLike& vehicle_pose) {
        return ws.with_vehicle_pose(trajectory_argument("vehicle_pose", vehicle_pose));
      },
      py::arg("vehicle_pose"),
      "Another workspace, the vehicle elsewhere: `vehicle_pose` as of the class.");
}

template <class Value>
std::optional<Value> copy_of(const std::optional<Value>& value) {
  return value;
}

void add_values(py::class_<Workspace>& cls) {
  cls.def_property_readonly(
         "arm", [](const Workspace& ws) { return Arm(ws.arm()); },
         "A copy. Its base is the mount, in the vehicle's frame.")
      .def_property_readonly(
          "mount",
          [](const Workspace& ws) { return to_numpy(ws.surroundings().vehicle_from_base); },
          "(4, 4) vehicle_from_base.")
      .def_property_readonly(
          "hull", [](const Workspace& ws) { return copy_of(ws.surroundings().hull); },
          "Hull or None.")
      .def_property_readonly(
          "scene", [](const Workspace& ws) { return copy_of(ws.surroundings().scene); },
          "Scene or None.")
      .def_property_readonly(
          "keepouts", [](const Workspace& ws) { return ws.surroundings().keepouts; },
          "List of KeepOut.")
      .def_property_readonly(
          "vehicle_pose", [](const Workspace& ws) { return ws.surroundings().world_from_vehicle; },
          "Trajectory: world_from_vehicle; of a single pose at rest.")
      .def_property_readonly(
          "vehicle_body",
          [](const Workspace& ws) { return copy_of(ws.surroundings().vehicle_body); },
          "RigidBody or None.")
      .def_property_readonly(
          "attached", [](const Workspace& ws) { return ws.attached(); },
          "RigidBody of what is attached, in the tool's frame; without mass where nothing is.")
      .def_property_readonly(
          "tip_depth", [](const Workspace& ws) { return ws.surroundings().tip_depth; },
          "How deep the end of the tool may be in the scene with ``tip_contact=True`` [m].")
      .def_property_readonly(
          "moves", &Workspace::moves,
          "Whether distances depend on the time: the vehicle or a keep-out moves.")
      .def_property_readonly(
          "capsule_links",
          [](const Workspace& ws) {
            std::vector<std::string> names;
            for (const LinkCapsule& c : ws.surroundings().capsules) {
              names.push_back(name_of_link(ws, c.link));
            }
            return names;
          },
          "List of the links' names, one a capsule, in the order of `place_capsules`.")
      .def_property_readonly("warnings", &Workspace::warnings,
                             "List of what looks like a mistake: a hull whose size or place does "
                             "not go with the arm's, a keep-out that holds its base.")
      .def_property_readonly(
          "obstacles", &Workspace::obstacles,
          "List of what links are compared with: \"hull\", the keep-outs' names, \"scene\".")
      .def_property_readonly(
          "excluded",
          [](const Workspace& ws) {
            std::vector<std::tuple<std::string, std::string, std::string>> pairs;
            for (const ExcludedPair& pair : ws.excluded()) {
              pairs.emplace_back(name_of_link(ws, pair.link),
                                 pair.obstacle >= 0 ? obstacle_name(ws, pair.obstacle)
                                                    : name_of_link(ws, pair.other_link),
                                 pair.reason);
            }
            return pairs;
          },
          "Pairs that are not compared, as tuples of a link, the other link or obstacle, and the "
          "reason: \"foot\", \"neighbours\", \"allowed\", \"fixed to it\", or \"touch in every "
          "posture\" of "
          "64 drawn.")
      .def("__repr__", [](const Workspace& ws) {
        const std::string around =
            ws.obstacles().empty() ? "nothing around" : listed(ws.obstacles());
        return "Workspace(" + (ws.arm().name().empty() ? "arm" : ws.arm().name()) + "; " + around +
               ")";
      });
}

}  // namespace

void bind_workspace_class(py::module_& module) {
  bind_workspace_answers(module);
  bind_motion_plan(module);
  bind_static_trim(module);
  bind_reach(module);
  bind_tip_motions(module);
  py::class_<Workspace> cls(module, "Workspace", workspace_docs::kWorkspace);
  cls.def(py::init(&make_workspace), py::arg("arm"), py::arg("mount") = py::none(), py::kw_only(),
          py::arg("hull") = py::none(), py::arg("scene") = py::none(),
          py::arg("keepouts") = py::list(), py::arg("vehicle_pose") = py::none(),
          py::arg("vehicle_pose_std") = py::none(), py::arg("vehicle_body") = py::none(),
          py::arg("radii") = py::none(), py::arg("capsules") = py::none(),
          py::arg("allowed") = py::list());
  add_queries(cls);
  add_plan(cls);
  add_reach(cls);
  add_follow(cls);
  add_variants(cls);
  add_values(cls);
  add_statics(cls);
  module.def(
      "with_link_radii",
      [](const Arm& arm, const ArrayLike& radii, std::optional<double> density) {
        return with_link_radii(
            arm, coordinates_argument("radii", radii, static_cast<Index>(arm.links().size())),
            density);
      },
      py::arg("arm"), py::arg("radii"), py::kw_only(), py::arg("density") = py::none(),
      workspace_docs::kWithLinkRadii);
  bind_sampling(module);
  bind_best_standpoint(module);
}

}  // namespace bathyal::python
