// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/terrain/triangulate_cells.hpp"

#include <algorithm>
#include <numeric>

#include "bathyal/terrain/triangulator.hpp"

namespace bathyal {

std::vector<Corners> triangulate_in_cells(std::span<const Point2> points, int /*cells*/,
                                          int /*num_threads*/) {
  std::vector<std::int32_t> all(points.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<Corners> corners;
  for (const LinkedTriangle& t : triangulate_points(points, all)) {
    if (is_ghost(t)) continue;
    Corners c = t.vertex;
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
    corners.push_back(c);
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

}  // namespace bathyal
