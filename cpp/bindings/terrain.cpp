// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/terrain/delaunay.hpp"
#include "bathyal/terrain/fit_plane.hpp"
#include "bathyal/terrain/sheets.hpp"
#include "bathyal/terrain/triangulate.hpp"
#include "bindings.hpp"

namespace bathyal::python {
namespace {

void bind_plane_fit(py::module_& module) {
  using Options = FitPlaneOptions;
  py::class_<PlaneFit>(module, "PlaneFit", R"(The plane of a bottom and how far to trust it.

Made by `fit_plane`. Unpacks as ``plane, rms = fit``.
)")
      .def_readonly("plane", &PlaneFit::plane, "Plane, its unit normal up.")
      .def_property_readonly(
          "normal", [](const PlaneFit& f) { return to_numpy(f.plane.normal()); },
          "(3,) unit normal m of eq 1, up.")
      .def_property_readonly(
          "offset", [](const PlaneFit& f) { return f.plane.offset(); }, "d of eq 1 [m].")
      .def_readonly("rms", &PlaneFit::rms, "Of the inliers, along the normal [m].")
      .def_property_readonly(
          "inliers",
          [](const PlaneFit& f) {
            return to_numpy(f.inliers).attr("view")("bool").cast<py::array>();
          },
          "(N,) bool: the points that the plane rests on.")
      .def_readonly("inlier_count", &PlaneFit::inlier_count, "Number of `inliers`.")
      .def_readonly("tilt_std", &PlaneFit::tilt_std,
                    "Standard deviation of the normal's direction, its worst way [rad].")
      .def_readonly("flat", &PlaneFit::flat, "Whether the plane may represent the bottom.")
      .def_readonly("flat_share", &PlaneFit::flat_share,
                    "Share of the patches that lie within the tolerance.")
      .def_readonly("relief", &PlaneFit::relief, "Largest distance of a patch from the plane [m].")
      .def("__iter__",
           [](const py::object& self) {
             return py::iter(py::make_tuple(self.attr("plane"), self.attr("rms")));
           })
      .def("__repr__", [](const PlaneFit& f) {
        return "PlaneFit(normal=(" + to_text(f.plane.normal().x()) + ", " +
               to_text(f.plane.normal().y()) + ", " + to_text(f.plane.normal().z()) +
               "), offset=" + to_text(f.plane.offset()) + ", rms=" + to_text(f.rms) + ", " +
               std::to_string(f.inlier_count) + " of " + std::to_string(f.inliers.size()) +
               " points, " + (f.flat ? "flat)" : "not flat)");
      });

  module.def(
      "fit_plane",
      [](const CloudLike& cloud, double tolerance, int patch_points, double flat_share, int trials,
         std::uint64_t seed, int num_threads) {
        const PointCloud input = cloud_argument(cloud);
        const py::gil_scoped_release release;
        check_clean("cloud", input.points());
        return fit_plane(input.points(), {.tolerance = tolerance,
                                          .patch_points = patch_points,
                                          .flat_share = flat_share,
                                          .trials = trials,
                                          .seed = seed,
                                          .num_threads = num_threads});
      },
      py::arg("cloud"), py::kw_only(), py::arg("tolerance") = Options{}.tolerance,
      py::arg("patch_points") = Options{}.patch_points,
      py::arg("flat_share") = Options{}.flat_share, py::arg("trials") = Options{}.trials,
      py::arg("seed") = Options{}.seed, py::arg("num_threads") = Options{}.num_threads,
      R"(Fit a plane to a bottom, undisturbed by gross errors in up to 45 % of the points.

Least median of squares over random triples, then total least squares over the points within three
sigma (Filaretov, Konoplin, Konoplin 2018, eq 1; Rousseeuw 1984). A vertical plane has no up: the
first component of its normal that is not zero is positive.

Parameters
----------
cloud : PointCloud or (N, 3) array
    [m]
tolerance : float
    How far the ground may lie off the plane and still count as flat [m].
patch_points : int
    Soundings in a patch; the median of a patch is the ground's height there, so that neither noise
    nor single spikes count as relief.
flat_share : float
    Share of the patches that must lie within `tolerance`.
trials, seed : int
    Random triples tried (10⁶ at most), and the seed of their choice.
num_threads : int
    0 = all. The same result for any.

Returns
-------
PlaneFit
    ``.plane .normal .offset .rms .inliers .flat .relief …``; unpacks as ``plane, rms``.

Raises
------
ValueError
    For fewer than three distinct points, points on one line, or coordinates that are not finite.

Examples
--------
>>> import bathyal
>>> fit = bathyal.fit_plane([[0, 0, -5], [1, 0, -5], [0, 1, -5], [1, 1, -5]])
>>> fit.plane
Plane(normal=(0, 0, 1), offset=-5)
>>> fit.flat
True
)");
}

void bind_sheets(py::module_& module) {
  using Options = FindSheetsOptions;
  py::class_<SheetPatch>(module, "SheetPatch", "One place where a cloud has several sheets.")
      .def_property_readonly(
          "low", [](const SheetPatch& p) { return to_numpy(p.low); },
          "(3,) least corner of its bounding box [m].")
      .def_property_readonly(
          "high", [](const SheetPatch& p) { return to_numpy(p.high); }, "(3,) greatest corner [m].")
      .def_readonly("area", &SheetPatch::area, "In plan, to the size of a cell [m²].")
      .def_readonly("separation", &SheetPatch::separation,
                    "Median vertical distance of its sheets [m].")
      .def_readonly("point_count", &SheetPatch::point_count, "Soundings on its sheets.")
      .def("__repr__", [](const SheetPatch& p) {
        return "SheetPatch(area=" + to_text(p.area) + ", separation=" + to_text(p.separation) + ")";
      });

  py::class_<SheetReport>(module, "SheetReport",
                          R"(Where a cloud has several sheets over one (x, y).

Made by `find_sheets`. True where there are any; ``str`` says where and how much.
)")
      .def_readonly("patches", &SheetReport::patches, "SheetPatch, the largest area first.")
      .def_property_readonly(
          "cells", [](const SheetReport& r) { return to_numpy(Points(r.cells)); },
          "(K, 3) cells of the patches: centre x, y and the height between the sheets [m].")
      .def_property_readonly(
          "separation", [](const SheetReport& r) { return to_numpy(r.separation); },
          "(K,) vertical distance of the two sheets there [m].")
      .def_readonly("cell_size", &SheetReport::cell_size, "Side of a cell [m].")
      .def_readonly("covered_area", &SheetReport::covered_area,
                    "Of all cells that hold a sounding [m²].")
      .def_readonly("sheet_area", &SheetReport::sheet_area, "Of `cells` [m²].")
      .def_property_readonly("share", &SheetReport::share, "sheet_area / covered_area.")
      .def_readonly("spacing", &SheetReport::spacing, "√(covered area / soundings) [m].")
      .def_readonly("noise", &SheetReport::noise,
                    "Median rms of soundings about the planes they lie on [m].")
      .def_readonly("min_separation", &SheetReport::min_separation,
                    "Vertical distance from which two sheets count [m], as given or chosen.")
      .def_property_readonly("single_valued", &SheetReport::single_valued,
                             "Whether the cloud is a height field.")
      .def("__bool__", [](const SheetReport& r) { return !r.single_valued(); })
      .def("__str__", [](const SheetReport& r) { return describe(r); })
      .def("__repr__", [](const SheetReport& r) {
        return "SheetReport(" + std::to_string(r.patches.size()) +
               " patches, share=" + to_text(r.share()) + ")";
      });

  module.def(
      "find_sheets",
      [](const CloudLike& cloud, double min_separation, int min_points, int num_threads) {
        const PointCloud input = cloud_argument(cloud);
        const py::gil_scoped_release release;
        check_clean("cloud", input.points());
        return find_sheets(input.points(), {.min_separation = min_separation,
                                            .min_points = min_points,
                                            .num_threads = num_threads});
      },
      py::arg("cloud"), py::kw_only(), py::arg("min_separation") = Options{}.min_separation,
      py::arg("min_points") = Options{}.min_points, py::arg("num_threads") = Options{}.num_threads,
      R"(Find where a cloud is not a height field: overhangs, arches, undersides.

Survey passes that disagree in height by clearly more than their noise are found as well. Steep
and stepped ground, noise and spikes are not: a place counts when its soundings lie on two planes,
well apart for their scatter, and the two groups are interleaved in plan.

Parameters
----------
cloud : PointCloud or (N, 3) array
    [m], z up.
min_separation : float
    Vertical distance from which two sheets count [m]; 0 takes the larger of 6 × noise and
    1 × spacing, both measured from the cloud.
min_points : int
    Soundings that a place needs on each of its sheets.
num_threads : int
    0 = all. The same report for any.

Returns
-------
SheetReport

Examples
--------
>>> import bathyal, numpy as np
>>> x, y = np.mgrid[0:20, 0:20] * 0.1
>>> ground = np.c_[x.ravel(), y.ravel(), np.zeros(400)]
>>> bool(bathyal.find_sheets(ground))
False
>>> roof = ground[ground[:, 0] < 1] + [0.05, 0.05, 0.8]
>>> report = bathyal.find_sheets(np.r_[ground, roof])
>>> len(report.patches), round(report.patches[0].separation, 3)
(1, 0.8)
)");
}

void bind_triangulate(py::module_& module) {
  module.def(
      "triangulate",
      [](const CloudLike& cloud, std::optional<double> max_edge, int num_threads) {
        const PointCloud input = shared_cloud_argument(cloud);  // the mesh keeps the points
        Triangulation result;
        {
          const py::gil_scoped_release release;
          result = triangulate(input, {.max_edge = max_edge, .num_threads = num_threads});
        }
        return py::make_tuple(result.mesh, result.sheets);
      },
      py::arg("cloud"), py::kw_only(), py::arg("max_edge") = DelaunayOptions{}.max_edge,
      py::arg("num_threads") = DelaunayOptions{}.num_threads,
      "The TriangleMesh of a cloud as a height field, and its SheetReport.");
}

void bind_delaunay(py::module_& module) {
  module.def(
      "triangulate_delaunay",
      [](const ArrayLike& points, std::optional<double> max_edge, int num_threads) {
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

void bind_terrain(py::module_& module) {
  bind_plane_fit(module);
  bind_sheets(module);
  bind_delaunay(module);
  bind_triangulate(module);
}

}  // namespace bathyal::python
