// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "bathyal/scene/internal/chain.hpp"
#include "bathyal/scene/scene.hpp"
#include "meshes.hpp"
#include "sections.hpp"

namespace bathyal {
namespace {

using test::expect_equal;
using test::expect_well_formed;
using test::length;
using test::level_grid;
using test::mesh_of;

/// The same triangles with corners of their own, as an STL file has them.
TriangleMesh soup(const TriangleMesh& mesh) {
  PointMatrix vertices(3 * mesh.triangle_count(), 3);
  TriangleMatrix triangles(mesh.triangle_count(), 3);
  for (Index t = 0; t < triangles.rows(); ++t) {
    for (int c = 0; c < 3; ++c) {
      vertices.row(3 * t + c) = mesh.corner(t, c);
      triangles(t, c) = static_cast<std::int32_t>(3 * t + c);
    }
  }
  return {std::move(vertices), std::move(triangles)};
}

TEST(Section, MeshesAreNeverJoined) {
  const Scene scene({level_grid(3, 3), level_grid(3, 3, {2.0, 0.0, 0.0})});
  const auto lines = scene.section({0.0, 0.5, 0.0}, {4.0, 0.5, 0.0});
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].points.back(), lines[1].points.front());
}

TEST(Section, SoupIsJoinedByPosition) {
  const TriangleMesh mesh = test::seabed(30, 20);
  const Vec3 a(1.3, 2.7, 0.0), b(27.1, 15.9, 0.0);
  expect_equal(Scene({mesh}).section(a, b), Scene({soup(mesh)}).section(a, b));
}

TEST(Section, NonManifoldMeshesLoseNothing) {
  // Five half planes around the y axis, cut across: five segments that meet in one point.
  std::vector<Vec3> vertices = {{0, 0, 0}, {0, 2, 0}};
  std::vector<Eigen::Vector3i> triangles;
  for (int i = 0; i < 5; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 5.0 + 0.1;
    vertices.emplace_back(std::cos(angle), 1.0, std::sin(angle));
    triangles.emplace_back(0, 1, 2 + i);
  }
  const Scene scene({mesh_of(vertices, triangles)});
  const auto lines = scene.section(Plane(Vec3::UnitY(), 1.0));
  expect_well_formed(lines, scene);
  EXPECT_EQ(lines.size(), 3U);  // two pass through the axis, one ends there
  EXPECT_NEAR(length(lines), 5.0, 1e-12);

  // One triangle twice, and once turned over.
  const Scene doubled(
      {mesh_of({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {{0, 1, 2}, {0, 1, 2}, {2, 1, 0}})});
  const auto once = doubled.section(Plane(Vec3::UnitX(), 0.5));
  ASSERT_EQ(once.size(), 1U);
  EXPECT_EQ(once[0].triangle, std::vector<std::int32_t>{0});
  EXPECT_NEAR(length(doubled.section(Plane(Vec3::UnitZ(), 0.0))), 4.0 + 2.0 * std::sqrt(2.0),
              1e-12);
}

TEST(Section, ManyFinsOnOneAxisEndInTime) {
  std::vector<Vec3> vertices = {{0, 0, 0}, {0, 2, 0}};
  std::vector<Eigen::Vector3i> triangles;
  constexpr int kFins = 1001;
  for (int i = 0; i < kFins; ++i) {
    vertices.emplace_back(std::cos(0.1 * i), 1.0, std::sin(0.1 * i));
    triangles.emplace_back(0, 1, 2 + i);
  }
  const Scene scene({mesh_of(vertices, triangles)});
  const auto lines = scene.section(Plane(Vec3::UnitY(), 1.0));
  EXPECT_EQ(lines.size(), (kFins + 1U) / 2U);
  EXPECT_NEAR(length(lines), kFins, 1e-9);
}

TEST(Section, SaddleCrossesStraight) {
  // z = xy about the origin: the plane z = 0 cuts along both axes.
  const Scene scene({mesh_of(
      {{0, 0, 0},
       {1, 0, 0},
       {1, 1, 1},
       {0, 1, 0},
       {-1, 1, -1},
       {-1, 0, 0},
       {-1, -1, 1},
       {0, -1, 0},
       {1, -1, -1}},
      {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}, {0, 6, 7}, {0, 7, 8}, {0, 8, 1}})});
  const auto lines = scene.section(Plane(Vec3::UnitZ(), 0.0));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].points, (std::vector<Vec3>{{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}}));
  EXPECT_EQ(lines[1].points, (std::vector<Vec3>{{0, -1, 0}, {0, 0, 0}, {0, 1, 0}}));
}

TEST(Section, OrderOfTrianglesDoesNotMatter) {
  const TriangleMesh mesh = test::sphere(3, 2.0);
  TriangleMatrix shuffled = mesh.triangles();
  std::mt19937 random(3);
  for (Index i = shuffled.rows() - 1; i > 0; --i) {
    const Index j = std::uniform_int_distribution<Index>(0, i)(random);
    shuffled.row(i).swap(shuffled.row(j));
  }
  const Scene scene({mesh}), other({TriangleMesh(mesh.shared_vertices(), shuffled)});
  for (const double offset : {-1.9, 0.0, 0.3, 1.2}) {
    expect_equal(scene.section(Plane({1, 2, 3}, offset)), other.section(Plane({1, 2, 3}, offset)));
    expect_equal(scene.section(Plane({0, 0, 1}, offset)), other.section(Plane({0, 0, 1}, offset)));
  }
}

TEST(ChainSegments, DoNotDependOnTheOrderOfTheSegments) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  std::vector<scene::CutSegment> segments{{{2, 3}, 0, 5}, {{1, 0}, 0, 4}, {{1, 2}, 0, 6}};
  for (int turn = 0; turn < 3; ++turn) {
    std::rotate(segments.begin(), segments.begin() + 1, segments.end());
    const auto lines = scene::chain_segments(points, segments, Vec3::UnitX(), Vec3::UnitZ());
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0].points, points);
    EXPECT_EQ(lines[0].triangle, (std::vector<std::int32_t>{4, 6, 5}));
    EXPECT_FALSE(lines[0].closed);
  }
}

}  // namespace
}  // namespace bathyal
