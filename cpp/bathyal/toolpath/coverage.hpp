// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/toolpath/targets.hpp"

namespace bathyal {

/// Corners (x, y) of a polygon in the world, in either sense of rotation.
using Polygon = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

struct CoverOptions {
  double direction = 0.0;  ///< of the lines, from the world's x towards y [rad]
  double margin = 0.0;     ///< kept from the polygon's edges [m], 0 or more

  void check() const;
};

/// Aims that mow a polygon: for every straight stretch two axes straight down, at its beginning and
/// its end, from 1 m above the highest point of the bottom there; plan_toolpath joins them along
/// the bottom.
///
/// Lines lie at equal distances no wider than `spacing` [m], the outermost half of that distance
/// inside the polygon (less the margin), so that a tool as wide as the spacing leaves nothing out.
/// Every point of a line is at least `margin` from every edge. A concave polygon is cut into cells
/// in which each line has one stretch; a cell is mown to and fro before the next one is begun, and
/// the way to the next one may leave the polygon.
///
/// A closing corner equal to the first and repeated corners are dropped. Where the margin leaves
/// nothing of the polygon there are no aims.
/// \throw std::invalid_argument for a spacing that is not above 0 or gives more than a million
/// lines, fewer than three corners, corners that are not finite, a polygon without area or one that
/// crosses itself, an upright plane or a scene without triangles.
Aims cover_polygon(const Surface& surface, const Polygon& polygon, double spacing,
                   const CoverOptions& options = {});

}  // namespace bathyal
