// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/geometry/mesh_report.hpp"

#include "arrays.hpp"
#include "bindings.hpp"

namespace bathyal::python {
namespace {

/// Every public attribute by name, for tables and JSON.
py::dict as_dict(const py::object& report) {
  py::dict result;
  for (const py::handle name : py::type::of(report).attr("__dict__")) {
    const std::string text = py::str(name);
    if (text.front() != '_' && text != "as_dict") result[name] = report.attr(name);
  }
  return result;
}

}  // namespace

void bind_mesh_report(py::module_& module) {
  using Report = MeshReport;
  py::class_<Report>(module, "MeshReport", R"(What a person asks of a mesh before trusting it.

Made by `mesh_report`. Lengths in metres, angles in radians; ``print`` it to read it.
)")
      .def_readonly("vertex_count", &Report::vertex_count, "Vertices, used or not.")
      .def_readonly("unused_vertices", &Report::unused_vertices, "Vertices of no triangle.")
      .def_readonly("triangle_count", &Report::triangle_count, "Triangles of the mesh.")
      .def_property_readonly(
          "low", [](const Report& r) { return to_numpy(r.low); },
          "(3,) least corner of the bounding box of the vertices in use [m].")
      .def_property_readonly(
          "high", [](const Report& r) { return to_numpy(r.high); },
          "(3,) greatest corner of the bounding box [m].")
      .def_readonly("area", &Report::area, "Area of the surface [m²].")
      .def_readonly("planar_area", &Report::planar_area,
                    "Area of the shadow on the horizontal plane, every place once [m²].")
      .def_readonly("rugosity", &Report::rugosity, "area / planar_area; NaN without a shadow.")
      .def_readonly("components", &Report::components, "Pieces joined by edges.")
      .def_property_readonly(
          "boundary_loops", [](const Report& r) { return to_numpy(r.boundary_loops); },
          "Lengths of the rims, longest first [m].")
      .def_readonly("boundary_edges", &Report::boundary_edges, "Edges of one triangle only.")
      .def_readonly("nonmanifold_edges", &Report::nonmanifold_edges,
                    "Edges of three triangles or more.")
      .def_readonly("nonmanifold_vertices", &Report::nonmanifold_vertices,
                    "Vertices where fans of triangles touch by the vertex alone.")
      .def_readonly("inconsistent_edges", &Report::inconsistent_edges,
                    "Edges along which their two triangles run the same way.")
      .def_readonly("zero_area_triangles", &Report::zero_area_triangles,
                    "Triangles whose area is 0.")
      .def_readonly("duplicate_triangles", &Report::duplicate_triangles,
                    "Triangles on the same three vertices as an earlier one.")
      .def_readonly("closed", &Report::closed,
                    "Whether every edge has two triangles, turned consistently.")
      .def_readonly("volume", &Report::volume,
                    "Volume inside [m³], negative when turned inside out; NaN unless closed.")
      .def_readonly("inverted_triangles", &Report::inverted_triangles, "Triangles facing down.")
      .def_readonly("area_share_inverted", &Report::area_share_inverted,
                    "Part of the area that faces down.")
      .def_readonly("slope_mean", &Report::slope_mean,
                    "Area-weighted mean angle between normal and up, 0 to π [rad].")
      .def_readonly("slope_median", &Report::slope_median, "Area-weighted median [rad].")
      .def_readonly("slope_p95", &Report::slope_p95, "95 % of the area is less steep [rad].")
      .def_readonly("slope_max", &Report::slope_max, "[rad]")
      .def("as_dict", &as_dict, "All of it, by name.")
      .def("__str__", [](const Report& r) { return describe(r); })
      .def("__repr__", [](const Report& r) { return describe(r); });

  module.def(
      "mesh_report",
      [](const TriangleMesh& mesh, int num_threads) {
        const py::gil_scoped_release release;
        return mesh_report(mesh.snapshot(), num_threads);
      },
      py::arg("mesh"), py::kw_only(), py::arg("num_threads") = 0,
      R"(Measure a mesh: area, rims, pieces, defects, slopes, rugosity.

The planar area is that of the mesh's shadow on the horizontal plane, every place counted once:
exact where no two triangles lie over one another, else to a few parts in 10⁴. Published
rugosities divide by other planar areas: compare with care.

Parameters
----------
mesh : TriangleMesh
num_threads : int
    0 = all. The same numbers for any.

Returns
-------
MeshReport
    Zeros for an empty mesh, NaN where there is nothing to divide.

Examples
--------
>>> import bathyal
>>> ramp = bathyal.TriangleMesh([[0, 0, 0], [1, 0, 1], [0, 1, 0]], [[0, 1, 2]])
>>> report = bathyal.mesh_report(ramp)
>>> round(report.rugosity, 6), report.inverted_triangles, len(report.boundary_loops)
(1.414214, 0, 1)
)");
}

}  // namespace bathyal::python
