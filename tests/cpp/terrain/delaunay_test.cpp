// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/terrain/delaunay.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bathyal/base/random.hpp"
#include "bathyal/geometry/predicates.hpp"
#include "bathyal/terrain/internal/hilbert_order.hpp"
#include "bathyal/terrain/internal/triangulate_cells.hpp"
#include "bathyal/terrain/internal/triangulator.hpp"
#include "bathyal/terrain/triangulate.hpp"

namespace bathyal {
namespace {

using namespace terrain;

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

/// Whatever the order of the points, the same corners in the same order.
TEST(Delaunay, OrderOfPointsDoesNotShow) {
  for (const auto& [name, points] : arrangements()) {
    SCOPED_TRACE(name);
    Plane2 shuffled = points;
    RandomStream random(11);
    for (std::size_t i = shuffled.size(); i > 1; --i) {
      std::swap(shuffled[i - 1], shuffled[random.next() % i]);
    }
    const Triangles a = full(points).triangles, b = full(shuffled).triangles;
    ASSERT_EQ(a.rows(), b.rows());
    for (Index i = 0; i < 3 * a.rows(); ++i) {
      ASSERT_EQ(at(points, a.data()[i]), at(shuffled, b.data()[i]));
    }
  }
}

TEST(Delaunay, GapsAndHolesStay) {
  Plane2 points;
  for (const Point2& p : grid(60, 40, 1.0)) {
    const bool in_hole = std::hypot(p.x - 15.0, p.y - 20.0) < 9.0;
    const bool in_gap = p.x > 35.0 && p.x < 45.0;
    if (!in_hole && !in_gap) points.push_back(p);
  }
  const PointMatrix matrix = with_depth(points);
  const Delaunay trimmed = delaunay(PointView(matrix.data(), matrix.rows(), 3));
  EXPECT_DOUBLE_EQ(trimmed.max_edge, 5.0 * std::sqrt(2.0));
  EXPECT_EQ(trimmed.merged_points, 0);
  EXPECT_EQ(trimmed.cut_triangles + trimmed.triangles.rows(), full(points).triangles.rows());
  for (Index t = 0; t < trimmed.triangles.rows(); ++t) {
    Point2 middle{0.0, 0.0};
    for (int c = 0; c < 3; ++c) {
      const Point2 p = at(points, trimmed.triangles.view()(t, c));
      middle = {middle.x + p.x / 3.0, middle.y + p.y / 3.0};
    }
    ASSERT_TRUE(middle.x < 35.1 || middle.x > 44.9);
    ASSERT_GT(std::hypot(middle.x - 15.0, middle.y - 20.0), 5.0);
  }
}

TEST(Delaunay, ReportsWhatItMergedAndCutAlike) {
  Plane2 points = scattered(70000, 8);
  for (std::size_t i = 0; i < 5000; ++i) points.push_back(points[2 * i]);
  const PointMatrix matrix = with_depth(points);
  const PointView view(matrix.data(), matrix.rows(), 3);
  const Delaunay one = delaunay(view, {.num_threads = 1}), two = delaunay(view, {.num_threads = 2});
  EXPECT_EQ(one.merged_points, 5000);
  EXPECT_GT(one.cut_triangles, 0);
  EXPECT_EQ(one.cut_triangles, two.cut_triangles);
  EXPECT_EQ(one.max_edge, two.max_edge);
  EXPECT_EQ(one.triangles.view(), two.triangles.view());
}

TEST(Delaunay, RefusesWhatHasNoTriangulation) {
  EXPECT_THROW(full({}), std::invalid_argument);
  EXPECT_THROW(full({{0, 0}}), std::invalid_argument);
  EXPECT_THROW(full(Plane2(100, Point2{3, 4})), std::invalid_argument);
  EXPECT_THROW(full(grid(50, 1, 0.1, {1e7, 1e7})), std::invalid_argument);
  EXPECT_THROW(full({{0, 0}, {1, 0}, {0, NAN}}), std::invalid_argument);
  EXPECT_THROW(full({{0, 0}, {1, 0}, {0, kInfinity}}), std::invalid_argument);
  EXPECT_THROW(full({{0, 0}, {1, 0}, {0, 2e75}}), std::invalid_argument);
  EXPECT_THROW(full(grid(2, 2, 1.0), -1), std::invalid_argument);
  const PointMatrix square = with_depth(grid(2, 2, 1.0));
  for (const double bad : {0.0, -1.0, static_cast<double>(NAN)}) {
    EXPECT_THROW(delaunay(PointView(square.data(), 4, 3), {.max_edge = bad}),
                 std::invalid_argument);
  }
}

TEST(Triangulator, ClosesTheHullWithGhosts) {
  const Plane2 points = scattered(500);
  std::vector<std::int32_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::int32_t>(i);
  const auto triangles = triangulate_points(points, order);
  EXPECT_EQ(triangles.size(), 2 * points.size() - 2);
  const auto ghosts = std::count_if(triangles.begin(), triangles.end(),
                                    [](const Corners& t) { return is_ghost(t); });
  EXPECT_EQ(static_cast<Index>(triangles.size()) - ghosts, full(points).triangles.rows());
  EXPECT_TRUE(triangulate_points(Plane2{{0, 0}, {1, 1}, {2, 2}}, {{0, 1, 2}}).empty());
}

TEST(Triangulate, SharesTheCloudAndCountsWhatIsNotFinite) {
  PointMatrix points = with_depth(scattered(300));
  const PointCloud cloud{Points(points)};
  const Triangulation made = triangulate(cloud);
  EXPECT_EQ(made.mesh.vertices().data(), cloud.points().data());
  EXPECT_TRUE(made.sheets.single_valued());
  EXPECT_GT(made.mesh.triangle_count(), 0);
  points(7, 2) = std::nan("");
  try {
    triangulate(PointCloud{Points(points)});
    ADD_FAILURE() << "a point that is not finite was taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("1 point that is not, the first in row 7"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace bathyal
