// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/scene.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "bindings.hpp"
#include "rays.hpp"
#include "scene_docs.hpp"

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
          py::arg("points"), py::kw_only(), py::arg("num_threads") = 0, kNearestDoc)
      .def("nearest_segments", &find_nearest_segments, py::arg("start"), py::arg("end"),
           py::kw_only(), py::arg("within") = NearestSegmentOptions().within,
           py::arg("num_threads") = 0, kNearestSegmentsDoc)
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
          py::arg("num_threads") = 0, kWindingNumberDoc)
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
          py::arg("num_threads") = 0, kSceneContainsDoc)
      .def(
          "section",
          [](const Scene& self, const Plane& plane) {
            const py::gil_scoped_release release;
            return self.section(plane);
          },
          py::arg("plane"), "The lines in which a whole plane cuts the scene; see below.")
      .def("section", &section_between, py::arg("a"), py::arg("b") = py::none(),
           py::arg("up") = py::none(), kSectionDoc);
}

/// What nobody writes to; meshes over the same arrays stay so.
std::vector<TriangleMesh> snapshots(std::vector<TriangleMesh> meshes) {
  std::map<std::pair<const double*, const std::int32_t*>, TriangleMesh> taken;
  for (TriangleMesh& mesh : meshes) {
    const std::pair arrays(mesh.vertices().data(), mesh.triangles().data());
    const auto at = taken.find(arrays);
    if (at != taken.end() && at->second.vertex_count() == mesh.vertex_count() &&
        at->second.triangle_count() == mesh.triangle_count()) {
      mesh = at->second;
    } else {
      mesh = taken[arrays] = mesh.snapshot();
    }
  }
  return meshes;
}

Scene make_scene(std::vector<TriangleMesh> meshes, const OptionalArray& poses,
                 const OptionalArray& scales, int num_threads) {
  const bool is_posed = !poses.is_none() || !scales.is_none();
  std::vector<Pose> at(is_posed ? meshes.size() : 0, Pose::Identity());
  if (!poses.is_none()) at = poses_argument("poses", poses);
  std::vector<double> sizes;
  if (!scales.is_none()) {
    const Values values = values_argument("scales", scales);
    sizes.assign(values.data(), values.data() + values.rows());
  }
  const py::gil_scoped_release release;
  meshes = snapshots(std::move(meshes));
  if (!is_posed) return Scene(std::move(meshes), num_threads);
  // An empty (0,) is a wrong number of them, not none.
  if (!scales.is_none() && sizes.empty()) {
    throw_argument("scales", "one a mesh (" + std::to_string(meshes.size()) + ")", "0");
  }
  return Scene(std::move(meshes), at, sizes, num_threads);
}

TriangleMesh mesh_in_world(const Scene& scene, std::int64_t mesh) {
  if (mesh < 0 || mesh >= scene.row_count()) {
    throw_argument("mesh", "a row from 0 to " + std::to_string(scene.row_count() - 1),
                   std::to_string(mesh));
  }
  const py::gil_scoped_release release;
  return scene.mesh_in_world(static_cast<std::int32_t>(mesh));
}

}  // namespace

void bind_scene(py::module_& module) {
  bind_hits(module);
  bind_nearest(module);
  bind_polyline(module);
  py::class_<Scene> scene(module, "Scene", kSceneDoc);
  scene
      .def(py::init([](const TriangleMesh& mesh, const OptionalArray& poses,
                       const OptionalArray& scales,
                       int num_threads) { return make_scene({mesh}, poses, scales, num_threads); }),
           py::arg("mesh"), py::kw_only(), py::arg("poses") = py::none(),
           py::arg("scales") = py::none(), py::arg("num_threads") = 0)
      .def(py::init(&make_scene), py::arg("mesh"), py::kw_only(), py::arg("poses") = py::none(),
           py::arg("scales") = py::none(), py::arg("num_threads") = 0)
      .def(
          "with_poses",
          [](const Scene& self, const ArrayLike& poses, int num_threads) {
            const std::vector<Pose> moved = poses_argument("poses", poses);
            const py::gil_scoped_release release;
            return self.with_poses(moved, num_threads);
          },
          py::arg("poses"), py::kw_only(), py::arg("num_threads") = 0, kWithPosesDoc)
      .def_property_readonly("meshes", &Scene::meshes,
                             "The meshes as given, as a list: each in its own frame.")
      .def_property_readonly(
          "poses", [](const Scene& self) { return to_numpy(self.poses()); },
          "(K, 4, 4) world_from_mesh of each row, the identity where none were given.")
      .def_property_readonly(
          "scales", [](const Scene& self) { return to_numpy(self.scales()); },
          "(K,) metres of the world for one of the mesh, 1 where none were given.")
      .def("mesh_in_world", &mesh_in_world, py::arg("mesh"), kMeshInWorldDoc)
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
