// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "bathyal/terrain/internal/plan_grid.hpp"

namespace bathyal::terrain {

/// A cell whose neighbourhood has two sheets.
struct SheetCell {
  std::size_t cell;  ///< of PlanGrid::cells()
  bool seed;         ///< clear enough to start a patch
  double separation, middle;
};

/// All cells under two sheets, in order, and the sheet of each point.
struct SheetSearch {
  std::vector<SheetCell> found;
  std::vector<std::uint8_t> sheet;  ///< by row of PlanGrid::points(): kLower and kUpper, or both
  static constexpr std::uint8_t kLower = 1, kUpper = 2;
};

/// Looks at one cell in each block of two by two, then at the neighbours of every cell found.
SheetSearch search_sheets(const PlanGrid& grid, double min_separation, int num_threads);

/// Median, over about a thousand neighbourhoods, of the rms about the planes that they lie on [m].
double measure_noise(const PlanGrid& grid);

}  // namespace bathyal::terrain
