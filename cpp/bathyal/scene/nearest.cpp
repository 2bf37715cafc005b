// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/nearest.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "bathyal/base/parallel.hpp"
#include "bathyal/scene/cutter.hpp"
#include "bathyal/scene/hierarchy.hpp"

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
  if (along >= length && length > 0.0) {
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

/// Squared distance from `q` to a lane's box; infinite for an empty lane.
double squared_distance_to_box(const WideNode& node, int lane, const Vec3& q) {
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = node.low[axis][lane];
    const double high = node.high[axis][lane];
    const double d = std::max({low - q[axis], q[axis] - high, 0.0});
    sum += d * d;
  }
  return sum;
}

double square(double x) { return x * x; }
double reach(const Vec3& v) { return v.cwiseAbs().maxCoeff(); }

struct Waiting {
  double squared_distance;
  std::int32_t item;
};

/// Depth first, nearest child first; whatever may still hold an equal distance is looked at, since
/// the lowest number wins a tie.
NearestPoint find_nearest(const Scene::Hierarchy& hierarchy, const Vec3& query) {
  NearestPoint nearest;
  if (hierarchy.nodes.empty()) return nearest;
  const Vec3 local = query - hierarchy.origin;
  // How far rounding may carry a closest point out of the box that its triangle lies in.
  const double rounding =
      16.0 * std::numeric_limits<double>::epsilon() * (reach(query) + reach(hierarchy.origin));
  ClosestPoint best{std::numeric_limits<double>::infinity(), {}, 0.0, 0.0};
  std::uint32_t best_primitive = kNoPrimitive;
  double limit = best.squared_distance;  // a box beyond it holds nothing as near as the best
  std::array<Waiting, kStackSize> stack;
  std::size_t depth = 0;
  stack[depth++] = {0.0, 0};
  while (depth > 0) {
    const Waiting top = stack[--depth];
    if (top.squared_distance > limit) continue;
    if (top.item < 0) {
      for (const std::uint32_t primitive :
           hierarchy.blocks[static_cast<std::size_t>(~top.item)].primitive) {
        if (primitive == kNoPrimitive) break;
        const ClosestPoint found = closest_point(hierarchy.corners(primitive), query);
        if (std::tie(found.squared_distance, primitive) <
            std::tie(best.squared_distance, best_primitive)) {
          best = found;
          best_primitive = primitive;
          limit = square(std::sqrt(best.squared_distance) + rounding);
        }
      }
      continue;
    }
    const WideNode& node = hierarchy.nodes[static_cast<std::size_t>(top.item)];
    const std::size_t first = depth;
    for (int lane = 0; lane < kWidth; ++lane) {
      if (node.child[lane] == kNoChild) continue;
      const double d = squared_distance_to_box(node, lane, local);
      if (d <= limit) stack[depth++] = {d, node.child[lane]};
    }
    std::sort(
        stack.begin() + static_cast<std::ptrdiff_t>(first),
        stack.begin() + static_cast<std::ptrdiff_t>(depth),
        [](const Waiting& a, const Waiting& b) { return a.squared_distance > b.squared_distance; });
  }
  const PrimitiveName name = hierarchy.name(best_primitive);
  return {std::sqrt(best.squared_distance), name.mesh, name.triangle, best.u, best.v, best.point};
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
      found[i] = scene::find_nearest(*hierarchy_, points.row(static_cast<Index>(i)).transpose());
    }
  });
  return found;
}

}  // namespace bathyal
