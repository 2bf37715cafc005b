// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bathyal/terrain/delaunay.hpp"
#include "bindings.hpp"

namespace bathyal::python {
namespace {

void bind_delaunay(py::module_& module) {
  module.def(
      "triangulate_delaunay",
      [](const py::object& points, std::optional<double> max_edge, int num_threads) {
        const Points array = points_argument("points", points);
        Delaunay result;
        {
          const py::gil_scoped_release release;
          result = delaunay(array.view(), {.max_edge = max_edge, .num_threads = num_threads});
        }
        py::dict report;
        report["max_edge"] = result.max_edge;
        report["cut_triangles"] = result.cut_triangles;
        report["merged_points"] = result.merged_points;
        return py::make_tuple(to_numpy(result.triangles), report);
      },
      py::arg("points"), py::kw_only(), py::arg("max_edge") = DelaunayOptions{}.max_edge,
      py::arg("num_threads") = DelaunayOptions{}.num_threads,
      "(T, 3) int32 rows of `points`, and a dict: max_edge [m], cut_triangles, merged_points.");
}

}  // namespace

void bind_terrain(py::module_& module) { bind_delaunay(module); }

}  // namespace bathyal::python
