// SPDX-License-Identifier: BSD-3-Clause
#include "rays.hpp"

#include <algorithm>
#include <memory>
#include <string>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/scene/moller_trumbore.hpp"
#include "bindings.hpp"

namespace bathyal::python {
namespace {

/// (N, 3), or (3,) as the one row that serves all; read in place.
Points rows_argument(std::string_view name, const py::object& object) {
  const py::array array = array_argument(name, object, "real numbers of shape (N, 3)");
  if (array.ndim() == 1) return shared_points_argument(name, array.attr("reshape")(1, -1));
  return shared_points_argument(name, array);
}

Hits cast_rays(const Scene& scene, const ArrayLike& origins, const ArrayLike& directions,
               int num_threads) {
  const Points from = rows_argument("origins", origins);
  const Points along = rows_argument("directions", directions);
  auto hits = std::make_shared<HitArray>(static_cast<std::size_t>(along.rows()));
  {
    const py::gil_scoped_release release;
    scene.cast(from.view(), along.view(), {hits->data(), hits->size()}, num_threads);
  }
  return {std::move(hits), scene};
}

Hits cast_brute_force(const TriangleMesh& given, const ArrayLike& origins,
                      const ArrayLike& directions, int num_threads) {
  const TriangleMesh mesh = given.snapshot();
  const Points from = rows_argument("origins", origins);
  const Points along = rows_argument("directions", directions);
  auto hits = std::make_shared<HitArray>(static_cast<std::size_t>(along.rows()));
  {
    const py::gil_scoped_release release;
    const std::vector<RayHit> found =
        intersect_moller_trumbore(mesh, from.view(), along.view(), num_threads);
    std::copy(found.begin(), found.end(), hits->data());
  }
  return {std::move(hits), mesh};
}

py::array find_occluded(const Scene& scene, const ArrayLike& from, const ArrayLike& to,
                        int num_threads) {
  const Points starts = rows_argument("from", from);
  const Points ends = rows_argument("to", to);
  std::vector<bool> blocked;
  {
    const py::gil_scoped_release release;
    blocked = scene.occluded(starts.view(), ends.view(), num_threads);
  }
  py::array_t<bool> result(static_cast<py::ssize_t>(blocked.size()));
  std::copy(blocked.begin(), blocked.end(), result.mutable_data());
  result.attr("setflags")(py::arg("write") = false);
  return result;
}

}  // namespace

void bind_hits(py::module_& module) {
  py::class_<Hits>(module, "Hits", R"(What each of N rays met first.

All arrays are read-only. ``range``, ``mesh`` and ``triangle`` are there when the cast returns (as
columns of one array, so with a stride); ``point``, ``normal`` and ``barycentric`` are computed at
the first access, and kept.
)")
      .def_property_readonly(
          "range", [](const Hits& h) { return h.column(&RayHit::range); },
          "(N,) distance along the ray [m], inf where it met nothing.")
      .def_property_readonly(
          "mesh", [](const Hits& h) { return h.column(&RayHit::mesh); },
          "(N,) number of the mesh in the scene, −1 where the ray met nothing.")
      .def_property_readonly(
          "triangle", [](const Hits& h) { return h.column(&RayHit::triangle); },
          "(N,) triangle of that mesh, −1 where the ray met nothing.")
      .def_property_readonly("point", &Hits::point,
                             "(N, 3) where it met it [m], NaN where it met nothing.")
      .def_property_readonly("normal", &Hits::normal,
                             "(N, 3) unit normal of the triangle as it is wound, NaN where the ray "
                             "met nothing.")
      .def_property_readonly(
          "barycentric", &Hits::barycentric,
          "(N, 3) weights (u, v, w) of corners 1, 2 and 0, as eq 4; NaN where there is none.")
      .def("__len__", &Hits::size)
      .def("__repr__", [](const Hits& hits) {
        const auto met = std::count_if(hits.begin(), hits.end(),
                                       [](const RayHit& hit) { return hit.triangle >= 0; });
        return "Hits(" + std::to_string(met) + " of " + std::to_string(hits.size()) +
               (hits.size() == 1 ? " ray)" : " rays)");
      });

  module.def("intersect_moller_trumbore", &cast_brute_force, py::arg("mesh"), py::arg("origins"),
             py::arg("directions"), py::kw_only(), py::arg("num_threads") = 0,
             R"(Every ray against every triangle, as the paper does it.

Filaretov, Konoplin, Konoplin (2018), eq 5–9, after Möller and Trumbore (1997), with what the
printed form leaves out: t ≥ 0 and the nearest hit. For study and comparison: it costs rays ×
triangles, and unlike Scene.cast it may let a ray slip between triangles that share an edge.

Parameters
----------
mesh : TriangleMesh
origins, directions
    As in Scene.cast.
num_threads : int
    0 means all.

Returns
-------
Hits

Examples
--------
>>> import bathyal
>>> floor = bathyal.TriangleMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
>>> bathyal.intersect_moller_trumbore(floor, (1, 1, 3), [[0, 0, -1], [0, 0, 1]]).range
array([ 3., inf])
)");
}

void bind_rays(py::class_<Scene>& scene) {
  scene
      .def("cast", &cast_rays, py::arg("origins"), py::arg("directions"), py::kw_only(),
           py::arg("num_threads") = 0, R"(The first triangle that each ray meets, from either side.

Decided in double on the mesh's own vertices, with exact signs, so that a ray through an edge or a
vertex of a closed mesh never slips through (Woop, Benthin, Wald 2013, Watertight ray/triangle
intersection). Equal ranges give the lowest (mesh, triangle). A ray that runs in the plane of a
triangle does not meet that one, but meets its neighbours' borders.

Parameters
----------
origins : (N, 3), (1, 3) or (3,) array
    [m], finite. One origin serves all directions.
directions : (N, 3) or (3,) array
    Any length but zero.
num_threads : int
    0 means all. The result is the same bytes for any number.

Returns
-------
Hits
    ``.range`` (N,) [m], ``.mesh`` and ``.triangle`` (N,), ``.point``, ``.normal`` and
    ``.barycentric`` (N, 3). A ray that meets nothing gives inf, −1 and NaN.

Raises
------
ValueError
    For a direction of zero or a value that is not finite: names the first row at fault.

Examples
--------
>>> import bathyal
>>> floor = bathyal.TriangleMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
>>> hits = bathyal.Scene(floor).cast((1, 1, 3), [[0, 0, -2], [0, 0, 1]])
>>> hits.range, hits.triangle.tolist()
(array([ 3., inf]), [0, -1])
)")
      .def("occluded", &find_occluded, py::arg("from_"), py::arg("to"), py::kw_only(),
           py::arg("num_threads") = 0,
           R"(Whether anything lies on each straight segment, its ends included.

Decided as by cast. A segment of no length meets nothing.

Parameters
----------
from_ : (N, 3), (1, 3) or (3,) array
    [m], finite. One start serves all ends.
to : (N, 3) or (3,) array
    [m], finite.
num_threads : int
    0 means all.

Returns
-------
(N,) array of bool

Examples
--------
>>> import bathyal
>>> floor = bathyal.TriangleMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
>>> bathyal.Scene(floor).occluded((1, 1, 3), [[1, 1, -1], [1, 1, 1]]).tolist()
[True, False]
)");
}

}  // namespace bathyal::python
