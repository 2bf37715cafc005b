// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/geometry/shape.hpp"

#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "bindings.hpp"
#include "enum_names.hpp"

namespace bathyal::python {
namespace {

constexpr const char* kShapeDoc =
    R"(The outline of a body, or a part of it, as a robot's file gives it.

Parameters
----------
kind : str
    "box" (with `size`), "cylinder" (`radius`, `length`), "sphere" (`radius`) or "mesh" (`file`).
size : (3,) array
    Full lengths of a box along its x, y and z [m].
radius, length : float
    Of a cylinder, which lies along z with its middle in the origin, and of a sphere [m].
file : str
    Of a mesh: the name that its owner's file gives. It is never opened here; `bathyal.mesh_path`
    finds it.
folder : str
    The folder from which a relative `file` starts; empty where it is unknown.
scale : (3,) array
    Of a mesh along its x, y and z; 1 unless given, negative mirrors.
pose : (4, 4) array, optional
    body_from_shape: of a link's shape, link_from_shape.
part : str
    The body that it outlines, where several were made one: a finger of a gripper.

Raises
------
ValueError
    For what the kind has not or lacks, lengths that are negative or not finite, a scale of 0, a
    pose that is not rigid.

Examples
--------
>>> import bathyal
>>> bathyal.Shape("cylinder", radius=0.05, length=0.4)
Shape("cylinder", radius=0.05, length=0.4)
)";

const EnumNames<ShapeKind>& kind_names() {
  static const EnumNames<ShapeKind> names{{"box", ShapeKind::kBox},
                                          {"cylinder", ShapeKind::kCylinder},
                                          {"sphere", ShapeKind::kSphere},
                                          {"mesh", ShapeKind::kMesh}};
  return names;
}

bool has_radius(ShapeKind kind) {
  return kind == ShapeKind::kCylinder || kind == ShapeKind::kSphere;
}

/// Whether an argument was given; what the kind lacks or has not is refused.
bool is_given(const char* name, const py::object& value, bool needed, const std::string& kind) {
  if (value.is_none() == !needed) return needed;
  throw_argument(name, (needed ? "a value, as a " : "none, as a ") + kind + " has",
                 py::repr(value).cast<std::string>());
}

double number_argument(const char* name, const py::object& value) {
  try {
    return value.cast<double>();
  } catch (const py::cast_error&) {
    throw_argument(name, "a number", py::repr(value).cast<std::string>());
  }
}

using OptionalNumber = py::typing::Optional<py::float_>;

Shape make_shape(const std::string& word, const OptionalArray& size, const OptionalNumber& radius,
                 const OptionalNumber& length, const std::optional<std::string>& file,
                 const std::string& folder, const OptionalArray& scale, const OptionalArray& pose,
                 const std::string& part) {
  Shape shape;
  shape.kind = enum_argument("kind", word, kind_names());
  const bool mesh = shape.kind == ShapeKind::kMesh;
  if (is_given("size", size, shape.kind == ShapeKind::kBox, word)) {
    shape.size = vector_argument("size", size);
  }
  if (is_given("radius", radius, has_radius(shape.kind), word)) {
    shape.radius = number_argument("radius", radius);
  }
  if (is_given("length", length, shape.kind == ShapeKind::kCylinder, word)) {
    shape.length = number_argument("length", length);
  }
  if (is_given("file", py::cast(file), mesh, word)) shape.file = *file;
  if (!scale.is_none() && is_given("scale", scale, mesh, word)) {
    shape.scale = vector_argument("scale", scale);
  }
  shape.folder = folder;
  shape.body_from_shape = pose_argument("pose", pose);
  shape.part = part;
  shape.check();
  return shape;
}

/// None for a shape of another kind.
template <class Value>
std::optional<Value> if_kind(bool holds, Value value) {
  return holds ? std::optional<Value>(std::move(value)) : std::nullopt;
}

py::dict state_of(const Shape& s) {
  const bool mesh = s.kind == ShapeKind::kMesh;
  py::dict state;
  state["kind"] = enum_name(s.kind, kind_names());
  if (s.kind == ShapeKind::kBox) state["size"] = to_numpy(s.size);
  if (has_radius(s.kind)) state["radius"] = s.radius;
  if (s.kind == ShapeKind::kCylinder) state["length"] = s.length;
  if (mesh) state["file"] = s.file;
  if (mesh) state["folder"] = s.folder;
  if (mesh) state["scale"] = to_numpy(s.scale);
  state["pose"] = to_numpy(s.body_from_shape);
  state["part"] = s.part;
  return state;
}

std::string shape_text(const Shape& s) {
  std::string text = "Shape(\"" + enum_name(s.kind, kind_names()) + "\"";
  if (s.kind == ShapeKind::kBox) {
    text += ", size=(" + to_text(s.size.x()) + ", " + to_text(s.size.y()) + ", " +
            to_text(s.size.z()) + ")";
  }
  if (has_radius(s.kind)) text += ", radius=" + to_text(s.radius);
  if (s.kind == ShapeKind::kCylinder) text += ", length=" + to_text(s.length);
  if (s.kind == ShapeKind::kMesh) text += ", file=\"" + s.file + "\"";
  return text + ")";
}

}  // namespace

void bind_shape(py::module_& module) {
  py::class_<Shape> cls(module, "Shape", kShapeDoc);
  cls.def(py::init(&make_shape), py::arg("kind"), py::kw_only(), py::arg("size") = py::none(),
          py::arg("radius") = py::none(), py::arg("length") = py::none(),
          py::arg("file") = py::none(), py::arg("folder") = "", py::arg("scale") = py::none(),
          py::arg("pose") = py::none(), py::arg("part") = "")
      .def_property_readonly(
          "kind", [](const Shape& s) { return enum_name(s.kind, kind_names()); },
          "\"box\", \"cylinder\", \"sphere\" or \"mesh\".")
      .def_property_readonly(
          "size",
          [](const Shape& s) { return if_kind(s.kind == ShapeKind::kBox, to_numpy(s.size)); },
          "(3,) full lengths of a box [m]; None of the others.")
      .def_property_readonly(
          "radius", [](const Shape& s) { return if_kind(has_radius(s.kind), s.radius); },
          "Of a cylinder or sphere [m]; None of the others.")
      .def_property_readonly(
          "length",
          [](const Shape& s) { return if_kind(s.kind == ShapeKind::kCylinder, s.length); },
          "Of a cylinder [m]; None of the others.")
      .def_property_readonly(
          "file", [](const Shape& s) { return if_kind(s.kind == ShapeKind::kMesh, s.file); },
          "Of a mesh, as its owner's file names it; None of the others.")
      .def_readonly("folder", &Shape::folder,
                    "Where a relative `file` starts; empty where it is unknown.")
      .def_property_readonly(
          "scale",
          [](const Shape& s) { return if_kind(s.kind == ShapeKind::kMesh, to_numpy(s.scale)); },
          "(3,) of a mesh; None of the others.")
      .def_property_readonly(
          "pose", [](const Shape& s) { return to_numpy(s.body_from_shape); },
          "(4, 4) body_from_shape.")
      .def_readonly("part", &Shape::part, "The body that it outlines; empty where unknown.")
      .def("as_dict", &state_of,
           "What the constructor takes, without what the kind has not: for files and tables.")
      .def("__repr__", &shape_text)
      .def("__reduce__", [](const py::object& self) -> py::typing::Tuple<py::function, py::tuple> {
        const py::object build = py::module_::import("functools").attr("partial");
        return py::make_tuple(build(py::type::of(self), **self.attr("as_dict")().cast<py::dict>()),
                              py::tuple());
      });
}

}  // namespace bathyal::python
