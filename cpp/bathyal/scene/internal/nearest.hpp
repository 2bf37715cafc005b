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

/// Takes the foot of the perpendicular where it falls inside the triangle, else the best of the
/// three edges; a triangle without area is its edges. Edges are walked from the end with the lower
/// x, y, z, so that triangles that share one find the same bytes on it.
ClosestPoint closest_point(const std::array<Vec3, 3>& corners, const Vec3& query);

}  // namespace bathyal::scene
