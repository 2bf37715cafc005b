// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/internal/nearest.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "bathyal/base/parallel.hpp"
#include "bathyal/scene/internal/cutter.hpp"
#include "bathyal/scene/internal/hierarchy.hpp"
#include "bathyal/scene/internal/instance_nearest.hpp"
#include "bathyal/scene/internal/instances.hpp"
#include "bathyal/scene/internal/nearest_walk.hpp"
#include "bathyal/scene/internal/nearness.hpp"

namespace bathyal {
namespace scene {

OnEdge closest_on_edge(const Vec3& from, const Vec3& to, const Vec3& query) {
  if (precedes(to, from)) {
    OnEdge found = closest_on_edge(to, from, query);
    found.t = 1.0 - found.t;
    return found;
  }
  const Vec3 edge = to - from;
  const double along = edge.dot(query - from);
  const double length = edge.squaredNorm();
  double t = 0.0;
  Vec3 point = from;
  if (along >= length && along > 0.0) {  // also where the square of a tiny edge is zero
    t = 1.0;
    point = to;
  } else if (along > 0.0) {
    t = along / length;
    point = from + t * edge;
  }
  return {(point - query).squaredNorm(), point, t};
}

ClosestPoint closest_point(const std::array<Vec3, 3>& corners, const Vec3& query) {
  const auto& [a, b, c] = corners;
  const OnEdge ab = closest_on_edge(a, b, query);
  const OnEdge bc = closest_on_edge(b, c, query);
  const OnEdge ca = closest_on_edge(c, a, query);
  ClosestPoint best{ab.squared_distance, ab.point, ab.t, 0.0};
  if (bc.squared_distance < best.squared_distance) {
    best = {bc.squared_distance, bc.point, 1.0 - bc.t, bc.t};
  }
  if (ca.squared_distance < best.squared_distance) {
    best = {ca.squared_distance, ca.point, 0.0, 1.0 - ca.t};
  }

  // Weights of the foot of the perpendicular, times |normal|².
  const Vec3 ab_edge = b - a, ac_edge = c - a, to_query = query - a;
  const Vec3 normal = ab_edge.cross(ac_edge);
  const double u = normal.dot(to_query.cross(ac_edge));
  const double v = normal.dot(ab_edge.cross(to_query));
  const double area = normal.squaredNorm();
  if (u > 0.0 && v > 0.0 && u + v < area) {
    const Vec3 foot = a + (u / area) * ab_edge + (v / area) * ac_edge;
    const double squared_distance = (foot - query).squaredNorm();
    if (squared_distance < best.squared_distance) {
      best = {squared_distance, foot, u / area, v / area};
    }
  }
  return best;
}

namespace {

/// The walk's query where it is a point.
class PointQuery {
 public:
  using Found = ClosestPoint;

  PointQuery(const LocalFrame& frame, const Vec3& point)
      : point_(point),
        nearness_(frame, point - frame.origin),
        rounding_(16.0 * std::numeric_limits<double>::epsilon() *
                  (reach(point) + reach(frame.origin))) {}

  template <class Lanes>
  void bound(const Lanes& lanes, LaneDistances& bounds) const {
    nearness_.bound(lanes, bounds);
  }
  float limit(double distance) const { return nearness_.limit(distance + rounding_); }
  Found measure(const std::array<Vec3, 3>& corners) const { return closest_point(corners, point_); }

 private:
  Vec3 point_;
  Nearness nearness_;
  double rounding_;  ///< how far it may carry a closest point out of its triangle's box [m]
};

NearestPoint nearest_to(const Scene::Hierarchy& hierarchy, const Vec3& point) {
  NearestWalk walk(hierarchy, PointQuery(hierarchy, point));
  walk.run();
  if (walk.primitive() == kNoPrimitive) return {};
  const PrimitiveName name = hierarchy.name(walk.primitive());
  const ClosestPoint& best = walk.found();
  return {std::sqrt(best.squared_distance), name.mesh, name.triangle, best.u, best.v, best.point};
}

NearestPoint nearest_to(const Scene::Instances& instances, const Vec3& point) {
  InstanceNearest walk(instances, PointQuery(instances, point),
                       std::numeric_limits<double>::infinity());
  walk.run([&](const Scene::Hierarchy& hierarchy, const InstanceFrame& frame) {
    return PointQuery(hierarchy, frame.at_identity ? point : to_mesh(frame, point));
  });
  if (walk.row() < 0) return {};
  const InstanceFrame& frame = instances.frame(walk.row());
  const ClosestPoint& best = walk.found();
  return {
      walk.distance(), walk.row(), static_cast<std::int32_t>(walk.triangle()),
      best.u,          best.v,     frame.at_identity ? best.point : to_world(frame, best.point)};
}

}  // namespace
}  // namespace scene

NearestPoint Scene::nearest(const Vec3& point) const {
  return nearest(PointView(point.data(), 1, 3), 1).front();
}

std::vector<NearestPoint> Scene::nearest(PointView points, int num_threads) const {
  check_points_finite("points", points);
  std::vector<NearestPoint> found(static_cast<std::size_t>(points.rows()));
  constexpr std::size_t kGrain = 256;
  parallel_for(found.size(), kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 point = points.row(static_cast<Index>(i)).transpose();
      found[i] = instances_ ? scene::nearest_to(*instances_, point)
                            : scene::nearest_to(*hierarchy_, point);
    }
  });
  return found;
}

}  // namespace bathyal
