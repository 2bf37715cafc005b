// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/toolpath/internal/normals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "bathyal/base/random.hpp"
#include "bathyal/toolpath/internal/route.hpp"
#include "bathyal/toolpath/internal/sheet_walk.hpp"
#include "bottoms.hpp"

namespace bathyal {
namespace {

using namespace toolpath;

using test::down;
using test::grid;
using test::mesh_of;
using test::scene_of;

double angle(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

TriangleMesh with_uncertainty(const TriangleMesh& mesh, double sigma) {
  Values::Matrix values = Values::Matrix::Constant(mesh.vertex_count(), sigma);
  return {mesh.shared_vertices(), mesh.shared_triangles(), {{"uncertainty", Values(values)}}};
}

TriangleMesh noisy(double sigma, double spacing, int cells, std::uint64_t seed) {
  RandomStream random(seed);
  const double size = spacing * cells;
  return grid([&](double, double) { return sigma * random.normal(); }, 0, size, cells, 0, size,
              cells);
}

double std_of_one_facet(double leg, double sigma) {
  const TriangleMesh mesh =
      with_uncertainty(mesh_of({{0, 0, 0}, {leg, 0, 0}, {0, leg, 0}}, {{0, 1, 2}}), sigma);
  return plan_toolpath(scene_of(mesh), down({{leg / 4, leg / 4}})).normal_std[0];
}

TEST(NormalStd, OfARightFacetIsTwoSigmaOverItsLeg) {
  for (const double ratio : {1e-3, 0.05, 0.4}) {
    EXPECT_NEAR(std_of_one_facet(2.0, 2.0 * ratio), std::atan(2 * ratio), 1e-12);
  }
}

TEST(NormalStd, TwoCentimetresAtFiveCentimetreSpacingTiltAFacetByThirtyDegrees) {
  double mean = 0.0, squared = 0.0;
  const int draws = 20000;
  RandomStream random(1);
  for (int k = 0; k < draws; ++k) {
    const double z0 = 0.02 * random.normal(), z1 = 0.02 * random.normal(),
                 z2 = 0.02 * random.normal();
    const TriangleMesh mesh = mesh_of({{0, 0, z0}, {0.05, 0, z1}, {0, 0.05, z2}}, {{0, 1, 2}});
    const double tilt = angle(outward_normal(mesh, 0), Vec3::UnitZ());
    mean += tilt / draws;
    squared += tilt * tilt / draws;
  }
  const double degrees = 180.0 / std::numbers::pi;
  EXPECT_NEAR(mean * degrees, 32.5, 0.5);
  // To first order in the slope, so a little above the drawn root mean square for so steep a tilt.
  EXPECT_NEAR(std_of_one_facet(0.05, 0.02), std::sqrt(squared), 0.1);
}

TEST(NormalStd, IsTheDrawnRootMeanSquareOfGentleTilts) {
  for (const double radius : {0.0, 0.2}) {
    const double sigma = 0.002;
    double squared = 0.0, stated = 0.0;
    const int draws = 300;
    for (int k = 0; k < draws; ++k) {
      const TriangleMesh mesh = with_uncertainty(noisy(sigma, 0.05, 12, 100 + k), sigma);
      ToolPathOptions options;
      options.normal_radius = radius;
      const ToolPath path = plan_toolpath(scene_of(mesh), down({{0.31, 0.32}}), options);
      const double tilt = angle(path.approach[0], Vec3::UnitZ());
      squared += tilt * tilt / draws;
      stated += path.normal_std[0] * path.normal_std[0] / draws;
    }
    EXPECT_NEAR(std::sqrt(stated / squared), 1.0, radius == 0.0 ? 0.25 : 0.1) << radius;
  }
}

TEST(NormalStd, WithoutAnAttributeComesFromTheScatterAround) {
  const double sigma = 0.002;
  double without = 0.0;
  const int draws = 200;
  for (int k = 0; k < draws; ++k) {
    const ToolPath path =
        plan_toolpath(scene_of(noisy(sigma, 0.05, 12, 500 + k)), down({{0.31, 0.32}}));
    without += path.normal_std[0] * path.normal_std[0] / draws;
  }
  EXPECT_NEAR(std::sqrt(without) / std::atan(2 * sigma / 0.05), 1.0, 0.05);
  const Scene lone = scene_of(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  EXPECT_TRUE(std::isnan(plan_toolpath(lone, down({{0.2, 0.2}})).normal_std[0]))
      << "soundings unknown";
  EXPECT_EQ(plan_toolpath(Plane(Vec3::UnitZ(), 0), down({{0, 0}})).normal_std[0], 0.0);
}

TEST(Footprint, DoesNotStayNearASteepFacet) {
  RandomStream random(11);
  const auto slope = [&](double x, double) { return 1.2 * x + 0.04 * random.normal(); };
  const Scene scene = scene_of(grid(slope, 0, 3, 60, 0, 3, 60));
  ToolPathOptions options;
  options.normal_radius = 0.3;
  options.orientation = Orientation::kPiecewiseConstant;
  const ToolPath path = plan_toolpath(scene, down({{0.5, 0.6}, {2.5, 2.4}}), options);
  double steepest = 0.0, worst = 0.0;
  for (std::size_t j = 0; j < path.size(); ++j) {
    const Vec3 facet = outward_normal(scene.meshes()[0], path.triangle[j]);
    steepest = std::max(steepest, angle(facet, Vec3(-1.2, 0, 1)));
    worst = std::max(worst, angle(path.approach[j], Vec3(-1.2, 0, 1)));
  }
  EXPECT_GT(steepest, 0.7) << "the ground must hold what the test is about";
  EXPECT_LT(worst, 0.15);
}

TEST(Footprint, IsExactOnATiltedPlaneAndQuietsNoise) {
  ToolPathOptions options;
  options.normal_radius = 0.3;
  const auto tilted = [](double x, double y) { return 0.4 * x - 0.3 * y; };
  const ToolPath exact =
      plan_toolpath(scene_of(grid(tilted, 0, 4, 40, 0, 4, 40)), down({{1, 1}, {3, 2.5}}), options);
  for (const Vec3& a : exact.approach) EXPECT_LT(angle(a, Vec3(-0.4, 0.3, 1)), 1e-9);

  const Scene scene = scene_of(noisy(0.02, 0.05, 60, 3));
  const auto worst = [&](double radius) {
    options.normal_radius = radius;
    double tilt = 0.0;
    for (const Vec3& a : plan_toolpath(scene, down({{0.5, 0.5}, {2.5, 2.4}}), options).approach) {
      tilt = std::max(tilt, angle(a, Vec3::UnitZ()));
    }
    return tilt;
  };
  EXPECT_LT(worst(0.3), 0.2 * worst(0.0));
}

TEST(Footprint, SmallerThanTheFacetsIsTheFacet) {
  const auto roof = [](double x, double) { return -std::abs(x); };
  const Scene scene = scene_of(grid(roof, -4, 4, 2, -2, 2, 1));
  ToolPathOptions options = test::piecewise_constant();
  const ToolPath facets = plan_toolpath(scene, down({{-2, 0.5}, {2, 0.5}}), options);
  options.normal_radius = 0.01;
  const ToolPath footprint = plan_toolpath(scene, down({{-2, 0.5}, {2, 0.5}}), options);
  EXPECT_EQ(footprint.approach.front(), facets.approach.front());
  EXPECT_EQ(footprint.approach.back(), facets.approach.back());
}

TEST(Footprint, StaysOnItsSideOfAPlate) {
  // A plate 2 cm thick, folded at x = 1: near the fold its underside is within the footprint.
  const TriangleMesh flat = grid([](double, double) { return 0.0; }, 0, 2, 40, 0, 1, 20);
  PointMatrix vertices = flat.vertices();
  for (Index i = 0; i < vertices.rows(); ++i) {
    if (vertices(i, 0) < 1.01) continue;
    vertices(i, 0) = 2.0 - vertices(i, 0);
    vertices(i, 2) = -0.02;
  }
  ToolPathOptions options;
  options.normal_radius = 0.2;
  const ToolPath path = plan_toolpath(scene_of(TriangleMesh(vertices, flat.shared_triangles())),
                                      down({{0.91, 0.51}}), options);
  EXPECT_LT(angle(path.approach[0], Vec3::UnitZ()), 1e-12);
  EXPECT_LT(path.normal_std[0], 1e-9);
}

TEST(OutwardNormal, OfAFacetWithoutAreaIsThatOfItsNeighbourOnThePath) {
  // The first triangle is flat to a line along y, and the path begins or ends along it.
  const auto at = [](double x, double y) { return Vec3(x, y, 0.2 * x + 0.1 * y); };
  const Scene scene = scene_of(
      mesh_of({at(0, -1), at(0, 1), at(-2, 0), at(2, 0), at(0, 0), at(0, 3)},
              {{0, 4, 1}, {2, 0, 4}, {2, 4, 1}, {0, 3, 4}, {4, 3, 1}, {2, 1, 5}, {1, 3, 5}}));
  for (const Aims& aims : {down({{0, -0.4}, {0, 2}}), down({{0, 2}, {0, -0.4}})}) {
    const ToolPath path = plan_toolpath(scene, aims, test::piecewise_constant());
    EXPECT_NE(std::find(path.triangle.begin(), path.triangle.end(), 0), path.triangle.end());
    for (const Vec3& a : path.approach) {
      EXPECT_NEAR(a.norm(), 1.0, 1e-12);
      EXPECT_LT(angle(a, Vec3(-0.2, -0.1, 1)), 1e-9);
    }
  }
}

TEST(SheetWalk, StaysOnTheSheetAndWithinTheRadius) {
  const TriangleMesh mesh = grid([](double, double) { return 0.0; }, 0, 10, 10, 0, 10, 10);
  const SheetWalk walk(mesh);
  const Vec3 centre(5, 5, 0);
  std::vector<std::int32_t> expected;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if ((Vec3(mesh.vertices().row(v)) - centre).norm() <= 1.5) {
      expected.push_back(static_cast<std::int32_t>(v));
    }
  }
  EXPECT_EQ(walk.vertices_within(2 * (5 * 10 + 5), centre, 1.5), expected);
  std::set<std::int32_t> around;
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::Vector3i corners = mesh.triangles().row(t), first = mesh.triangles().row(0);
    const auto shared = [&](int v) { return (first.array() == v).any(); };
    if (std::any_of(corners.begin(), corners.end(), shared))
      around.insert(corners.begin(), corners.end());
  }
  EXPECT_EQ(walk.vertices_around(0), std::vector<std::int32_t>(around.begin(), around.end()));
}

TEST(Route, IsCutIntoEqualPartsThatKeepTheFacet) {
  Route route;
  route.runs.emplace_back();
  Piece piece;
  piece.to = Vec3(1, 0, 0);
  piece.triangle = 7;
  route.runs[0].pieces = {piece};
  subdivide(route, 0.3);
  ASSERT_EQ(route.runs[0].pieces.size(), 4U);
  for (const Piece& part : route.runs[0].pieces) {
    EXPECT_NEAR(part.length(), 0.25, 1e-15);
    EXPECT_EQ(part.triangle, 7);
  }
  EXPECT_EQ(route.runs[0].pieces.back().to, Vec3(1, 0, 0));
}

}  // namespace
}  // namespace bathyal
