// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/terrain/internal/sheet_search.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>

#include "bathyal/base/parallel.hpp"
#include "bathyal/terrain/internal/two_sheets.hpp"

namespace bathyal::terrain {
namespace {

constexpr std::size_t kCellGrain = 2048;
constexpr std::size_t kNoiseSamples = 4000;

/// A neighbourhood's points and the index of each in PlanGrid::points(). A place with very many
/// points is thinned evenly.
struct Neighbourhood {
  std::array<PlanGrid::Point, kMaxNeighbourhood> storage;
  std::array<std::size_t, kMaxNeighbourhood> rows;
  std::size_t count = 0;

  void gather(const PlanGrid& grid, std::size_t cell) {
    const auto runs = grid.neighbours(cell);
    std::size_t all = 0;
    for (const auto& run : runs) all += grid.points_of(run).size();
    const std::size_t step = (all + kMaxNeighbourhood - 1) / kMaxNeighbourhood;
    count = 0;
    std::size_t seen = 0;
    for (const auto& run : runs) {
      for (const PlanGrid::Point& p : grid.points_of(run)) {
        if (seen++ % step != 0) continue;
        storage[count] = p;
        rows[count++] = static_cast<std::size_t>(&p - grid.points().data());
      }
    }
  }
  std::span<const PlanGrid::Point> points() const { return {storage.data(), count}; }
};

struct HeightRange {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

std::vector<HeightRange> heights_of_cells(const PlanGrid& grid, int num_threads) {
  const auto& cells = grid.cells();
  std::vector<HeightRange> heights(cells.size());
  parallel_for(cells.size(), kCellGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      for (std::size_t i = cells[c].begin; i < cells[c].end; ++i) {
        heights[c].low = std::min(heights[c].low, grid.points()[i].z);
        heights[c].high = std::max(heights[c].high, grid.points()[i].z);
      }
    }
  });
  return heights;
}

std::size_t index_of(const PlanGrid& grid, const PlanGrid::Cell& cell) {
  return static_cast<std::size_t>(&cell - grid.cells().data());
}

/// The first occupied cell of each block of two by two. Neighbourhoods overlap so far that no patch
/// worth reporting slips through between these.
std::vector<std::size_t> first_of_blocks(const PlanGrid& grid) {
  std::vector<std::size_t> result;
  for (std::size_t c = 0; c < grid.cells().size(); ++c) {
    const PlanGrid::Cell& cell = grid.cells()[c];
    bool first = true;
    for (const auto& run : grid.neighbours(c)) {
      for (const PlanGrid::Cell& other : run) {
        first = first && (index_of(grid, other) >= c || other.row / 2 != cell.row / 2 ||
                          other.column / 2 != cell.column / 2);
      }
    }
    if (first) result.push_back(c);
  }
  return result;
}

class Search {
 public:
  Search(const PlanGrid& grid, double min_separation, int num_threads)
      : grid_(grid),
        min_separation_(min_separation),
        num_threads_(num_threads),
        heights_(heights_of_cells(grid, num_threads)) {
    result_.sheet.resize(grid.points().size());
  }

  SheetSearch run() {
    std::vector<bool> seen(grid_.cells().size(), false);
    std::vector<std::size_t> wave = first_of_blocks(grid_);
    while (!wave.empty()) {
      for (const std::size_t cell : wave) seen[cell] = true;
      const std::size_t before = result_.found.size();
      look_at(wave);
      wave.clear();
      for (std::size_t i = before; i < result_.found.size(); ++i) {
        for (const auto& run : grid_.neighbours(result_.found[i].cell)) {
          for (const PlanGrid::Cell& cell : run) {
            const std::size_t c = index_of(grid_, cell);
            if (!seen[c]) wave.push_back(c);
            seen[c] = true;
          }
        }
      }
    }
    std::sort(result_.found.begin(), result_.found.end(),
              [](const SheetCell& a, const SheetCell& b) { return a.cell < b.cell; });
    return std::move(result_);
  }

 private:
  void look_at(const std::vector<std::size_t>& wave) {
    std::vector<std::vector<SheetCell>> found((wave.size() + kCellGrain - 1) / kCellGrain);
    parallel_for(wave.size(), kCellGrain, num_threads_, [&](std::size_t begin, std::size_t end) {
      Neighbourhood around;
      for (std::size_t i = begin; i < end; ++i) look_at(wave[i], around, found[begin / kCellGrain]);
    });
    for (const auto& part : found) {
      result_.found.insert(result_.found.end(), part.begin(), part.end());
    }
  }

  void look_at(std::size_t cell, Neighbourhood& around, std::vector<SheetCell>& found) {
    HeightRange range;
    for (const auto& run : grid_.neighbours(cell)) {
      for (const PlanGrid::Cell& other : run) {
        const HeightRange& heights = heights_[index_of(grid_, other)];
        range.low = std::min(range.low, heights.low);
        range.high = std::max(range.high, heights.high);
      }
    }
    if (range.high - range.low < min_separation_) return;
    around.gather(grid_, cell);
    const TwoSheets sheets = split_into_sheets(around.points(), min_separation_);
    if (!sheets.found) return;
    found.push_back({cell, sheets.seed, sheets.separation, sheets.middle});
    for (std::size_t i = 0; i < around.count; ++i) {
      // Neighbourhoods overlap, so two threads may mark one point; both marks stay.
      std::atomic_ref<std::uint8_t>(result_.sheet[around.rows[i]])
          .fetch_or(sheets.upper[i] != 0 ? SheetSearch::kUpper : SheetSearch::kLower,
                    std::memory_order_relaxed);
    }
  }

  const PlanGrid& grid_;
  double min_separation_;
  int num_threads_;
  std::vector<HeightRange> heights_;
  SheetSearch result_;
};

}  // namespace

SheetSearch search_sheets(const PlanGrid& grid, double min_separation, int num_threads) {
  return Search(grid, min_separation, num_threads).run();
}

double measure_noise(const PlanGrid& grid) {
  const std::size_t step = std::max<std::size_t>(1, grid.cells().size() / kNoiseSamples);
  std::vector<double> rms;
  Neighbourhood around;
  for (std::size_t cell = 0; cell < grid.cells().size(); cell += step) {
    around.gather(grid, cell);
    if (around.count > 9) rms.push_back(rms_about_sheets(around.points()));
  }
  if (rms.empty()) return 0.0;
  const auto middle = rms.begin() + static_cast<std::ptrdiff_t>(rms.size() / 2);
  std::nth_element(rms.begin(), middle, rms.end());
  return *middle;
}

}  // namespace bathyal::terrain
