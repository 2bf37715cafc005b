// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/arm/arm.hpp"

#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "arm_class.hpp"
#include "arm_docs.hpp"
#include "arm_parts.hpp"
#include "arrays.hpp"
#include "bindings.hpp"
#include "enum_names.hpp"

namespace bathyal::python {
namespace {

/// What each coordinate is led by.
template <class Value, class Get>
std::vector<Value> of_coordinates(const Arm& arm, const Get& get) {
  std::vector<Value> values;
  for (const Joint& joint : arm.joints()) {
    if (joint.coordinate == static_cast<int>(values.size())) values.push_back(get(joint));
  }
  return values;
}

void add_copies(py::class_<Arm>& cls) {
  cls.def(
         "copy", [](const Arm& arm) { return arm; }, "An arm of its own, base and tool too.")
      .def("__copy__", [](const Arm& arm) { return arm; })
      .def(
          "__deepcopy__", [](const Arm& arm, const py::dict&) { return arm; }, py::arg("memo"))
      .def(py::pickle(&arm_parts, &arm_from_parts));
}

void add_properties(py::class_<Arm>& cls) {
  cls.def_property_readonly("name", &Arm::name, "For people; may be empty.")
      .def_property_readonly("source", &Arm::source, "Where the numbers come from.")
      .def_property_readonly("size", &Arm::size, "Number of coordinates n, the width of every q.")
      .def_property_readonly(
          "joint_names",
          [](const Arm& arm) {
            return of_coordinates<std::string>(
                arm, [](const Joint& j) { return j.follows.empty() ? j.name : j.follows; });
          },
          "One name a coordinate: of the joint that leads it, in the arm or outside it.")
      .def_property_readonly(
          "joint_types",
          [](const Arm& arm) {
            return of_coordinates<std::string>(
                arm, [](const Joint& j) { return enum_name(j.type, type_names()); });
          },
          "One word a coordinate, \"revolute\" or \"prismatic\".")
      .def_property_readonly(
          "link_names",
          [](const Arm& arm) {
            std::vector<std::string> names;
            for (const Link& link : arm.links()) names.push_back(link.name);
            return names;
          },
          "One name a link, the foot first: the order of forward(q, links=True).")
      .def_property_readonly("links", &Arm::links, "The Links, the foot first: a list.")
      .def_property_readonly(
          "lower", [](const Arm& arm) { return to_numpy(arm.lower()); },
          "(n,) lower limits [rad] or [m], −inf where there is none.")
      .def_property_readonly(
          "upper", [](const Arm& arm) { return to_numpy(arm.upper()); },
          "(n,) upper limits [rad] or [m], inf where there is none.")
      .def_property_readonly(
          "velocity",
          [](const Arm& arm) {
            return to_numpy(of_coordinates<double>(arm, [](const Joint& j) { return j.velocity; }));
          },
          "(n,) greatest speed of the joint that leads each coordinate [rad/s] or [m/s].")
      .def_property_readonly(
          "effort",
          [](const Arm& arm) {
            return to_numpy(of_coordinates<double>(arm, [](const Joint& j) { return j.effort; }));
          },
          "(n,) greatest torque [N m] or force [N] of that joint.")
      .def_property(
          "base", [](const Arm& arm) { return to_numpy(arm.base()); },
          [](Arm& arm, const OptionalArray& pose) { arm.set_base(pose_argument("base", pose)); },
          "(4, 4) world_from_base; may be set, None is the identity.")
      .def_property(
          "tool", [](const Arm& arm) { return to_numpy(arm.tool()); },
          [](Arm& arm, const OptionalArray& pose) { arm.set_tool(pose_argument("tool", pose)); },
          "(4, 4) flange_from_tool; may be set, None is the identity.")
      .def("__repr__", [](const Arm& arm) {
        return "Arm(" + (arm.name().empty() ? "" : "\"" + arm.name() + "\", ") +
               std::to_string(arm.size()) + (arm.size() == 1 ? " joint)" : " joints)");
      });
}

}  // namespace

void bind_arm(py::module_& module) {
  bind_arm_tables(module);
  bind_inverse_result(module);
  py::class_<Arm> cls(module, "Arm", kArmDoc);
  add_tables(cls);
  add_copies(cls);
  add_properties(cls);
  add_kinematics(cls);
  add_inverse(cls);
  bind_arm_parts(module);
}

}  // namespace bathyal::python
