// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/terrain/delaunay.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "bathyal/base/error.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/geometry/point_cloud.hpp"
#include "bathyal/terrain/hilbert_order.hpp"
#include "bathyal/terrain/triangulate_cells.hpp"

namespace bathyal {
namespace {

constexpr std::size_t kGrain = 1 << 15;
constexpr double kMedianFactor = 5.0;
constexpr std::size_t kFewestForMedian = 50;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

void check_points(PointView points) {
  check_points_finite("points", points);
  if (points.rows() > std::numeric_limits<std::int32_t>::max() / 8) {
    throw_argument("points", "at most 268435455 rows", std::to_string(points.rows()));
  }
  if (points.rows() > 0 && points.leftCols<2>().cwiseAbs().maxCoeff() > kLargestCoordinate) {
    throw_argument("points", "coordinates up to " + to_text(kLargestCoordinate),
                   to_text(points.leftCols<2>().cwiseAbs().maxCoeff()));
  }
}

std::vector<Point2> gather(PointView points, const std::vector<std::int32_t>& rows,
                           int num_threads) {
  std::vector<Point2> plane(rows.size());
  parallel_for(rows.size(), kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) plane[i] = {points(rows[i], 0), points(rows[i], 1)};
  });
  return plane;
}

double squared_distance(const Point2& a, const Point2& b) {
  const double dx = a.x - b.x, dy = a.y - b.y;
  return dx * dx + dy * dy;
}

double longest_edge(const std::vector<Point2>& points, const Corners& t) {
  const Point2 &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
  return std::sqrt(
      std::max({squared_distance(a, b), squared_distance(b, c), squared_distance(c, a)}));
}

double automatic_max_edge(const std::vector<Point2>& points, const std::vector<Corners>& triangles,
                          int num_threads) {
  if (points.size() < kFewestForMedian) return kInfinity;
  std::vector<double> longest(triangles.size());
  parallel_for(triangles.size(), kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) longest[i] = longest_edge(points, triangles[i]);
  });
  const auto middle = longest.begin() + static_cast<std::ptrdiff_t>(longest.size() / 2);
  std::nth_element(longest.begin(), middle, longest.end());
  return kMedianFactor * *middle;
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
  check_points(points);
  const int num_threads = resolve_threads(options.num_threads);
  const std::vector<std::int32_t> rows = hilbert_order(points, num_threads);
  const std::vector<Point2> plane = gather(points, rows, num_threads);
  std::vector<Corners> corners = triangulate_in_cells(plane, num_threads, num_threads);
  if (corners.empty()) {
    throw_argument(
        "points", "three or more that differ in (x, y) and are not on one line",
        std::to_string(rows.size()) + " distinct" + (rows.size() < 3 ? "" : ", all on one line"));
  }
  Delaunay result;
  result.merged_points = points.rows() - static_cast<Index>(rows.size());
  result.max_edge =
      options.max_edge ? *options.max_edge : automatic_max_edge(plane, corners, num_threads);
  const std::size_t all = corners.size();
  if (result.max_edge < kInfinity) {
    std::erase_if(corners,
                  [&](const Corners& t) { return longest_edge(plane, t) > result.max_edge; });
  }
  result.cut_triangles = static_cast<Index>(all - corners.size());
  TriangleMatrix triangles(static_cast<Index>(corners.size()), 3);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (int c = 0; c < 3; ++c) triangles(static_cast<Index>(i), c) = rows[corners[i][c]];
  }
  result.triangles = std::move(triangles);
  return result;
}

}  // namespace bathyal
