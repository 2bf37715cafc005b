// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <map>
#include <string>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/geometry/plane.hpp"
#include "bathyal/geometry/triangle_mesh.hpp"
#include "bindings.hpp"

namespace bathyal::python {
namespace {

using PythonAttributes = std::map<std::string, ArrayLike>;

Attributes attributes_argument(const PythonAttributes& attributes) {
  Attributes result;
  for (const auto& [name, values] : attributes) {
    result.emplace(name, shared_values_argument("attributes[\"" + name + "\"]", values));
  }
  return result;
}

py::dict to_python(const Attributes& attributes) {
  py::dict result;
  for (const auto& [name, values] : attributes) result[py::str(name)] = to_numpy(values);
  return result;
}

std::string count_text(Index count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

void bind_plane(py::module_& module) {
  py::class_<Plane>(module, "Plane", R"(normal · x = offset.

Filaretov, Konoplin, Konoplin (2018), eq 1: the unit normal m and the distance d.

Parameters
----------
normal : (3,) array
    Any length but zero; scaled to unit length, `offset` with it.
offset : float
    [m]

Examples
--------
>>> import bathyal
>>> bathyal.Plane((0, 0, 2), -10.0).offset
-5.0
)")
      .def(py::init([](const ArrayLike& normal, double offset) {
             return Plane(vector_argument("normal", normal), offset);
           }),
           py::arg("normal"), py::arg("offset"))
      .def_property_readonly(
          "normal",
          [](const Plane& p) {
            return to_numpy(std::vector<double>(p.normal().begin(), p.normal().end()));
          },
          "(3,) unit normal, up for a bottom.")
      .def_property_readonly("offset", &Plane::offset,
                             "normal · x of every point of the plane [m].")
      .def(
          "distance",
          [](const Plane& plane, const ArrayLike& points) {
            const Points array = points_argument("points", points);
            const PointView view = array.view();
            std::vector<double> distance(static_cast<std::size_t>(view.rows()));
            for (Index i = 0; i < view.rows(); ++i) {
              distance[static_cast<std::size_t>(i)] = plane.distance(view.row(i).transpose());
            }
            return to_numpy(std::move(distance));
          },
          py::arg("points"), "Signed distances (N,) [m] of points (N, 3), positive above.")
      .def("__repr__", [](const Plane& p) {
        return "Plane(normal=(" + to_text(p.normal().x()) + ", " + to_text(p.normal().y()) + ", " +
               to_text(p.normal().z()) + "), offset=" + to_text(p.offset()) + ")";
      });
}

void bind_point_cloud(py::module_& module) {
  py::class_<PointCloud>(module, "PointCloud",
                         R"(Positions in metres, z up, and what rides along with them.

Survey coordinates (10⁵ to 10⁷ m) are kept as they are. Read-only once made.

Parameters
----------
points : (N, 3) array
    [m]. Shared, not copied, where it is float64 in C order: do not write to it afterwards. A
    function that is given the cloud works on a copy of what the array holds when it is called.
attributes : dict of (N,) arrays, optional
    For instance ``uncertainty`` [m], ``intensity``, ``red``, ``green``, ``blue``.
crs, vertical_datum : str, optional
    Coordinate reference system ("EPSG:…" or WKT) and vertical datum; empty when unknown.

Examples
--------
>>> import bathyal
>>> cloud = bathyal.PointCloud([[0, 0, -5], [1, 0, -5.1]], crs="EPSG:32602")
>>> len(cloud), cloud.crs
(2, 'EPSG:32602')
)")
      .def(py::init([](const ArrayLike& points, const PythonAttributes& attributes, std::string crs,
                       std::string vertical_datum) {
             return PointCloud(shared_points_argument("points", points),
                               attributes_argument(attributes),
                               {std::move(crs), std::move(vertical_datum)});
           }),
           py::arg("points"), py::kw_only(), py::arg("attributes") = PythonAttributes{},
           py::arg("crs") = "", py::arg("vertical_datum") = "")
      .def_property_readonly(
          "points", [](const PointCloud& c) { return to_numpy(c.shared_points()); },
          "(N, 3) positions [m], z up.")
      .def_property_readonly(
          "attributes", [](const PointCloud& c) { return to_python(c.attributes()); },
          "What rides along: name → (N,) array.")
      .def_property_readonly(
          "crs", [](const PointCloud& c) { return c.datum().crs; },
          "Reference system of x and y, as its file gives it; empty if unknown.")
      .def_property_readonly(
          "vertical_datum", [](const PointCloud& c) { return c.datum().vertical; },
          "What z is measured from; empty if unknown.")
      .def("__len__", &PointCloud::size)
      .def("__repr__",
           [](const PointCloud& c) { return "PointCloud(" + count_text(c.size(), "point") + ")"; });
}

void bind_triangle_mesh(py::module_& module) {
  py::class_<TriangleMesh>(module, "TriangleMesh", R"(Vertices and the triangles over them.

Triangles run counter-clockwise seen from outside (from above, for a bottom). Vertices that no
triangle uses are allowed: a mesh made from a cloud keeps its points row for row.

Parameters
----------
vertices : (N, 3) array
    [m], finite. Shared, not copied, where it is float64 in C order: do not write to it
    afterwards. A Scene keeps a copy.
triangles : (T, 3) array of int
    Rows of `vertices`. Copied.
attributes, crs, vertical_datum
    As in PointCloud, one value a vertex.

Examples
--------
>>> import bathyal
>>> bathyal.TriangleMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
TriangleMesh(3 vertices, 1 triangle)
)")
      .def(py::init([](const ArrayLike& vertices, const ArrayLike& triangles,
                       const PythonAttributes& attributes, std::string crs,
                       std::string vertical_datum) {
             return TriangleMesh(shared_points_argument("vertices", vertices),
                                 triangles_argument("triangles", triangles),
                                 attributes_argument(attributes),
                                 {std::move(crs), std::move(vertical_datum)});
           }),
           py::arg("vertices"), py::arg("triangles"), py::kw_only(),
           py::arg("attributes") = PythonAttributes{}, py::arg("crs") = "",
           py::arg("vertical_datum") = "")
      .def_property_readonly(
          "vertices", [](const TriangleMesh& m) { return to_numpy(m.shared_vertices()); },
          "(N, 3) positions [m], z up.")
      .def_property_readonly(
          "triangles", [](const TriangleMesh& m) { return to_numpy(m.shared_triangles()); },
          "(T, 3) int32 rows of `vertices`.")
      .def_property_readonly(
          "attributes", [](const TriangleMesh& m) { return to_python(m.attributes()); },
          "What rides along: name → (N,) array.")
      .def_property_readonly(
          "crs", [](const TriangleMesh& m) { return m.datum().crs; },
          "Reference system of x and y, as its file gives it; empty if unknown.")
      .def_property_readonly(
          "vertical_datum", [](const TriangleMesh& m) { return m.datum().vertical; },
          "What z is measured from; empty if unknown.")
      .def("__repr__",
           [](const TriangleMesh& m) {
             return "TriangleMesh(" + std::to_string(m.vertex_count()) +
                    (m.vertex_count() == 1 ? " vertex, " : " vertices, ") +
                    count_text(m.triangle_count(), "triangle") + ")";
           })
      .def(py::pickle(
          [](const TriangleMesh& m) {
            return py::make_tuple(to_numpy(m.shared_vertices()), to_numpy(m.shared_triangles()),
                                  to_python(m.attributes()), m.datum().crs, m.datum().vertical);
          },
          [](const py::tuple& state) {
            return TriangleMesh(shared_points_argument("vertices", state[0]),
                                triangles_argument("triangles", state[1]),
                                attributes_argument(state[2].cast<PythonAttributes>()),
                                {state[3].cast<std::string>(), state[4].cast<std::string>()});
          }));
}

}  // namespace

void bind_geometry(py::module_& module) {
  bind_plane(module);
  bind_point_cloud(module);
  bind_triangle_mesh(module);
}

}  // namespace bathyal::python
