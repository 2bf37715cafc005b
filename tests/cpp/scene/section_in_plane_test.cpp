// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "bathyal/scene/scene.hpp"
#include "meshes.hpp"
#include "sections.hpp"

namespace bathyal {
namespace {

using test::expect_well_formed;
using test::length;
using test::level_grid;
using test::mesh_of;

TriangleMesh moved(const TriangleMesh& mesh, const Eigen::Isometry3d& motion) {
  PointMatrix vertices(mesh.vertex_count(), 3);
  for (Index i = 0; i < vertices.rows(); ++i) {
    vertices.row(i) = motion * Vec3(mesh.vertices().row(i).transpose());
  }
  return {std::move(vertices), mesh.shared_triangles()};
}

TEST(Section, VertexInThePlaneIsACutPoint) {
  const Scene scene(
      {mesh_of({{0, 0, 0}, {2, -1, 1}, {2, 1, 1}, {3, 0, 0}}, {{0, 1, 2}, {1, 3, 2}})});
  const auto lines = scene.section({0, 0, 5}, {3, 0, 5});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].points, (std::vector<Vec3>{{0, 0, 0}, {2, 0, 1}, {3, 0, 0}}));
  EXPECT_EQ(lines[0].triangle, (std::vector<std::int32_t>{0, 1}));
}

TEST(Section, TouchedAtOneCornerGivesNothing) {
  const Scene scene({test::tetrahedron()});
  EXPECT_TRUE(scene.section(Plane({1.0, 1.0, 1.0}, 3.0)).empty());
}

TEST(Section, EdgesInThePlaneAppearOnce) {
  const Scene scene({level_grid(6, 5)});
  const auto lines = scene.section({0.0, 2.0, 0.0}, {5.0, 2.0, 0.0});  // a row of grid edges
  expect_well_formed(lines, scene);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].points.size(), 6U);
  EXPECT_DOUBLE_EQ(length(lines[0]), 5.0);
}

TEST(Section, RidgeThatTouchesThePlaneIsKept) {
  const Scene scene(
      {mesh_of({{0, 0, 1}, {2, 0, 1}, {1, -1, 0}, {1, 1, 0}}, {{0, 2, 1}, {0, 1, 3}})});
  const auto lines = scene.section(Plane(Vec3::UnitZ(), 1.0));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].points, (std::vector<Vec3>{{0, 0, 1}, {2, 0, 1}}));
  EXPECT_EQ(lines[0].triangle, std::vector<std::int32_t>{0});
}

TEST(Section, BorderInThePlaneIsKeptFromBothSides) {
  const Scene scene({level_grid(6, 5)});
  for (const double y : {0.0, 4.0}) {
    for (const bool back : {false, true}) {
      Vec3 a(0.0, y, 0.0), b(5.0, y, 0.0);
      if (back) std::swap(a, b);
      const auto lines = scene.section(a, b);
      ASSERT_EQ(lines.size(), 1U);
      EXPECT_EQ(lines[0].points.size(), 6U);
      EXPECT_EQ(lines[0].points.front(), a);
      EXPECT_EQ(lines[0].points.back(), b);
    }
  }
}

TEST(Section, BorderOfAGridTurnedAtSurveyCoordinatesIsKept) {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.translate(Vec3(512345.25, 7212345.75, -52.0));
  motion.rotate(Eigen::AngleAxisd(0.7, Vec3(0.1, -0.2, 1.0).normalized()));
  const TriangleMesh mesh = moved(level_grid(40, 30), motion);
  const Scene scene({mesh});
  const Vec3 a = mesh.vertices().row(0), b = mesh.vertices().row(39);
  for (const auto& lines : {scene.section(a, b, motion.linear() * Vec3::UnitZ()),
                            scene.section(b, a, motion.linear() * Vec3::UnitZ())}) {
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0].points.size(), 40U);
    EXPECT_NEAR(length(lines[0]), 39.0, 1e-8);
  }
}

TEST(Section, TrianglesInThePlaneGiveTheirOutline) {
  // A plateau of 2 × 2 cells on a slope that falls away on all sides.
  std::vector<Vec3> vertices;
  for (int j = 0; j < 5; ++j) {
    for (int i = 0; i < 5; ++i) {
      const bool top = i > 0 && i < 4 && j > 0 && j < 4;
      vertices.emplace_back(i, j, top ? 1.0 : 0.0);
    }
  }
  const TriangleMesh flat = level_grid(5, 5);
  PointMatrix points(25, 3);
  for (Index i = 0; i < 25; ++i) points.row(i) = vertices[static_cast<std::size_t>(i)];
  const Scene scene({TriangleMesh(points, flat.shared_triangles())});
  const auto top = scene.section(Plane(Vec3::UnitZ(), 1.0));
  expect_well_formed(top, scene);
  ASSERT_EQ(top.size(), 1U);
  EXPECT_TRUE(top[0].closed);
  EXPECT_DOUBLE_EQ(length(top[0]), 8.0);

  const Scene whole({flat});  // all of it in the plane: the border, where the surface ends
  const auto border = whole.section(Plane(Vec3::UnitZ(), 0.0));
  ASSERT_EQ(border.size(), 1U);
  EXPECT_TRUE(border[0].closed);
  EXPECT_DOUBLE_EQ(length(border[0]), 16.0);

  const Scene box({test::box({1.0, 2.0, 3.0})});
  const auto face = box.section(Plane(Vec3::UnitX(), 1.0));
  ASSERT_EQ(face.size(), 1U);
  EXPECT_DOUBLE_EQ(length(face[0]), 20.0);
}

TEST(Section, TriangleWithoutWidthInThePlaneIsNotFollowedTwice) {
  // Above the line one triangle, below it two; a sliver (0, 1, 2) fills the junction.
  const Scene scene({mesh_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 1}, {1, -1, -1}},
                             {{0, 1, 2}, {0, 2, 3}, {0, 4, 1}, {1, 4, 2}})});
  const auto lines = scene.section({0, 0, 0}, {2, 0, 0});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].points, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
}

TEST(Section, DegenerateTrianglesBreakNoLine) {
  const Scene scene({mesh_of({{0, 0, 0}, {2, -1, 0}, {2, 1, 0}, {4, 0.5, 0}},
                             {{0, 1, 2}, {1, 1, 2}, {2, 2, 2}, {1, 3, 2}})});
  const auto lines = scene.section({-1, 0.25, 0}, {5, 0.25, 0});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].triangle, (std::vector<std::int32_t>{0, 3}));
}

}  // namespace
}  // namespace bathyal
