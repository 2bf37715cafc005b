// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/toolpath/coverage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "bathyal/base/check.hpp"
#include "bathyal/toolpath/internal/polygon.hpp"

namespace bathyal {
namespace {

using namespace toolpath;

constexpr double kClearance = 1.0;  // above the highest point of the bottom [m]

/// One line's only stretch in a cell.
struct Stretch {
  double y, low, high;
};
using Cell = std::vector<Stretch>;

/// Chains stretches of neighbouring lines: at a fork of the polygon new cells begin, at a join one
/// of them goes on (after the boustrophedon cells of Choset 2000).
std::vector<Cell> cells_of(const std::vector<std::pair<double, std::vector<Interval>>>& lines) {
  std::vector<Cell> cells;
  std::vector<std::size_t> open;  // cell of each stretch of the line before
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const auto& [y, intervals] = lines[l];
    const auto touches = [](const Interval& a, const Interval& b) {
      return a.low < b.high && b.low < a.high;
    };
    std::vector<std::size_t> now;
    for (const Interval& interval : intervals) {
      std::size_t cell = cells.size();
      for (std::size_t k = 0; k < open.size(); ++k) {
        const Interval& before = lines[l - 1].second[k];
        if (!touches(before, interval)) continue;
        const auto above = std::count_if(intervals.begin(), intervals.end(),
                                         [&](const Interval& i) { return touches(before, i); });
        if (above == 1) cell = open[k];
      }
      if (cell == cells.size()) cells.emplace_back();
      cells[cell].push_back({y, interval.low, interval.high});
      now.push_back(cell);
    }
    open = std::move(now);
  }
  return cells;
}

/// The four ends of a cell's first and last line: where mowing it may begin.
std::array<PlanPoint, 4> entries_of(const Cell& cell) {
  return {PlanPoint(cell.front().low, cell.front().y), PlanPoint(cell.front().high, cell.front().y),
          PlanPoint(cell.back().low, cell.back().y), PlanPoint(cell.back().high, cell.back().y)};
}

/// To and fro through each cell, each time on to the nearest entry of those not yet mown.
std::vector<PlanPoint> mow(std::vector<Cell> cells) {
  std::vector<PlanPoint> ends;
  while (!cells.empty()) {
    std::size_t next = 0, entry = 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < cells.size() && (c == 0 || !ends.empty()); ++c) {
      const auto entries = entries_of(cells[c]);
      for (std::size_t k = 0; k < entries.size(); ++k) {
        const double distance = (entries[k] - (ends.empty() ? entries[0] : ends.back())).norm();
        if (distance >= nearest) continue;
        nearest = distance;
        next = c;
        entry = k;
      }
    }
    Cell cell = std::move(cells[next]);
    cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(next));
    if (entry >= 2) std::reverse(cell.begin(), cell.end());
    bool to = entry % 2 == 0;
    for (const Stretch& s : cell) {
      ends.emplace_back(to ? s.low : s.high, s.y);
      ends.emplace_back(to ? s.high : s.low, s.y);
      to = !to;
    }
  }
  return ends;
}

/// A height above the bottom everywhere (a scene) or at (x, y) (a plane that is not upright).
double height_above(const Surface& surface, const PlanPoint& at) {
  if (const auto* plane = std::get_if<Plane>(&surface)) {
    const Vec3& m = plane->normal();
    return (plane->offset() - m.x() * at.x() - m.y() * at.y()) / m.z() + kClearance;
  }
  double top = -std::numeric_limits<double>::infinity();
  const auto& scene = std::get<Scene>(surface);
  for (std::int32_t m = 0; m < scene.row_count(); ++m) {
    const TriangleMesh mesh = scene.mesh_in_world(m);
    if (mesh.triangle_count() > 0) top = std::max(top, mesh.vertices().col(2).maxCoeff());
  }
  return top + kClearance;
}

void check_surface(const Surface& surface) {
  if (const auto* plane = std::get_if<Plane>(&surface)) {
    if (std::abs(plane->normal().z()) < 1e-9) {
      throw_argument("surface", "a plane that is not upright",
                     "a normal with z = " + to_text(plane->normal().z()));
    }
    return;
  }
  for (const TriangleMesh& mesh : std::get<Scene>(surface).meshes()) {
    if (mesh.triangle_count() > 0) return;
  }
  throw_argument("surface", "a scene with triangles", "none");
}

}  // namespace

void CoverOptions::check() const {
  check_finite("direction", direction);
  check_not_negative("margin", margin);
}

Aims cover_polygon(const Surface& surface, const Polygon& polygon, double spacing,
                   const CoverOptions& options) {
  options.check();
  check_positive("spacing", spacing);
  check_surface(surface);
  const PlanPoint origin = polygon.rows() > 0 ? PlanPoint(polygon.row(0)) : PlanPoint(0.0, 0.0);
  const PolygonCorners corners = corners_along(polygon, origin, options.direction);

  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const PlanPoint& corner : corners) {
    low = std::min(low, corner.y() + options.margin);
    high = std::max(high, corner.y() - options.margin);
  }
  std::vector<std::pair<double, std::vector<Interval>>> lines;
  if (low < high) {
    constexpr double kMostLines = 1e6;
    const double wanted = std::ceil((high - low) / spacing * (1.0 - 1e-12));
    if (wanted > kMostLines) {
      throw_argument("spacing", "lines no more than " + to_text(kMostLines), to_text(wanted));
    }
    for (double k = 0.5; k < wanted; k += 1.0) {
      const double y = low + k * (high - low) / wanted;
      lines.emplace_back(y, stretches(corners, y, options.margin));
    }
  }
  const std::vector<PlanPoint> ends = mow(cells_of(lines));

  Aims aims(static_cast<Index>(ends.size()), 6);
  const double scene_top =
      std::holds_alternative<Scene>(surface) ? height_above(surface, origin) : 0.0;
  for (Index i = 0; i < aims.rows(); ++i) {
    const PlanPoint at =
        origin + Eigen::Rotation2Dd(options.direction) * ends[static_cast<std::size_t>(i)];
    const double z = std::holds_alternative<Scene>(surface) ? scene_top : height_above(surface, at);
    aims.row(i) << at.x(), at.y(), z, 0.0, 0.0, -1.0;
  }
  return aims;
}

}  // namespace bathyal
