// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>
#include <set>

#include "bathyal/scene/scene.hpp"
#include "meshes.hpp"

namespace bathyal {
namespace {

using test::mesh_of;

/// A level grid of columns × rows points at 1 m, its first point at `corner`.
TriangleMesh level_grid(int columns, int rows, const Vec3& corner = Vec3::Zero()) {
  std::vector<Vec3> vertices;
  std::vector<Eigen::Vector3i> triangles;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) vertices.push_back(corner + Vec3(i, j, 0.0));
  }
  for (int j = 0; j + 1 < rows; ++j) {
    for (int i = 0; i + 1 < columns; ++i) {
      const int a = j * columns + i;
      triangles.emplace_back(a, a + 1, a + columns + 1);
      triangles.emplace_back(a, a + columns + 1, a + columns);
    }
  }
  return mesh_of(vertices, triangles);
}

TriangleMesh moved(const TriangleMesh& mesh, const Eigen::Isometry3d& motion) {
  PointMatrix vertices(mesh.vertex_count(), 3);
  for (Index i = 0; i < vertices.rows(); ++i) {
    vertices.row(i) = motion * Vec3(mesh.vertices().row(i).transpose());
  }
  return {std::move(vertices), mesh.shared_triangles()};
}

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

double length(const Polyline& line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    sum += (line.points[i] - line.points[i - 1]).norm();
  }
  return sum;
}

double length(const std::vector<Polyline>& lines) {
  double sum = 0.0;
  for (const Polyline& line : lines) sum += length(line);
  return sum;
}

/// What every section promises, whatever the mesh.
void expect_well_formed(const std::vector<Polyline>& lines, const Scene& scene) {
  using Corner = std::array<double, 3>;
  std::set<std::tuple<std::int32_t, Corner, Corner>> seen;
  for (const Polyline& line : lines) {
    ASSERT_GE(line.points.size(), 2U);
    ASSERT_EQ(line.mesh.size(), line.points.size() - 1);
    ASSERT_EQ(line.triangle.size(), line.points.size() - 1);
    EXPECT_EQ(line.closed, line.points.front() == line.points.back());
    for (std::size_t i = 0; i < line.mesh.size(); ++i) {
      EXPECT_EQ(line.mesh[i], line.mesh[0]);
      const Vec3 &p = line.points[i], &q = line.points[i + 1];
      EXPECT_NE(p, q) << "a segment of no length";
      Corner a{p.x(), p.y(), p.z()}, b{q.x(), q.y(), q.z()};
      if (b < a) std::swap(a, b);
      EXPECT_TRUE(seen.emplace(line.mesh[i], a, b).second) << "a segment twice";
      const TriangleMesh& mesh = scene.meshes()[static_cast<std::size_t>(line.mesh[i])];
      const Vec3 v0 = mesh.corner(line.triangle[i], 0);
      const double size = 1.0 + v0.norm();
      const Vec3 normal = mesh.area_vector(line.triangle[i]).normalized();
      EXPECT_NEAR(normal.dot(p - v0), 0.0, 1e-13 * size) << "off its triangle's plane";
      EXPECT_NEAR(normal.dot(q - v0), 0.0, 1e-13 * size);
    }
  }
}

void expect_equal(const std::vector<Polyline>& a, const std::vector<Polyline>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].points, b[i].points);
    EXPECT_EQ(a[i].closed, b[i].closed);
  }
}

TEST(Section, SphereGivesItsCircle) {
  const Scene scene({test::sphere(5, 2.0)});
  const auto lines = scene.section(Plane({0.3, -0.2, 0.9}, 0.731));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(lines[0].closed);
  expect_well_formed(lines, scene);
  const double radius = std::sqrt(4.0 - std::pow(0.731 / std::sqrt(0.94), 2));
  EXPECT_NEAR(length(lines[0]), 2.0 * std::numbers::pi * radius, 0.02);
}

TEST(Section, ClosedLinesRunCounterClockwiseFromTheirFirstPoint) {
  const Scene scene({test::box({1.0, 2.0, 3.0})});
  for (const double up : {1.0, -1.0}) {
    const auto lines = scene.section(Plane({0.0, 0.0, up}, 0.5 * up));
    ASSERT_EQ(lines.size(), 1U);
    ASSERT_TRUE(lines[0].closed);
    EXPECT_EQ(lines[0].points.front(), Vec3(-1.0, -2.0, 0.5));
    Vec3 area = Vec3::Zero();
    for (std::size_t i = 1; i < lines[0].points.size(); ++i) {
      area += 0.5 * lines[0].points[i - 1].cross(lines[0].points[i]);
    }
    EXPECT_NEAR(area.z(), 8.0 * up, 1e-12);
  }
}

TEST(Section, EmptyWhereNothingIsCut) {
  const Scene scene({test::box({1.0, 1.0, 1.0})});
  EXPECT_TRUE(scene.section(Plane(Vec3::UnitZ(), 1.5)).empty());
  EXPECT_TRUE(scene.section({5.0, 0.0, 0.0}, {6.0, 0.0, 0.0}).empty());
  EXPECT_TRUE(Scene({TriangleMesh()}).section(Plane(Vec3::UnitZ(), 0.0)).empty());
}

// Errata: the printed t = |OA · r| / |V1 − V0|-normalised edge · r is right for no plane off the
// origin's side; t = r · (A − V0) / r · (V1 − V0) is right for all.
TEST(Section, EdgeCutIsNotThePrintedOne) {
  const Vec3 v0(0.0, -1.0, 0.0), v1(0.0, 3.0, 2.0), v2(4.0, 3.0, 1.0);
  const Scene scene({mesh_of({v0, v1, v2}, {{0, 1, 2}})});
  const Vec3 a(-1.0, 1.0, 9.0), b(5.0, 1.0, -3.0);
  const auto lines = scene.section(a, b);
  ASSERT_EQ(lines.size(), 1U);
  const Vec3 cut = lines[0].points.front();
  EXPECT_NEAR((cut - Vec3(0.0, 1.0, 1.0)).norm(), 0.0, 1e-15);

  const Vec3 r = (b - a).cross(Vec3::UnitZ()).normalized();
  const double printed = std::abs(a.dot(r)) / (v1 - v0).normalized().dot(r);
  const Vec3 printed_cut = v0 + printed * (v1 - v0);
  EXPECT_GT(std::abs(r.dot(printed_cut - a)), 0.5) << "the printed formula misses the plane";
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

TEST(Section, IsClippedToItsEndsExactly) {
  const Scene scene({test::seabed(60, 40)});
  const TriangleMesh& mesh = scene.meshes()[0];
  const auto on_surface = [&](Index triangle, double u, double v) {
    return Vec3(mesh.corner(triangle, 0) +
                u * (mesh.corner(triangle, 1) - mesh.corner(triangle, 0)) +
                v * (mesh.corner(triangle, 2) - mesh.corner(triangle, 0)));
  };
  std::mt19937 random(7);
  std::uniform_int_distribution<Index> triangle(0, mesh.triangle_count() - 1);
  for (int i = 0; i < 300; ++i) {
    // In a triangle, on an edge, on a corner.
    const double u = i % 3 == 0 ? 0.3 : i % 3 == 1 ? 0.4 : 1.0;
    const double v = i % 3 == 0 ? 0.2 : i % 3 == 1 ? 0.6 : 0.0;
    const Vec3 a = on_surface(triangle(random), u, v);
    const Vec3 b = on_surface(triangle(random), u, v);
    if ((b - a).head<2>().norm() < 0.1) continue;
    const auto lines = scene.section(a, b);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0].points.front(), a);
    EXPECT_EQ(lines[0].points.back(), b);
    for (std::size_t k = 1; k < lines[0].points.size(); ++k) {
      EXPECT_GT((lines[0].points[k] - lines[0].points[k - 1]).norm(), 1e-9);
    }
    expect_well_formed(lines, scene);
  }
}

TEST(Section, ClippedAboveAndBelowTheSurfaceToo) {
  const Scene scene({level_grid(11, 11)});
  const auto lines = scene.section({2.25, 3.5, 7.0}, {8.75, 3.5, -4.0});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].points.front(), Vec3(2.25, 3.5, 0.0));
  EXPECT_EQ(lines[0].points.back(), Vec3(8.75, 3.5, 0.0));
}

TEST(Section, UpTurnsThePlane) {
  const Scene scene({test::sphere(4, 1.0)});
  const auto lines = scene.section({-1, 0, 0}, {1, 0, 0}, Vec3::UnitY());  // the plane z = 0
  ASSERT_FALSE(lines.empty());
  for (const Polyline& line : lines) {
    for (const Vec3& p : line.points) EXPECT_EQ(p.z(), 0.0);
  }
}

TEST(Section, SeveralSheetsAreSeveralLines) {
  const Scene scene({level_grid(5, 5), level_grid(5, 5, {0.0, 0.0, 2.0})});
  const auto lines = scene.section({0.0, 1.5, 0.0}, {4.0, 1.5, 0.0});
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].mesh.front(), 0);
  EXPECT_EQ(lines[1].mesh.front(), 1);
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

TEST(Section, SurveyCoordinatesKeepTheirMillimetres) {
  const Vec3 offset(512345.0, 7212345.0, -52.0);
  const Scene near({test::seabed(60, 40)}), far({test::seabed(60, 40, offset)});
  const Vec3 a(3.2, 4.1, 0.0), b(55.5, 31.9, 0.0);
  const auto here = near.section(a, b), there = far.section(a + offset, b + offset);
  ASSERT_EQ(here.size(), there.size());
  ASSERT_EQ(here[0].points.size(), there[0].points.size());
  for (std::size_t i = 0; i < here[0].points.size(); ++i) {
    EXPECT_NEAR((there[0].points[i] - offset - here[0].points[i]).norm(), 0.0, 1e-8);
  }
}

TEST(Section, RefusesPairsWithoutAPlane) {
  const Scene scene({level_grid(3, 3)});
  const Vec3 a(1.0, 1.0, 0.0);
  EXPECT_THROW(scene.section(a, a), std::invalid_argument);
  EXPECT_THROW(scene.section(a, a + 3.0 * Vec3::UnitZ()), std::invalid_argument);
  EXPECT_THROW(scene.section(a, a + Vec3::UnitX(), Vec3::UnitX()), std::invalid_argument);
  EXPECT_THROW(scene.section(a, a + Vec3::UnitX(), Vec3::Zero()), std::invalid_argument);
  EXPECT_THROW(scene.section(a, Vec3::Constant(std::nan(""))), std::invalid_argument);
  const Vec3 far(512345.3, 7212345.7, -52.0);
  EXPECT_THROW(scene.section(far, far + Vec3(1e-10, 0.0, 1.0)), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
