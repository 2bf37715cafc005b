// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/internal/clean_steps.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/base/error.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/soundings/internal/neighbours.hpp"
#include "bathyal/soundings/internal/parallel_sort.hpp"

namespace bathyal::soundings {
namespace {

constexpr std::size_t kPointGrain = std::size_t{1} << 14U;
constexpr double kMadToStd = 1.4826;  ///< for normal noise

/// Median by value (the upper one of two); reorders.
double median(double* begin, double* end) {
  double* const middle = begin + (end - begin) / 2;
  std::nth_element(begin, middle, end);
  return *middle;
}

struct Cell {
  std::int64_t x, y, z;
  std::uint32_t index;  ///< of the sounding

  bool same_place(const Cell& other) const { return x == other.x && y == other.y && z == other.z; }
};

std::int64_t cell_of(double coordinate, double voxel) {
  const double cell = std::floor(coordinate / voxel);
  if (!(std::abs(cell) < 0x1p53)) {
    throw_argument("voxel", "cells that can be counted at these coordinates", to_text(voxel));
  }
  return static_cast<std::int64_t>(cell);
}

std::vector<Cell> sorted_cells(const Soundings& soundings, const CleanOptions& options) {
  std::vector<Cell> cells(soundings.size());
  parallel_for(cells.size(), kPointGrain, options.num_threads,
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t i = begin; i < end; ++i) {
                   const Sounding& s = soundings[i];
                   cells[i] = {cell_of(s.x, options.voxel), cell_of(s.y, options.voxel),
                               cell_of(s.z, options.voxel), static_cast<std::uint32_t>(i)};
                 }
               });
  parallel_sort(
      cells,
      [](const Cell& a, const Cell& b) {
        if (a.x != b.x) return a.x < b.x;
        if (a.y != b.y) return a.y < b.y;
        if (a.z != b.z) return a.z < b.z;
        return a.index < b.index;
      },
      options.num_threads);
  return cells;
}

/// Of the soundings in one cell, the index of the one nearest to their centroid; the lowest of
/// those equally near.
std::uint32_t nearest_to_centroid(const Soundings& soundings, const Cell* begin, const Cell* end) {
  // Relative to one of them: at 10⁷ m the sum itself would cost digits.
  const Sounding& origin = soundings[begin->index];
  const Vec3 base(origin.x, origin.y, origin.z);
  const auto local = [&](const Cell* cell) -> Vec3 {
    const Sounding& s = soundings[cell->index];
    return Vec3(s.x, s.y, s.z) - base;
  };
  Vec3 centroid = Vec3::Zero();
  for (const Cell* cell = begin; cell != end; ++cell) centroid += local(cell);
  centroid /= static_cast<double>(end - begin);
  const Cell* best = begin;
  for (const Cell* cell = begin + 1; cell != end; ++cell) {
    if ((local(cell) - centroid).squaredNorm() < (local(best) - centroid).squaredNorm()) {
      best = cell;
    }
  }
  return best->index;
}

}  // namespace

Marks mark_spikes(const Soundings& soundings, const CleanOptions& options) {
  const Neighbours<2> neighbours(soundings, options.num_threads);
  std::vector<double> residual(soundings.size());
  std::vector<double> spread(soundings.size());
  neighbours.for_each(options.spike_neighbours, options.num_threads,
                      [&](std::size_t i, const Neighbours<2>::Found& found) {
                        auto z = found.z;
                        double* const end = z.data() + found.count;
                        if (found.count == 0) {
                          residual[i] = 0.0;
                          spread[i] = 0.0;
                          return;
                        }
                        const double middle = median(z.data(), end);
                        for (double* p = z.data(); p != end; ++p) *p = std::abs(*p - middle);
                        residual[i] = std::abs(soundings[i].z - middle);
                        spread[i] = median(z.data(), end);
                      });
  Marks marks(soundings.size(), 0);
  if (soundings.empty()) return marks;
  std::vector<double> sorted = residual;
  const double whole = median(sorted.data(), sorted.data() + sorted.size());
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const double scale = kMadToStd * std::max(whole, spread[i]);
    marks[i] = residual[i] > std::max(options.spike_sigma * scale, options.spike_height) ? 1 : 0;
  }
  return marks;
}

Marks mark_outliers(const Soundings& soundings, const CleanOptions& options) {
  Marks marks(soundings.size(), 0);
  if (soundings.size() < 2) return marks;
  const Neighbours<3> neighbours(soundings, options.num_threads);
  std::vector<double> distance(soundings.size());
  neighbours.for_each(options.outlier_neighbours, options.num_threads,
                      [&](std::size_t i, const Neighbours<3>::Found& found) {
                        double sum = 0.0;
                        for (int k = 0; k < found.count; ++k) sum += std::sqrt(found.squared[k]);
                        distance[i] = sum / found.count;
                      });
  const auto sum_of = [&](const auto& term) {
    return parallel_sum<double>(distance.size(), kPointGrain, options.num_threads,
                                [&](std::size_t begin, std::size_t end) {
                                  double sum = 0.0;
                                  for (std::size_t i = begin; i < end; ++i)
                                    sum += term(distance[i]);
                                  return sum;
                                });
  };
  const auto count = static_cast<double>(distance.size());
  const double mean = sum_of([](double d) { return d; }) / count;
  const double variance = sum_of([&](double d) { return (d - mean) * (d - mean); }) / (count - 1.0);
  const double limit = mean + options.outlier_sigma * std::sqrt(variance);
  for (std::size_t i = 0; i < marks.size(); ++i) marks[i] = distance[i] > limit ? 1 : 0;
  return marks;
}

Marks mark_thinned(const Soundings& soundings, const CleanOptions& options) {
  const std::vector<Cell> cells = sorted_cells(soundings, options);
  Marks marks(soundings.size(), 1);
  const Cell* const last = cells.data() + cells.size();
  for (const Cell* begin = cells.data(); begin != last;) {
    const Cell* end = begin + 1;
    while (end != last && end->same_place(*begin)) ++end;
    marks[nearest_to_centroid(soundings, begin, end)] = 0;
    begin = end;
  }
  return marks;
}

}  // namespace bathyal::soundings
