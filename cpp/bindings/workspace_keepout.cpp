// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/keepout.hpp"

#include <pybind11/stl.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "bathyal/base/check.hpp"
#include "trajectory.hpp"
#include "workspace_docs.hpp"
#include "workspace_volumes.hpp"

namespace bathyal::python {
namespace {

using workspace_docs::kKeepOutFrameDoc;

template <class Value>
std::optional<Value> only_if(bool has, Value value) {
  return has ? std::optional<Value>(std::move(value)) : std::nullopt;
}

using OptionalName = std::optional<std::string>;

/// The radius of a cone's end, given as such or by its full opening angle.
double cone_radius(double length, std::optional<double> radius, std::optional<double> angle) {
  if (radius.has_value() == angle.has_value()) {
    throw_argument("radius", "either it or `angle`", radius ? "both" : "neither");
  }
  if (radius) return *radius;
  if (!(*angle > 0.0 && *angle < std::numbers::pi)) {
    throw_argument("angle", "an opening angle above 0 and below pi", to_text(*angle));
  }
  return length * std::tan(0.5 * *angle);
}

Plane half_space_border(const ArrayLike& normal, std::optional<double> offset,
                        const OptionalArray& point) {
  const Vec3 direction = vector_argument("normal", normal);
  if (offset.has_value() != point.is_none()) {
    throw_argument("offset", "either it or `point`", offset ? "both" : "neither");
  }
  return offset ? Plane(direction, *offset)
                : Plane::through(vector_argument("point", point), direction);
}

KeepOut mesh_keepout(const py::typing::Union<TriangleMesh, Hull>& mesh, KeepOutLabel label) {
  if (py::isinstance<Hull>(mesh)) return KeepOut::mesh(mesh.cast<Hull>(), std::move(label));
  if (!py::isinstance<TriangleMesh>(mesh)) {
    throw py::type_error("`mesh`: expected a bathyal.TriangleMesh or bathyal.Hull, got " +
                         py::type::of(mesh).attr("__name__").cast<std::string>());
  }
  return KeepOut::mesh(make_hull(mesh.cast<const TriangleMesh&>(), 0), std::move(label));
}

/// One radius for all capsules, or one each.
std::vector<double> capsule_radii(const ArrayLike& radius, Index count) {
  const py::array given = array_argument("radius", radius, "a number or (N,) real numbers");
  const py::object row = given.ndim() == 0 ? given.attr("reshape")(1) : py::object(given);
  const Values values = values_argument("radius", row);
  if (given.ndim() == 0) {
    return std::vector<double>(static_cast<std::size_t>(count), values.view()[0]);
  }
  return {values.data(), values.data() + values.rows()};
}

void bind_keepout_makers(py::class_<KeepOut>& keepout) {
  const KeepOutLabel defaults;
  const auto frame = py::arg_v("frame", defaults.frame);
  const auto name = py::arg_v("name", py::none());
  keepout
      .def_static(
          "sphere",
          [](double radius, const ArrayLike& center, std::string frame, OptionalName name) {
            return KeepOut::sphere(radius, vector_argument("center", center), {frame, name});
          },
          py::arg("radius"), py::arg("center") = py::make_tuple(0, 0, 0), py::kw_only(), frame,
          name, workspace_docs::kSphere)
      .def_static(
          "box",
          [](const ArrayLike& size, const OptionalArray& pose, std::string frame,
             OptionalName name) {
            return KeepOut::box(vector_argument("size", size), pose_argument("pose", pose),
                                {frame, name});
          },
          py::arg("size"), py::arg("pose") = py::none(), py::kw_only(), frame, name,
          workspace_docs::kBox)
      .def_static(
          "cylinder",
          [](double radius, double length, const OptionalArray& pose, std::string frame,
             OptionalName name) {
            return KeepOut::cylinder(radius, length, pose_argument("pose", pose), {frame, name});
          },
          py::arg("radius"), py::arg("length"), py::arg("pose") = py::none(), py::kw_only(), frame,
          name, workspace_docs::kCylinder)
      .def_static(
          "cone",
          [](double length, const OptionalArray& pose, std::optional<double> radius,
             std::optional<double> angle, std::string frame, OptionalName name) {
            check_positive("length", length);
            return KeepOut::cone(cone_radius(length, radius, angle), length,
                                 pose_argument("pose", pose), {frame, name});
          },
          py::arg("length"), py::arg("pose") = py::none(), py::kw_only(),
          py::arg("radius") = py::none(), py::arg("angle") = py::none(), frame, name,
          workspace_docs::kCone)
      .def_static(
          "half_space",
          [](const ArrayLike& normal, std::optional<double> offset, const OptionalArray& point,
             std::string frame, OptionalName name) {
            return KeepOut::half_space(half_space_border(normal, offset, point), {frame, name});
          },
          py::arg("normal"), py::arg("offset") = py::none(), py::kw_only(),
          py::arg("point") = py::none(), frame, name, workspace_docs::kHalfSpace)
      .def_static(
          "mesh",
          [](const py::typing::Union<TriangleMesh, Hull>& mesh, std::string frame,
             OptionalName name) {
            return mesh_keepout(mesh, {frame, name});
          },
          py::arg("mesh"), py::kw_only(), frame, name, workspace_docs::kMesh);
}

KeepOut keepout_from_state(const py::tuple& s) {
  using Kind = KeepOutKind;
  const KeepOutLabel label{s[1].cast<std::string>(), s[2].cast<std::string>()};
  const auto radius = s[3].cast<double>(), length = s[4].cast<double>();
  const Pose pose = pose_argument("pose", s[6]);
  switch (static_cast<Kind>(s[0].cast<int>())) {
    case Kind::kSphere:
      return KeepOut::sphere(radius, pose.translation(), label);
    case Kind::kBox:
      return KeepOut::box(vector_argument("size", s[5]), pose, label);
    case Kind::kCylinder:
      return KeepOut::cylinder(radius, length, pose, label);
    case Kind::kCone:
      return KeepOut::cone(radius, length, pose, label);
    case Kind::kHalfSpace:
      return KeepOut::half_space(Plane(vector_argument("normal", s[7]), s[8].cast<double>()),
                                 label);
    default:
      return KeepOut::mesh(s[9].cast<Hull>(), label);
  }
}

void bind_keepout_values(py::class_<KeepOut>& keepout) {
  using Kind = KeepOutKind;
  keepout
      .def_property_readonly(
          "kind", [](const KeepOut& k) { return to_string(k.kind()); },
          "\"sphere\", \"box\", \"cylinder\", \"cone\", \"half_space\" or \"mesh\".")
      .def_property_readonly("frame", &KeepOut::frame, kKeepOutFrameDoc)
      .def_property_readonly("name", &KeepOut::name, "What reports call it.")
      .def_property_readonly(
          "radius",
          [](const KeepOut& k) {
            const bool has =
                k.kind() == Kind::kSphere || k.kind() == Kind::kCylinder || k.kind() == Kind::kCone;
            return only_if(has, k.radius());
          },
          "Of a sphere, cylinder or a cone's end [m]; None of the others.")
      .def_property_readonly(
          "length",
          [](const KeepOut& k) {
            return only_if(k.kind() == Kind::kCylinder || k.kind() == Kind::kCone, k.length());
          },
          "Of a cylinder or cone, along its z [m]; None of the others.")
      .def_property_readonly(
          "size",
          [](const KeepOut& k) { return only_if(k.kind() == Kind::kBox, to_numpy(k.size())); },
          "(3,) full lengths of a box [m]; None of the others.")
      .def_property_readonly(
          "pose",
          [](const KeepOut& k) {
            const bool has = k.kind() != Kind::kHalfSpace && k.kind() != Kind::kMesh;
            return only_if(has, to_numpy(k.pose()));
          },
          "(4, 4) frame_from_shape; None of a half-space or mesh, given in the frame itself.")
      .def_property_readonly(
          "border",
          [](const KeepOut& k) { return only_if(k.kind() == Kind::kHalfSpace, k.border()); },
          "Plane of a half-space, its normal towards the free side; None of the others.")
      .def_property_readonly(
          "motion", [](const KeepOut& k) { return k.motion(); },
          "Trajectory: how what was given in the frame is moved; at rest unless `moved`.")
      .def(
          "moved",
          [](const KeepOut& k, const PoseLike& pose) {
            return k.moved(trajectory_argument("pose", pose));
          },
          py::arg("pose"), workspace_docs::kMoved)
      .def_property_readonly(
          "hull", [](const KeepOut& k) { return k.hull(); }, "Hull of a mesh; None of the others.")
      .def("__repr__",
           [](const KeepOut& k) {
             return "KeepOut." + to_string(k.kind()) + "(frame=\"" + k.frame() + "\", name=\"" +
                    k.name() + "\")";
           })
      .def(py::pickle(
          [](const KeepOut& k) {
            return py::make_tuple(static_cast<int>(k.kind()), k.frame(), k.name(), k.radius(),
                                  k.length(), to_numpy(k.size()), to_numpy(k.pose()),
                                  to_numpy(k.border().normal()), k.border().offset(), k.hull(),
                                  k.motion());
          },
          [](const py::tuple& s) {
            return keepout_from_state(s).moved(s[10].cast<Trajectory>());
          }));
}

void bind_keepout_queries(py::class_<KeepOut>& keepout) {
  keepout
      .def(
          "contains",
          [](const KeepOut& self, const ArrayLike& points, int num_threads) {
            const Points queries = points_argument("points", points);
            return filled_flags(static_cast<std::size_t>(queries.rows()), [&](auto inside) {
              self.contains(queries.view(), inside, num_threads);
            });
          },
          py::arg("points"), py::kw_only(), py::arg("num_threads") = 0,
          workspace_docs::kKeepOutContains)
      .def(
          "distance",
          [](const KeepOut& self, const ArrayLike& points, int num_threads) {
            const Points queries = points_argument("points", points);
            return unlocked_values([&] { return self.distance(queries.view(), num_threads); });
          },
          py::arg("points"), py::kw_only(), py::arg("num_threads") = 0,
          workspace_docs::kKeepOutDistance)
      .def(
          "capsule_distance",
          [](const KeepOut& self, const ArrayLike& a, const ArrayLike& b, const ArrayLike& radius,
             int num_threads) {
            const Points from = points_argument("a", a), to = points_argument("b", b);
            const std::vector<double> radii = capsule_radii(radius, from.rows());
            return unlocked_values(
                [&] { return self.capsule_distance(from.view(), to.view(), radii, num_threads); });
          },
          py::arg("a"), py::arg("b"), py::arg("radius"), py::kw_only(), py::arg("num_threads") = 0,
          workspace_docs::kCapsuleDistance);
}

}  // namespace

void bind_keepout(py::module_& module) {
  py::class_<KeepOut> keepout(module, "KeepOut", workspace_docs::kKeepOut);
  bind_keepout_makers(keepout);
  bind_keepout_values(keepout);
  bind_keepout_queries(keepout);
}

}  // namespace bathyal::python
