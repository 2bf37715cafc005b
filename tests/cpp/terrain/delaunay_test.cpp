// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/terrain/delaunay.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <stdexcept>

#include "bathyal/base/random.hpp"
#include "bathyal/geometry/predicates.hpp"
#include "bathyal/terrain/hilbert_order.hpp"
#include "bathyal/terrain/triangulate_cells.hpp"

namespace bathyal {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Plane2 = std::vector<Point2>;

PointMatrix with_depth(const Plane2& points) {
  PointMatrix matrix(static_cast<Index>(points.size()), 3);
  for (Index i = 0; i < matrix.rows(); ++i) {
    matrix.row(i) << points[static_cast<std::size_t>(i)].x, points[static_cast<std::size_t>(i)].y,
        -50.0;
  }
  return matrix;
}

Delaunay full(const Plane2& points, int num_threads = 1) {
  return delaunay(Points(with_depth(points)).view(),
                  {.max_edge = kInfinity, .num_threads = num_threads});
}

// ---- Arrangements of points

Plane2 scattered(std::size_t count, std::uint64_t seed = 1, Point2 offset = {0, 0}) {
  RandomStream random(seed);
  Plane2 points(count);
  for (Point2& p : points) {
    p.x = offset.x + random.uniform(0.0, 1000.0);
    p.y = offset.y + random.uniform(0.0, 1000.0);
  }
  return points;
}

Plane2 grid(int columns, int rows, double step, Point2 offset = {0, 0}) {
  Plane2 points;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) points.push_back({offset.x + step * i, offset.y + step * j});
  }
  return points;
}

/// All integer points at squared distance 5² · 13² · 17² · 29² from the centre: exactly
/// co-circular.
Plane2 integer_circle() {
  Plane2 points;
  const long radius = 5 * 13 * 17 * 29;
  for (long x = -radius; x <= radius; ++x) {
    const long y = std::lround(std::sqrt(static_cast<double>(radius * radius - x * x)));
    if (x * x + y * y != radius * radius) continue;
    points.push_back({static_cast<double>(x), static_cast<double>(y)});
    if (y != 0) points.push_back({static_cast<double>(x), static_cast<double>(-y)});
  }
  return points;
}

Plane2 line_and_one(int count) {
  Plane2 points{{0.5 * count, 7.0}};
  for (int i = 0; i < count; ++i) points.push_back({static_cast<double>(i), 0.0});
  return points;
}

Plane2 parabola(int count) {
  Plane2 points;
  for (int i = 0; i < count; ++i) {
    points.push_back({static_cast<double>(i), static_cast<double>(i) * i});
  }
  return points;
}

Plane2 rounded_circle(int count) {
  Plane2 points;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count;
    points.push_back({std::cos(angle), std::sin(angle)});
  }
  return points;
}

Plane2 two_clusters(std::size_t count) {
  Plane2 points = scattered(count, 5);
  for (std::size_t i = 0; i < count; i += 2) points[i].x = points[i].x * 1e-3 + 1e12;
  return points;
}

Plane2 along_curve(const Plane2& points) {
  Plane2 sorted;
  for (const std::int32_t row : hilbert_order(Points(with_depth(points)).view(), 1)) {
    sorted.push_back(points[static_cast<std::size_t>(row)]);
  }
  return sorted;
}

// ---- What a Delaunay triangulation is

Point2 at(const Plane2& points, std::int32_t i) { return points[static_cast<std::size_t>(i)]; }

/// Every triangle counter-clockwise, every inner edge shared by two that pass the empty-circle test
/// (local Delaunay everywhere is Delaunay), the outer edges one convex loop, every point used, and
/// Euler's count: together a proof.
void expect_delaunay(const Plane2& points, TriangleView triangles) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> apex;
  std::vector<bool> used(points.size(), false);
  for (Index t = 0; t < triangles.rows(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const std::int32_t v = triangles(t, c), a = triangles(t, (c + 1) % 3),
                         b = triangles(t, (c + 2) % 3);
      used[static_cast<std::size_t>(v)] = true;
      ASSERT_TRUE(apex.emplace(std::pair(a, b), v).second) << "edge used twice";
    }
    ASSERT_EQ(orient2d(at(points, triangles(t, 0)), at(points, triangles(t, 1)),
                       at(points, triangles(t, 2))),
              1);
  }
  ASSERT_TRUE(std::all_of(used.begin(), used.end(), [](bool u) { return u; }));
  std::map<std::int32_t, std::int32_t> hull;
  for (const auto& [edge, v] : apex) {
    const auto other = apex.find({edge.second, edge.first});
    if (other == apex.end()) {
      ASSERT_TRUE(hull.emplace(edge.first, edge.second).second) << "hull touches itself";
      continue;
    }
    ASSERT_FALSE(in_perturbed_circle(at(points, edge.first), at(points, edge.second), at(points, v),
                                     at(points, other->second)));
  }
  const std::int32_t start = hull.begin()->first;
  std::size_t length = 0;
  for (std::int32_t v = start; length == 0 || v != start; v = hull.at(v), ++length) {
    ASSERT_GE(orient2d(at(points, v), at(points, hull.at(v)), at(points, hull.at(hull.at(v)))), 0);
    ASSERT_LE(length, hull.size());
  }
  ASSERT_EQ(length, hull.size());
  ASSERT_EQ(static_cast<std::size_t>(triangles.rows()), 2 * points.size() - 2 - hull.size());
}

const std::map<std::string, Plane2>& arrangements() {
  static const std::map<std::string, Plane2> all{
      {"three", {{0, 0}, {1, 0}, {0, 1}}},
      {"square", grid(2, 2, 1.0)},
      {"scattered", scattered(200000)},
      {"scattered far off", scattered(20000, 2, {5e6, 1e7})},
      {"grid", grid(300, 200, 1.0)},
      {"survey grid", grid(150, 130, 2.0, {620152.873, 7246504.912})},
      {"fine grid about zero", grid(120, 130, 0.1)},
      {"one row and a bit", grid(5000, 2, 0.1, {-250, 1e7})},
      {"integer circle", integer_circle()},
      {"rounded circle", rounded_circle(5000)},
      {"line and one point off it", line_and_one(3000)},
      {"parabola", parabola(3000)},
      {"two clusters far apart", two_clusters(20000)},
  };
  return all;
}

TEST(Delaunay, IsProvenExactlyOnEveryArrangement) {
  for (const auto& [name, points] : arrangements()) {
    SCOPED_TRACE(name);
    expect_delaunay(points, full(points).triangles.view());
  }
}

TEST(Delaunay, SameBytesForAnyNumberOfThreads) {
  for (const auto& [name, points] : arrangements()) {
    SCOPED_TRACE(name);
    const Triangles one = full(points, 1).triangles;
    for (const int threads : {2, 3, 8}) {
      const Triangles many = full(points, threads).triangles;
      ASSERT_EQ(one.view(), many.view()) << threads;
    }
  }
}

TEST(Delaunay, SameBytesForAnyNumberOfCells) {
  for (const auto& [name, points] : arrangements()) {
    SCOPED_TRACE(name);
    const Plane2 sorted = along_curve(points);
    const TriangleMatrix one = triangulate_in_cells(sorted, 1, 1);
    for (const int cells : {2, 3, 5, 8, 13}) {
      ASSERT_EQ(one, triangulate_in_cells(sorted, cells, 2)) << cells;
    }
  }
}

}  // namespace
}  // namespace bathyal
