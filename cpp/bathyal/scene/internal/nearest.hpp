// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "bathyal/geometry/shared_array.hpp"

namespace bathyal::scene {

/// The point of a triangle closest to a query, with the weights of corners 1 and 2.
struct ClosestPoint {
  double squared_distance = 0.0;  ///< [m²], of `point` as stored, rounding included
  Vec3 point = Vec3::Zero();
  double u = 0.0;
  double v = 0.0;
};

/// The point of an edge closest to a query.
struct OnEdge {
  double squared_distance;
  Vec3 point;
  double t;  ///< where between its two ends the point lies: 0 at the first, 1 at the second
};

/// Walks the edge from the end with the lower x, y, z: the same point whichever end is named first.
OnEdge closest_on_edge(const Vec3& from, const Vec3& to, const Vec3& query);

/// Takes the foot of the perpendicular where it falls inside the triangle, else the best of the
/// three edges; a triangle without area is its edges. Edges are walked from the end with the lower
/// x, y, z, so that triangles that share one find the same bytes on it.
ClosestPoint closest_point(const std::array<Vec3, 3>& corners, const Vec3& query);

}  // namespace bathyal::scene
