// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>
#include <pybind11/typing.h>

#include <optional>
#include <string>
#include <vector>

#include "arm_class.hpp"
#include "arm_docs.hpp"
#include "arm_parts.hpp"
#include "arrays.hpp"
#include "bathyal/arm/dh.hpp"
#include "bathyal/base/error.hpp"
#include "enum_names.hpp"
#include "rigid_body.hpp"

namespace bathyal::python {
namespace {

const EnumNames<DhConvention>& convention_names() {
  static const EnumNames<DhConvention> names{{"standard", DhConvention::kStandard},
                                             {"modified", DhConvention::kModified}};
  return names;
}

std::vector<double> list_argument(std::string_view name, const py::object& object) {
  if (object.is_none()) return {};
  const Values values = values_argument(name, object);
  return {values.data(), values.data() + values.rows()};
}

template <class Get>
py::array column(const DhTable& table, const Get& get) {
  std::vector<double> values;
  for (const DhRow& row : table.rows) values.push_back(get(row));
  return python::to_numpy(std::move(values));
}

DhTable dh_table_argument(const ArrayLike& a, const ArrayLike& alpha, const ArrayLike& d,
                          const ArrayLike& theta, const OptionalArray& beta,
                          const std::optional<std::vector<std::string>>& joint_types,
                          const std::string& convention, const OptionalArray& root,
                          const OptionalArray& flange) {
  DhTable table;
  table.convention = enum_argument("convention", convention, convention_names());
  const std::vector<double> columns[] = {list_argument("a", a), list_argument("alpha", alpha),
                                         list_argument("d", d), list_argument("theta", theta),
                                         list_argument("beta", beta)};
  const char* names[] = {"a", "alpha", "d", "theta", "beta"};
  const std::size_t rows = columns[0].size();
  for (int i = 1; i < 5; ++i) {
    if (columns[i].size() != rows && !(i == 4 && beta.is_none())) {
      throw_argument(names[i], std::to_string(rows) + " values, as many as `a` has",
                     std::to_string(columns[i].size()));
    }
  }
  for (std::size_t k = 0; k < rows; ++k) {
    table.rows.push_back({columns[0][k], columns[1][k], columns[2][k], columns[3][k],
                          beta.is_none() ? 0.0 : columns[4][k]});
  }
  table.types.assign(rows, JointType::kRevolute);
  if (joint_types) {
    table.types.clear();
    for (const std::string& word : *joint_types) {
      table.types.push_back(enum_argument("joint_types", word, type_names()));
    }
  }
  table.root = pose_argument("root", root);
  table.flange = pose_argument("flange", flange);
  return table;
}

Link make_link(const std::string& name, double mass, const ArrayLike& center_of_mass,
               const OptionalArray& inertia, double volume, const ArrayLike& center_of_buoyancy,
               const OptionalArray& frame, std::vector<Shape> collision,
               std::vector<Shape> visual) {
  Link link;
  link.name = name;
  link.body = rigid_body_arguments(mass, center_of_mass, inertia, volume, center_of_buoyancy);
  link.row_from_link = pose_argument("frame", frame);
  check_rigid("frame", link.row_from_link);
  link.collision = std::move(collision);
  link.visual = std::move(visual);
  return link;
}

py::typing::Tuple<Shape, py::ellipsis> tuple_of(const std::vector<Shape>& shapes) {
  return py::tuple(py::cast(shapes));
}

void bind_link(py::module_& module) {
  py::class_<Link>(module, "Link", kLinkDoc)
      .def(py::init(&make_link), py::arg("name") = "", py::kw_only(),
           py::arg("mass") = Link().body.mass, py::arg("center_of_mass") = py::make_tuple(0, 0, 0),
           py::arg("inertia") = py::none(), py::arg("volume") = Link().body.volume,
           py::arg("center_of_buoyancy") = py::make_tuple(0, 0, 0), py::arg("frame") = py::none(),
           py::arg("collision") = std::vector<Shape>(), py::arg("visual") = std::vector<Shape>())
      .def_readonly("name", &Link::name, "As the file of the arm calls it; may be empty.")
      .def_readonly("body", &Link::body, "The RigidBody in the link's frame.")
      .def_property_readonly(
          "mass", [](const Link& l) { return l.body.mass; }, "[kg]; 0 is unknown.")
      .def_property_readonly(
          "center_of_mass", [](const Link& l) { return python::to_numpy(l.body.center_of_mass); },
          "(3,) in the link's frame [m].")
      .def_property_readonly(
          "inertia", [](const Link& l) { return python::to_numpy(l.body.inertia); },
          "(3, 3) about the centre of mass, along the link's axes [kg m²].")
      .def_property_readonly(
          "volume", [](const Link& l) { return l.body.volume; }, "Displaced [m³]; 0 is unknown.")
      .def_property_readonly(
          "center_of_buoyancy",
          [](const Link& l) { return python::to_numpy(l.body.center_of_buoyancy); },
          "(3,) in the link's frame [m].")
      .def_property_readonly(
          "frame", [](const Link& l) { return python::to_numpy(l.row_from_link); },
          "(4, 4) row_from_link: the link's frame, seen from the frame behind its row.")
      .def_property_readonly(
          "collision", [](const Link& l) { return tuple_of(l.collision); },
          "Tuple of Shapes in the link's frame that must not touch anything.")
      .def_property_readonly(
          "visual", [](const Link& l) { return tuple_of(l.visual); },
          "Tuple of Shapes in the link's frame: what it looks like.")
      .def("__repr__", [](const Link& l) {
        return "Link(\"" + l.name + "\", mass=" + to_text(l.body.mass) + ")";
      });
}

void bind_table(py::module_& module) {
  using Numbers = double DhRow::*;
  py::class_<DhTable> cls(module, "DhTable", kDhTableDoc);
  const auto add = [&cls](const char* name, Numbers number, const char* doc) {
    cls.def_property_readonly(
        name,
        [number](const DhTable& t) {
          return column(t, [number](const DhRow& row) { return row.*number; });
        },
        doc);
  };
  add("a", &DhRow::a, "(m,) [m]");
  add("alpha", &DhRow::alpha, "(m,) [rad]");
  add("d", &DhRow::d, "(m,) [m]; a sliding joint adds its value.");
  add("theta", &DhRow::theta, "(m,) [rad]; a turning joint adds its value.");
  add("beta", &DhRow::beta, "(m,) [rad]; Hayati and Mirmirani's angle.");
  cls.def_property_readonly(
         "joint_types",
         [](const DhTable& t) {
           std::vector<std::string> names;
           for (const JointType type : t.types) names.push_back(enum_name(type, type_names()));
           return names;
         },
         "One word a row: \"revolute\", \"prismatic\" or \"fixed\".")
      .def_property_readonly(
          "convention",
          [](const DhTable& t) { return enum_name(t.convention, convention_names()); },
          "\"standard\" or \"modified\".")
      .def_property_readonly(
          "root", [](const DhTable& t) { return python::to_numpy(t.root); },
          "(4, 4) before the first row.")
      .def_property_readonly(
          "flange", [](const DhTable& t) { return python::to_numpy(t.flange); },
          "(4, 4) behind the last row.")
      .def("__len__", [](const DhTable& t) { return t.rows.size(); })
      .def("__repr__", [](const DhTable& t) {
        return "DhTable(" + std::to_string(t.rows.size()) + " rows, " +
               enum_name(t.convention, convention_names()) + ")";
      });
}

}  // namespace

void bind_arm_tables(py::module_& module) {
  bind_link(module);
  bind_table(module);
}

void add_tables(py::class_<Arm>& cls) {
  const DhTable table;
  const DhArmOptions defaults;
  cls.def_static(
         "from_dh",
         [](const ArrayLike& a, const ArrayLike& alpha, const ArrayLike& d, const ArrayLike& theta,
            const OptionalArray& beta, const std::optional<std::vector<std::string>>& joint_types,
            const std::string& convention, const OptionalArray& lower, const OptionalArray& upper,
            const OptionalArray& velocity, const OptionalArray& effort,
            std::vector<std::string> names, std::vector<Link> links, const OptionalArray& root,
            const OptionalArray& flange, const OptionalArray& base, const OptionalArray& tool,
            std::string name, std::string source) {
           DhArmOptions options;
           options.name = std::move(name);
           options.source = std::move(source);
           options.names = std::move(names);
           options.links = std::move(links);
           options.lower = list_argument("lower", lower);
           options.upper = list_argument("upper", upper);
           options.velocity = list_argument("velocity", velocity);
           options.effort = list_argument("effort", effort);
           Arm arm = arm_from_dh(
               dh_table_argument(a, alpha, d, theta, beta, joint_types, convention, root, flange),
               options);
           arm.set_base(pose_argument("base", base));
           arm.set_tool(pose_argument("tool", tool));
           return arm;
         },
         py::arg("a"), py::arg("alpha"), py::arg("d"), py::arg("theta"), py::kw_only(),
         py::arg("beta") = py::none(), py::arg("joint_types") = py::none(),
         py::arg("convention") = enum_name(table.convention, convention_names()),
         py::arg("lower") = py::none(), py::arg("upper") = py::none(),
         py::arg("velocity") = py::none(), py::arg("effort") = py::none(),
         py::arg("names") = defaults.names, py::arg("links") = std::vector<Link>(),
         py::arg("root") = py::none(), py::arg("flange") = py::none(), py::arg("base") = py::none(),
         py::arg("tool") = py::none(), py::arg("name") = defaults.name,
         py::arg("source") = defaults.source, kFromDhDoc)
      .def(
          "to_dh",
          [](const Arm& arm, const std::string& convention) {
            return dh_table(arm, enum_argument("convention", convention, convention_names()));
          },
          py::kw_only(), py::arg("convention") = enum_name(table.convention, convention_names()),
          kToDhDoc);
}

}  // namespace bathyal::python
