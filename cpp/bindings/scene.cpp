// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/scene.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "bindings.hpp"
#include "rays.hpp"

namespace bathyal::python {
namespace {

/// What the scene's nearest points have in common, a column each.
struct NearestColumns {
  py::array distance, point, mesh, triangle, barycentric;

  template <class Found>
  explicit NearestColumns(const std::vector<Found>& found) {
    std::vector<double> distances, points, weights;
    std::vector<std::int32_t> meshes, triangles;
    distances.reserve(found.size());
    points.reserve(3 * found.size());
    weights.reserve(3 * found.size());
    meshes.reserve(found.size());
    triangles.reserve(found.size());
    constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
    for (const Found& one : found) {
      distances.push_back(one.distance);
      points.insert(points.end(), one.point.begin(), one.point.end());
      meshes.push_back(one.mesh);
      triangles.push_back(one.triangle);
      if (one.triangle < 0) {
        weights.insert(weights.end(), 3, kNothing);
      } else {
        weights.insert(weights.end(), {one.u, one.v, 1.0 - one.u - one.v});
      }
    }
    distance = to_numpy(std::move(distances));
    point = to_numpy(std::move(points), {3});
    mesh = to_numpy(std::move(meshes));
    triangle = to_numpy(std::move(triangles));
    barycentric = to_numpy(std::move(weights), {3});
  }
};

/// Answers of Scene.nearest.
struct Nearest : NearestColumns {
  using NearestColumns::NearestColumns;
};

/// Answers of Scene.nearest_segments.
struct NearestSegments : NearestColumns {
  py::array fraction, segment_point;

  explicit NearestSegments(const std::vector<NearestToSegment>& found) : NearestColumns(found) {
    std::vector<double> fractions, points;
    fractions.reserve(found.size());
    points.reserve(3 * found.size());
    for (const NearestToSegment& one : found) {
      fractions.push_back(one.fraction);
      points.insert(points.end(), one.segment_point.begin(), one.segment_point.end());
    }
    fraction = to_numpy(std::move(fractions));
    segment_point = to_numpy(std::move(points), {3});
  }
};

py::array points_to_numpy(const std::vector<Vec3>& points) {
  std::vector<double> values;
  values.reserve(3 * points.size());
  for (const Vec3& p : points) values.insert(values.end(), p.begin(), p.end());
  return to_numpy(std::move(values), {3});
}

/// The columns in common; `distance` says when there is none, `thing` what each row is about.
template <class Columns>
py::class_<Columns> bind_nearest_columns(py::module_& module, const char* name, const char* doc,
                                         const char* distance, const std::string& thing) {
  return py::class_<Columns>(module, name, doc)
      .def_readonly("distance", &Columns::distance, distance)
      .def_readonly("point", &Columns::point, "(N, 3) of the scene [m], NaN where there is none.")
      .def_readonly("mesh", &Columns::mesh,
                    "(N,) number of the mesh in the scene, −1 where there is none.")
      .def_readonly("triangle", &Columns::triangle,
                    "(N,) triangle of that mesh, −1 where there is none.")
      .def_readonly(
          "barycentric", &Columns::barycentric,
          "(N, 3) weights (u, v, w) of corners 1, 2 and 0, as eq 4; NaN where there is none.")
      .def("__len__", [](const Columns& c) { return c.distance.size(); })
      .def("__repr__", [name = std::string(name), thing](const Columns& c) {
        return name + "(" + std::to_string(c.distance.size()) + " " + thing +
               (c.distance.size() == 1 ? ")" : "s)");
      });
}

void bind_nearest(py::module_& module) {
  bind_nearest_columns<Nearest>(module, "Nearest",
                                "The closest point of a scene to each of N points.",
                                "(N,) [m], inf where the scene holds no triangle.", "point");
  bind_nearest_columns<NearestSegments>(
      module, "NearestSegments", "Where a scene comes closest to each of N segments.",
      "(N,) [m], 0 where the segment meets a triangle, inf where there is none within reach.",
      "segment")
      .def_readonly("fraction", &NearestSegments::fraction,
                    "(N,) where along the segment, 0 at its start, 1 at its end; NaN where there "
                    "is none.")
      .def_readonly("segment_point", &NearestSegments::segment_point,
                    "(N, 3) of the segment [m], the same as `point` where they meet; NaN where "
                    "there is none.");
}

void bind_polyline(py::module_& module) {
  py::class_<Polyline>(module, "Polyline",
                       "A line of a section: segment i runs from point i to point i + 1.")
      .def_property_readonly(
          "points", [](const Polyline& line) { return points_to_numpy(line.points); },
          "(P, 3) [m]; a closed line repeats its first point.")
      .def_property_readonly(
          "mesh", [](const Polyline& line) { return to_numpy(line.mesh); },
          "(P − 1,) the mesh each segment lies on: one and the same along a line.")
      .def_property_readonly(
          "triangle", [](const Polyline& line) { return to_numpy(line.triangle); },
          "(P − 1,) the triangle of that mesh each segment lies on.")
      .def_readonly("closed", &Polyline::closed, "Whether the line comes back to where it began.")
      .def("__repr__", [](const Polyline& line) {
        return "Polyline(" + std::to_string(line.points.size()) + " points" +
               (line.closed ? ", closed)" : ")");
      });
}

std::vector<Polyline> section_between(const Scene& scene, const ArrayLike& a,
                                      const OptionalArray& b, const OptionalArray& up) {
  const Vec3 from = vector_argument("a", a);
  if (b.is_none()) throw_argument("b", "a second point, or a bathyal.Plane alone", "nothing");
  const Vec3 to = vector_argument("b", b);
  const Vec3 direction = up.is_none() ? Vec3(Vec3::UnitZ()) : vector_argument("up", up);
  const py::gil_scoped_release release;
  return scene.section(from, to, direction);
}

/// (N, 3), or (3,) as one row.
Points segment_ends(std::string_view name, const py::object& object) {
  const py::array array = array_argument(name, object, "real numbers of shape (N, 3)");
  return points_argument(name, array.ndim() == 1 ? py::array(array.attr("reshape")(1, -1)) : array);
}

NearestSegments find_nearest_segments(const Scene& scene, const ArrayLike& start,
                                      const ArrayLike& end, double within, int num_threads) {
  const Points from = segment_ends("start", start);
  const Points to = segment_ends("end", end);
  std::vector<NearestToSegment> found;
  {
    const py::gil_scoped_release release;
    found = scene.nearest_segments(from.view(), to.view(), {within}, num_threads);
  }
  return NearestSegments(found);
}

void bind_queries(py::class_<Scene>& scene) {
  const double accuracy = WindingOptions().accuracy;
  scene
      .def(
          "nearest",
          [](const Scene& self, const ArrayLike& points, int num_threads) {
            const Points queries = points_argument("points", points);
            std::vector<NearestPoint> found;
            {
              const py::gil_scoped_release release;
              found = self.nearest(queries.view(), num_threads);
            }
            return Nearest(found);
          },
          py::arg("points"), py::kw_only(), py::arg("num_threads") = 0,
          R"(The closest point of all triangles to each point.

Decided in double; equal distances give the lowest (mesh, triangle). A triangle without area counts
as the segment or point that it is.

Parameters
----------
points : (N, 3) array
    [m], finite.
num_threads : int
    0 means all.

Returns
-------
Nearest
    ``.distance`` (N,) [m], ``.point`` (N, 3), ``.mesh`` (N,), ``.triangle`` (N,) and
    ``.barycentric`` (N, 3). A scene without triangles gives inf, NaN and −1.

Examples
--------
>>> import bathyal
>>> floor = bathyal.TriangleMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
>>> near = bathyal.Scene(floor).nearest([[1, 1, 3], [-3, 0, -4]])
>>> near.distance.tolist(), near.point.tolist()
([3.0, 5.0], [[1.0, 1.0, 0.0], [0.0, 0.0, 0.0]])
)")
      .def("nearest_segments", &find_nearest_segments, py::arg("start"), py::arg("end"),
           py::kw_only(), py::arg("within") = NearestSegmentOptions().within,
           py::arg("num_threads") = 0,
           R"(Where all triangles come closest to each straight segment.

Decided in double; equal distances give the lowest (mesh, triangle). Where a segment meets a
triangle, borders and ends included, its distance is exactly 0 and both points are one: decided with
exact signs, in the plane of a triangle too. A triangle without area counts as the segment or point
that it is; a segment without length is as by nearest. The distance of a capsule is that of its axis
less its radius.

Parameters
----------
start : (N, 3), (1, 3) or (3,) array
    [m], finite and no further out than 10²⁵ m. One start serves all ends.
end : (N, 3) or (3,) array
    [m], likewise.
within : float
    What is further away is not found [m]; a small distance saves time.
num_threads : int
    0 means all. The result is the same bytes for any number.

Returns
-------
NearestSegments
    ``.distance`` (N,) [m], ``.point`` (N, 3) of the scene, ``.mesh`` (N,), ``.triangle`` (N,),
    ``.barycentric`` (N, 3), ``.fraction`` (N,) along the segment and ``.segment_point`` (N, 3).
    Where nothing lies within reach: inf, NaN and −1.

Raises
------
ValueError
    For an end that is not finite or out of range: names the first row at fault.

Examples
--------
>>> import bathyal
>>> floor = bathyal.TriangleMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
>>> near = bathyal.Scene(floor).nearest_segments((1, 1, 3), [[1, 2, 2], [1, 1, -1]])
>>> near.distance.tolist(), near.fraction.tolist()
([2.0, 0.0], [1.0, 0.75])
)")
      .def(
          "winding_number",
          [](const Scene& self, const ArrayLike& points, double accuracy, int num_threads) {
            const Points queries = points_argument("points", points);
            std::vector<double> numbers;
            {
              const py::gil_scoped_release release;
              numbers = self.winding_number(queries.view(), {accuracy}, num_threads);
            }
            return to_numpy(std::move(numbers));
          },
          py::arg("points"), py::kw_only(), py::arg("accuracy") = accuracy,
          py::arg("num_threads") = 0, R"(How often the triangles wind around each point.

The solid angle of all triangles over 4π: 1 inside a closed mesh with outward normals, −1 inside one
turned inside out, 2 inside two of them, a fraction near the holes of an open one, the mean of the
two sides on a triangle. Jacobson, Kavan, Sorkine-Hornung (2013), Robust inside-outside segmentation
using generalized winding numbers; far triangles are taken together as in Barill, Dickson, Schmidt,
Levin, Jacobson (2018), Fast winding numbers for soups and clouds.

Parameters
----------
points : (N, 3) array
    [m], finite.
accuracy : float
    What a far cluster of triangles may be off by, as a part of its area / (4π distance²); above 0.
num_threads : int
    0 means all.

Returns
-------
(N,) array

Examples
--------
>>> import bathyal
>>> tetrahedron = bathyal.TriangleMesh([[0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3]],
...                                    [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
>>> bathyal.Scene(tetrahedron).winding_number([[0.5, 0.5, 0.5], [5, 5, 5]]).round(3) + 0.0
array([1., 0.])
)")
      .def(
          "contains",
          [](const Scene& self, const ArrayLike& points, double accuracy, int num_threads) {
            const Points queries = points_argument("points", points);
            std::vector<bool> inside;
            {
              const py::gil_scoped_release release;
              inside = self.contains(queries.view(), {accuracy}, num_threads);
            }
            py::array_t<bool> result(static_cast<py::ssize_t>(inside.size()));
            std::copy(inside.begin(), inside.end(), result.mutable_data());
            result.attr("setflags")(py::arg("write") = false);
            return result;
          },
          py::arg("points"), py::kw_only(), py::arg("accuracy") = accuracy,
          py::arg("num_threads") = 0, R"(Whether each point lies inside.

Inside is where the winding number is beyond ±1/2, so it holds for meshes that are inside out, open
or cut themselves: a hole counts as filmed over. A point on a triangle is contained. Bodies that
overlap add up; two that are wound against each other cancel where both are.

Parameters
----------
points : (N, 3) array
    [m], finite.
accuracy : float
    As in winding_number.
num_threads : int
    0 means all.

Returns
-------
(N,) array of bool

Examples
--------
>>> import bathyal
>>> tetrahedron = bathyal.TriangleMesh([[0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3]],
...                                    [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
>>> bathyal.Scene(tetrahedron).contains([[0.5, 0.5, 0.5], [5, 5, 5]]).tolist()
[True, False]
)")
      .def(
          "section",
          [](const Scene& self, const Plane& plane) {
            const py::gil_scoped_release release;
            return self.section(plane);
          },
          py::arg("plane"), "The lines in which a whole plane cuts the scene; see below.")
      .def("section", &section_between, py::arg("a"), py::arg("b") = py::none(),
           py::arg("up") = py::none(), R"(The lines in which a plane cuts the scene.

``section(plane)`` cuts by a whole plane. ``section(a, b)`` cuts by the plane through two points and
the direction ``up`` and keeps what lies between them, measured along the horizontal, ends included
(Filaretov, Konoplin, Konoplin 2018: r = (b − a) × up).

Edges in the plane appear once, triangles in the plane give the outline of their region, a surface
that touches the plane at single points gives nothing there. Lines never join two meshes; they are
sorted by mesh and by where they start. Open lines run from a towards b (by a plane: from their end
with the lower x, then y, z), closed ones counter-clockwise seen from where the normal, or r, points
to. A line that starts or ends at a or b to rounding starts or ends at exactly that point.

Parameters
----------
plane : Plane
    Alone; or
a, b : (3,) array
    Two points [m], not above each other along `up`.
up : (3,) array, optional
    With two points: any length but zero; (0, 0, 1) unless given.

Returns
-------
list of Polyline
    ``.points`` (P, 3) [m], ``.mesh`` and ``.triangle`` (P − 1,), ``.closed``.

Raises
------
ValueError
    Where b lies above, below or at a along ``up``: there is no such plane.

Examples
--------
>>> import bathyal
>>> floor = bathyal.TriangleMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
>>> line, = bathyal.Scene(floor).section((0, 1, 9), (2, 1, 9))
>>> line.points.tolist()
[[0.0, 1.0, 0.0], [2.0, 1.0, 0.0]]
)");
}

}  // namespace

void bind_scene(py::module_& module) {
  bind_hits(module);
  bind_nearest(module);
  bind_polyline(module);
  py::class_<Scene> scene(module, "Scene",
                          R"(One or more meshes, made ready for rays, nearest points and sections.

Answers are decided in double, the same bytes on every instruction set and for any number of
threads; equal ranges or distances give the lowest (mesh, triangle). The meshes are shared, not
copied. Any number of threads may query it at once.

Parameters
----------
mesh : TriangleMesh, or a sequence of them
    One at least; meshes without triangles are allowed and never hit.
num_threads : int
    For the build; 0 means all.

Examples
--------
>>> import bathyal
>>> floor = bathyal.TriangleMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
>>> bathyal.Scene(floor)
Scene(1 mesh, 1 triangle)
)");
  scene
      .def(py::init([](const TriangleMesh& mesh, int num_threads) {
             const py::gil_scoped_release release;
             return Scene({mesh.snapshot()}, num_threads);
           }),
           py::arg("mesh"), py::kw_only(), py::arg("num_threads") = 0)
      .def(py::init([](std::vector<TriangleMesh> meshes, int num_threads) {
             const py::gil_scoped_release release;
             for (TriangleMesh& mesh : meshes) mesh = mesh.snapshot();
             return Scene(std::move(meshes), num_threads);
           }),
           py::arg("mesh"), py::kw_only(), py::arg("num_threads") = 0)
      .def_property_readonly("meshes", &Scene::meshes, "The meshes, as a list.")
      .def_property_readonly("memory", &Scene::memory, "Bytes held besides the meshes' own arrays.")
      .def("__repr__", [](const Scene& s) {
        Index triangles = 0;
        for (const TriangleMesh& mesh : s.meshes()) triangles += mesh.triangle_count();
        return "Scene(" + std::to_string(s.meshes().size()) +
               (s.meshes().size() == 1 ? " mesh, " : " meshes, ") + std::to_string(triangles) +
               (triangles == 1 ? " triangle)" : " triangles)");
      });
  bind_rays(scene);
  bind_queries(scene);
}

}  // namespace bathyal::python
