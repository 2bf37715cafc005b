// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>

#include "bathyal/scene/internal/hierarchy.hpp"
#include "bathyal/scene/internal/lanes.hpp"
#include "bathyal/scene/internal/nearness.hpp"

namespace bathyal::scene {

/// How near boxes and triangles may be to a segment, in float, as Nearness does for a point: no
/// bound that it gives exceeds `limit(r)` where the true distance is at most r.
///
/// Along any direction m, a convex body lies no nearer than its support does; so m may be chosen
/// with whatever rounding, and only h = min over the ends m · end − max over the body m · x counts.
class SegmentNearness {
 public:
  /// `start` and `end` in the local frame [m].
  SegmentNearness(const LocalFrame& frame, const Vec3& start, const Vec3& end)
      : start_(all_lanes(start)),
        end_(all_lanes(end)),
        limit_(frame, std::max(start.lpNorm<Eigen::Infinity>(), end.lpNorm<Eigen::Infinity>())) {
    const Vec3 along = end - start;
    along_ = all_lanes(along);
    per_length_ = all_lanes(along / std::max(along.squaredNorm(), 1e-30));
  }

  /// The largest bound of what is within `distance` [m].
  float limit(double distance) const { return limit_(distance); }

  /// Bounds of the boxes; infinite, or NaN, for an empty lane. The better of two: the gap between
  /// the box and that of the segment, and along the direction from the box to the segment where
  /// they are nearest, found by going back and forth between them once.
  void bound(const WideNode& node, LaneDistances& bounds) const {
    for (std::size_t i = 0; i < kWidth; i += 4) {
      LaneVector low, high, middle;
      Float4 gaps{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = load4(node.low[axis] + i);
        high[axis] = load4(node.high[axis] + i);
        middle[axis] = 0.5F * (low[axis] + high[axis]);
        const Float4 gap = max4(max4(low[axis] - max4(start_[axis], end_[axis]),
                                     min4(start_[axis], end_[axis]) - high[axis]),
                                Float4{});
        gaps += gap * gap;
      }
      const LaneVector in_box = clamped(at(nearest_to(middle)), low, high);
      const LaneVector on_segment = at(nearest_to(in_box));
      Float4 from_start{}, from_end{}, squared{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Float4 x = on_segment[axis];
        const Float4 m = max4(x - high[axis], Float4{}) + min4(x - low[axis], Float4{});
        const Float4 support = m > Float4{} ? high[axis] : low[axis];
        from_start += m * (start_[axis] - support);
        from_end += m * (end_[axis] - support);
        squared += m * m;
      }
      const Float4 bound = max4(bound_along(min4(from_start, from_end), squared), gaps);
      __builtin_memcpy(bounds.data() + i, &bound, sizeof bound);
    }
  }

  /// Bounds of the triangles; of no meaning for an empty lane. The better of two: along the normal,
  /// and along the direction to the segment from the nearest point of the triangle's box.
  void bound(const TriangleBlock& block, LaneDistances& bounds) const {
    for (std::size_t i = 0; i < kWidth; i += 4) {
      LaneVector v0, e1, e2, middle;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        v0[axis] = load4(block.v0[axis] + i);
        e1[axis] = load4(block.e1[axis] + i);
        e2[axis] = load4(block.e2[axis] + i);
        middle[axis] = v0[axis] + (1.0F / 3.0F) * (e1[axis] + e2[axis]);
      }
      const LaneVector on_segment = at(nearest_to(middle));
      LaneVector from_box, normal;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Float4 to_0 = on_segment[axis] - v0[axis];
        const Float4 least = min4(to_0, min4(to_0 - e1[axis], to_0 - e2[axis]));
        const Float4 most = max4(to_0, max4(to_0 - e1[axis], to_0 - e2[axis]));
        from_box[axis] = max4(least, Float4{}) + min4(most, Float4{});
        const std::size_t y = (axis + 1) % 3, z = (axis + 2) % 3;
        normal[axis] = e1[y] * e2[z] - e1[z] * e2[y];
      }
      const Range box_side = heights(from_box, v0, e1, e2);
      const Range plane_side = heights(normal, v0, e1, e2);
      const Float4 bound =
          max4(bound_along(box_side.least, box_side.squared),
               bound_along(max4(plane_side.least, -plane_side.most), plane_side.squared));
      __builtin_memcpy(bounds.data() + i, &bound, sizeof bound);
    }
  }

 private:
  /// Of m · (end − corner) over both ends and all corners; and m · m.
  struct Range {
    Float4 least, most, squared;
  };

  Range heights(const LaneVector& m, const LaneVector& v0, const LaneVector& e1,
                const LaneVector& e2) const {
    Float4 start_0{}, start_1{}, start_2{}, end_0{}, end_1{}, end_2{}, squared{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Float4 from_start = start_[axis] - v0[axis];
      const Float4 from_end = end_[axis] - v0[axis];
      start_0 += m[axis] * from_start;
      start_1 += m[axis] * (from_start - e1[axis]);
      start_2 += m[axis] * (from_start - e2[axis]);
      end_0 += m[axis] * from_end;
      end_1 += m[axis] * (from_end - e1[axis]);
      end_2 += m[axis] * (from_end - e2[axis]);
      squared += m[axis] * m[axis];
    }
    return {min4(min4(min4(start_0, start_1), start_2), min4(min4(end_0, end_1), end_2)),
            max4(max4(max4(start_0, start_1), start_2), max4(max4(end_0, end_1), end_2)), squared};
  }

  /// Where along the segment it is nearest to the points, 0 to 1; 1 for NaN.
  Float4 nearest_to(const LaneVector& points) const {
    Float4 t{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      t += per_length_[axis] * (points[axis] - start_[axis]);
    }
    return max4(min4(t, all4(1.0F)), Float4{});
  }

  LaneVector at(Float4 t) const {
    return {start_[0] + t * along_[0], start_[1] + t * along_[1], start_[2] + t * along_[2]};
  }

  static LaneVector clamped(const LaneVector& x, const LaneVector& low, const LaneVector& high) {
    return {max4(min4(x[0], high[0]), low[0]), max4(min4(x[1], high[1]), low[1]),
            max4(min4(x[2], high[2]), low[2])};
  }

  LaneVector start_, end_;
  LaneVector along_;       ///< end − start
  LaneVector per_length_;  ///< along / |along|²
  NearnessLimit limit_;
};

}  // namespace bathyal::scene
