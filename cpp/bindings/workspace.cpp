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
#include "bindings.hpp"
#include "workspace_class.hpp"
#include "workspace_docs.hpp"
#include "workspace_volumes.hpp"

namespace bathyal::python {
namespace {

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

}  // namespace

void bind_workspace(py::module_& module) {
  bind_hull_report(module);
  bind_voxels(module);
  bind_hull(module);
  bind_keepout(module);
  bind_workspace_class(module);
}

}  // namespace bathyal::python
