// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "bathyal/scene/internal/cutter.hpp"
#include "bathyal/scene/scene.hpp"
#include "meshes.hpp"
#include "sections.hpp"

namespace bathyal {
namespace {

using test::expect_well_formed;
using test::length;
using test::level_grid;
using test::mesh_of;

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

TEST(Cutter, CutsAnEdgeAlikeFromBothEndsAndClipsToItsStrip) {
  const scene::Cutter cutter = scene::Cutter::between({431200.5, 6172650.25, -38},
                                                      {431210.5, 6172650.25, -30}, Vec3::UnitZ());
  const Vec3 a(431203.1, 6172649.3, -37.7), b(431204.9, 6172651.9, -36.1);
  const double pa = cutter.height(a), pb = cutter.height(b);
  ASSERT_LT(pa * pb, 0.0);
  const Vec3 cut = scene::Cutter::cut_edge(a, pa, b, pb);
  EXPECT_EQ(cut, scene::Cutter::cut_edge(b, pb, a, pa));
  EXPECT_NEAR(cut.y(), 6172650.25, 1e-8);
  EXPECT_EQ(cutter.height(cutter.anchor()), 0.0);
  Vec3 p(431190.5, 6172650.25, -38), q(431205.5, 6172650.25, -38);
  ASSERT_TRUE(cutter.clip(p, q));
  EXPECT_NEAR(p.x(), 431200.5, 1e-9);
  EXPECT_EQ(q.x(), 431205.5);
  q = Vec3(431195.5, 6172650.25, -38), p = q - Vec3::UnitX();
  EXPECT_FALSE(cutter.clip(p, q));
}

}  // namespace
}  // namespace bathyal
