// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "bathyal/geometry/shared_array.hpp"

namespace bathyal::scene {

/// Largest coordinate of a segment's end [m] for which the decisions below hold.
inline constexpr double kLargestSegmentReach = 1e25;

/// Where a segment and a triangle come closest.
struct SegmentApproach {
  double squared_distance = 0.0;  ///< [m²]
  Vec3 point = Vec3::Zero();      ///< of the triangle
  double u = 0.0;                 ///< its weight of corner 1
  double v = 0.0;                 ///< its weight of corner 2
  double fraction = 0.0;          ///< along the segment: 0 at `start`, 1 at `end`
  Vec3 on_segment = Vec3::Zero();
};

/// Whether a segment and a triangle have a point in common, borders and ends included, one in the
/// plane of the other too: the exact answer for the coordinates as they are. Either may be
/// degenerate.
bool segment_meets(const std::array<Vec3, 3>& corners, const Vec3& start, const Vec3& end);

/// The least of what the segment's ends have to the triangle and the segment to its three edges,
/// and exactly 0, with one point for both, where they meet; a triangle without area is its edges.
/// Computed relative to `start`, so that survey coordinates lose no digit but in the points' own
/// rounding. Triangles that share an edge find the same bytes on it. A segment without length gives
/// the bytes of closest_point.
SegmentApproach closest_to_segment(const std::array<Vec3, 3>& corners, const Vec3& start,
                                   const Vec3& end);

}  // namespace bathyal::scene
