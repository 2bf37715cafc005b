// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/geometry/mesh_report.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "bathyal/geometry/orient.hpp"

namespace bathyal {
namespace {

using std::numbers::pi;
using Row = std::array<std::int32_t, 3>;

TriangleMesh mesh_of(const std::vector<Vec3>& vertices, const std::vector<Row>& rows,
                     const Vec3& offset = Vec3::Zero()) {
  PointMatrix points(static_cast<Index>(vertices.size()), 3);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    points.row(static_cast<Index>(i)) = vertices[i] + offset;
  TriangleMatrix triangles(static_cast<Index>(rows.size()), 3);
  for (std::size_t t = 0; t < rows.size(); ++t) {
    for (int c = 0; c < 3; ++c)
      triangles(static_cast<Index>(t), c) = rows[t][static_cast<std::size_t>(c)];
  }
  return TriangleMesh(points, triangles);
}

/// n × n squares, each cut in two, on z = f(x, y), a cell 1 m wide.
TriangleMesh field(int n, double (*f)(double, double), const Vec3& offset = Vec3::Zero()) {
  std::vector<Vec3> vertices;
  std::vector<Row> rows;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) vertices.emplace_back(i, j, f(i, j));
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const std::int32_t v = j * (n + 1) + i;
      rows.push_back({v, v + 1, v + n + 2});
      rows.push_back({v, v + n + 2, v + n + 1});
    }
  }
  return mesh_of(vertices, rows, offset);
}

const std::vector<Vec3> kCube = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                 {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const std::vector<Row> kCubeRows = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7},
                                    {0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5},
                                    {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};

TEST(MeshReport, MeasuresARamp) {
  for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(620152, 7246504, -52)}) {
    const MeshReport r = mesh_report(field(
        10, [](double x, double) { return x; }, offset));
    EXPECT_NEAR(r.area, 100.0 * std::sqrt(2.0), 1e-9);
    EXPECT_NEAR(r.planar_area, 100.0, 1e-9);
    EXPECT_NEAR(r.rugosity, std::sqrt(2.0), 1e-12);
    for (const double slope : {r.slope_mean, r.slope_median, r.slope_p95, r.slope_max}) {
      EXPECT_NEAR(slope, pi / 4, 1e-12);
    }
    EXPECT_EQ(r.components, 1);
    ASSERT_EQ(r.boundary_loops.size(), 1U);
    EXPECT_NEAR(r.boundary_loops[0], 20.0 + 20.0 * std::sqrt(2.0), 1e-9);
    EXPECT_EQ(r.boundary_edges, 40);
    EXPECT_EQ(r.inverted_triangles, 0);
    EXPECT_FALSE(r.closed);
    EXPECT_TRUE(std::isnan(r.volume));
    EXPECT_EQ(r.low, offset);
    EXPECT_EQ(r.high, Vec3(10, 10, 10) + offset);
  }
}

TEST(MeshReport, MeasuresAClosedCube) {
  const MeshReport r = mesh_report(mesh_of(kCube, kCubeRows, Vec3(1e6, 1e6, 0)));
  EXPECT_TRUE(r.closed);
  EXPECT_NEAR(r.volume, 1.0, 1e-9);
  EXPECT_NEAR(r.area, 6.0, 1e-9);
  EXPECT_NEAR(r.planar_area, 1.0, 1e-9);
  EXPECT_NEAR(r.area_share_inverted, 1.0 / 6.0, 1e-9);
  EXPECT_EQ(r.inverted_triangles, 2);
  EXPECT_NEAR(r.slope_median, pi / 2, 1e-9);
  EXPECT_NEAR(r.slope_max, pi, 1e-9);
  EXPECT_TRUE(r.boundary_loops.empty());
  std::vector<Row> inside_out = kCubeRows;
  for (Row& row : inside_out) std::swap(row[1], row[2]);
  EXPECT_NEAR(mesh_report(mesh_of(kCube, inside_out)).volume, -1.0, 1e-9);
}

// Two unit squares, one over the other and shifted by half: the shadow is 1.5, not 2.
TEST(MeshReport, CountsEveryPlaceOfTheShadowOnce) {
  std::vector<Vec3> v;
  for (const double s : {0.0, 0.5}) {
    v.insert(v.end(), {{s, 0, s}, {1 + s, 0, s}, {1 + s, 1, s}, {s, 1, s}});
  }
  const MeshReport r = mesh_report(mesh_of(v, {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}}));
  EXPECT_NEAR(r.planar_area, 1.5, 1e-9);
  EXPECT_NEAR(r.rugosity, 2.0 / 1.5, 1e-9);
  EXPECT_EQ(r.components, 2);
}

TEST(MeshReport, SphereHasTheShadowOfADisc) {
  std::vector<Vec3> v;
  std::vector<Row> rows;
  const int n = 128, m = 64;
  for (int j = 0; j <= m; ++j) {
    for (int i = 0; i < n; ++i) {
      const double a = 2 * pi * i / n, b = pi * j / m;
      v.emplace_back(std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), std::cos(b));
    }
  }
  for (int j = 0; j < m; ++j) {
    for (int i = 0; i < n; ++i) {
      const int p = j * n + i, q = j * n + (i + 1) % n;
      rows.push_back({p, p + n, q + n});
      rows.push_back({p, q + n, q});
    }
  }
  const MeshReport r = mesh_report(mesh_of(v, rows));
  EXPECT_NEAR(r.planar_area, 0.5 * n * std::sin(2 * pi / n), 1e-3);  // the polygon of the equator
  EXPECT_NEAR(r.area, 4 * pi, 0.01);
  EXPECT_NEAR(r.area_share_inverted, 0.5, 1e-9);
}

TEST(MeshReport, NamesEveryDefect) {
  // Vertices 0 to 3 a square; 4 above it: a third triangle on the diagonal 0-2; one repeated; one
  // without area (0, 1, 5), 5 half-way; 6 unused; 7 to 9 a piece of its own, facing down.
  const std::vector<Vec3> v = {{0, 0, 0}, {1, 0, 0},    {1, 1, 0}, {0, 1, 0}, {0, 0, 1},
                               {2, 0, 0}, {50, 50, 50}, {5, 5, 0}, {6, 5, 0}, {5, 6, 0}};
  const MeshReport r =
      mesh_report(mesh_of(v, {{0, 1, 2}, {0, 2, 3}, {0, 2, 4}, {2, 3, 0}, {0, 1, 5}, {7, 9, 8}}));
  EXPECT_EQ(r.nonmanifold_edges, 1);  // 0-2, of four
  EXPECT_EQ(r.duplicate_triangles, 1);
  EXPECT_EQ(r.zero_area_triangles, 1);
  EXPECT_EQ(r.inverted_triangles, 1);
  EXPECT_EQ(r.components, 2);
  EXPECT_EQ(r.unused_vertices, 1);
  EXPECT_EQ(r.high, Vec3(6, 6, 1));
}

TEST(MeshReport, CountsFansThatTouchInAVertexAndEdgesTurnedTheSameWay) {
  const std::vector<Vec3> v = {{0, 0, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}};
  const MeshReport bow = mesh_report(mesh_of(v, {{0, 1, 2}, {0, 3, 4}}));
  EXPECT_EQ(bow.nonmanifold_vertices, 1);
  EXPECT_EQ(bow.boundary_loops.size(), 2U);
  EXPECT_EQ(bow.components, 2);
  const MeshReport good = mesh_report(mesh_of(v, {{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(good.inconsistent_edges, 0);
  EXPECT_EQ(good.nonmanifold_vertices, 0);
  const MeshReport bad = mesh_report(mesh_of(v, {{0, 1, 2}, {0, 3, 2}}));
  EXPECT_EQ(bad.inconsistent_edges, 1);
  EXPECT_FALSE(bad.closed);
}

TEST(MeshReport, AHoleIsARimOfItsOwn) {
  const TriangleMesh whole = field(5, [](double, double) { return 0.0; });
  TriangleMatrix some(48, 3);
  some.topRows(24) = whole.triangles().topRows(24);
  some.bottomRows(24) = whole.triangles().bottomRows(24);  // without the middle square
  const MeshReport r = mesh_report(TriangleMesh(whole.shared_vertices(), some));
  ASSERT_EQ(r.boundary_loops.size(), 2U);
  EXPECT_NEAR(r.boundary_loops[0], 20.0, 1e-12);
  EXPECT_NEAR(r.boundary_loops[1], 4.0, 1e-12);
  EXPECT_NEAR(r.planar_area, 24.0, 1e-9);
}

TEST(MeshReport, WeighsSlopesByArea) {
  // 9 parts level, 1 part at 60°.
  const double s = std::sqrt(3.0) / 2.0;
  const MeshReport r =
      mesh_report(mesh_of({{0, 0, 0}, {9, 0, 0}, {9, 2, 0}, {9, 0, 0}, {9.5, 0, s}, {9.5, 2, s}},
                          {{0, 1, 2}, {3, 4, 5}}));
  EXPECT_NEAR(r.slope_mean, 0.1 * pi / 3, 1e-12);
  EXPECT_EQ(r.slope_median, 0.0);
  EXPECT_NEAR(r.slope_p95, pi / 3, 1e-12);
}

TEST(MeshReport, TakesAnEmptyMeshAndOneWithoutArea) {
  const MeshReport empty = mesh_report(TriangleMesh());
  EXPECT_EQ(empty.triangle_count, 0);
  EXPECT_EQ(empty.area, 0.0);
  EXPECT_TRUE(std::isnan(empty.rugosity));
  EXPECT_FALSE(empty.closed);
  const MeshReport point = mesh_report(mesh_of({{1, 1, 1}}, {{0, 0, 0}}));
  EXPECT_EQ(point.zero_area_triangles, 1);
  EXPECT_TRUE(std::isnan(point.slope_median));
  EXPECT_FALSE(describe(point).empty());
  const MeshReport vast =
      mesh_report(mesh_of({{0, 0, 0}, {1e300, 0, 0}, {0, 1e300, 0}}, {{0, 1, 2}}));
  EXPECT_FALSE(std::isfinite(vast.planar_area));
}

TEST(MeshReport, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh mesh =
      field(150, [](double x, double y) { return std::sin(0.3 * x) * std::cos(0.7 * y); });
  const MeshReport one = mesh_report(mesh, 1), eight = mesh_report(mesh, 8);
  EXPECT_EQ(one.area, eight.area);
  EXPECT_EQ(one.planar_area, eight.planar_area);
  EXPECT_EQ(one.slope_p95, eight.slope_p95);
  EXPECT_EQ(one.boundary_loops, eight.boundary_loops);
  EXPECT_THROW(mesh_report(mesh, -1), std::invalid_argument);
}

TEST(Orient, TurnsAShuffledCubeOutwardAndAShuffledFieldUp) {
  TriangleMesh cube = mesh_of(kCube, kCubeRows, Vec3(1e6, 1e6, -50));
  TriangleMatrix rows = cube.triangles();
  for (const Index t : {1, 4, 5, 9}) std::swap(rows(t, 0), rows(t, 1));
  orient(cube.vertices(), rows);
  const MeshReport r = mesh_report(TriangleMesh(cube.shared_vertices(), rows));
  EXPECT_TRUE(r.closed);
  EXPECT_NEAR(r.volume, 1.0, 1e-9);

  const TriangleMesh up = field(6, [](double x, double y) { return std::sin(x + y); });
  rows = up.triangles();
  for (Index t = 0; t < rows.rows(); t += 3) std::swap(rows(t, 1), rows(t, 2));
  orient(up.vertices(), rows);
  const MeshReport turned = mesh_report(TriangleMesh(up.shared_vertices(), rows));
  EXPECT_EQ(turned.inverted_triangles, 0);
  EXPECT_EQ(turned.inconsistent_edges, 0);
}

}  // namespace
}  // namespace bathyal
