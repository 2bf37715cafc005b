// SPDX-License-Identifier: BSD-3-Clause
// The section between targets: what the paper leaves open, one test or more for each.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bottoms.hpp"

namespace bathyal {
namespace {

using test::any;
using test::axis;
using test::down;
using test::grid;
using test::mesh_of;
using test::piecewise_constant;
using test::points_of;
using test::rows;
using test::scene_of;
using test::warned;

const auto kFlat = [](double, double) { return -5.0; };

// Erratum: the printed T takes |OA·r| and divides by a normalised edge.
TEST(EdgeCut, PrintedFormulaIsWrongAndTheTWeUseIsRight) {
  const Vec3 v0(0, 0, 0), v1(0, 4, 0), a(0, 1, 0), r(0, -1, 0);  // AA' along x: r = x × z = −y
  const Vec3 edge = v1 - v0;
  const double printed_t = -(r.dot(v0) + std::abs(a.dot(r))) / r.dot(edge);
  const Vec3 printed = v0 + printed_t * edge.normalized();
  EXPECT_GT((printed - a).norm(), 0.1) << "the printed formula misses the plane";
  // The same plane through the other side of the origin: wrong by its sign as well.
  const Vec3 b(0, -1, 0), w0(0, -4, 0);
  const double printed_s = -(r.dot(w0) + std::abs(b.dot(r))) / r.dot(v0 - w0);
  EXPECT_GT(std::abs(r.dot(w0 + printed_s * (v0 - w0).normalized() - b)), 0.1);

  for (const double y : {-1.0, 1.0}) {
    const Scene scene =
        scene_of(mesh_of({{-3, -4, 0}, {3, -4, 0}, {-3, 4, 0}, {3, 4, 0}}, {{0, 1, 2}, {1, 3, 2}}));
    const ToolPath path = plan_toolpath(scene, down({{-2, y}, {2, y}}), piecewise_constant());
    const auto points = points_of(path);
    ASSERT_EQ(points.size(), 3U);
    // The diagonal from (3, −4) to (−3, 4) at this y.
    EXPECT_NEAR((points[1] - Vec3(-0.75 * y, y, 0)).norm(), 0.0, 1e-12);
  }
}

TEST(Section, FollowsARidgeAndAValley) {
  for (const double sign : {1.0, -1.0}) {
    const auto roof = [sign](double x, double) { return -5.0 - sign * std::abs(x); };
    const Scene scene = scene_of(grid(roof, -4, 4, 2, -2, 2, 1));
    const ToolPath path = plan_toolpath(scene, down({{-2, 0.5}, {2, 0.5}}), piecewise_constant());
    const auto points = points_of(path);
    for (const Vec3& p : points) {
      EXPECT_NEAR(p.z(), roof(p.x(), 0.0), 1e-12);
      EXPECT_NEAR(p.y(), 0.5, 1e-12);
    }
    EXPECT_NEAR((points.front() - Vec3(-2, 0.5, -5 - 2 * sign)).norm(), 0.0, 1e-12);
    EXPECT_NEAR((points.back() - Vec3(2, 0.5, -5 - 2 * sign)).norm(), 0.0, 1e-12);
    EXPECT_NEAR(path.arc_length.back(), 4 * std::sqrt(2.0), 1e-12);
    EXPECT_NEAR((path.approach.front() - Vec3(-sign, 0, 1).normalized()).norm(), 0.0, 1e-12);
    EXPECT_NEAR((path.travel.front() - Vec3(1, 0, sign).normalized()).norm(), 0.0, 1e-12);
    EXPECT_NEAR((path.travel.back() - Vec3(1, 0, -sign).normalized()).norm(), 0.0, 1e-12);
  }
}

TEST(Section, OnAnEdgePiecewiseConstantGivesTTwiceOncePerTriangle) {
  const auto roof = [](double x, double) { return -std::abs(x); };
  const Scene scene = scene_of(grid(roof, -4, 4, 2, -2, 2, 1));
  const ToolPath path = plan_toolpath(scene, down({{-2, 0.5}, {2, 0.5}}), piecewise_constant());
  std::size_t twice = 0;
  for (std::size_t j = 0; j + 1 < path.size(); ++j) {
    if ((path.surface[j] - path.surface[j + 1]).norm() > 0.0) {
      EXPECT_EQ(path.triangle[j], path.triangle[j + 1]) << "a stretch lies on one triangle";
      EXPECT_EQ(path.approach[j], path.approach[j + 1]);
    } else {
      EXPECT_NE(path.triangle[j], path.triangle[j + 1]);
      ++twice;
    }
  }
  EXPECT_EQ(twice, points_of(path).size() - 2);
  EXPECT_GE(twice, 1U);
}

TEST(Section, FollowsTheArcOfASphereAndOfACylinder) {
  const double radius = 10.0;
  const auto cap = [&](double x, double y) { return std::sqrt(radius * radius - x * x - y * y); };
  const auto barrel = [&](double x, double) { return std::sqrt(radius * radius - x * x); };
  const Aims aims = down({{-4, 0.01}, {4, 0.01}});
  for (const bool sphere : {true, false}) {
    const Scene scene = sphere ? scene_of(grid(cap, -5, 5, 50, -5, 5, 50))
                               : scene_of(grid(barrel, -5, 5, 50, -5, 5, 50));
    const ToolPath path = plan_toolpath(scene, aims, piecewise_constant());
    EXPECT_NEAR(path.arc_length.back(), 2 * radius * std::asin(0.4), 0.01);
    for (std::size_t j = 0; j < path.size(); ++j) {
      Vec3 outward = path.surface[j];
      if (!sphere) outward.y() = 0.0;
      EXPECT_NEAR(outward.norm(), radius, 0.01);
      EXPECT_GT(path.approach[j].dot(outward.normalized()), std::cos(0.03));
    }
  }
}

TEST(Section, ACutThroughVerticesAndAlongEdgesIsNeitherBrokenNorDoubled) {
  // y = 2 runs along a row of edges, y = x along the diagonals, both through vertices with p = 0.
  const auto waves = [](double x, double y) { return std::sin(x) + 0.3 * y; };
  const Scene scene = scene_of(grid(waves, 0, 6, 6, 0, 6, 6));
  for (const auto& [from, to] : {std::pair<Eigen::Vector2d, Eigen::Vector2d>{{0.5, 2}, {5.5, 2}},
                                 {{0.5, 0.5}, {5.5, 5.5}},
                                 {{1, 2}, {5, 2}},
                                 {{3, 1}, {3, 5}}}) {
    const ToolPath path = plan_toolpath(scene, down({from, to}), piecewise_constant());
    EXPECT_FALSE(any(path.gap));
    const auto points = points_of(path);
    const Eigen::Vector2d ahead = (to - from).normalized();
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      EXPECT_GT(ahead.dot((points[k + 1] - points[k]).head<2>()), 0.1) << "each vertex once";
    }
    EXPECT_NEAR((points.back().head<2>() - to).norm(), 0.0, 1e-9);
    for (const Vec3& p : points) {
      if (std::abs(p.x() - std::round(p.x())) < 1e-9 &&
          std::abs(p.y() - std::round(p.y())) < 1e-9) {
        EXPECT_NEAR(p.z(), waves(std::round(p.x()), std::round(p.y())), 1e-9) << "T is the vertex";
      }
    }
  }
}

TEST(Section, WholeTrianglesInTheCuttingPlaneLeaveOnePath) {
  // A step whose riser lies in the plane y = 0 of the cut: both of its triangles lie in it.
  const Scene scene =
      scene_of(mesh_of({{-2, -2, 0},
                        {2, -2, 0},
                        {-2, 0, 0},
                        {2, 0, 0},
                        {-2, 0, 1},
                        {2, 0, 1},
                        {-2, 2, 1},
                        {2, 2, 1}},
                       {{0, 1, 3}, {0, 3, 2}, {2, 3, 5}, {2, 5, 4}, {4, 5, 7}, {4, 7, 6}}));
  const ToolPath path =
      plan_toolpath(scene, rows({axis({-1, 0, 9}, {0, 0, -1}), axis({1, 0, 9}, {0, 0, -1})}));
  EXPECT_NEAR(path.surface.front().x(), -1, 1e-9);
  EXPECT_NEAR(path.surface.back().x(), 1, 1e-9);
  EXPECT_LE(path.arc_length.back(), 4.0 + 1e-9);
  for (const Vec3& p : path.surface) {
    EXPECT_NEAR(p.y(), 0.0, 1e-9);
    EXPECT_TRUE(p.z() > -1e-9 && p.z() < 1 + 1e-9);
  }
}

TEST(Section, ATargetOnAnEdgeOrAVertexHasAPath) {
  const Scene scene = scene_of(grid(kFlat, 0, 4, 4, 0, 4, 4));
  for (const Eigen::Vector2d& from : {Eigen::Vector2d(1, 1), {1, 1.5}, {1.5, 1.5}, {0, 0}}) {
    const ToolPath path = plan_toolpath(scene, down({from, {3.3, 2.9}}), piecewise_constant());
    EXPECT_FALSE(any(path.gap));
    EXPECT_NEAR(path.arc_length.back(), (Eigen::Vector2d(3.3, 2.9) - from).norm(), 1e-9);
    for (const Vec3& a : path.approach) EXPECT_NEAR((a - Vec3::UnitZ()).norm(), 0.0, 1e-12);
  }
}

// A lip: the top sheet runs over an overhang, round its edge and back underneath to a lower floor.
Scene lip() {
  const std::vector<std::array<double, 2>> profile{{-4, 0}, {2, 0},  {2.5, -0.5}, {2, -1},
                                                   {0, -1}, {0, -3}, {6, -3}};
  std::vector<Vec3> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const auto& [x, z] : profile) {
    points.emplace_back(x, -5, z);
    points.emplace_back(x, 5, z);
  }
  for (std::int32_t k = 0; k + 2 < static_cast<std::int32_t>(points.size()); k += 2) {
    triangles.push_back({k, k + 2, k + 3});
    triangles.push_back({k, k + 3, k + 1});
  }
  return scene_of(mesh_of(points, triangles));
}

TEST(Section, OfSeveralSheetsTheOneThatJoinsTheTargetsIsFollowed) {
  // Floor to floor under the lip: the top sheet lies over the way and must not be climbed.
  const ToolPath floor =
      plan_toolpath(lip(), rows({axis({6, 0.1, 2}, {-4.5, 0, -5}), axis({4, 0.1, 2}, {0, 0, -1})}),
                    piecewise_constant());
  EXPECT_FALSE(any(floor.gap));
  for (const Vec3& p : floor.surface) EXPECT_NEAR(p.z(), -3, 1e-12);
  EXPECT_NEAR(floor.arc_length.back(), 2.5, 1e-12);
  // Top to floor: round the lip and along its underside, whose normals point down.
  const ToolPath round = plan_toolpath(lip(), down({{1, 0.1}, {4, 0.1}}), piecewise_constant());
  EXPECT_FALSE(any(round.gap));
  EXPECT_NEAR(round.arc_length.back(), 1 + 2 * std::sqrt(0.5) + 2 + 2 + 4, 1e-9);
  double lowest = 1.0;
  for (const Vec3& a : round.approach) lowest = std::min(lowest, a.z());
  EXPECT_NEAR(lowest, -1.0, 1e-12);
  EXPECT_TRUE(warned(round, "round an overhang")) << "the underside lies behind the first target";
}

// Erratum: A_i above A_{i+1} leaves r = A_iA_{i+1} × z / ‖…‖ without a direction.
TEST(Section, ATargetAboveTheNextIsJoinedDownTheWall) {
  const Vec3 upper(0, 0.1, -1.2), lower(0, 0.1, -2.8);
  const Vec3 printed = (lower - upper).cross(Vec3::UnitZ());
  EXPECT_TRUE((printed / printed.norm()).array().isNaN().all()) << "the printed r";
  const ToolPath path = plan_toolpath(lip(),
                                      rows({axis({2, 0.1, -2}, upper - Vec3(2, 0.1, -2)),
                                            axis({2, 0.1, -2}, lower - Vec3(2, 0.1, -2))}),
                                      piecewise_constant());
  EXPECT_FALSE(any(path.gap));
  EXPECT_NEAR(path.arc_length.back(), 1.6, 1e-9);
  for (std::size_t j = 0; j < path.size(); ++j) {
    EXPECT_NEAR(path.surface[j].x(), 0.0, 1e-9);
    EXPECT_NEAR((path.approach[j] - Vec3::UnitX()).norm(), 0.0, 1e-12);
    EXPECT_NEAR((path.travel[j] + Vec3::UnitZ()).norm(), 0.0, 1e-12);
  }
}

TEST(Section, ATargetAboveTheNextOnUprightNormalsIsJoinedRoundTheLipOrFlagged) {
  const Aims pair = rows({axis({1, 0.1, 9}, {0, 0, -1}), axis({3, 0.1, -2}, {-2, 0, -1})});
  const ToolPath joined = plan_toolpath(lip(), pair, piecewise_constant());
  EXPECT_FALSE(any(joined.gap));
  EXPECT_NEAR(joined.arc_length.back(), 1 + 2 * std::sqrt(0.5) + 2 + 2 + 1, 1e-9);
  // Two plates that nothing joins.
  const auto plate = [](double z) {
    return grid([z](double, double) { return z; }, -1, 1, 2, -1, 1, 2);
  };
  const ToolPath flagged =
      plan_toolpath(Scene({plate(0), plate(-2)}, 1),
                    rows({axis({0.1, 0.1, 5}, {0, 0, -1}), axis({1.1, 0.1, -1}, {-1, 0, -1})}));
  ASSERT_EQ(flagged.size(), 2U);
  EXPECT_TRUE(flagged.gap[0]);
}

/// A closed box of 2 × 2 × 2 m about the origin, turned by 30° about z.
Scene turned_box() {
  std::vector<Vec3> corners;
  for (int k = 0; k < 8; ++k) {
    const Vec3 corner((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1);
    corners.push_back(Eigen::AngleAxisd(std::numbers::pi / 6, Vec3::UnitZ()) * corner);
  }
  return scene_of(mesh_of(corners, {{0, 2, 3},
                                    {0, 3, 1},
                                    {4, 5, 7},
                                    {4, 7, 6},
                                    {0, 1, 5},
                                    {0, 5, 4},
                                    {2, 6, 7},
                                    {2, 7, 3},
                                    {0, 4, 6},
                                    {0, 6, 2},
                                    {1, 3, 7},
                                    {1, 7, 5}}));
}

TEST(Section, AVerticalPairGoesStraightDownItsWallTheShorterWayRoundAClosedSection) {
  const Vec3 out(std::cos(std::numbers::pi / 6), std::sin(std::numbers::pi / 6), 0);
  const Vec3 along = Vec3::UnitZ().cross(out);
  const auto at = [&](double z) { return axis(4 * out + 0.3 * along + z * Vec3::UnitZ(), -out); };
  for (const double sign : {1.0, -1.0}) {
    const ToolPath path =
        plan_toolpath(turned_box(), rows({at(0.7 * sign), at(-0.6 * sign)}), piecewise_constant());
    EXPECT_FALSE(any(path.gap));
    EXPECT_NEAR(path.arc_length.back(), 1.3, 1e-9);
    EXPECT_EQ(path.surface.back(), path.targets.point.back());
    for (const Vec3& a : path.approach) {
      EXPECT_LT((a - out).norm(), 1e-12);
    }
  }
}

TEST(Section, AVerticalPairOnABulgingWallIsJoinedOverTheBulge) {
  // A wall across y, 0.5 m proud at half height: the plane that holds its normals is y-z.
  const Scene scene = scene_of(
      mesh_of({{-2, 0, 1}, {2, 0, 1}, {-2, -0.5, 0}, {2, -0.5, 0}, {-2, 0, -1}, {2, 0, -1}},
              {{0, 2, 3}, {0, 3, 1}, {2, 4, 5}, {2, 5, 3}}));
  const ToolPath path = plan_toolpath(
      scene, rows({axis({0.3, -5, 0.5}, {0, 1, 0}), axis({0.3, -5, -0.5}, {0, 1, 0})}),
      piecewise_constant());
  EXPECT_FALSE(any(path.gap));
  EXPECT_NEAR(path.arc_length.back(), 2 * std::hypot(0.5, 0.25), 1e-9);
  for (const Vec3& p : path.surface) {
    EXPECT_NEAR(p.x(), 0.3, 1e-9);
  }
}

TEST(Section, FromTheWallOfABoxToItsTopIsRoundTheEdge) {
  const Vec3 out(std::cos(std::numbers::pi / 6), std::sin(std::numbers::pi / 6), 0);
  const ToolPath path = plan_toolpath(turned_box(),
                                      rows({axis(4 * out + 0.7 * Vec3::UnitZ(), -out),
                                            axis(0.5 * out + 4 * Vec3::UnitZ(), -Vec3::UnitZ())}),
                                      piecewise_constant());
  EXPECT_FALSE(any(path.gap));
  EXPECT_NEAR(path.arc_length.back(), 0.3 + 0.5, 1e-9);
}

TEST(Section, CoincidentTargetsAddNoLengthAndAreReported) {
  const Scene scene = scene_of(grid(kFlat, 0, 4, 4, 0, 4, 4));
  for (const Surface& surface : {Surface(scene), Surface(Plane(Vec3::UnitZ(), -5.0))}) {
    const ToolPath path =
        plan_toolpath(surface, down({{0.5, 1}, {2, 1}, {2, 1}, {3, 1}}), piecewise_constant());
    EXPECT_NEAR(path.arc_length.back(), 2.5, 1e-12);
    for (const Vec3& n : path.travel) EXPECT_NEAR((n - Vec3::UnitX()).norm(), 0.0, 1e-12);
    EXPECT_TRUE(warned(path, "coincide"));
    const ToolPath point = plan_toolpath(surface, down({{2, 1.2}, {2, 1.2}}));
    EXPECT_EQ(point.size(), 1U);
    EXPECT_EQ(point.travel[0], Vec3::UnitX());
  }
}

// Erratum: z is the vehicle's axis; with the vehicle pitched, vertical must be able to mean
// gravity.
TEST(Section, VerticalIsGravityOrTheVehiclesAxis) {
  const auto roof = [](double x, double) { return -std::abs(x); };
  const Scene scene = scene_of(grid(roof, -9, 9, 2, -9, 9, 1));
  ToolPathOptions options = piecewise_constant();
  options.targets.reference.frame = AimsFrame::kWorld;
  options.targets.reference.world_from_vehicle =
      Pose(Eigen::AngleAxisd(0.3, Vec3::UnitX()));  // rolled
  const Aims aims = down({{-2, 1}, {2, 1}});
  const auto crest = [](const ToolPath& path) {
    for (const Vec3& p : path.surface) {
      if (std::abs(p.x()) < 1e-9) return p;
    }
    return Vec3(Vec3::Constant(NAN));
  };
  EXPECT_NEAR((crest(plan_toolpath(scene, aims, options)) - Vec3(0, 1, 0)).norm(), 0, 1e-9);
  options.targets.reference.vertical = Vertical::kVehicle;
  // From (±2, 1, −2) up to z = 0 along (0, −sin, cos) of the roll.
  EXPECT_NEAR(
      (crest(plan_toolpath(scene, aims, options)) - Vec3(0, 1 - 2 * std::tan(0.3), 0)).norm(), 0,
      1e-9);
}

TEST(Section, APlaneIsCrossedStraight) {
  const Plane plane(Vec3(-0.2, 0.1, 1), -5.0);
  const ToolPath path = plan_toolpath(plane, down({{0, 0}, {3, 1}}), piecewise_constant());
  ASSERT_EQ(path.size(), 2U);
  EXPECT_EQ(path.approach[0], plane.normal());
  EXPECT_NEAR(path.travel[0].cross(path.surface[1] - path.surface[0]).norm(), 0.0, 1e-12);
  EXPECT_EQ(path.triangle, (std::vector<std::int32_t>{-1, -1}));
}

}  // namespace
}  // namespace bathyal
