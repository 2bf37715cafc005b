// SPDX-License-Identifier: BSD-3-Clause
#include "workspace_answers.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <limits>

#include "bathyal/base/text.hpp"
#include "enum_names.hpp"
#include "workspace_class_docs.hpp"

namespace bathyal::python {

std::string name_of_link(const Workspace& ws, int link) {
  return link < 0 ? "" : link_name(ws.arm(), link);
}

std::string obstacle_name(const Workspace& ws, int obstacle) {
  return obstacle < 0 ? "" : ws.obstacles()[static_cast<std::size_t>(obstacle)];
}

namespace {

const EnumNames<TargetIndicator>& target_names() {
  static const EnumNames<TargetIndicator> names{{"hull", TargetIndicator::kHull},
                                                {"keepout", TargetIndicator::kKeepOut},
                                                {"ground", TargetIndicator::kGround},
                                                {"unreachable", TargetIndicator::kUnreachable},
                                                {"collision", TargetIndicator::kCollision},
                                                {"limit", TargetIndicator::kLimit},
                                                {"free", TargetIndicator::kFree}};
  return names;
}

void bind_capsule(py::module_& module) {
  py::class_<Capsule>(module, "Capsule", workspace_docs::kCapsule)
      .def(py::init([](const ArrayLike& start, const ArrayLike& end, double radius) {
             const Capsule made{vector_argument("start", start), vector_argument("end", end),
                                radius};
             made.check();
             return made;
           }),
           py::arg("start"), py::arg("end"), py::arg("radius"))
      .def_property_readonly(
          "start", [](const Capsule& c) { return to_numpy(c.start); }, "(3,) [m].")
      .def_property_readonly(
          "end", [](const Capsule& c) { return to_numpy(c.end); }, "(3,) [m].")
      .def_readonly("radius", &Capsule::radius, "[m].")
      .def("__repr__", [](const Capsule& c) {
        return "Capsule(length=" + to_text((c.end - c.start).norm()) +
               ", radius=" + to_text(c.radius) + ")";
      });
}

void bind_clearances(py::module_& module) {
  using Rows = ClearanceRows;
  py::class_<Rows>(module, "Clearances", workspace_docs::kClearances)
      .def_property_readonly(
          "distance",
          [](const Rows& r) { return r.numbers([](const auto& c) { return c.distance; }); },
          "(N,) smallest distance of any link to hull, keep-outs and scene [m]: below 0 where they "
          "overlap, inf where there is nothing.")
      .def_property_readonly(
          "self_distance",
          [](const Rows& r) { return r.numbers([](const auto& c) { return c.self_distance; }); },
          "(N,) smallest distance between the arm's own links [m].")
      .def_property_readonly(
          "link",
          [](const Rows& r) {
            return r.names([&](const auto& c) { return name_of_link(r.workspace, c.link); });
          },
          "(N,) name of the link that is nearest; empty where there is nothing.")
      .def_property_readonly(
          "against",
          [](const Rows& r) {
            return r.names([&](const auto& c) { return obstacle_name(r.workspace, c.obstacle); });
          },
          "(N,) to what: \"hull\", \"scene\" or a keep-out's name.")
      .def_property_readonly(
          "point",
          [](const Rows& r) { return r.points([](const auto& c) { return c.obstacle_point; }); },
          "(N, 3) the nearest point of that, in the vehicle's frame [m]; nan where there is "
          "nothing.")
      .def_property_readonly(
          "link_point",
          [](const Rows& r) { return r.points([](const auto& c) { return c.axis_point; }); },
          "(N, 3) the nearest point on the axis of the link's capsule, in the vehicle's frame [m].")
      .def("__len__", [](const Rows& r) { return r.rows.size(); })
      .def("__repr__", [](const Rows& r) {
        double least = std::numeric_limits<double>::infinity();
        for (const Clearance& row : r.rows) least = std::min(least, row.distance);
        return "Clearances(" + counted(static_cast<long>(r.rows.size()), "posture") + ", least " +
               to_text(least) + " m)";
      });
}

void bind_motion_check(py::module_& module) {
  using Check = NamedMotionCheck;
  py::class_<Check>(module, "MotionCheck", workspace_docs::kMotionCheck)
      .def_property_readonly(
          "free", [](const Check& c) { return c.check.free; }, "Whether there is no contact.")
      .def_property_readonly(
          "contact", [](const Check& c) { return c.check.contact; },
          "Row of the first contact, with the fraction of the way to the next; nan of a free "
          "motion.")
      .def_property_readonly(
          "time", [](const Check& c) { return c.check.time; },
          "Of the first contact [s]; nan of a free motion, and where no times were given.")
      .def_readonly("link", &Check::link, "Name of the link that touches; empty of a free motion.")
      .def_readonly("against", &Check::against,
                    "What it touches: \"hull\", \"scene\", a keep-out's name or another link's.")
      .def("__bool__", [](const Check& c) { return c.check.free; })
      .def("__repr__", [](const Check& c) {
        if (c.check.free) return std::string("MotionCheck(free)");
        return "MotionCheck(" + c.link + " against " + c.against + " at row " +
               to_text(c.check.contact) + ")";
      });
}

void bind_target_checks(py::module_& module) {
  using Rows = TargetRows;
  py::class_<Rows>(module, "TargetChecks", workspace_docs::kTargetChecks)
      .def_property_readonly(
          "status",
          [](const Rows& r) {
            std::vector<std::string> names;
            for (const TargetCheck& row : r.rows) {
              names.push_back(enum_name(row.status, target_names()));
            }
            return text_array(names);
          },
          "(N,) the first that holds: \"hull\" (inside it), \"keepout\", \"ground\" (under the "
          "bottom), \"unreachable\" (within the limits, in any orientation), \"collision\" (only "
          "by "
          "postures that touch something), \"limit\" (only with a joint within 0.01 rad, 1 mm of a "
          "limit), \"free\".")
      .def_property_readonly(
          "keepout",
          [](const Rows& r) {
            std::vector<std::int32_t> values;
            for (const TargetCheck& row : r.rows) values.push_back(row.keepout);
            return to_numpy(std::move(values));
          },
          "(N,) index of the keep-out that the point lies in, −1 where none.")
      .def_property_readonly(
          "distance",
          [](const Rows& r) {
            std::vector<double> values;
            for (const TargetCheck& row : r.rows) values.push_back(row.distance);
            return to_numpy(std::move(values));
          },
          "(N,) from the point to the nearest of hull, keep-outs and ground [m], below 0 inside; "
          "inf where there is nothing.")
      .def_property_readonly(
          "q",
          [](const Rows& r) {
            std::vector<double> values;
            for (const TargetCheck& row : r.rows) {
              for (Index k = 0; k < r.size; ++k) {
                values.push_back(row.q.empty() ? std::numeric_limits<double>::quiet_NaN()
                                               : row.q[static_cast<std::size_t>(k)]);
              }
            }
            return to_numpy(std::move(values), {r.size});
          },
          "(N, n) a posture that reaches the point, the best that was found; nan where there is "
          "none.")
      .def("__len__", [](const Rows& r) { return r.rows.size(); })
      .def("__repr__", [](const Rows& r) {
        const auto free = std::ranges::count(r.rows, TargetIndicator::kFree, &TargetCheck::status);
        return "TargetChecks(" + std::to_string(free) + " of " + std::to_string(r.rows.size()) +
               " free)";
      });
}

}  // namespace

void bind_workspace_answers(py::module_& module) {
  bind_capsule(module);
  bind_clearances(module);
  bind_motion_check(module);
  bind_target_checks(module);
}

}  // namespace bathyal::python
