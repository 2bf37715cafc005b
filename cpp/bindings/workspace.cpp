// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "bathyal/base/check.hpp"
#include "bathyal/workspace/hull.hpp"
#include "bathyal/workspace/keepout.hpp"
#include "bindings.hpp"
#include "trajectory.hpp"
#include "workspace_class.hpp"
#include "workspace_docs.hpp"

namespace bathyal::python {
namespace {

using workspace_docs::kKeepOutFrameDoc;

/// (N,) from a function that fills N values and wants no lock.
template <class Fill>
py::array filled_flags(std::size_t count, const Fill& fill) {
  std::shared_ptr<bool[]> flags(new bool[count]);
  {
    const py::gil_scoped_release release;
    fill(std::span<bool>(flags.get(), count));
  }
  return read_only_array(flags.get(), {static_cast<py::ssize_t>(count)}, flags);
}

template <class Work>
py::array unlocked_values(const Work& work) {
  std::vector<double> values;
  {
    const py::gil_scoped_release release;
    values = work();
  }
  return to_numpy(std::move(values));
}

template <class Value>
std::optional<Value> only_if(bool has, Value value) {
  return has ? std::optional<Value>(std::move(value)) : std::nullopt;
}

Hull make_hull(const TriangleMesh& mesh, int num_threads) {
  const py::gil_scoped_release release;
  return Hull(mesh.snapshot(), num_threads);
}

void bind_hull_report(py::module_& module) {
  using Report = HullReport;
  py::class_<Report>(module, "HullReport", workspace_docs::kHullReport)
      .def_readonly("triangle_count", &Report::triangle_count, "Triangles of the mesh.")
      .def_property_readonly(
          "low", [](const Report& r) { return to_numpy(r.low); },
          "(3,) least corner of the bounding box [m].")
      .def_property_readonly(
          "high", [](const Report& r) { return to_numpy(r.high); },
          "(3,) greatest corner of the bounding box [m].")
      .def_readonly("area", &Report::area, "Area of the surface [m²].")
      .def_readonly("closed", &Report::closed,
                    "Whether along every edge as many triangles run one way as the other.")
      .def_readonly("inside_out", &Report::inside_out,
                    "Whether the normals point inwards, all in all; inside is the same.")
      .def_readonly("volume", &Report::volume,
                    "Inside a closed surface, overlaps counted twice [m³]; NaN of an open one.")
      .def_readonly("open_edges", &Report::open_edges,
                    "Edges along which the triangles do not cancel.")
      .def_readonly("boundary_edges", &Report::boundary_edges, "Edges of one triangle only.")
      .def_readonly("nonmanifold_edges", &Report::nonmanifold_edges,
                    "Edges of three triangles or more.")
      .def_readonly("inconsistent_edges", &Report::inconsistent_edges,
                    "Edges whose two triangles run the same way along it.")
      .def_readonly("degenerate_triangles", &Report::degenerate_triangles,
                    "Triangles lower than 1e-12 of their longest edge.")
      .def_readonly("parts", &Report::parts, "Pieces joined by edges.")
      .def_readonly("opposed_parts", &Report::opposed_parts,
                    "Pieces of a closed surface wound against the whole: cavities, or mistakes.")
      .def_readonly("overlapping_parts", &Report::overlapping_parts,
                    "Pairs of pieces whose surfaces cross.")
      .def_readonly("intersecting_pairs", &Report::intersecting_pairs,
                    "Pairs of triangles that meet other than by a corner or an edge that they "
                    "share, decided exactly.")
      .def_readonly("warnings", &Report::warnings,
                    "A short sentence for each thing that is wrong; empty for a sound hull.")
      .def("__str__", [](const Report& r) { return describe(r); })
      .def("__repr__", [](const Report& r) { return describe(r); });
}

void bind_voxels(py::module_& module) {
  py::class_<Voxels>(module, "Voxels",
                     "A box of cubes and which of their middles lie inside a hull.\n\n"
                     "Voxel (i, j, k) begins at ``origin + size * (i, j, k)``.\n")
      .def_property_readonly(
          "origin", [](const Voxels& v) { return to_numpy(v.origin); },
          "(3,) corner of the first voxel, in the hull's frame [m].")
      .def_readonly("size", &Voxels::size, "Edge of a voxel [m].")
      .def_property_readonly(
          "inside",
          [](const Voxels& v) {
            return read_only_array(v.inside.get(), {v.count[0], v.count[1], v.count[2]}, v.inside);
          },
          "(nx, ny, nz) bool: whether the voxel's middle lies inside.")
      .def("__repr__", [](const Voxels& v) {
        return "Voxels(" + std::to_string(v.count[0]) + " x " + std::to_string(v.count[1]) + " x " +
               std::to_string(v.count[2]) + ", size=" + to_text(v.size) + ")";
      });
}

void bind_hull(py::module_& module) {
  py::class_<Hull>(module, "Hull", workspace_docs::kHull)
      .def(py::init(&make_hull), py::arg("mesh"), py::kw_only(), py::arg("num_threads") = 0)
      .def_property_readonly("mesh", &Hull::mesh, "The mesh, in the vehicle's frame.")
      .def_property_readonly(
          "report",
          [](const Hull& hull) {
            const py::gil_scoped_release release;
            return hull.report();
          },
          "HullReport: what is wrong with the mesh. Made when first asked for.")
      .def(
          "contains",
          [](const Hull& hull, const ArrayLike& points, int num_threads) {
            const Points queries = points_argument("points", points);
            return filled_flags(static_cast<std::size_t>(queries.rows()), [&](auto inside) {
              hull.contains(queries.view(), inside, num_threads);
            });
          },
          py::arg("points"), py::kw_only(), py::arg("num_threads") = 0,
          workspace_docs::kHullContains)
      .def(
          "signed_distance",
          [](const Hull& hull, const ArrayLike& points, int num_threads) {
            const Points queries = points_argument("points", points);
            return unlocked_values(
                [&] { return hull.signed_distance(queries.view(), num_threads); });
          },
          py::arg("points"), py::kw_only(), py::arg("num_threads") = 0,
          workspace_docs::kHullSignedDistance)
      .def(
          "voxels",
          [](const Hull& hull, double size, int num_threads) {
            const py::gil_scoped_release release;
            return hull.voxels(size, num_threads);
          },
          py::arg("size"), py::kw_only(), py::arg("num_threads") = 0, workspace_docs::kHullVoxels)
      .def("__repr__",
           [](const Hull& hull) {
             const Index count = hull.mesh().triangle_count();
             return "Hull(" + std::to_string(count) +
                    (hull.closed() ? " triangles, closed)" : " triangles, open)");
           })
      .def(py::pickle(
          [](const Hull& hull) {
            return py::make_tuple(to_numpy(hull.mesh().shared_vertices()),
                                  to_numpy(hull.mesh().shared_triangles()));
          },
          [](const py::tuple& state) {
            return make_hull(TriangleMesh(points_argument("vertices", state[0]),
                                          triangles_argument("triangles", state[1])),
                             0);
          }));
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

void bind_workspace(py::module_& module) {
  bind_hull_report(module);
  bind_voxels(module);
  bind_hull(module);
  py::class_<KeepOut> keepout(module, "KeepOut", workspace_docs::kKeepOut);
  bind_keepout_makers(keepout);
  bind_keepout_values(keepout);
  bind_keepout_queries(keepout);
  bind_workspace_class(module);
}

}  // namespace bathyal::python
