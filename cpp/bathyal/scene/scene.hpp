// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "bathyal/geometry/plane.hpp"
#include "bathyal/geometry/triangle_mesh.hpp"

namespace bathyal {

/// What a ray met first. `triangle` is −1 and `range` infinite where it met nothing.
struct RayHit {
  double range = std::numeric_limits<double>::infinity();  ///< along the unit direction [m]
  std::int32_t mesh = -1;                                  ///< which mesh of the scene
  std::int32_t triangle = -1;                              ///< which triangle of that mesh
  double u = 0.0;  ///< barycentric weight of corner 1 (eq 4); that of corner 0 is 1 − u − v
  double v = 0.0;  ///< barycentric weight of corner 2
};

/// The closest point of the scene to a query.
struct NearestPoint {
  double distance = std::numeric_limits<double>::infinity();  ///< [m]
  std::int32_t mesh = -1;
  std::int32_t triangle = -1;
  double u = 0.0, v = 0.0;
  Vec3 point = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
};

/// A chain of straight cuts: segment i runs from point i to point i + 1 through mesh[i] and
/// triangle[i]. A closed chain repeats its first point as its last.
struct Polyline {
  std::vector<Vec3> points;
  std::vector<std::int32_t> mesh;      ///< one less than points
  std::vector<std::int32_t> triangle;  ///< one less than points
  bool closed = false;
};

/// One or more meshes under a bounding volume hierarchy. Answers are decided in double, the same on
/// every instruction set and for any number of threads; equal ranges or distances give the lowest
/// (mesh, triangle). Immutable after construction, so any number of threads may ask at once.
class Scene {
 public:
  /// \throw std::invalid_argument for no mesh at all. A mesh without triangles is allowed and
  /// never hit.
  explicit Scene(std::vector<TriangleMesh> meshes, int num_threads = 0);

  const std::vector<TriangleMesh>& meshes() const;

  /// Bytes held by the hierarchy, the meshes' own arrays left out.
  std::size_t memory() const;

  /// First triangle met at t ≥ 0 from `origin` along `direction` (any length but zero), from either
  /// side. Watertight: where two triangles share an edge or several a vertex, a ray through it
  /// meets at least one of them.
  RayHit cast(const Vec3& origin, const Vec3& direction) const;

  /// The same for (N, 3) origins and directions; one origin serves all directions when N = 1.
  std::vector<RayHit> cast(PointView origins, PointView directions, int num_threads = 0) const;

  /// Whether anything lies on the segment from `from[i]` to `to[i]`, ends included.
  std::vector<bool> occluded(PointView from, PointView to, int num_threads = 0) const;

  NearestPoint nearest(const Vec3& point) const;
  std::vector<NearestPoint> nearest(PointView points, int num_threads = 0) const;

  /// Winding number of each point: 1 inside a closed mesh with outward normals, −1 inside one
  /// turned inside out, in between near holes of an open one (Jacobson et al. 2013; far triangles
  /// by a dipole expansion, Barill et al. 2018).
  std::vector<double> winding_number(PointView points, int num_threads = 0) const;

  /// |winding number| > 1/2.
  std::vector<bool> contains(PointView points, int num_threads = 0) const;

  /// The cut of a plane through the whole scene.
  std::vector<Polyline> section(const Plane& plane) const;

  /// The cut of the plane through `a`, `b` and the direction `up`, kept between `a` and `b`
  /// (measured along the horizontal from a to b, ends included).
  /// \throw std::invalid_argument when a → b is parallel to `up`: no such plane.
  std::vector<Polyline> section(const Vec3& a, const Vec3& b, const Vec3& up = Vec3::UnitZ()) const;

  struct Hierarchy;  ///< lives in hierarchy.hpp
  const Hierarchy& hierarchy() const;

 private:
  std::shared_ptr<const Hierarchy> hierarchy_;
};

}  // namespace bathyal
