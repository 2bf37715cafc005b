// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/internal/obstacle.hpp"

#include <algorithm>
#include <utility>

#include "bathyal/workspace/internal/convex_distance.hpp"

namespace bathyal::workspace {
namespace {

Eigen::AlignedBox3d box_of(const Scene& scene) {
  Eigen::AlignedBox3d box;
  for (std::int32_t m = 0; m < scene.row_count(); ++m) {
    const TriangleMesh mesh = scene.mesh_in_world(m);
    const PointView vertices = mesh.vertices();
    for (Index i = 0; i < vertices.rows(); ++i) box.extend(Vec3(vertices.row(i).transpose()));
  }
  return box;
}

const Scene* surface_of(const std::variant<Hull, KeepOut, Scene>& body) {
  if (const Hull* hull = std::get_if<Hull>(&body)) return &hull->scene();
  if (const Scene* scene = std::get_if<Scene>(&body)) return scene;
  const KeepOut& keepout = std::get<KeepOut>(body);
  return keepout.hull() ? &keepout.hull()->scene() : nullptr;
}

/// Size of a volume [m]: what its distances are exact to a part of.
double extent(const KeepOut& shape) {
  return std::max({shape.radius(), shape.length(), shape.size().maxCoeff()});
}

/// The signed distance of a convex volume is convex along the axis.
Nearness nearest_of_convex(const KeepOut& keepout, const Capsule& capsule) {
  const Pose shape_from_frame = keepout.pose().inverse();
  const Vec3 start = shape_from_frame * capsule.start;
  const Vec3 span = shape_from_frame.linear() * (capsule.end - capsule.start);
  Nearness found;
  const auto at = [&](double t) {
    const Vec3 point = start + t * span;
    const SignedDistance there = signed_distance(keepout, point);
    if (there.value < found.distance) {
      found = {there.value, point, point - there.value * there.gradient};
    }
    return std::pair(there.value, there.gradient.dot(span));
  };
  constexpr double kPart = 1e-13;
  convex_minimum(at, kPart * (extent(keepout) + span.stableNorm()));
  found.distance -= capsule.radius;
  found.axis_point = keepout.pose() * found.axis_point;
  found.surface_point = keepout.pose() * found.surface_point;
  return found;
}

}  // namespace

Obstacle::Obstacle(Hull hull) : name_("hull"), frame_(kVehicleFrame), body_(std::move(hull)) {
  box_ = box_of(*surface_of(body_));
}

Obstacle::Obstacle(KeepOut keepout, int frame)
    : name_(keepout.name()), frame_(frame), motion_(keepout.motion()), body_(std::move(keepout)) {
  if (const Scene* surface = surface_of(body_)) box_ = box_of(*surface);
}

Obstacle::Obstacle(Scene scene) : name_("scene"), frame_(kWorldFrame), body_(std::move(scene)) {
  box_ = box_of(*surface_of(body_));
}

Nearness Obstacle::nearest(const Capsule& capsule, double within) const {
  if (const Scene* surface = surface_of(body_)) {
    return nearest_of_surface(*surface, capsule, within);
  }
  return nearest_of_convex(std::get<KeepOut>(body_), capsule);
}

bool Obstacle::holds(const Vec3& point) const {
  if (const Scene* scene = std::get_if<Scene>(&body_)) {
    if (point.z() > box_.max().z()) return false;
    const RayHit hit = scene->cast(point, Vec3::UnitZ());
    return hit.mesh >= 0 && hit_normal(*scene, hit).z() > 0.0;
  }
  if (!box_.contains(point)) return false;
  bool inside = false;
  const Hull* hull = std::get_if<Hull>(&body_);
  (hull ? *hull : *std::get<KeepOut>(body_).hull()).contains({point.data(), 1, 3}, {&inside, 1}, 1);
  return inside;
}

Nearness Obstacle::nearest_of_surface(const Scene& surface, const Capsule& capsule,
                                      double within) const {
  const NearestToSegment nearest = surface.nearest_segment(
      capsule.start, capsule.end, {.within = std::max(0.0, within + capsule.radius)});
  const bool crosses = nearest.distance == 0.0;
  Nearness found{nearest.distance - capsule.radius, nearest.segment_point, nearest.point};
  if (!crosses && !holds(capsule.start)) return found;
  double depth = 0.0;
  for (const Vec3& end : {capsule.start, capsule.end}) {
    // An axis that does not cross the surface lies inside with both its ends.
    if (crosses && !holds(end)) continue;
    const NearestPoint out = surface.nearest(end);
    if (out.distance < depth) continue;
    depth = out.distance;
    found.axis_point = end;
    found.surface_point = out.point;
  }
  found.distance = -capsule.radius - depth;
  return found;
}

}  // namespace bathyal::workspace
