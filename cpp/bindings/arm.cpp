// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/arm/arm.hpp"

#include <pybind11/stl.h>

#include <optional>
#include <string>

#include "arm_docs.hpp"
#include "arm_parts.hpp"
#include "arrays.hpp"
#include "bathyal/arm/dh.hpp"
#include "bathyal/arm/kinematics.hpp"
#include "bathyal/arm/statics.hpp"
#include "bathyal/base/error.hpp"
#include "bindings.hpp"
#include "words.hpp"

namespace bathyal::python {
namespace {

// Words -----------------------------------------------------------------------------------------

const Words<DhConvention>& convention_words() {
  static const Words<DhConvention> words{{"standard", DhConvention::kStandard},
                                         {"modified", DhConvention::kModified}};
  return words;
}
const Words<TipFrame>& frame_words() {
  static const Words<TipFrame> words{{"world", TipFrame::kWorld}, {"tool", TipFrame::kTool}};
  return words;
}
const Words<Manipulability>& manipulability_words() {
  static const Words<Manipulability> words{
      {"yoshikawa", Manipulability::kYoshikawa},
      {"smallest", Manipulability::kSmallest},
      {"inverse_condition", Manipulability::kInverseCondition}};
  return words;
}
const Words<JacobianPart>& part_words() {
  static const Words<JacobianPart> words{{"all", JacobianPart::kAll},
                                         {"linear", JacobianPart::kLinear},
                                         {"angular", JacobianPart::kAngular}};
  return words;
}

// Arguments and results -------------------------------------------------------------------------

std::vector<double> list_argument(std::string_view name, const py::object& object) {
  if (object.is_none()) return {};
  const Values values = values_argument(name, object);
  return {values.data(), values.data() + values.rows()};
}

JointView view_of(const Rows& rows) {
  return {rows.table.data(), rows.table.rows(), rows.table.cols()};
}

py::array to_numpy(const Eigen::VectorXd& values) {
  return python::to_numpy(std::vector<double>(values.data(), values.data() + values.size()));
}

template <class Get>
py::array column(const DhTable& table, const Get& get) {
  std::vector<double> values;
  for (const DhRow& row : table.rows) values.push_back(get(row));
  return python::to_numpy(std::move(values));
}

DhTable table_argument(const py::object& a, const py::object& alpha, const py::object& d,
                       const py::object& theta, const py::object& beta,
                       const std::optional<std::vector<std::string>>& joint_types,
                       const std::string& convention, const py::object& root,
                       const py::object& flange) {
  DhTable table;
  table.convention = word_argument("convention", convention, convention_words());
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
      table.types.push_back(word_argument("joint_types", word, type_words()));
    }
  }
  table.root = pose_argument("root", root);
  table.flange = pose_argument("flange", flange);
  return table;
}

/// What each coordinate is led by.
template <class Value, class Get>
std::vector<Value> of_coordinates(const Arm& arm, const Get& get) {
  std::vector<Value> values;
  for (const Joint& joint : arm.joints()) {
    if (joint.coordinate == static_cast<int>(values.size())) values.push_back(get(joint));
  }
  return values;
}

py::array to_numpy(const Eigen::Matrix3d& matrix) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rows = matrix;
  return python::to_numpy(std::vector<double>(rows.data(), rows.data() + 9), {3});
}

Link make_link(const std::string& name, double mass, const py::object& center_of_mass,
               const py::object& inertia, double volume, const py::object& center_of_buoyancy,
               const py::object& frame) {
  Link link;
  link.name = name;
  link.mass = mass;
  link.center_of_mass = vector_argument("center_of_mass", center_of_mass);
  if (!inertia.is_none()) {
    const Points rows = points_argument("inertia", inertia);
    if (rows.rows() != 3) {
      throw_argument("inertia", "shape (3, 3)", "shape (" + std::to_string(rows.rows()) + ", 3)");
    }
    link.inertia = rows.view();
  }
  link.volume = volume;
  link.center_of_buoyancy = vector_argument("center_of_buoyancy", center_of_buoyancy);
  link.row_from_link = pose_argument("frame", frame);
  return link;
}

// Methods ---------------------------------------------------------------------------------------

py::array forward_python(const Arm& arm, const py::object& q, bool links, int num_threads) {
  const Rows rows = rows_argument("q", q, arm.size());
  std::vector<double> poses;
  {
    const py::gil_scoped_release release;
    poses = links ? forward_links(arm, view_of(rows), num_threads)
                  : forward(arm, view_of(rows), num_threads);
  }
  const auto count = static_cast<py::ssize_t>(arm.links().size());
  return python::to_numpy(
      std::move(poses), rows.single,
      links ? std::vector<py::ssize_t>{count, 4, 4} : std::vector<py::ssize_t>{4, 4});
}

py::array jacobian_python(const Arm& arm, const py::object& q, const std::string& frame,
                          int num_threads) {
  const Rows rows = rows_argument("q", q, arm.size());
  const TipFrame tip = word_argument("frame", frame, frame_words());
  std::vector<double> jacobians;
  {
    const py::gil_scoped_release release;
    jacobians = jacobian(arm, view_of(rows), tip, num_threads);
  }
  return python::to_numpy(std::move(jacobians), rows.single, {6, arm.size()});
}

py::object manipulability_python(const Arm& arm, const py::object& q, const std::string& kind,
                                 const std::string& part, int num_threads) {
  const Rows rows = rows_argument("q", q, arm.size());
  const Manipulability what = word_argument("kind", kind, manipulability_words());
  const JacobianPart counted = word_argument("part", part, part_words());
  std::vector<double> values;
  {
    const py::gil_scoped_release release;
    values = manipulability(arm, view_of(rows), what, counted, num_threads);
  }
  if (rows.single) return py::float_(values.front());
  return python::to_numpy(std::move(values));
}

py::object within_limits_python(const Arm& arm, const py::object& q) {
  const Rows rows = rows_argument("q", q, arm.size());
  const std::vector<bool> within = within_limits(arm, view_of(rows));
  if (rows.single) return py::bool_(within.front());
  py::array_t<bool> array(static_cast<py::ssize_t>(within.size()));
  std::copy(within.begin(), within.end(), array.mutable_data());
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

py::array statics_python(const Arm& arm, const py::object& q, const py::object& wrench,
                         const StaticsOptions& options) {
  const Rows rows = rows_argument("q", q, arm.size());
  const Rows pushes = wrench.is_none() ? Rows{} : rows_argument("wrench", wrench, 6);
  std::vector<double> torques;
  {
    const py::gil_scoped_release release;
    const Wrenches view(pushes.table.data(), pushes.table.rows(), 6);
    torques = statics(arm, view_of(rows), view, options);
  }
  return python::to_numpy(std::move(torques), rows.single, {arm.size()});
}

// Classes ---------------------------------------------------------------------------------------

void bind_link(py::module_& module) {
  py::class_<Link>(module, "Link", kLinkDoc)
      .def(py::init(&make_link), py::arg("name") = "", py::kw_only(), py::arg("mass") = Link().mass,
           py::arg("center_of_mass") = py::make_tuple(0, 0, 0), py::arg("inertia") = py::none(),
           py::arg("volume") = Link().volume,
           py::arg("center_of_buoyancy") = py::make_tuple(0, 0, 0), py::arg("frame") = py::none())
      .def_readonly("name", &Link::name)
      .def_readonly("mass", &Link::mass, "[kg]; 0 is unknown.")
      .def_property_readonly(
          "center_of_mass", [](const Link& l) { return python::to_numpy(l.center_of_mass); },
          "(3,) in the link's frame [m].")
      .def_property_readonly(
          "inertia", [](const Link& l) { return to_numpy(l.inertia); },
          "(3, 3) about the centre of mass, along the link's axes [kg m²].")
      .def_readonly("volume", &Link::volume, "Displaced [m³]; 0 is unknown.")
      .def_property_readonly(
          "center_of_buoyancy",
          [](const Link& l) { return python::to_numpy(l.center_of_buoyancy); },
          "(3,) in the link's frame [m].")
      .def_property_readonly(
          "frame", [](const Link& l) { return python::to_numpy(l.row_from_link); },
          "(4, 4) row_from_link: the link's frame, seen from the frame behind its row.")
      .def("__repr__",
           [](const Link& l) { return "Link(\"" + l.name + "\", mass=" + to_text(l.mass) + ")"; });
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
           std::vector<std::string> words;
           for (const JointType type : t.types) words.push_back(word_of(type, type_words()));
           return words;
         },
         "One word a row: \"revolute\", \"prismatic\" or \"fixed\".")
      .def_property_readonly(
          "convention", [](const DhTable& t) { return word_of(t.convention, convention_words()); },
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
               word_of(t.convention, convention_words()) + ")";
      });
}

void bind_makers(py::class_<Arm>& cls) {
  const DhTable table;
  const DhArmOptions defaults;
  cls.def_static(
         "from_dh",
         [](const py::object& a, const py::object& alpha, const py::object& d,
            const py::object& theta, const py::object& beta,
            const std::optional<std::vector<std::string>>& joint_types,
            const std::string& convention, const py::object& lower, const py::object& upper,
            const py::object& velocity, const py::object& effort, std::vector<std::string> names,
            std::vector<Link> links, const py::object& root, const py::object& flange,
            const py::object& base, const py::object& tool, std::string name, std::string source) {
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
               table_argument(a, alpha, d, theta, beta, joint_types, convention, root, flange),
               options);
           arm.set_base(pose_argument("base", base));
           arm.set_tool(pose_argument("tool", tool));
           return arm;
         },
         py::arg("a"), py::arg("alpha"), py::arg("d"), py::arg("theta"), py::kw_only(),
         py::arg("beta") = py::none(), py::arg("joint_types") = py::none(),
         py::arg("convention") = word_of(table.convention, convention_words()),
         py::arg("lower") = py::none(), py::arg("upper") = py::none(),
         py::arg("velocity") = py::none(), py::arg("effort") = py::none(),
         py::arg("names") = defaults.names, py::arg("links") = std::vector<Link>(),
         py::arg("root") = py::none(), py::arg("flange") = py::none(), py::arg("base") = py::none(),
         py::arg("tool") = py::none(), py::arg("name") = defaults.name,
         py::arg("source") = defaults.source, kFromDhDoc)
      .def(
          "to_dh",
          [](const Arm& arm, const std::string& convention) {
            return dh_table(arm, word_argument("convention", convention, convention_words()));
          },
          py::kw_only(), py::arg("convention") = word_of(table.convention, convention_words()),
          kToDhDoc)
      .def(
          "copy", [](const Arm& arm) { return arm; }, "An arm of its own, base and tool too.")
      .def("__copy__", [](const Arm& arm) { return arm; })
      .def(
          "__deepcopy__", [](const Arm& arm, const py::dict&) { return arm; }, py::arg("memo"))
      .def(py::pickle(&arm_parts, &arm_from_parts));
}

void bind_properties(py::class_<Arm>& cls) {
  cls.def_property_readonly("name", &Arm::name)
      .def_property_readonly("source", &Arm::source, "Where the numbers come from.")
      .def_property_readonly("size", &Arm::size, "Number of coordinates n, the width of every q.")
      .def_property_readonly(
          "joint_names",
          [](const Arm& arm) {
            return of_coordinates<std::string>(
                arm, [](const Joint& j) { return j.follows.empty() ? j.name : j.follows; });
          },
          "One name a coordinate: of the joint that leads it, in the arm or beside it.")
      .def_property_readonly(
          "joint_types",
          [](const Arm& arm) {
            return of_coordinates<std::string>(
                arm, [](const Joint& j) { return word_of(j.type, type_words()); });
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
            return python::to_numpy(
                of_coordinates<double>(arm, [](const Joint& j) { return j.velocity; }));
          },
          "(n,) greatest speed of the joint that leads each coordinate [rad/s] or [m/s].")
      .def_property_readonly(
          "effort",
          [](const Arm& arm) {
            return python::to_numpy(
                of_coordinates<double>(arm, [](const Joint& j) { return j.effort; }));
          },
          "(n,) greatest torque [N m] or force [N] of that joint.")
      .def_property(
          "base", [](const Arm& arm) { return python::to_numpy(arm.base()); },
          [](Arm& arm, const py::object& pose) { arm.set_base(pose_argument("base", pose)); },
          "(4, 4) world_from_base; may be set, None is the identity.")
      .def_property(
          "tool", [](const Arm& arm) { return python::to_numpy(arm.tool()); },
          [](Arm& arm, const py::object& pose) { arm.set_tool(pose_argument("tool", pose)); },
          "(4, 4) flange_from_tool; may be set, None is the identity.")
      .def("__repr__", [](const Arm& arm) {
        return "Arm(" + (arm.name().empty() ? "" : "\"" + arm.name() + "\", ") +
               std::to_string(arm.size()) + (arm.size() == 1 ? " joint)" : " joints)");
      });
}

void bind_kinematics(py::class_<Arm>& cls) {
  const StaticsOptions still;
  cls.def("forward", &forward_python, py::arg("q"), py::kw_only(), py::arg("links") = false,
          py::arg("num_threads") = 0, kForwardDoc)
      .def("jacobian", &jacobian_python, py::arg("q"), py::kw_only(),
           py::arg("frame") = word_of(TipFrame::kWorld, frame_words()), py::arg("num_threads") = 0,
           kJacobianDoc)
      .def("manipulability", &manipulability_python, py::arg("q"), py::kw_only(),
           py::arg("kind") = word_of(Manipulability::kYoshikawa, manipulability_words()),
           py::arg("part") = word_of(JacobianPart::kAll, part_words()), py::arg("num_threads") = 0,
           kManipulabilityDoc)
      .def(
          "statics",
          [](const Arm& arm, const py::object& q, const py::object& wrench,
             const std::string& frame, const py::object& gravity, double water_density,
             double payload, const py::object& payload_center, double payload_volume,
             const py::object& payload_center_of_buoyancy, int num_threads) {
            StaticsOptions options;
            options.gravity = vector_argument("gravity", gravity);
            options.water_density = water_density;
            options.payload.mass = payload;
            options.payload.volume = payload_volume;
            options.payload.center_of_mass = vector_argument("payload_center", payload_center);
            options.payload.center_of_buoyancy =
                payload_center_of_buoyancy.is_none()
                    ? options.payload.center_of_mass
                    : vector_argument("payload_center_of_buoyancy", payload_center_of_buoyancy);
            options.frame = word_argument("frame", frame, frame_words());
            options.num_threads = num_threads;
            return statics_python(arm, q, wrench, options);
          },
          py::arg("q"), py::arg("wrench") = py::none(), py::kw_only(),
          py::arg("frame") = word_of(still.frame, frame_words()),
          py::arg("gravity") =
              py::make_tuple(still.gravity.x(), still.gravity.y(), still.gravity.z()),
          py::arg("water_density") = still.water_density, py::arg("payload") = still.payload.mass,
          py::arg("payload_center") = py::make_tuple(0, 0, 0),
          py::arg("payload_volume") = still.payload.volume,
          py::arg("payload_center_of_buoyancy") = py::none(),
          py::arg("num_threads") = still.num_threads, kStaticsDoc)
      .def("within_limits", &within_limits_python, py::arg("q"),
           "Whether each pose q (N, n) keeps the limits: (N,) bool; one pose (n,) gives one.");
}

}  // namespace

void bind_arm(py::module_& module) {
  bind_link(module);
  bind_table(module);
  py::class_<Arm> cls(module, "Arm", kArmDoc);
  bind_makers(cls);
  bind_properties(cls);
  bind_kinematics(cls);
  add_arm_files(cls);
  bind_arm_parts(module);
}

}  // namespace bathyal::python
