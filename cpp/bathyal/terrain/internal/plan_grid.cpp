// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/terrain/internal/plan_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace bathyal::terrain {
namespace {

struct Keyed {
  std::uint64_t key;
  std::uint32_t index;
};

/// Stable, so that points of one cell keep their order. Least significant digit first.
void radix_sort(std::vector<Keyed>& items, std::uint64_t largest_key) {
  constexpr int kDigit = 11;
  std::vector<Keyed> other(items.size());
  for (int shift = 0; shift < static_cast<int>(std::bit_width(largest_key)); shift += kDigit) {
    std::array<std::size_t, 1U << kDigit> start{};
    const auto digit = [shift](const Keyed& k) { return (k.key >> shift) & ((1U << kDigit) - 1U); };
    for (const Keyed& k : items) ++start[digit(k)];
    std::size_t sum = 0;
    for (std::size_t& s : start) sum += std::exchange(s, sum);
    for (const Keyed& k : items) other[start[digit(k)]++] = k;
    items.swap(other);
  }
}

}  // namespace

PlanGrid::PlanGrid(PointView points, double points_per_cell) : origin_(local_origin(points)) {
  double high_x = points(0, 0) - origin_.x();
  double high_y = points(0, 1) - origin_.y();
  low_x_ = high_x;
  low_y_ = high_y;
  for (Index i = 1; i < points.rows(); ++i) {
    const double x = points(i, 0) - origin_.x();
    const double y = points(i, 1) - origin_.y();
    low_x_ = std::min(low_x_, x);
    high_x = std::max(high_x, x);
    low_y_ = std::min(low_y_, y);
    high_y = std::max(high_y, y);
  }
  width_ = high_x - low_x_;
  height_ = high_y - low_y_;
  // No cell is finer than this part of the extent, so that columns and rows stay small numbers
  // also where every point has the same (x, y).
  const double extent = std::max(width_, height_);
  const double smallest = extent > 0.0 ? extent * 0x1p-24 : 1.0;
  const auto count = static_cast<double>(points.rows());
  double size = std::max(std::sqrt(width_ * height_ * points_per_cell / count), smallest);
  // The bounding box may be mostly empty: the occupied cells then hold too many points, and the
  // cells shrink until they do not.
  for (int round = 0;; ++round) {
    sort_into_cells(points, size);
    const double held = count / static_cast<double>(cells_.size());
    if (held <= 1.5 * points_per_cell || size <= smallest || round == 12) break;
    size = std::max(size * std::sqrt(1.1 * points_per_cell / held), smallest);
  }
  link_rows();
}

void PlanGrid::sort_into_cells(PointView points, double size) {
  cell_size_ = size;
  const auto columns = static_cast<std::uint64_t>(width_ / size) + 1;
  const auto rows = static_cast<std::uint64_t>(height_ / size) + 1;
  const auto count = static_cast<std::size_t>(points.rows());
  std::vector<Keyed> keyed(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double x = points(static_cast<Index>(i), 0) - origin_.x() - low_x_;
    const double y = points(static_cast<Index>(i), 1) - origin_.y() - low_y_;
    const auto column = static_cast<std::uint64_t>(x / size);
    const auto row = static_cast<std::uint64_t>(y / size);
    keyed[i] = {row * columns + column, static_cast<std::uint32_t>(i)};
  }
  radix_sort(keyed, columns * rows);
  points_.resize(count);
  cells_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const auto from = static_cast<Index>(keyed[i].index);
    points_[i] = {points(from, 0) - origin_.x(), points(from, 1) - origin_.y(),
                  points(from, 2) - origin_.z()};
    if (i == 0 || keyed[i].key != keyed[i - 1].key) {
      cells_.push_back({static_cast<std::int64_t>(keyed[i].key % columns),
                        static_cast<std::int64_t>(keyed[i].key / columns), i, i, 0, 0});
    }
    cells_.back().end = i + 1;
  }
}

std::array<double, 2> PlanGrid::centre(const Cell& cell) const {
  return {low_x_ + (static_cast<double>(cell.column) + 0.5) * cell_size_,
          low_y_ + (static_cast<double>(cell.row) + 0.5) * cell_size_};
}

std::array<std::span<const PlanGrid::Cell>, 3> PlanGrid::neighbours(std::size_t index) const {
  const Cell& cell = cells_[index];
  const bool has_left =
      index > 0 && cells_[index - 1].row == cell.row && cells_[index - 1].column + 1 == cell.column;
  const std::array<std::size_t, 3> starts{cell.row_below, has_left ? index - 1 : index,
                                          cell.row_above};
  std::array<std::span<const Cell>, 3> runs;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int64_t row = cell.row + static_cast<std::int64_t>(k) - 1;
    std::size_t end = starts[k];
    while (end < cells_.size() && cells_[end].row == row && cells_[end].column <= cell.column + 1) {
      ++end;
    }
    runs[k] = {cells_.data() + starts[k], end - starts[k]};
  }
  return runs;
}

std::span<const PlanGrid::Point> PlanGrid::points_of(std::span<const Cell> run) const {
  if (run.empty()) return {};
  return {points_.data() + run.front().begin, run.back().end - run.front().begin};
}

/// Cells are in order of (row, column), so both links only ever move forward.
void PlanGrid::link_rows() {
  const auto before = [](const Cell& cell, std::int64_t row, std::int64_t column) {
    return cell.row < row || (cell.row == row && cell.column < column);
  };
  std::size_t below = 0;
  std::size_t above = 0;
  for (Cell& cell : cells_) {
    while (below < cells_.size() && before(cells_[below], cell.row - 1, cell.column - 1)) ++below;
    while (above < cells_.size() && before(cells_[above], cell.row + 1, cell.column - 1)) ++above;
    cell.row_below = below;
    cell.row_above = above;
  }
}

}  // namespace bathyal::terrain
