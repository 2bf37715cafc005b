// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/hull_report.hpp"

#include <gtest/gtest.h>

#include <random>

#include "../scene/meshes.hpp"
#include "bathyal/workspace/internal/triangle_pairs.hpp"

namespace bathyal {
namespace {

using workspace::WeldedMesh;

TEST(HullReport, FindsNothingWrongWithASphere) {
  const HullReport report = hull_report(test::sphere(4, 0.5));
  EXPECT_TRUE(report.closed);
  EXPECT_FALSE(report.inside_out);
  EXPECT_NEAR(report.volume, 0.5236, 0.005);
  EXPECT_EQ(report.parts, 1);
  EXPECT_EQ(report.intersecting_pairs, 0);
  EXPECT_TRUE(report.warnings.empty()) << describe(report);
}

TEST(HullReport, SaysWhatIsOpenAndInsideOut) {
  const TriangleMesh box = test::box({1.0, 1.0, 1.0});
  TriangleMatrix triangles = box.triangles().topRows(11);
  const HullReport open = hull_report({box.shared_vertices(), triangles});
  EXPECT_FALSE(open.closed);
  EXPECT_EQ(open.boundary_edges, 3);
  EXPECT_EQ(open.open_edges, 3);
  EXPECT_TRUE(std::isnan(open.volume));
  ASSERT_EQ(open.warnings.size(), 1U);

  triangles = box.triangles();
  triangles.row(0).reverseInPlace();
  const HullReport turned = hull_report({box.shared_vertices(), triangles});
  EXPECT_EQ(turned.inconsistent_edges, 3);
  EXPECT_EQ(turned.boundary_edges, 0);

  triangles = box.triangles().rowwise().reverse();
  const HullReport inside_out = hull_report({box.shared_vertices(), triangles});
  EXPECT_TRUE(inside_out.inside_out);
  EXPECT_DOUBLE_EQ(inside_out.volume, 8.0);
  EXPECT_EQ(inside_out.warnings.size(), 1U);
}

TEST(HullReport, WarnsOfSizeAndPlace) {
  EXPECT_EQ(hull_report(test::box({900.0, 300.0, 300.0})).warnings.size(), 1U);
  EXPECT_EQ(hull_report(test::box({0.001, 0.0003, 0.0003})).warnings.size(), 1U);
  EXPECT_EQ(hull_report(test::box({1.0, 1.0, 1.0}, {1e7, 0.0, 0.0})).warnings.size(), 1U);
  EXPECT_TRUE(hull_report(test::box({3.0, 0.4, 0.4}, {2.0, 0.0, 0.0})).warnings.empty());
}

/// Two boxes that cross, each pair of triangles decided by hand: a bar through a plate.
TEST(HullReport, CountsPartsThatOverlap) {
  std::vector<Vec3> vertices;
  std::vector<Eigen::Vector3i> triangles;
  for (const TriangleMesh& box :
       {test::box({1.0, 1.0, 0.1}), test::box({0.1, 0.1, 1.0}, {0.3, 0.1, 0.0})}) {
    const int first = static_cast<int>(vertices.size());
    for (Index i = 0; i < box.vertex_count(); ++i) vertices.push_back(box.vertices().row(i));
    for (Index t = 0; t < box.triangle_count(); ++t) {
      triangles.push_back(box.triangles().row(t).transpose().array() + first);
    }
  }
  const HullReport report = hull_report(test::mesh_of(vertices, triangles));
  EXPECT_EQ(report.parts, 2);
  EXPECT_EQ(report.overlapping_parts, 1);
  EXPECT_TRUE(report.closed);
  // Each of the eight triangles of the bar's sides passes through top and bottom of the plate,
  // where it meets one triangle, or two where it crosses the diagonal.
  EXPECT_GE(report.intersecting_pairs, 12);
  EXPECT_LE(report.intersecting_pairs, 32);
}

WeldedMesh two(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e,
               const Vec3& f) {
  return WeldedMesh(test::mesh_of({a, b, c, d, e, f}, {{0, 1, 2}, {3, 4, 5}}));
}

TEST(TriangleIntersection, DecidesByWhatIsShared) {
  const Vec3 a(0, 0, 0), b(2, 0, 0), c(0, 2, 0), up(0, 0, 1);
  // Nothing shared: through, touching by a corner, above, next to it in its plane, inside it.
  EXPECT_TRUE(intersect(two(a, b, c, {0.5, 0.5, -1}, {0.5, 0.5, 1}, {3, 3, 1}), 0, 1));
  EXPECT_TRUE(intersect(two(a, b, c, {0.5, 0.5, 0}, {0.5, 0.5, 1}, {3, 3, 1}), 0, 1));
  EXPECT_FALSE(intersect(two(a, b, c, {0.5, 0.5, 1e-300}, {0.5, 0.5, 1}, {3, 3, 1}), 0, 1));
  EXPECT_FALSE(intersect(two(a, b, c, {1.5, 1.5, 0}, {3, 2, 0}, {2, 3, 0}), 0, 1));
  EXPECT_TRUE(intersect(two(a, b, c, {0.2, 0.2, 0}, {0.4, 0.2, 0}, {0.2, 0.4, 0}), 0, 1));
  // A corner shared: apart, through the other, and along it in one plane.
  EXPECT_FALSE(intersect(two(a, b, c, a, {-1, 0, 1}, {0, -1, 1}), 0, 1));
  EXPECT_TRUE(intersect(two(a, b, c, a, {1, 1, -1}, {1, 1, 1}), 0, 1));
  EXPECT_FALSE(intersect(two(a, b, c, a, {-1, 0, 0}, {0, -1, 0}), 0, 1));
  EXPECT_TRUE(intersect(two(a, b, c, a, {1, 1, 0}, {1, 0.5, 0}), 0, 1));
  // An edge shared: a crease, flat, and folded onto itself.
  EXPECT_FALSE(intersect(two(a, b, c, b, a, up), 0, 1));
  EXPECT_FALSE(intersect(two(a, b, c, b, a, {0, -2, 0}), 0, 1));
  EXPECT_TRUE(intersect(two(a, b, c, b, a, {0, 1, 0}), 0, 1));
  // All shared, and one without area.
  EXPECT_TRUE(intersect(two(a, b, c, c, b, a), 0, 1));
  EXPECT_FALSE(intersect(two(a, b, c, {0.5, 0.5, -1}, {0.5, 0.5, 0}, {0.5, 0.5, 1}), 0, 1));
}

TEST(TrianglePairs, AreThoseOfAllPairs) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> whole(0, 12);  // ties and flat triangles are common
  std::vector<Vec3> vertices;
  std::vector<Eigen::Vector3i> triangles;
  for (int t = 0; t < 300; ++t) {
    const Vec3 corner(whole(random), whole(random), whole(random));
    for (int c = 0; c < 3; ++c) {
      vertices.push_back(corner + Vec3(whole(random) % 4, whole(random) % 4, whole(random) % 4));
    }
    triangles.emplace_back(3 * t, 3 * t + 1, 3 * t + 2);
  }
  const WeldedMesh mesh(test::mesh_of(vertices, triangles));
  std::vector<std::pair<std::int32_t, std::int32_t>> expected;
  for (int i = 0; i < 300; ++i) {
    for (int j = i + 1; j < 300; ++j) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      EXPECT_EQ(intersect(mesh, a, b), intersect(mesh, b, a));
      if (intersect(mesh, a, b)) expected.emplace_back(i, j);
    }
  }
  EXPECT_GT(expected.size(), 50U);
  EXPECT_EQ(workspace::intersecting_pairs(mesh, 1), expected);
  EXPECT_EQ(workspace::intersecting_pairs(mesh, 2), expected);
}

}  // namespace
}  // namespace bathyal
