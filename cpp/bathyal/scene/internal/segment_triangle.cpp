// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/internal/segment_triangle.hpp"

#include <algorithm>
#include <limits>

#include "bathyal/geometry/predicates.hpp"
#include "bathyal/scene/internal/cutter.hpp"
#include "bathyal/scene/internal/nearest.hpp"

namespace bathyal::scene {
namespace {

Point3 exact_point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

/// The point as seen along an axis.
Point2 projected(const Vec3& p, int axis) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

bool intervals_meet(double a, double b, double c, double d) {
  return std::max(a, b) >= std::min(c, d) && std::max(c, d) >= std::min(a, b);
}

/// Whether closed segments of the plane have a point in common; either may be a point.
bool segments_meet(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  return intervals_meet(a.x, b.x, c.x, d.x) && intervals_meet(a.y, b.y, c.y, d.y) &&
         orient2d(a, b, c) * orient2d(a, b, d) <= 0 && orient2d(c, d, a) * orient2d(c, d, b) <= 0;
}

/// The same for segments of one plane in space: they meet where all three projections do, since
/// one of those at least takes different points of the plane to different points.
bool coplanar_segments_meet(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!segments_meet(projected(a, axis), projected(b, axis), projected(c, axis),
                       projected(d, axis))) {
      return false;
    }
  }
  return true;
}

/// Whether a point of the triangle's plane lies inside, its edges left out.
bool is_inside(const std::array<Vec3, 3>& corners, const Vec3& point) {
  for (int axis = 0; axis < 3; ++axis) {
    const Point2 a = projected(corners[0], axis), b = projected(corners[1], axis);
    const Point2 c = projected(corners[2], axis), p = projected(point, axis);
    const int turn = orient2d(a, b, p);
    if (turn != 0 && turn == orient2d(b, c, p) && turn == orient2d(c, a, p)) return true;
  }
  return false;
}

bool meets_in_plane(const std::array<Vec3, 3>& corners, const Vec3& start, const Vec3& end) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& from = corners[i];
    const Vec3& to = corners[(i + 1) % 3];
    // Of a triangle without area, the segment may leave the line that all its edges lie on.
    if (orient3d(exact_point(start), exact_point(end), exact_point(from), exact_point(to)) == 0 &&
        coplanar_segments_meet(start, end, from, to)) {
      return true;
    }
  }
  return is_inside(corners, start);
}

/// Keeps the best of several pairs of points, one of the triangle and one of the segment.
class BestApproach {
 public:
  /// The segment from the origin along `along`.
  explicit BestApproach(const Vec3& along) : along_(along) {}

  void consider(const Vec3& point, double u, double v, double fraction) {
    const Vec3 on_segment = fraction == 1.0 ? along_ : Vec3(fraction * along_);
    const double squared_distance = (on_segment - point).squaredNorm();
    if (squared_distance < best_.squared_distance) {
      best_ = {squared_distance, point, u, v, fraction, on_segment};
    }
  }

  void consider(const ClosestPoint& closest, double fraction) {
    consider(closest.point, closest.u, closest.v, fraction);
  }

  const SegmentApproach& best() const { return best_; }

 private:
  Vec3 along_;
  SegmentApproach best_{std::numeric_limits<double>::infinity()};
};

/// Weights of corners 1 and 2 at `t` along the edge from corner `i`.
void consider_on_edge(BestApproach& best, std::size_t i, const Vec3& point, double t,
                      double fraction) {
  constexpr std::array<std::array<double, 2>, 3> kWeights{{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}};
  const auto& from = kWeights[i];
  const auto& to = kWeights[(i + 1) % 3];
  best.consider(point, (1.0 - t) * from[0] + t * to[0], (1.0 - t) * from[1] + t * to[1], fraction);
}

/// Where the lines of the segment (from the origin along `along`) and of an edge are nearest, if
/// that is between the ends of both; the ends are others' to consider. Cross products, since the
/// usual determinant of dot products loses twice the digits where the two are nearly parallel.
void consider_crossing(BestApproach& best, const std::array<Vec3, 3>& corners, std::size_t i,
                       const Vec3& along) {
  const bool is_turned = precedes(corners[(i + 1) % 3], corners[i]);
  const Vec3& from = corners[is_turned ? (i + 1) % 3 : i];
  const Vec3& to = corners[is_turned ? i : (i + 1) % 3];
  const Vec3 edge = to - from;
  const Vec3 across = along.cross(edge);
  const double squared = across.squaredNorm();
  const double on_segment = from.cross(edge).dot(across);
  const double on_edge = from.cross(along).dot(across);
  if (!(on_segment > 0.0 && on_segment < squared && on_edge > 0.0 && on_edge < squared)) return;
  const double t = on_edge / squared;
  consider_on_edge(best, i, from + t * edge, is_turned ? 1.0 - t : t, on_segment / squared);
}

/// Where the segment goes through the triangle's plane.
void consider_plane(BestApproach& best, const std::array<Vec3, 3>& corners, const Vec3& along) {
  const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const double height = normal.dot(corners[0]);
  const double rise = normal.dot(along);
  if (rise == 0.0) return;
  const double fraction = std::clamp(height / rise, 0.0, 1.0);
  best.consider(closest_point(corners, fraction * along), fraction);
}

}  // namespace

bool segment_meets(const std::array<Vec3, 3>& corners, const Vec3& start, const Vec3& end) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
    if (!intervals_meet(low, high, start[axis], end[axis])) return false;
  }
  const Point3 a = exact_point(corners[0]), b = exact_point(corners[1]);
  const Point3 c = exact_point(corners[2]), p = exact_point(start), q = exact_point(end);
  const int start_side = orient3d(a, b, c, p), end_side = orient3d(a, b, c, q);
  if (start_side * end_side > 0) return false;
  if (start_side == 0 && end_side == 0) return meets_in_plane(corners, start, end);
  const int ab = orient3d(p, q, a, b), bc = orient3d(p, q, b, c), ca = orient3d(p, q, c, a);
  return std::min({ab, bc, ca}) >= 0 || std::max({ab, bc, ca}) <= 0;
}

SegmentApproach closest_to_segment(const std::array<Vec3, 3>& corners, const Vec3& start,
                                   const Vec3& end) {
  if (start == end) {
    const ClosestPoint closest = closest_point(corners, start);
    return {closest.squared_distance, closest.point, closest.u, closest.v, 0.0, start};
  }
  const std::array<Vec3, 3> local{corners[0] - start, corners[1] - start, corners[2] - start};
  const Vec3 along = end - start;
  BestApproach best(along);
  best.consider(closest_point(local, Vec3::Zero()), 0.0);
  best.consider(closest_point(local, along), 1.0);
  for (std::size_t i = 0; i < 3; ++i) {
    consider_on_edge(best, i, local[i], 0.0, closest_on_edge(Vec3::Zero(), along, local[i]).t);
    consider_crossing(best, local, i, along);
  }
  const bool meets = segment_meets(corners, start, end);
  if (meets) consider_plane(best, local, along);

  SegmentApproach found = best.best();
  found.on_segment = found.fraction == 1.0 ? end : Vec3(start + found.on_segment);
  found.point += start;
  if (meets) {
    found.squared_distance = 0.0;
    found.point = found.on_segment;
  }
  return found;
}

}  // namespace bathyal::scene
