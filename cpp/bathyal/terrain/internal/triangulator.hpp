// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "bathyal/base/page_allocator.hpp"
#include "bathyal/geometry/predicates.hpp"

namespace bathyal::terrain {

/// Three vertices, counter-clockwise. Outside the hull one of them is kGhost.
using Corners = std::array<std::int32_t, 3>;

/// The vertex at infinity: every hull edge has a triangle with it, so that each triangle has three
/// neighbours.
inline constexpr std::int32_t kGhost = -1;

inline bool is_ghost(const Corners& t) { return (t[0] | t[1] | t[2]) < 0; }

/// The Delaunay triangulation, made unique by in_perturbed_circle, of `points[vertices[i]]`, which
/// are distinct and in an order that keeps neighbours close. Ghost triangles included: 2 n − 2 in
/// all. Empty when there are fewer than three points or all lie on one line.
///
/// Incremental (Bowyer 1981, Watson 1981): each point is found by walking from the last one and the
/// triangles whose circle it lies in give way to a star around it. Points are taken in rounds of
/// random thinning, coarse first, each in the order given (Amenta, Choi, Rote 2003), which
/// guards against the arrangements that would make it quadratic.
PageVector<Corners> triangulate_points(std::span<const Point2> points,
                                       std::span<const std::int32_t> vertices);

}  // namespace bathyal::terrain
