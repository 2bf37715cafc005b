// SPDX-License-Identifier: BSD-3-Clause
// What happens where the bottom or a target is missing, and where meshes meet.
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
using test::piecewise_constant;
using test::rows;
using test::scene_of;
using test::warned;

const auto kFlat = [](double, double) { return -5.0; };

std::size_t first_gap(const ToolPath& path) {
  return static_cast<std::size_t>(std::find(path.gap.begin(), path.gap.end(), true) -
                                  path.gap.begin());
}

TEST(Gaps, AHoleBetweenTargetsIsCrossedStraightAndFlagged) {
  const auto keep = [](int c, int) { return c != 4 && c != 5 && c != 8; };
  const auto slope = [](double x, double) { return 0.1 * x; };
  const Scene scene = scene_of(grid(slope, 0, 12, 12, 0, 4, 4, Vec3::Zero(), keep));
  for (const Orientation orientation : {Orientation::kBlended, Orientation::kPiecewiseConstant}) {
    ToolPathOptions options;
    options.orientation = orientation;
    options.step = 0.25;
    const ToolPath path = plan_toolpath(scene, down({{1, 1.3}, {11, 1.3}}), options);
    std::vector<std::pair<double, double>> gaps;
    for (std::size_t j = 0; j + 1 < path.size(); ++j) {
      if (path.gap[j]) gaps.emplace_back(path.surface[j].x(), path.surface[j + 1].x());
      if (path.gap[j]) continue;
      EXPECT_LE(path.surface[j + 1].x() - path.surface[j].x(), 0.2500001);
    }
    ASSERT_EQ(gaps.size(), 2U);
    EXPECT_NEAR(gaps[0].first, 4, 1e-9);
    EXPECT_NEAR(gaps[0].second, 6, 1e-9);
    EXPECT_NEAR(gaps[1].first, 8, 1e-9);
    EXPECT_NEAR(gaps[1].second, 9, 1e-9);
    EXPECT_FALSE(path.gap.back());
    EXPECT_TRUE(warned(path, "segment 0 crosses a gap"));
    for (const Vec3& p : path.surface) EXPECT_NEAR(p.z(), 0.1 * p.x(), 1e-9);
  }
}

TEST(Gaps, TilesThatAbutAreOneSheet) {
  const Vec3 far(620153, 7246506, -52);
  const auto waves = [](double x, double) { return std::sin(x); };
  const auto tile = [&](int k) { return grid(waves, 3.0 * k, 3.0 * (k + 1), 7, 0, 4, 5, far); };
  const Scene scene({tile(0), tile(1), tile(2)}, 1);
  // From within a tile and from a border, in both directions.
  for (const auto& [from, to] :
       {std::pair<double, double>{0.4, 8.7}, {8.7, 0.4}, {3.0, 6.0}, {6.0, 3.0}, {3.0, 8.7}}) {
    Aims aims = down({{from, 1.1}, {to, 2.9}});
    aims.leftCols<3>().rowwise() += far.transpose();
    const ToolPath path = plan_toolpath(scene, aims);
    EXPECT_FALSE(any(path.gap)) << from << " to " << to;
    EXPECT_TRUE(path.warnings.empty());
    EXPECT_GT(path.size(), 10U);
    for (std::size_t j = 0; j + 1 < path.size(); ++j) {
      EXPECT_GT(path.arc_length[j + 1], path.arc_length[j]);
      EXPECT_GT((to - from) * path.travel[j].x(), 0.0);
    }
  }
}

TEST(Gaps, WhereMeshesLieOnEachOtherThePathStaysOnThatOfItsTargets) {
  const Vec3 far(620153, 7246506, -52);
  const auto slope = [](double x, double y) { return 0.3 * x + 0.1 * y; };
  const Scene scene({grid(slope, 0, 6, 3, 0, 6, 3, far), grid(slope, 0, 6, 5, 0, 6, 4, far)}, 1);
  for (double y = 0.7; y < 5.5; y += 0.37) {
    Aims aims = down({{0.9, y}, {5.2, 6.0 - y}});
    aims.leftCols<3>().rowwise() += far.transpose();
    const ToolPath path = plan_toolpath(scene, aims, piecewise_constant());
    if (path.targets.mesh[0] != path.targets.mesh[1]) continue;
    EXPECT_FALSE(any(path.gap)) << y;
    for (const std::int32_t mesh : path.mesh) {
      EXPECT_EQ(mesh, path.targets.mesh[0]) << y;
    }
  }
}

TEST(Gaps, AMissedAimMakesAGapAndIsReported) {
  const Scene scene = scene_of(grid(kFlat, 0, 10, 10, 0, 4, 4));
  const Aims aims = down({{-3, 1}, {1, 1}, {3, 1}, {20, 1}, {6, 1}, {8, 1}, {30, 1}});
  const ToolPath path = plan_toolpath(scene, aims, piecewise_constant());
  const std::size_t j = first_gap(path);
  EXPECT_NEAR(path.surface[j].x(), 3, 1e-12);
  EXPECT_NEAR(path.surface[j + 1].x(), 6, 1e-12);
  EXPECT_EQ(path.segment.front(), 1);
  EXPECT_EQ(path.segment[j], 2) << "the gap begins at aim 2";
  EXPECT_EQ(path.segment[j + 1], 4);
  EXPECT_EQ(std::count(path.gap.begin(), path.gap.end(), true), 1);
  EXPECT_NEAR(path.surface.back().x(), 8, 1e-12);
  EXPECT_TRUE(warned(path, "aims 0, 3 and 6 have no target (miss) and are left out"));
  EXPECT_EQ(path.targets.size(), 7U);

  ToolPathOptions strict;
  strict.missed = MissedAims::kRefuse;
  EXPECT_THROW(plan_toolpath(scene, aims, strict), std::invalid_argument);
}

TEST(Gaps, OfManyMissedAimsTheFirstTenAreNamedAndAllCounted) {
  const Scene scene = scene_of(grid(kFlat, 0, 10, 10, 0, 4, 4));
  const auto missed = [&](int count) {
    std::vector<Eigen::Vector2d> places{{1, 1}};
    for (int i = 0; i < count; ++i) places.push_back({20.0 + i, 1});
    return plan_toolpath(scene, down(places)).warnings.at(0);
  };
  EXPECT_EQ(missed(1), "aim 1 has no target (miss) and is left out");
  EXPECT_EQ(missed(2), "aims 1 and 2 have no target (miss) and are left out");
  EXPECT_EQ(missed(10),
            "aims 1, 2, 3, 4, 5, 6, 7, 8, 9 and 10 have no target (miss) and are left out");
  EXPECT_EQ(missed(12),
            "aims 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, … (12 in all) have no target (miss) and are left "
            "out");
}

TEST(Gaps, AimsThatGrazeOrComeFromBeneathAreUsedAndReported) {
  const Scene scene = scene_of(grid(kFlat, 0, 10, 10, 0, 4, 4));
  ToolPathOptions options;
  options.targets.grazing_angle = 1.0;
  const Aims aims = rows(
      {axis({1, 1, 9}, {0, 0, -1}), axis({0, 1, -4}, {3, 0, -1}), axis({5, 1, -9}, {0, 0, 1})});
  const ToolPath path = plan_toolpath(scene, aims, options);
  EXPECT_TRUE(warned(path, "aim 1 grazes the bottom and is used"));
  EXPECT_TRUE(warned(path, "aim 2 strikes the bottom from beneath and is used"));
  EXPECT_NEAR(path.arc_length.back(), 4.0, 1e-12);
  options.targets.grazing_angle = std::numbers::pi;
  EXPECT_TRUE(warned(plan_toolpath(scene, aims, options), "aim 2 strikes"));
}

TEST(Gaps, ALoneTargetBetweenMissedAimsKeepsItsSample) {
  const Scene scene = scene_of(grid(kFlat, 0, 10, 10, 0, 4, 4));
  const ToolPath path =
      plan_toolpath(scene, down({{1.5, 1}, {50, 1}, {5.5, 1}, {50, 1}, {8.5, 1}}));
  ASSERT_EQ(path.size(), 3U);
  EXPECT_EQ(path.gap, (std::vector<bool>{true, true, false}));
  EXPECT_EQ(path.segment, (std::vector<std::int32_t>{0, 2, 2}));
  for (const Vec3& n : path.travel) EXPECT_NEAR((n - Vec3::UnitX()).norm(), 0.0, 1e-12);
  EXPECT_GE(path.triangle[1], 0);
}

TEST(Gaps, NoAimsAndNoTargetsAreRefused) {
  const Plane plane(Vec3::UnitZ(), -5.0);
  EXPECT_THROW(plan_toolpath(plane, Aims(0, 6)), std::invalid_argument);
  EXPECT_THROW(plan_toolpath(plane, axis(Vec3::Zero(), Vec3::UnitZ())), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
