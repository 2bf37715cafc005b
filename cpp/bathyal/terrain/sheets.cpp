// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/terrain/sheets.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>

#include "bathyal/base/check.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/terrain/internal/plan_grid.hpp"
#include "bathyal/terrain/internal/sheet_search.hpp"

namespace bathyal {
namespace {

using namespace terrain;

constexpr double kLargest = 1e75;              // so that squares and their sums stay finite
constexpr double kNeighbourhoodPoints = 2.25;  // cells of 1.5 spacings
constexpr int kMinSeeds = 3;                   // one or two alone occur by chance

std::size_t root(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

/// Groups cells that touch, by side or by corner; each group in order of its cells.
std::vector<std::vector<std::size_t>> connect(const PlanGrid& grid,
                                              const std::vector<SheetCell>& found) {
  constexpr auto kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> of_cell(grid.cells().size(), kNone);
  for (std::size_t i = 0; i < found.size(); ++i) of_cell[found[i].cell] = i;
  std::vector<std::size_t> parent(found.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (const auto& run : grid.neighbours(found[i].cell)) {
      for (const PlanGrid::Cell& cell : run) {
        const std::size_t j = of_cell[static_cast<std::size_t>(&cell - grid.cells().data())];
        if (j == kNone) continue;
        const std::size_t a = root(parent, i);
        const std::size_t b = root(parent, j);
        parent[std::max(a, b)] = std::min(a, b);
      }
    }
  }
  std::vector<std::vector<std::size_t>> groups(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) groups[root(parent, i)].push_back(i);
  std::erase_if(groups, [](const auto& group) { return group.empty(); });
  return groups;
}

/// Adds the patch that `group` forms, and its cells to `kept`; nothing when there is too little of
/// it.
void add_patch(const PlanGrid& grid, const SheetSearch& search,
               const std::vector<std::size_t>& group, int min_points,
               std::vector<std::size_t>& kept, SheetReport& report) {
  SheetPatch patch;
  patch.low.setConstant(std::numeric_limits<double>::infinity());
  patch.high = -patch.low;
  int seeds = 0, lower = 0, upper = 0;
  std::vector<double> separations;
  for (const std::size_t i : group) {
    const SheetCell& found = search.found[i];
    seeds += found.seed;
    separations.push_back(found.separation);
    const PlanGrid::Cell& cell = grid.cells()[found.cell];
    for (std::size_t row = cell.begin; row < cell.end; ++row) {
      if (search.sheet[row] == 0) continue;
      lower += (search.sheet[row] & SheetSearch::kLower) != 0;
      upper += (search.sheet[row] & SheetSearch::kUpper) != 0;
      const PlanGrid::Point& p = grid.points()[row];
      patch.low = patch.low.cwiseMin(Vec3(p.x, p.y, p.z));
      patch.high = patch.high.cwiseMax(Vec3(p.x, p.y, p.z));
      ++patch.point_count;
    }
  }
  if (seeds < kMinSeeds || lower < min_points || upper < min_points) return;
  patch.low += grid.origin();
  patch.high += grid.origin();
  patch.area = static_cast<double>(group.size()) * grid.cell_size() * grid.cell_size();
  const auto middle = separations.begin() + static_cast<std::ptrdiff_t>(separations.size() / 2);
  std::nth_element(separations.begin(), middle, separations.end());
  patch.separation = *middle;
  report.patches.push_back(patch);
  kept.insert(kept.end(), group.begin(), group.end());
}

void write_cells(const PlanGrid& grid, const std::vector<SheetCell>& found,
                 std::vector<std::size_t>& kept, SheetReport& report) {
  std::sort(kept.begin(), kept.end());
  PointMatrix cells(static_cast<Index>(kept.size()), 3);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const SheetCell& at = found[kept[i]];
    const auto [x, y] = grid.centre(grid.cells()[at.cell]);
    cells.row(static_cast<Index>(i)) =
        Vec3(x, y, at.middle).transpose() + grid.origin().transpose();
    report.separation.push_back(at.separation);
  }
  report.cells = std::move(cells);
}

std::string rounded(double value, const char* format) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

}  // namespace

void FindSheetsOptions::check() const {
  check_not_negative("min_separation", min_separation);
  if (min_points < 5) throw_argument("min_points", "5 or more", std::to_string(min_points));
  resolve_threads(num_threads);
}

SheetReport find_sheets(PointView points, const FindSheetsOptions& options) {
  options.check();
  check_points_finite("points", points);
  SheetReport report;
  if (points.rows() < 2 * options.min_points) return report;
  const double largest = points.cwiseAbs().maxCoeff();
  if (largest > kLargest) {
    throw_argument("points", "coordinates of 1e75 at most", to_text(largest));
  }

  const PlanGrid grid(points, kNeighbourhoodPoints);
  const double cell_area = grid.cell_size() * grid.cell_size();
  report.cell_size = grid.cell_size();
  report.covered_area = static_cast<double>(grid.cells().size()) * cell_area;
  report.spacing = std::sqrt(report.covered_area / static_cast<double>(points.rows()));
  report.noise = measure_noise(grid);
  report.min_separation = options.min_separation > 0.0
                              ? options.min_separation
                              : std::max(6.0 * report.noise, report.spacing);

  const SheetSearch search = search_sheets(grid, report.min_separation, options.num_threads);
  std::vector<std::size_t> kept;
  for (const auto& group : connect(grid, search.found)) {
    add_patch(grid, search, group, options.min_points, kept, report);
  }
  std::stable_sort(report.patches.begin(), report.patches.end(),
                   [](const SheetPatch& a, const SheetPatch& b) { return a.area > b.area; });
  report.sheet_area = static_cast<double>(kept.size()) * cell_area;
  write_cells(grid, search.found, kept, report);
  return report;
}

std::string describe(const SheetReport& report) {
  if (report.single_valued()) return "The cloud is a height field: one sheet over every (x, y).";
  const SheetPatch& largest = report.patches.front();
  const Vec3 middle = 0.5 * (largest.low + largest.high);
  const std::size_t places = report.patches.size();
  return "The cloud has several sheets over one (x, y) on " +
         rounded(100.0 * report.share(), "%.1f") + " % of its area (" +
         rounded(report.sheet_area, "%.3g") + " m²), in " + std::to_string(places) +
         (places == 1 ? " place" : " places") + "; the largest, " + rounded(largest.area, "%.3g") +
         " m² about x = " + rounded(middle.x(), "%.2f") + ", y = " + rounded(middle.y(), "%.2f") +
         ", has its sheets " + rounded(largest.separation, "%.3g") + " m apart.";
}

}  // namespace bathyal
