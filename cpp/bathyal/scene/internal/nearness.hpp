// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <limits>

#include "bathyal/scene/internal/hierarchy.hpp"
#include "bathyal/scene/internal/lanes.hpp"

namespace bathyal::scene {

/// Least squared distances [m²] of eight lanes to a query, as floats know them.
using LaneDistances = std::array<float, kWidth>;

/// The nearest float; beyond the largest, infinite.
inline float narrow(double x) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  if (x > std::numeric_limits<float>::max()) return kInfinity;
  return x < std::numeric_limits<float>::lowest() ? -kInfinity : static_cast<float>(x);
}

/// One vector in the local frame [m], each coordinate in all lanes.
using LaneVector = std::array<Float4, 3>;

inline LaneVector all_lanes(const Vec3& v) {
  return {all4(narrow(v.x())), all4(narrow(v.y())), all4(narrow(v.z()))};
}

/// Turns distances into limits of bounds that were computed in float.
class NearnessLimit {
 public:
  /// `reach`: largest coordinate of the query in the local frame [m].
  NearnessLimit(const LocalFrame& frame, double reach) {
    // Differences of rounded coordinates, and their products with a direction, are off by less than
    // 18 ε · (the largest coordinate of the query + that of the scene).
    constexpr double kRounding = 32.0 * std::numeric_limits<float>::epsilon();
    slack_ = kRounding * (reach + frame.reach());
  }

  /// The largest bound of what is within `distance` [m].
  float operator()(double distance) const {
    constexpr double kSquaring = 1.000001;  // a dozen roundings of a float
    const double reach = distance + slack_;
    return narrow(kSquaring * reach * reach);
  }

 private:
  double slack_;
};

/// The square of h / |m|, of which `squared` is |m|²: the bound that a direction m gives, along
/// which the query and the lane lie h apart. 0 where h is not above 0, or |m|² is too small or too
/// large for a float.
inline Float4 bound_along(Float4 h, Float4 squared) {
  // The square of m is short of digits below a length of 10⁻¹⁰ m, and infinite far away.
  constexpr float kLargest = std::numeric_limits<float>::max();
  const Int4 is_known = (h > Float4{}) & (squared > all4(1e-20F)) & (squared <= all4(kLargest));
  return is_known ? h / squared * h : Float4{};
}

/// How near boxes and triangles may be to a point, in float: no bound that it gives exceeds
/// `limit(r)` where the true distance is at most r. It rules out and decides nothing.
class Nearness {
 public:
  /// `query` in the local frame [m].
  Nearness(const LocalFrame& frame, const Vec3& query)
      : query_(all_lanes(query)), limit_(frame, query.lpNorm<Eigen::Infinity>()) {}

  /// The largest bound of what is within `distance` [m].
  float limit(double distance) const { return limit_(distance); }

  /// Bounds of the boxes; infinite, or NaN, for an empty lane.
  void bound(const WideNode& node, LaneDistances& bounds) const {
    for (std::size_t i = 0; i < kWidth; i += 4) {
      Float4 sum{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Float4 gap = max4(load4(node.low[axis] + i) - query_[axis],
                                max4(query_[axis] - load4(node.high[axis] + i), Float4{}));
        sum += gap * gap;
      }
      __builtin_memcpy(bounds.data() + i, &sum, sizeof sum);
    }
  }

  /// Bounds of the triangles; of no meaning for an empty lane. Seen along any direction m, a
  /// triangle lies no nearer than the nearest of its corners does: m points to the query from the
  /// nearest point of the triangle's own box.
  void bound(const TriangleBlock& block, LaneDistances& bounds) const {
    for (std::size_t i = 0; i < kWidth; i += 4) {
      Float4 h0{}, h1{}, h2{}, squared{};  // m · (query − corner), m · m
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Float4 to_0 = query_[axis] - load4(block.v0[axis] + i);
        const Float4 to_1 = to_0 - load4(block.e1[axis] + i);
        const Float4 to_2 = to_0 - load4(block.e2[axis] + i);
        const Float4 least = min4(to_0, min4(to_1, to_2));
        const Float4 most = max4(to_0, max4(to_1, to_2));
        const Float4 m = max4(least, Float4{}) + min4(most, Float4{});
        h0 += m * to_0;
        h1 += m * to_1;
        h2 += m * to_2;
        squared += m * m;
      }
      const Float4 h = min4(h0, min4(h1, h2));
      const Float4 bound = bound_along(h, squared);
      __builtin_memcpy(bounds.data() + i, &bound, sizeof bound);
    }
  }

 private:
  LaneVector query_;
  NearnessLimit limit_;
};

}  // namespace bathyal::scene
