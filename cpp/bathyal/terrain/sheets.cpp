// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/terrain/sheets.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>

#include "bathyal/base/check.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/terrain/plan_grid.hpp"
#include "bathyal/terrain/two_sheets.hpp"

namespace bathyal {
namespace {

constexpr double kPointsPerCell = 2.25;  // cells of 1.5 spacings
constexpr int kMinSeeds = 3;             // one or two alone are chance
constexpr std::size_t kMaxNeighbourhood = 256;
constexpr std::size_t kGrain = 2048;

/// What one cell's neighbourhood says.
struct Finding {
  std::size_t cell;
  bool seed;
  double separation, middle;
  std::vector<std::size_t> lower, upper;  ///< rows of PlanGrid::points()
};

/// A neighbourhood's points and where each stands in PlanGrid::points(). A place with very many
/// points is thinned evenly.
struct Neighbourhood {
  std::vector<PlanGrid::Point> points;
  std::vector<std::size_t> rows;
};

void gather(const PlanGrid& grid, std::size_t cell, Neighbourhood& out) {
  out.points.clear();
  out.rows.clear();
  std::size_t count = 0;
  const auto runs = grid.neighbours(cell);
  for (const auto& run : runs) count += grid.points_of(run).size();
  const std::size_t step = (count + kMaxNeighbourhood - 1) / kMaxNeighbourhood;
  std::size_t seen = 0;
  for (const auto& run : runs) {
    for (const PlanGrid::Point& p : grid.points_of(run)) {
      if (seen++ % step != 0) continue;
      out.points.push_back(p);
      out.rows.push_back(static_cast<std::size_t>(&p - grid.points().data()));
    }
  }
}

/// Median, over evenly chosen neighbourhoods, of the rms about the local plane.
double measure_noise(const PlanGrid& grid) {
  const std::size_t step = std::max<std::size_t>(1, grid.cells().size() / 4000);
  std::vector<double> rms;
  Neighbourhood around;
  for (std::size_t cell = 0; cell < grid.cells().size(); cell += step) {
    gather(grid, cell, around);
    if (around.points.size() > 9) rms.push_back(rms_about_sheets(around.points));
  }
  if (rms.empty()) return 0.0;
  const auto middle = rms.begin() + static_cast<std::ptrdiff_t>(rms.size() / 2);
  std::nth_element(rms.begin(), middle, rms.end());
  return *middle;
}

struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

std::vector<Finding> search(const PlanGrid& grid, double min_separation, int num_threads) {
  const auto& cells = grid.cells();
  std::vector<Span> heights(cells.size());
  parallel_for(cells.size(), kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      for (std::size_t i = cells[c].begin; i < cells[c].end; ++i) {
        heights[c].low = std::min(heights[c].low, grid.points()[i].z);
        heights[c].high = std::max(heights[c].high, grid.points()[i].z);
      }
    }
  });
  std::vector<std::vector<Finding>> found((cells.size() + kGrain - 1) / kGrain);
  parallel_for(cells.size(), kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    Neighbourhood around;
    for (std::size_t c = begin; c < end; ++c) {
      Span span;
      for (const auto& run : grid.neighbours(c)) {
        for (const PlanGrid::Cell& cell : run) {
          const Span& of_cell = heights[static_cast<std::size_t>(&cell - cells.data())];
          span.low = std::min(span.low, of_cell.low);
          span.high = std::max(span.high, of_cell.high);
        }
      }
      if (span.high - span.low < min_separation) continue;
      gather(grid, c, around);
      const TwoSheets sheets = split_into_sheets(around.points, min_separation);
      if (!sheets.found) continue;
      Finding finding{c, sheets.seed, sheets.separation, sheets.middle, {}, {}};
      for (std::size_t i = 0; i < sheets.upper.size(); ++i) {
        (sheets.upper[i] != 0 ? finding.upper : finding.lower).push_back(around.rows[i]);
      }
      found[begin / kGrain].push_back(std::move(finding));
    }
  });
  std::vector<Finding> all;
  for (auto& part : found) std::move(part.begin(), part.end(), std::back_inserter(all));
  return all;
}

std::size_t root(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

/// Groups findings whose cells touch, by side or by corner; each group in order of its cells.
std::vector<std::vector<std::size_t>> connect(const PlanGrid& grid,
                                              const std::vector<Finding>& findings) {
  constexpr auto kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> of_cell(grid.cells().size(), kNone);
  for (std::size_t i = 0; i < findings.size(); ++i) of_cell[findings[i].cell] = i;
  std::vector<std::size_t> parent(findings.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  for (std::size_t i = 0; i < findings.size(); ++i) {
    for (const auto& run : grid.neighbours(findings[i].cell)) {
      for (const PlanGrid::Cell& cell : run) {
        const std::size_t j = of_cell[static_cast<std::size_t>(&cell - grid.cells().data())];
        if (j == kNone) continue;
        const std::size_t a = root(parent, i);
        const std::size_t b = root(parent, j);
        parent[std::max(a, b)] = std::min(a, b);
      }
    }
  }
  std::vector<std::vector<std::size_t>> groups(findings.size());
  for (std::size_t i = 0; i < findings.size(); ++i) groups[root(parent, i)].push_back(i);
  std::erase_if(groups, [](const auto& group) { return group.empty(); });
  return groups;
}

std::size_t count_distinct(std::vector<std::size_t>& rows) {
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows.size();
}

/// Adds the patch that `group` forms, and its cells; nothing when either sheet is too thin.
void add_patch(const PlanGrid& grid, const std::vector<Finding>& findings,
               const std::vector<std::size_t>& group, int min_points,
               std::vector<std::size_t>& kept, SheetReport& report) {
  std::vector<std::size_t> lower, upper;
  std::vector<double> separations;
  int seeds = 0;
  for (const std::size_t i : group) {
    lower.insert(lower.end(), findings[i].lower.begin(), findings[i].lower.end());
    upper.insert(upper.end(), findings[i].upper.begin(), findings[i].upper.end());
    separations.push_back(findings[i].separation);
    seeds += findings[i].seed;
  }
  const auto least = static_cast<std::size_t>(min_points);
  if (seeds < kMinSeeds || count_distinct(lower) < least || count_distinct(upper) < least) return;
  lower.insert(lower.end(), upper.begin(), upper.end());
  SheetPatch patch;
  patch.point_count = static_cast<Index>(count_distinct(lower));
  patch.low.setConstant(std::numeric_limits<double>::infinity());
  patch.high = -patch.low;
  for (const std::size_t row : lower) {
    const PlanGrid::Point& p = grid.points()[row];
    patch.low = patch.low.cwiseMin(Vec3(p.x, p.y, p.z));
    patch.high = patch.high.cwiseMax(Vec3(p.x, p.y, p.z));
  }
  patch.low += grid.origin();
  patch.high += grid.origin();
  patch.area = static_cast<double>(group.size()) * grid.cell_size() * grid.cell_size();
  const auto middle = separations.begin() + static_cast<std::ptrdiff_t>(separations.size() / 2);
  std::nth_element(separations.begin(), middle, separations.end());
  patch.separation = *middle;
  report.patches.push_back(patch);
  kept.insert(kept.end(), group.begin(), group.end());
}

void write_cells(const PlanGrid& grid, const std::vector<Finding>& findings,
                 std::vector<std::size_t>& kept, SheetReport& report) {
  std::sort(kept.begin(), kept.end());
  PointMatrix cells(static_cast<Index>(kept.size()), 3);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const Finding& finding = findings[kept[i]];
    const auto [x, y] = grid.centre(grid.cells()[finding.cell]);
    cells.row(static_cast<Index>(i)) =
        Vec3(x, y, finding.middle).transpose() + grid.origin().transpose();
    report.separation.push_back(finding.separation);
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
  if (min_points < 12) throw_argument("min_points", "12 or more", std::to_string(min_points));
  resolve_threads(num_threads);
}

SheetReport find_sheets(PointView points, const FindSheetsOptions& options) {
  options.check();
  check_points_finite("points", points);
  SheetReport report;
  if (points.rows() < 2 * options.min_points) return report;

  const PlanGrid grid(points, kPointsPerCell);
  const double cell_area = grid.cell_size() * grid.cell_size();
  report.cell_size = grid.cell_size();
  report.covered_area = static_cast<double>(grid.cells().size()) * cell_area;
  report.spacing = std::sqrt(report.covered_area / static_cast<double>(points.rows()));
  report.noise = measure_noise(grid);
  report.min_separation = options.min_separation > 0.0
                              ? options.min_separation
                              : std::max(6.0 * report.noise, report.spacing);

  const std::vector<Finding> findings = search(grid, report.min_separation, options.num_threads);
  std::vector<std::size_t> kept;
  for (const auto& group : connect(grid, findings)) {
    add_patch(grid, findings, group, options.min_points, kept, report);
  }
  std::stable_sort(report.patches.begin(), report.patches.end(),
                   [](const SheetPatch& a, const SheetPatch& b) { return a.area > b.area; });
  report.sheet_area = static_cast<double>(kept.size()) * cell_area;
  write_cells(grid, findings, kept, report);
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
