// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "bathyal/terrain/internal/plan_grid.hpp"

namespace bathyal::terrain {

/// More points of one neighbourhood than this are not looked at.
inline constexpr std::size_t kMaxNeighbourhood = 256;

/// Two sheets found in one neighbourhood: which sheet each point is on, and how far they are apart.
struct TwoSheets {
  bool found = false;
  bool seed = false;        ///< clear enough to start a patch, not only to widen one
  double separation = 0.0;  ///< mean vertical distance of the two planes [m]
  double middle = 0.0;      ///< height half-way between them [m]
  std::array<std::uint8_t, kMaxNeighbourhood> upper{};  ///< 1 for points of the upper sheet
};

/// rms of the points about the one or two planes they lie on, with the degrees of freedom taken off
/// [m]: the scatter that stays when a second sheet, should there be one, is not mistaken for it. 0
/// for three points or fewer.
double rms_about_sheets(std::span<const PlanGrid::Point> points);

/// Conditions 1 and 2 of find_sheets for the points of one neighbourhood, kMaxNeighbourhood at
/// most.
TwoSheets split_into_sheets(std::span<const PlanGrid::Point> points, double min_separation);

}  // namespace bathyal::terrain
