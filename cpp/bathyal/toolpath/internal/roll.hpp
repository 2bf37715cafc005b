// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "bathyal/toolpath/internal/ball.hpp"

namespace bathyal::toolpath {

/// One place of the ball on its way. Two with one centre: there the ball touches two triangles, and
/// goes from the one to the other.
struct Rest {
  Vec3 centre = Vec3::Zero();
  Vec3 touch = Vec3::Zero();      ///< on the bottom
  Vec3 approach = Vec3::UnitZ();  ///< unit, from the touch to the centre
  Vec3 travel = Vec3::Zero();     ///< unit, the way the centre goes on
  std::int32_t mesh = -1;
  std::int32_t triangle = -1;
  std::int32_t segment = 0;
  bool is_turn = false;      ///< the approach jumps from the rest before
  bool is_backward = false;  ///< on a leg rolled against its sense
};

/// The upright plane the ball's centre keeps to.
struct RollingPlane {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitY();  ///< unit
  double sense = 1.0;           ///< travel = sense · normal × approach's part in the plane

  Vec3 onto(const Vec3& p) const { return p - normal.dot(p - point) * normal; }
  Vec3 within(const Vec3& v) const { return v - normal.dot(v) * normal; }
};

/// The ball's way over the scene, its centre in the plane, from `start` to `goal`, both free and
/// touching. The centres that a triangle forbids are the cut of the plane through the triangle's
/// points thickened by the radius, a convex region bounded by straight pieces (over its face), arcs
/// of ellipses (over its edges) and of circles (over its corners); the way is the outline of the
/// union of all these regions, followed from `start`: along one triangle's region, each centre
/// solved for by Newton's method from outside, up to the first point where another triangle is
/// touched too (found by bracketing on that triangle's distance), and on along that one's.
///
/// Centres are no further apart than a tenth of the radius where they do not lie on a line, and the
/// approach turns by no more than 0.1 rad between them. None where the way does not lead there
/// within `longest` [m].
std::optional<std::vector<Rest>> roll(const Ball& ball, const RollingPlane& plane,
                                      const Vec3& start, const Vec3& goal, double longest);

/// Adds a rest; one on a straight line between its neighbours over one triangle is left out.
void append_rest(std::vector<Rest>& rests, const Rest& rest);

/// The centre nearest to `near` along the direction that is just free of the triangle, in the plane
/// through `near` that `normal` is across; none where the triangle is touched sideways.
std::optional<Vec3> settle(const Ball& ball, const RollingPlane& plane, std::int32_t mesh,
                           std::int32_t triangle, Vec3 near);

}  // namespace bathyal::toolpath
