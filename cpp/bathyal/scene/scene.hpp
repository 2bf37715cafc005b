// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "bathyal/geometry/plane.hpp"
#include "bathyal/geometry/pose.hpp"
#include "bathyal/geometry/triangle_mesh.hpp"
#include "bathyal/scene/ray_hit.hpp"

namespace bathyal {

/// The closest point of the scene to a query.
struct NearestPoint {
  double distance = std::numeric_limits<double>::infinity();  ///< [m]
  std::int32_t mesh = -1;
  std::int32_t triangle = -1;
  double u = 0.0, v = 0.0;
  Vec3 point = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
};

/// Where the scene comes closest to a segment.
struct NearestToSegment {
  double distance = std::numeric_limits<double>::infinity();  ///< [m]
  std::int32_t mesh = -1;
  std::int32_t triangle = -1;
  double u = 0.0, v = 0.0;
  Vec3 point = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< of the scene
  double fraction = std::numeric_limits<double>::quiet_NaN();  ///< 0 at the start, 1 at the end
  Vec3 segment_point = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
};

/// What counts as near a segment.
struct NearestSegmentOptions {
  /// What is further away is not found [m], 0 or more; a small one saves time.
  double within = std::numeric_limits<double>::infinity();

  void check() const;
};

/// How closely winding numbers are computed.
struct WindingOptions {
  /// What a far cluster of triangles may be off by at most, as a part of its area / (4π distance²);
  /// above 0. Most of it cancels: 0.1 keeps within 0.02 of the exact sum in a sphere, where the
  /// least does, and within 0.002 on hulls of vehicles.
  double accuracy = 0.1;

  void check() const;
};

/// A chain of straight cuts: segment i runs from point i to point i + 1 through mesh[i] and
/// triangle[i]. A closed chain repeats its first point as its last.
struct Polyline {
  std::vector<Vec3> points;
  std::vector<std::int32_t> mesh;      ///< one less than points
  std::vector<std::int32_t> triangle;  ///< one less than points
  bool closed = false;
};

/// One or more meshes under a bounding volume hierarchy, as they are or each at a pose of its own.
/// A row of the list is an instance, and `.mesh` in answers is that row. Everything that goes in or
/// comes out is in the world; `meshes()` are as given, each in its own frame, world = scale · pose
/// rotation · mesh + pose translation. A mesh that occurs several times (the same arrays) is held,
/// and gets its hierarchy, once: one tree a mesh in its own frame and one over the instances'
/// boxes.
///
/// Answers are decided in double, the same on
/// every instruction set and for any number of threads; equal ranges or distances give the lowest
/// (mesh, triangle). Immutable after construction, so any number of threads may query it at once.
class Scene {
 public:
  /// \throw std::invalid_argument for no mesh at all. A mesh without triangles is allowed and
  /// never hit.
  explicit Scene(std::vector<TriangleMesh> meshes, int num_threads = 0);

  /// A pose (world_from_mesh) a mesh, and a scale each or none for 1. A ray is moved into a mesh's
  /// frame in double and decided there on the mesh's own vertices: at the identity to the same
  /// bytes as without poses, elsewhere to double's rounding, and each instance is watertight in
  /// itself; across two that share an edge it is not promised. Of a rotation that is off by less
  /// than check_rigid allows the nearest rotation is taken. \throw std::invalid_argument for no
  /// mesh at all, or when poses or scales are not as many as the meshes, not rigid, not from 1e-9
  /// to 1e9, or carry triangles further than 10¹² m from the middle.
  Scene(std::vector<TriangleMesh> meshes, const std::vector<Pose>& poses,
        const std::vector<double>& scales = {}, int num_threads = 0);

  /// Another scene with the same meshes and scales at other poses. It shares meshes and their
  /// hierarchies, and only the tree over the instances is made anew. From a scene that was made
  /// without poses each call builds a hierarchy for each of several meshes.
  /// \throw std::invalid_argument as the constructor.
  Scene with_poses(const std::vector<Pose>& poses, int num_threads = 0) const;

  /// Rows of the list of meshes.
  std::int32_t row_count() const { return static_cast<std::int32_t>(meshes().size()); }

  /// As given, each in its own frame.
  const std::vector<TriangleMesh>& meshes() const;

  /// world_from_mesh and scale of each row; the identity and 1 for a scene without poses.
  std::vector<Pose> poses() const;
  std::vector<double> scales() const;

  /// Whether row `mesh` is neither moved, turned nor scaled: its mesh is in the world as it is.
  bool is_at_identity(std::int32_t mesh) const;

  /// Row `mesh` in the world: the mesh itself where it is at the identity, else a moved copy. With
  /// the attributes of the mesh; its datum only where it is at the identity.
  TriangleMesh mesh_in_world(std::int32_t mesh) const;

  /// Corner `corner` (0, 1, 2) of a triangle of row `mesh`, in the world.
  Vec3 corner(std::int32_t mesh, Index triangle, int corner) const;

  /// Its area_vector in the world.
  Vec3 area_vector(std::int32_t mesh, Index triangle) const;

  /// A direction of row `mesh`'s frame, turned into the world.
  Vec3 turn_to_world(std::int32_t mesh, const Vec3& direction) const;

  /// Bytes held by hierarchies and instances, the meshes' own arrays left out.
  std::size_t memory() const;

  /// First triangle met at t ≥ 0 from `origin` along `direction` (any length but zero), from either
  /// side, borders included. The decision is taken in double on the mesh's own vertices, with exact
  /// signs (Woop, Benthin, Wald 2013, Watertight ray/triangle intersection): a ray through an edge
  /// or a vertex of a closed mesh meets one of the triangles there, at survey coordinates too.
  /// Triangles that share what the ray goes through are met at exactly the same range.
  ///
  /// A ray that runs in the plane of a triangle does not meet that one, but meets its neighbours'
  /// borders. A triangle without area is met only where rounding opens it, which keeps a mesh that
  /// needs it closed. An origin further out than 10²⁵ m meets nothing.
  /// \throw std::invalid_argument for a direction of zero, or a value that is not finite.
  RayHit cast(const Vec3& origin, const Vec3& direction) const;

  /// The same for (N, 3) origins and directions; one origin serves all directions.
  /// \throw std::invalid_argument that names the first row at fault, or when the rows do not match.
  std::vector<RayHit> cast(PointView origins, PointView directions, int num_threads = 0) const;

  /// The same into `hits`, which has as many rows as `directions` and needs no first value.
  void cast(PointView origins, PointView directions, std::span<RayHit> hits,
            int num_threads = 0) const;

  /// Whether anything lies on the segment from `from[i]` to `to[i]`, ends included; one `from`
  /// serves all. Decided as by cast. A segment of no length, or of one beyond double's
  /// range, meets nothing.
  /// \throw std::invalid_argument that names the first row that is not finite, or when the rows do
  /// not match.
  std::vector<bool> occluded(PointView from, PointView to, int num_threads = 0) const;

  /// The closest point of all triangles, decided in double; a triangle without area counts as the
  /// segment or point that it is. No triangle at all gives an infinite distance.
  /// \throw std::invalid_argument for a point that is not finite.
  NearestPoint nearest(const Vec3& point) const;
  std::vector<NearestPoint> nearest(PointView points, int num_threads = 0) const;

  /// Where all triangles come closest to the straight segment from `start` to `end`, decided in
  /// double. The distance is exactly 0, and both points are one, where the segment meets a
  /// triangle: borders and ends included, in its plane too, decided with exact signs. A triangle
  /// without area counts as the segment or point that it is; a segment without length is as by
  /// `nearest`. Where nothing lies within `options.within`, the distance is infinite. \throw
  /// std::invalid_argument for an end that is not finite or further out than 10²⁵ m.
  NearestToSegment nearest_segment(const Vec3& start, const Vec3& end,
                                   const NearestSegmentOptions& options = {}) const;

  /// The same for (N, 3) starts and ends; one start serves all ends.
  /// \throw std::invalid_argument that names the first row at fault, or when the rows do not match.
  std::vector<NearestToSegment> nearest_segments(PointView start, PointView end,
                                                 const NearestSegmentOptions& options = {},
                                                 int num_threads = 0) const;

  /// Winding number of each point: the solid angle of all triangles over 4π (Jacobson, Kavan,
  /// Sorkine-Hornung 2013, Robust inside-outside segmentation using generalized winding numbers).
  /// 1 inside a closed mesh with outward normals, −1 inside one turned inside out, 2 inside two of
  /// them; near the holes of an open one it passes smoothly through what lies between. On a
  /// triangle it is the mean of the two sides. Far clusters are taken together (Barill, Dickson,
  /// Schmidt, Levin, Jacobson 2018, Fast winding numbers for soups and clouds).
  /// \throw std::invalid_argument for a point that is not finite.
  std::vector<double> winding_number(PointView points, const WindingOptions& options = {},
                                     int num_threads = 0) const;

  /// |winding number| > 1/2, so that a mesh turned inside out holds what one turned right does, and
  /// a mesh with holes what a film over them would. A point on a triangle, to the rounding of its
  /// coordinates, is contained. Bodies that overlap add up: two wound against each other cancel
  /// where both are.
  std::vector<bool> contains(PointView points, const WindingOptions& options = {},
                             int num_threads = 0) const;

  /// The cut of a plane through the whole scene: lines of one mesh each, sorted by mesh and by
  /// where they start. An open line starts at its end with the lower x (then y, z); a closed one at
  /// its point with the lowest, and runs counter-clockwise seen from where the normal points to.
  ///
  /// A vertex nearer to the plane than the rounding of its coordinates lies in it. An edge in the
  /// plane appears once, whether the surface passes through the plane there, touches it or ends in
  /// it; triangles in the plane give the outline of their region; a surface that touches the plane
  /// at single points gives nothing there. No segment appears twice in a mesh, none has zero
  /// length; one that several triangles share names the lowest. Corners are joined by position, so
  /// triangles need not share vertices. Where more than two segments meet, a line goes on into the
  /// one that turns least; of an odd number, one ends there.
  std::vector<Polyline> section(const Plane& plane) const;

  /// The cut of the plane through `a`, `b` and the direction `up`, kept between `a` and `b`
  /// (measured along the horizontal from a to b, ends included), with r = (b − a) × up (Filaretov,
  /// Konoplin, Konoplin 2018). As by plane, but open lines run from a towards b, and a line that
  /// starts or ends at a or b to rounding starts or ends at exactly that point. A closed line runs
  /// counter-clockwise seen from where r points to.
  /// \throw std::invalid_argument when a → b is parallel to `up` or a = b: no such plane.
  std::vector<Polyline> section(const Vec3& a, const Vec3& b, const Vec3& up = Vec3::UnitZ()) const;

  struct Hierarchy;  ///< lives in hierarchy.hpp
  struct Instances;  ///< lives in instances.hpp

  /// \pre The scene was made without poses.
  const Hierarchy& hierarchy() const { return *hierarchy_; }

 private:
  explicit Scene(std::shared_ptr<const Instances> instances);

  std::shared_ptr<const Hierarchy> hierarchy_;  // of all meshes; null where there are instances
  std::shared_ptr<const Instances> instances_;
};

/// Where a hit lies in the world, from the corners of its triangle; NaN where nothing was met.
Vec3 hit_point(const Scene& scene, const RayHit& hit);

/// Unit normal of the triangle that was hit, as it is wound, in the world; NaN where nothing was
/// met. A triangle without area gives the direction across its longest edge that points up most.
Vec3 hit_normal(const Scene& scene, const RayHit& hit);

/// The same of a hit on a mesh by itself.
Vec3 hit_point(const TriangleMesh& mesh, const RayHit& hit);
Vec3 hit_normal(const TriangleMesh& mesh, const RayHit& hit);

}  // namespace bathyal
