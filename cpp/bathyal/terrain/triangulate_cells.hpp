// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bathyal/geometry/predicates.hpp"

namespace bathyal {

/// Three points, counter-clockwise.
using Corners = std::array<std::int32_t, 3>;

/// All triangles of the unique Delaunay triangulation of distinct points that stand in an order
/// which keeps neighbours close; empty when there is none. Any number of cells, 1 or more, and of
/// threads gives the same triangles in the same order.
std::vector<Corners> triangulate_in_cells(std::span<const Point2> points, int cells,
                                          int num_threads);

}  // namespace bathyal
