// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "bathyal/scene/internal/boxes.hpp"
#include "bathyal/scene/internal/hierarchy.hpp"
#include "bathyal/scene/internal/local_frame.hpp"

namespace bathyal::scene {

/// Items [first, first + count) that lie in one cell of a grid.
struct Cell {
  std::uint32_t first;
  std::uint32_t count;
};

/// One box an item (first tag 1, second tag the primitive or row), sorted into cells of a few
/// hundred.
struct SortedBoxes {
  PageArray<Box> items;
  std::vector<Cell> cells;
};

/// Boxes of all triangles in the local frame, sorted by the cell of a grid that their middle falls
/// into, and by primitive within a cell. The first coarse step of the build: what comes after works
/// cell by cell, in parallel and in the nearest cache.
SortedBoxes sort_into_cells(const Scene::Hierarchy& hierarchy, int num_threads);

/// The same for boxes that exist already, in `frame`.
SortedBoxes sort_into_cells(const std::vector<Box>& boxes, const LocalFrame& frame,
                            int num_threads);

}  // namespace bathyal::scene
