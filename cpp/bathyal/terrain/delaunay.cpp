// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/terrain/delaunay.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "bathyal/base/error.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/geometry/point_cloud.hpp"
#include "bathyal/terrain/internal/hilbert_order.hpp"
#include "bathyal/terrain/internal/triangulate_cells.hpp"

namespace bathyal {
namespace {

using namespace terrain;

constexpr std::size_t kGrain = 1 << 15;
constexpr std::size_t kPointsPerCell = 20000;  // fewer are not worth a thread
constexpr int kMostCells = 1024;
constexpr double kMedianFactor = 5.0;
constexpr std::size_t kFewestForMedian = 50;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

void check_points(PointView points, int num_threads) {
  constexpr Index kMost = std::numeric_limits<std::int32_t>::max() / 8;
  if (points.rows() > kMost) {
    throw_argument("points", "at most " + std::to_string(kMost) + " rows",
                   std::to_string(points.rows()));
  }
  const auto count = static_cast<std::size_t>(points.rows());
  parallel_for(count, kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    double largest = 0.0, nothing = 0.0;  // 0 · x is NaN where x is not finite
    for (auto i = static_cast<Index>(begin); i < static_cast<Index>(end); ++i) {
      largest = std::max({largest, std::fabs(points(i, 0)), std::fabs(points(i, 1))});
      nothing += 0.0 * points(i, 0) + 0.0 * points(i, 1) + 0.0 * points(i, 2);
    }
    if (!(nothing == 0.0)) check_points_finite("points", points);
    if (largest > kLargestCoordinate) {
      throw_argument("points", "x and y of at most " + to_text(kLargestCoordinate) + " in size",
                     to_text(largest));
    }
  });
}

PageVector<Point2> gather(PointView points, const PageVector<std::int32_t>& rows, int num_threads) {
  PageVector<Point2> plane(rows.size());
  parallel_for(rows.size(), kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) plane[i] = {points(rows[i], 0), points(rows[i], 1)};
  });
  return plane;
}

TriangleMatrix triangulate(const PageVector<Point2>& points, int num_threads) {
  const auto worthwhile = static_cast<int>(points.size() / kPointsPerCell);
  const int cells = std::clamp(std::min(num_threads, worthwhile), 1, kMostCells);
  TriangleMatrix triangles = triangulate_in_cells(points, cells, num_threads);
  if (triangles.rows() == 0) {
    throw_argument("points", "three or more that differ in (x, y) and are not on one line",
                   std::to_string(points.size()) + " distinct" +
                       (points.size() < 3 ? "" : ", all on one line"));
  }
  return triangles;
}

PageVector<double> longest_edges(const PageVector<Point2>& points, const TriangleMatrix& triangles,
                                 int num_threads) {
  const auto squared = [](const Point2& a, const Point2& b) {
    const double dx = a.x - b.x, dy = a.y - b.y;
    return dx * dx + dy * dy;
  };
  PageVector<double> longest(static_cast<std::size_t>(triangles.rows()));
  parallel_for(longest.size(), kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto row = static_cast<Index>(i);
      const Point2& a = points[triangles(row, 0)];
      const Point2& b = points[triangles(row, 1)];
      const Point2& c = points[triangles(row, 2)];
      longest[i] = std::sqrt(std::max({squared(a, b), squared(b, c), squared(c, a)}));
    }
  });
  return longest;
}

/// The middle value, the upper one of two: found among those that share its leading bits.
double median(const PageVector<double>& values) {
  const auto bin = [](double value) { return std::bit_cast<std::uint64_t>(value) >> 47U; };
  std::vector<std::size_t> count(std::size_t{1} << 16U, 0);
  for (const double value : values) ++count[bin(value)];
  std::size_t below = 0, middle_bin = 0;
  while (below + count[middle_bin] <= values.size() / 2) below += count[middle_bin++];
  std::vector<double> candidates;
  candidates.reserve(count[middle_bin]);
  for (const double value : values) {
    if (bin(value) == middle_bin) candidates.push_back(value);
  }
  const auto middle = candidates.begin() + static_cast<std::ptrdiff_t>(values.size() / 2 - below);
  std::nth_element(candidates.begin(), middle, candidates.end());
  return *middle;
}

/// Leaves out the triangles with an edge above `max_edge`, in place, and turns places on the curve
/// into rows of the input.
void keep_triangles(TriangleMatrix& triangles, const PageVector<double>& longest, double max_edge,
                    const PageVector<std::int32_t>& rows, int num_threads) {
  std::vector<Index> kept((longest.size() + kGrain - 1) / kGrain);
  parallel_for(longest.size(), kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    auto next = static_cast<Index>(begin);
    for (std::size_t i = begin; i < end; ++i) {
      if (!(longest[i] <= max_edge)) continue;
      for (int c = 0; c < 3; ++c) triangles(next, c) = rows[triangles(static_cast<Index>(i), c)];
      ++next;
    }
    kept[begin / kGrain] = next - static_cast<Index>(begin);
  });
  Index total = 0;
  for (std::size_t chunk = 0; chunk < kept.size(); ++chunk) {
    const auto from = triangles.data() + 3 * static_cast<Index>(chunk * kGrain);
    std::copy_n(from, 3 * kept[chunk], triangles.data() + 3 * total);
    total += kept[chunk];
  }
  triangles.conservativeResize(total, 3);
}

}  // namespace

void DelaunayOptions::check() const {
  if (max_edge && !(*max_edge > 0.0)) {
    throw_argument("max_edge", "a number above 0, or infinity", to_text(*max_edge));
  }
  resolve_threads(num_threads);
}

Delaunay delaunay(PointView points, const DelaunayOptions& options) {
  options.check();
  const int num_threads = resolve_threads(options.num_threads);
  check_points(points, num_threads);
  const PageVector<std::int32_t> rows = hilbert_order(points, num_threads);
  const PageVector<Point2> plane = gather(points, rows, num_threads);
  TriangleMatrix triangles = triangulate(plane, num_threads);
  const Index complete = triangles.rows();
  const PageVector<double> longest = longest_edges(plane, triangles, num_threads);
  Delaunay result;
  if (options.max_edge) {
    result.max_edge = *options.max_edge;
  } else {
    result.max_edge = rows.size() < kFewestForMedian ? kInfinity : kMedianFactor * median(longest);
  }
  keep_triangles(triangles, longest, result.max_edge, rows, num_threads);
  result.cut_triangles = complete - triangles.rows();
  result.merged_points = points.rows() - static_cast<Index>(rows.size());
  result.triangles = std::move(triangles);
  return result;
}

}  // namespace bathyal
