// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/toolpath/coverage.hpp"

namespace bathyal::toolpath {

using PlanPoint = Eigen::Vector2d;
using PolygonCorners = std::vector<PlanPoint>;

inline double cross2(const PlanPoint& a, const PlanPoint& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Part of a line, from low to high along it.
struct Interval {
  double low, high;
};

/// The corners about `origin`, turned by −direction so that lines of that direction run along x;
/// repeated corners are dropped.
/// \throw std::invalid_argument as cover_polygon.
PolygonCorners corners_along(const Polygon& polygon, const PlanPoint& origin, double direction);

/// Parts of the line y = `y` inside the polygon and at least `margin` from every edge, rising.
std::vector<Interval> stretches(const PolygonCorners& corners, double y, double margin);

}  // namespace bathyal::toolpath
