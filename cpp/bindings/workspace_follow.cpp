// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "bathyal/base/text.hpp"
#include "bathyal/workspace/motion/follow.hpp"
#include "bathyal/workspace/motion/stepping.hpp"
#include "enum_names.hpp"
#include "workspace_class.hpp"
#include "workspace_follow_docs.hpp"

namespace bathyal::python {
namespace {

const EnumNames<InverseTask>& tip_task_names() {
  static const EnumNames<InverseTask> names{{"pose", InverseTask::kPose},
                                            {"position_axis", InverseTask::kPositionAxis},
                                            {"position", InverseTask::kPosition}};
  return names;
}
const EnumNames<MoveMethod>& move_method_names() {
  static const EnumNames<MoveMethod> names{{"damped", MoveMethod::kDamped},
                                           {"pseudo_inverse", MoveMethod::kPseudoInverse}};
  return names;
}

std::string contact_partner(const Workspace& ws, int obstacle, int other_link) {
  if (obstacle >= 0) return ws.obstacles()[static_cast<std::size_t>(obstacle)];
  return other_link < 0 ? "" : link_name(ws.arm(), other_link);
}

std::string link_or_none(const Workspace& ws, int link) {
  return link < 0 ? "" : link_name(ws.arm(), link);
}

std::string limited_joint(const Workspace& ws, int coordinate) {
  for (const Joint& joint : ws.arm().joints()) {
    if (joint.coordinate != coordinate || coordinate < 0 || !joint.follows.empty()) continue;
    return joint.name.empty() ? "joint " + std::to_string(coordinate) : joint.name;
  }
  return "";
}

/// What move() returns, with names.
struct TipMove {
  Move move;
  std::string link, against, joint;
};

/// What follow() returns, with names.
struct FollowedPath {
  Followed followed;
  Workspace workspace;
};

/// The target in the world and what of it counts.
std::pair<Pose, InverseTask> move_target(const OptionalArray& point, const OptionalArray& pose,
                                         const std::optional<std::string>& task) {
  if (point.is_none() == pose.is_none()) {
    throw_argument("point", "either it or `pose`", point.is_none() ? "neither" : "both");
  }
  if (!pose.is_none()) {
    return {pose_argument("pose", pose),
            task ? enum_argument("task", *task, tip_task_names()) : InverseTask::kPose};
  }
  if (task && *task != "position") {
    throw_argument("task", "\"position\" of a point", "\"" + *task + "\"");
  }
  return {Pose(Eigen::Translation3d(vector_argument("point", point))), InverseTask::kPosition};
}

void add_move(py::class_<Workspace>& cls) {
  const MoveOptions defaults;
  cls.def(
      "move",
      [](const Workspace& ws, const ArrayLike& q_start, const OptionalArray& point,
         const OptionalArray& pose, const std::string& method,
         const std::optional<std::string>& task, const ArrayLike& axis,
         std::optional<double> position_tolerance, std::optional<double> angle_tolerance, int steps,
         double speed, double angular_rate, double period, double clearance, double influence,
         double approach, int max_steps, const OptionalArray& velocity,
         const OptionalArray& acceleration, bool tip_contact, double time) {
        const auto [target, what] = move_target(point, pose, task);
        const Index size = ws.arm().size();
        const std::vector<double> start = posture_argument("q_start", q_start, size);
        MoveOptions options;
        options.method = enum_argument("method", method, move_method_names());
        options.task = what;
        options.axis = vector_argument("axis", axis);
        options.position_tolerance = position_tolerance;
        options.angle_tolerance = angle_tolerance;
        options.steps = steps;
        options.speed = speed;
        options.angular_rate = angular_rate;
        options.period = period;
        options.clearance = clearance;
        options.influence = influence;
        options.approach = approach;
        options.max_steps = max_steps;
        options.velocity = coordinates_argument("velocity", velocity, size);
        options.acceleration = coordinates_argument("acceleration", acceleration, size);
        options.tip_contact = tip_contact_argument(tip_contact);
        options.time = time;
        TipMove found;
        {
          const py::gil_scoped_release release;
          found.move = move_tip(ws, start, target, options);
        }
        found.link = link_or_none(ws, found.move.link);
        found.against = contact_partner(ws, found.move.obstacle, found.move.other_link);
        found.joint = limited_joint(ws, found.move.coordinate);
        return found;
      },
      py::arg("q_start"), py::kw_only(), py::arg("point") = py::none(),
      py::arg("pose") = py::none(),
      py::arg("method") = enum_name(defaults.method, move_method_names()),
      py::arg("task") = py::none(),
      py::arg("axis") = py::make_tuple(defaults.axis.x(), defaults.axis.y(), defaults.axis.z()),
      py::arg("position_tolerance") = defaults.position_tolerance,
      py::arg("angle_tolerance") = defaults.angle_tolerance, py::arg("steps") = defaults.steps,
      py::arg("speed") = defaults.speed, py::arg("angular_rate") = defaults.angular_rate,
      py::arg("period") = defaults.period, py::arg("clearance") = defaults.clearance,
      py::arg("influence") = defaults.influence, py::arg("approach") = defaults.approach,
      py::arg("max_steps") = defaults.max_steps, py::arg("velocity") = py::none(),
      py::arg("acceleration") = py::none(), py::arg("tip_contact") = false,
      py::arg("time") = defaults.time, workspace_docs::kMove);
}

void add_follow_path(py::class_<Workspace>& cls) {
  const FollowOptions defaults;
  cls.def(
      "follow",
      [](const Workspace& ws, const std::shared_ptr<ToolPath>& path, const OptionalArray& q_start,
         const std::string& task, double position_tolerance, double angle_tolerance, double step,
         double lift, double shortest, double transit_speed, double transit_rate, double clearance,
         double influence, int candidates, const OptionalArray& velocity,
         const OptionalArray& acceleration, std::optional<bool> tip_contact, double time,
         std::uint64_t seed) {
        const Index size = ws.arm().size();
        FollowOptions options;
        options.q_start = posture_argument("q_start", q_start, size);
        options.task = enum_argument("task", task, tip_task_names());
        options.position_tolerance = position_tolerance;
        options.angle_tolerance = angle_tolerance;
        options.step = step;
        options.lift = lift;
        options.shortest = shortest;
        options.transit_speed = transit_speed;
        options.transit_rate = transit_rate;
        options.clearance = clearance;
        options.influence = influence;
        options.candidates = candidates;
        options.velocity = coordinates_argument("velocity", velocity, size);
        options.acceleration = coordinates_argument("acceleration", acceleration, size);
        if (tip_contact) options.tip_contact = tip_contact_argument(*tip_contact);
        options.time = time;
        options.seed = seed;
        const py::gil_scoped_release release;
        return FollowedPath{follow_toolpath(ws, *path, options), ws};
      },
      py::arg("path"), py::kw_only(), py::arg("q_start") = py::none(),
      py::arg("task") = enum_name(defaults.task, tip_task_names()),
      py::arg("position_tolerance") = defaults.position_tolerance,
      py::arg("angle_tolerance") = defaults.angle_tolerance, py::arg("step") = defaults.step,
      py::arg("lift") = defaults.lift, py::arg("shortest") = defaults.shortest,
      py::arg("transit_speed") = defaults.transit_speed,
      py::arg("transit_rate") = defaults.transit_rate, py::arg("clearance") = defaults.clearance,
      py::arg("influence") = defaults.influence, py::arg("candidates") = defaults.candidates,
      py::arg("velocity") = py::none(), py::arg("acceleration") = py::none(),
      py::arg("tip_contact") = py::none(), py::arg("time") = defaults.time,
      py::arg("seed") = defaults.seed, workspace_docs::kFollow);
}

void bind_tip_move(py::module_& module) {
  py::class_<TipMove>(module, "TipMove", workspace_docs::kTipMove)
      .def_property_readonly(
          "status", [](const TipMove& m) { return std::string(to_text(m.move.status)); },
          "\"reached\"; \"stuck\": no step brings the tip nearer, by what is near or by a singular "
          "posture; \"blocked\": the next step or the start touches something; \"at_limit\": held "
          "by a joint's limit or sent beyond it; \"unreachable\": in no posture.")
      .def_property_readonly(
          "path", [](const TipMove& m) { return to_numpy(m.move.path); },
          "(K, n) from the start on [rad] or [m]; all of it free of contact, but for a start that "
          "is not.")
      .def_property_readonly(
          "time", [](const TipMove& m) { return to_numpy(m.move.time); }, "(K,) rising [s].")
      .def_property_readonly(
          "position_error", [](const TipMove& m) { return m.move.position_error; },
          "That remains at the end [m].")
      .def_property_readonly(
          "angle_error", [](const TipMove& m) { return m.move.angle_error; },
          "That remains at the end [rad].")
      .def_readonly("link", &TipMove::link,
                    "Name of the link that is in the way; empty where there is none.")
      .def_readonly("against", &TipMove::against,
                    "Of what: \"hull\", \"scene\", a keep-out's name or another link's.")
      .def_readonly("joint", &TipMove::joint,
                    "Name of the joint that is at its limit; empty where there is none.")
      .def_property_readonly(
          "reason", [](const TipMove& m) { return m.move.reason; },
          "A short sentence; empty when it was reached.")
      .def("__repr__", [](const TipMove& m) {
        const std::string reason = m.move.reason.empty() ? "" : ": " + m.move.reason;
        return "TipMove(" + std::string(to_text(m.move.status)) + reason + ")";
      });
}

void bind_followed_path(py::module_& module) {
  using Path = FollowedPath;
  using Cut = std::tuple<int, int, std::string>;
  py::class_<Path>(module, "FollowedPath", workspace_docs::kFollowedPath)
      .def_property_readonly(
          "q", [](const Path& p) { return to_numpy(p.followed.q); }, "(K, n) [rad] or [m].")
      .def_property_readonly(
          "time", [](const Path& p) { return to_numpy(p.followed.time); }, "(K,) rising [s].")
      .def_property_readonly(
          "sample", [](const Path& p) { return to_numpy(p.followed.sample); },
          "(K,) sample of the tool path at or before the row, −1 in transit. Samples that coincide "
          "share a row, which has the last of them.")
      .def_property_readonly(
          "fraction", [](const Path& p) { return to_numpy(p.followed.fraction); },
          "(K,) of the way from that sample to the next one; 0 in transit.")
      .def_property_readonly(
          "cut",
          [](const Path& p) {
            std::vector<Cut> cuts;
            for (const FollowCut& cut : p.followed.cut) {
              cuts.emplace_back(cut.first, cut.last, std::string(to_text(cut.reason)));
            }
            return cuts;
          },
          "List of (first, last, reason): the tool path from sample `first` to sample `last` is "
          "not "
          "followed (these two may be, as an end and a beginning), because it is \"unreachable\", "
          "only within reach beyond a \"limit\", only in \"collision\", because the arm would have "
          "to jump (\"singular\"), or no way there was found (\"no_transit\").")
      .def_property_readonly(
          "cut_by",
          [](const Path& p) {
            std::vector<std::string> names;
            for (const FollowCut& cut : p.followed.cut) {
              const std::string joint = limited_joint(p.workspace, cut.coordinate);
              const std::string link = link_or_none(p.workspace, cut.link);
              names.push_back(link.empty()
                                  ? joint
                                  : link + " against " +
                                        contact_partner(p.workspace, cut.obstacle, cut.other_link));
            }
            return names;
          },
          "List of the constraint at the beginning of each cut: a link and what it meets, or a "
          "joint; empty where neither is known.")
      .def_property_readonly(
          "position_error", [](const Path& p) { return p.followed.position_error; },
          "Greatest of the rows that are not in transit [m].")
      .def_property_readonly(
          "angle_error", [](const Path& p) { return p.followed.angle_error; },
          "Greatest of the rows that are not in transit [rad]; 0 of the task \"position\".")
      .def("__len__", [](const Path& p) { return p.followed.sample.size(); })
      .def("__repr__", [](const Path& p) {
        return "FollowedPath(" + counted(static_cast<long>(p.followed.sample.size()), "row") +
               ", " + counted(static_cast<long>(p.followed.cut.size()), "cut") + ")";
      });
}

}  // namespace

void bind_tip_motions(py::module_& module) {
  bind_tip_move(module);
  bind_followed_path(module);
}

void add_follow(py::class_<Workspace>& cls) {
  add_move(cls);
  add_follow_path(cls);
}

}  // namespace bathyal::python
