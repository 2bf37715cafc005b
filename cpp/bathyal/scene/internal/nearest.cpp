// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/internal/nearest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "bathyal/base/parallel.hpp"
#include "bathyal/scene/internal/cutter.hpp"
#include "bathyal/scene/internal/hierarchy.hpp"
#include "bathyal/scene/internal/nearness.hpp"
#include "bathyal/scene/internal/prefetch.hpp"

namespace bathyal {
namespace scene {
namespace {

/// Where between the two ends of an edge the closest point lies: 0 at `from`, 1 at `to`.
struct OnEdge {
  double squared_distance;
  Vec3 point;
  double t;
};

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

}  // namespace

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

/// A node, or ~block, that may hold something nearer.
struct Waiting {
  float bound;
  std::int32_t item;
};

/// One query's way through the hierarchy, depth first, nearest child first. Whatever may still hold
/// an equal distance is looked at, since the lowest number wins a tie.
class NearestWalk {
 public:
  NearestWalk(const Scene::Hierarchy& hierarchy, const Vec3& query)
      : hierarchy_(hierarchy),
        query_(query),
        nearness_(hierarchy, query - hierarchy.origin),
        rounding_(16.0 * std::numeric_limits<double>::epsilon() *
                  (reach(query) + reach(hierarchy.origin))) {}

  NearestPoint run() {
    if (hierarchy_.nodes.empty()) return {};
    stack_[depth_++] = {0.0F, 0};
    while (depth_ > 0) {
      const Waiting top = stack_[--depth_];
      if (top.bound > limit_) continue;
      if (top.item < 0) {
        look_at(hierarchy_.blocks[static_cast<std::size_t>(~top.item)]);
      } else {
        open(hierarchy_.nodes[static_cast<std::size_t>(top.item)]);
      }
    }
    const PrimitiveName name = hierarchy_.name(primitive_);
    return {
        std::sqrt(best_.squared_distance), name.mesh, name.triangle, best_.u, best_.v, best_.point};
  }

 private:
  /// Pushes the children that may hold something nearer, the nearest on top.
  void open(const WideNode& node) {
    LaneDistances bounds;
    nearness_.bound(node, bounds);
    const std::size_t first = depth_;
    for (std::size_t lane = 0; lane < kWidth; ++lane) {
      const std::int32_t child = node.child[lane];
      if (bounds[lane] > limit_ || child == kNoChild) continue;
      if (child < 0) {
        prefetch(hierarchy_.blocks[static_cast<std::size_t>(~child)]);
      } else {
        prefetch(hierarchy_.nodes[static_cast<std::size_t>(child)]);
      }
      std::size_t at = depth_++;
      for (; at > first && stack_[at - 1].bound < bounds[lane]; --at) stack_[at] = stack_[at - 1];
      stack_[at] = {bounds[lane], child};
    }
  }

  /// Measures the block's triangles, the one with the least bound first.
  void look_at(const TriangleBlock& block) {
    struct Candidate {
      float bound;
      std::uint32_t primitive;
    };
    LaneDistances bounds;
    nearness_.bound(block, bounds);
    std::array<Candidate, kWidth> candidates;
    std::size_t count = 0;
    for (std::size_t lane = 0; lane < kWidth; ++lane) {
      const std::uint32_t primitive = block.primitive[lane];
      if (primitive == kNoPrimitive) break;
      if (bounds[lane] > limit_) continue;
      prefetch_three(hierarchy_.row(primitive).index);
      std::size_t at = count++;
      for (; at > 0 && candidates[at - 1].bound > bounds[lane]; --at) {
        candidates[at] = candidates[at - 1];
      }
      candidates[at] = {bounds[lane], primitive};
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Scene::Hierarchy::Row row = hierarchy_.row(candidates[i].primitive);
      for (int c = 0; c < 3; ++c) prefetch_three(row.corner(c));
    }
    for (std::size_t i = 0; i < count && candidates[i].bound <= limit_; ++i) {
      measure(candidates[i].primitive);
    }
  }

  void measure(std::uint32_t primitive) {
    const ClosestPoint found = closest_point(hierarchy_.corners(primitive), query_);
    if (std::tie(found.squared_distance, primitive) >= std::tie(best_.squared_distance, primitive_))
      return;
    best_ = found;
    primitive_ = primitive;
    limit_ = nearness_.limit(std::sqrt(found.squared_distance) + rounding_);
  }

  const Scene::Hierarchy& hierarchy_;
  Vec3 query_;
  Nearness nearness_;
  double rounding_;  ///< how far it may carry a closest point out of its triangle's box [m]
  ClosestPoint best_{std::numeric_limits<double>::infinity(), {}, 0.0, 0.0};
  std::uint32_t primitive_ = kNoPrimitive;
  float limit_ = std::numeric_limits<float>::infinity();
  std::array<Waiting, kStackSize> stack_;
  std::size_t depth_ = 0;
};

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
      found[i] =
          scene::NearestWalk(*hierarchy_, points.row(static_cast<Index>(i)).transpose()).run();
    }
  });
  return found;
}

}  // namespace bathyal
