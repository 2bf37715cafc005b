// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/internal/cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bathyal/base/parallel.hpp"

namespace bathyal::scene {
namespace {

constexpr std::uint32_t kCellItems = 512;      ///< aimed at
constexpr std::uint32_t kCrowded = 1U << 15U;  ///< a cell with more gets a grid of its own
constexpr std::uint32_t kMostCells = 1U << 16U;
constexpr std::size_t kChunks = 16;  ///< of a sort: fixed, as every chunk holds a count per cell

/// Maps a (doubled) middle to its cell: cells as near to cubes as whole numbers allow.
class Grid {
 public:
  Grid(const Box& middles, std::uint32_t items) : base_(middles.low) {
    const Float4 extent = middles.high - middles.low;
    const float largest = std::max({extent[0], extent[1], extent[2]});
    const float wanted =
        static_cast<float>(std::clamp<std::uint32_t>(items / kCellItems, 1, kMostCells));
    for (int axis = 0; axis < 3; ++axis) count_[axis] = 1;
    // Divides finer and finer for as long as the number of cells stays within what is wanted.
    for (float along = 1.0F; largest > 0.0F; along *= 1.1F) {
      std::int32_t next[3];
      float cells = 1.0F;
      for (int axis = 0; axis < 3; ++axis) {
        next[axis] = 1 + static_cast<std::int32_t>(along * (extent[axis] / largest) * 0.999F);
        cells *= static_cast<float>(next[axis]);
      }
      if (cells > wanted) break;
      std::copy_n(next, 3, count_);
    }
    for (int axis = 0; axis < 3; ++axis) {
      const float s = 0.9999F * static_cast<float>(count_[axis]) / extent[axis];
      scale_[axis] = count_[axis] > 1 && std::isfinite(s) ? s : 0.0F;
    }
    scale_[3] = 0.0F;
    base_[3] = 0.0F;
    for (int axis = 0; axis < 4; ++axis)
      last_[axis] = axis < 3 ? static_cast<float>(count_[axis] - 1) : 0.0F;
  }

  std::uint32_t size() const {
    return static_cast<std::uint32_t>(count_[0] * count_[1] * count_[2]);
  }

  std::uint32_t operator()(const Box& box) const {
    // Clamped: in a scene much smaller than a metre the base is known to a few cells only.
    const Float4 place = (twice_middle(box) - base_) * scale_;
    const Int4 cell = __builtin_convertvector(min4(max4(place, Float4{}), last_), Int4);
    return static_cast<std::uint32_t>(cell[0] + count_[0] * (cell[1] + count_[1] * cell[2]));
  }

 private:
  Float4 base_;
  Float4 scale_;
  Float4 last_;
  std::int32_t count_[3];
};

/// Box of a triangle in the local frame, rounded outwards.
Box box_of(const MeshArrays& mesh, std::uint32_t primitive, const double* origin) {
  const std::int32_t* index = mesh.triangles + 3 * std::int64_t{primitive - mesh.first_primitive};
  const double* a = mesh.vertices + 3 * std::int64_t{index[0]};
  const double* b = mesh.vertices + 3 * std::int64_t{index[1]};
  const double* c = mesh.vertices + 3 * std::int64_t{index[2]};
  double low[3], high[3];
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = std::min(a[axis], std::min(b[axis], c[axis])) - origin[axis];
    high[axis] = std::max(a[axis], std::max(b[axis], c[axis])) - origin[axis];
  }
  Box box = rounded_outwards(low, high);
  box.set_tags(1, primitive);
  return box;
}

/// Counting sort of `count` items by their cell: stable, so the same for any number of threads.
/// `item(i)` gives the box of item i; the sorted boxes go to `sorted`.
template <class Item>
std::vector<Cell> sort_by_cell(const Grid& grid, std::uint32_t count, const Item& item, Box* sorted,
                               int num_threads) {
  const std::size_t cells = grid.size();
  const std::size_t grain = std::max<std::size_t>((count + kChunks - 1) / kChunks, 4096);
  const std::size_t chunks = (count + grain - 1) / grain;
  std::vector<std::uint32_t> cell_of(count);
  std::vector<std::uint32_t> slot(chunks * cells);
  parallel_for(count, grain, num_threads, [&](std::size_t begin, std::size_t end) {
    std::uint32_t* tally = slot.data() + begin / grain * cells;
    for (std::size_t i = begin; i < end; ++i) {
      cell_of[i] = grid(item(static_cast<std::uint32_t>(i)));
      ++tally[cell_of[i]];
    }
  });
  std::vector<Cell> result;
  std::uint32_t next = 0;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const std::uint32_t first = next;
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
      next += std::exchange(slot[chunk * cells + cell], next);
    }
    if (next > first) result.push_back({first, next - first});
  }
  parallel_for(count, grain, num_threads, [&](std::size_t begin, std::size_t end) {
    std::uint32_t* place = slot.data() + begin / grain * cells;
    for (std::size_t i = begin; i < end; ++i) {
      sorted[place[cell_of[i]]++] = item(static_cast<std::uint32_t>(i));
    }
  });
  return result;
}

/// Gives a crowded cell a grid of its own, as often as that separates anything.
void split_cell(Box* items, const Cell& cell, std::vector<Cell>& done, int num_threads) {
  if (cell.count <= kCrowded) {
    done.push_back(cell);
    return;
  }
  Box middles;
  for (std::uint32_t i = cell.first; i < cell.first + cell.count; ++i) {
    const Float4 middle = twice_middle(items[i]);
    middles.low = min4(middles.low, middle);
    middles.high = max4(middles.high, middle);
  }
  const std::vector<Box> copy(items + cell.first, items + cell.first + cell.count);
  std::vector<Cell> parts = sort_by_cell(
      Grid(middles, cell.count), cell.count, [&](std::uint32_t i) { return copy[i]; },
      items + cell.first, num_threads);
  if (parts.size() == 1) {
    done.push_back(cell);
    return;
  }
  for (const Cell& part : parts) {
    split_cell(items, {cell.first + part.first, part.count}, done, num_threads);
  }
}

template <class Item>
SortedBoxes sort_items(std::uint32_t count, const LocalFrame& frame, const Item& item,
                       int num_threads) {
  Box middles;
  for (int axis = 0; axis < 3; ++axis) {
    middles.low[axis] = 2.0F * static_cast<float>(frame.low[axis]);
    middles.high[axis] = 2.0F * static_cast<float>(frame.high[axis]);
  }
  SortedBoxes result{PageArray<Box>(count), {}};
  const std::vector<Cell> cells =
      sort_by_cell(Grid(middles, count), count, item, result.items.data(), num_threads);
  for (const Cell& cell : cells) {
    split_cell(result.items.data(), cell, result.cells, num_threads);
  }
  return result;
}

}  // namespace

SortedBoxes sort_into_cells(const Scene::Hierarchy& hierarchy, int num_threads) {
  const double* origin = hierarchy.origin.data();
  const auto mesh_count = static_cast<std::int32_t>(hierarchy.arrays.size());
  const auto item = [&](std::uint32_t i) {
    const MeshArrays* meshes = hierarchy.arrays.data();
    const std::int32_t mesh = mesh_count == 1 ? 0 : name_of(meshes, mesh_count, i).mesh;
    return box_of(meshes[mesh], i, origin);
  };
  return sort_items(hierarchy.primitive_count, hierarchy, item, num_threads);
}

SortedBoxes sort_into_cells(const std::vector<Box>& boxes, const LocalFrame& frame,
                            int num_threads) {
  return sort_items(
      static_cast<std::uint32_t>(boxes.size()), frame, [&](std::uint32_t i) { return boxes[i]; },
      num_threads);
}

}  // namespace bathyal::scene
