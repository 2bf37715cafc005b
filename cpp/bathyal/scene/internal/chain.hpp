// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "bathyal/scene/scene.hpp"

namespace bathyal::scene {

/// A straight piece of a section, between two rows of a list of points.
struct CutSegment {
  std::array<std::int32_t, 2> ends{};
  std::int32_t mesh = -1;
  std::int32_t triangle = -1;
};

/// Joins segments that share a point into polylines; every segment lands in exactly one of them.
/// Where more than two meet, a line goes on into the one that turns least and one without a partner
/// ends, so lines end only where an odd number of segments meet. The result does not depend on the
/// order of the segments: an open line starts at the end that comes first along `along` (then by
/// x, y, z), a closed one at its first point and runs counter-clockwise seen from the side `normal`
/// points to; lines are sorted by mesh, then by where they start.
/// \pre Points are distinct within a mesh and a point serves one mesh only; no segment is listed
/// twice or joins a point to itself.
std::vector<Polyline> chain_segments(const std::vector<Vec3>& points,
                                     const std::vector<CutSegment>& segments, const Vec3& along,
                                     const Vec3& normal);

}  // namespace bathyal::scene
