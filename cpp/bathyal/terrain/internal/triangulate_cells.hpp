// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "bathyal/geometry/predicates.hpp"
#include "bathyal/geometry/shared_array.hpp"

namespace bathyal::terrain {

/// The unique Delaunay triangulation of distinct points, in an order that keeps neighbours close:
/// rows of `points`, counter-clockwise, each triangle beginning with its lowest, ordered by row.
/// Empty when all points lie on one line.
///
/// The plane is cut into `cells` boxes of about as many points, 1 or more, which are triangulated
/// side by side. A triangle whose circle stays within its box is final; the vertices of all others
/// are triangulated once more, together, and this fills what is not yet covered (Funke, Sanders
/// 2017). Because the triangulation is unique, any number of cells and threads gives the same.
TriangleMatrix triangulate_in_cells(std::span<const Point2> points, int cells, int num_threads);

}  // namespace bathyal::terrain
