// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/motion/follow.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "bathyal/arm/row_frames.hpp"
#include "bathyal/workspace/motion/motion_timing.hpp"
#include "scene/meshes.hpp"
#include "support/arms.hpp"

namespace bathyal {
namespace {

/// z = height · sin(6 x) sin(5 y) over ±1.5 m.
TriangleMesh bottom(double height, int cells = 60) {
  std::vector<Vec3> vertices;
  std::vector<Eigen::Vector3i> triangles;
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; j <= cells; ++j) {
      const double x = -1.5 + 3.0 * i / cells, y = -1.5 + 3.0 * j / cells;
      vertices.emplace_back(x, y, height * std::sin(6.0 * x) * std::sin(5.0 * y));
      if (i == cells || j == cells) continue;
      const int a = i * (cells + 1) + j, b = a + cells + 1;
      triangles.emplace_back(a, b, b + 1);
      triangles.emplace_back(a, b + 1, a + 1);
    }
  }
  return test::mesh_of(vertices, triangles);
}

/// A Panda that hangs from a vehicle 0.75 m over the bottom, among what `around` adds.
struct Site {
  Arm arm = panda();
  Scene scene;
  Surroundings around;

  explicit Site(double height, double radius = 0.03) : scene({bottom(height)}) {
    around.capsules = capsules_of_rows(arm, std::vector<double>{radius});
    around.vehicle_from_base =
        Eigen::Translation3d(0.1, 0.0, -0.05) * Eigen::AngleAxisd(kPi, Vec3::UnitX());
    around.world_from_vehicle = Pose(Eigen::Translation3d(-0.1, 0.0, 0.8));
    around.scene = scene;
  }

  Workspace workspace() const { return {arm, around}; }

  /// A path through the points (x, y) of the bottom; a row with x above 100 is an aim that misses.
  ToolPath path(const std::vector<std::pair<double, double>>& points, double standoff = 0.0) const {
    Aims aims(std::ssize(points), 6);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool misses = points[i].first > 100.0;
      aims.row(static_cast<Index>(i)) << (misses ? 0.0 : points[i].first), points[i].second, 1.0,
          0.0, 0.0, (misses ? 1.0 : -1.0);
    }
    ToolPathOptions options;
    options.targets.reference.frame = AimsFrame::kWorld;
    options.standoff = standoff;
    return plan_toolpath(scene, aims, options);
  }
};

std::span<const double> row(const JointMatrix& q, Index i) {
  return {q.data() + i * q.cols(), static_cast<std::size_t>(q.cols())};
}

double worst_rate(const Arm& arm, const Followed& motion) {
  const std::vector<double> velocity = default_limits(arm).velocity;
  const std::vector<double> acceleration = default_acceleration(arm);
  double worst = 0.0;
  const Index legs = motion.q.rows() - 1;
  for (Index k = 0; k < motion.q.cols(); ++k) {
    const auto joint = static_cast<std::size_t>(k);
    double rate = 0.0, duration = 0.0;
    for (Index i = 0; i <= legs; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double next_duration = i < legs ? motion.time[at + 1] - motion.time[at] : 0.0;
      const double next = i < legs ? (motion.q(i + 1, k) - motion.q(i, k)) / next_duration : 0.0;
      worst = std::max(worst, std::abs(next) / velocity[joint]);
      worst = std::max(
          worst, std::abs(next - rate) / (0.5 * (duration + next_duration)) / acceleration[joint]);
      rate = next, duration = next_duration;
    }
  }
  return worst;
}

/// Everything that is said of a result, looked at from outside.
void verify(const Workspace& ws, const ToolPath& path, const Followed& followed,
            TipContact contact) {
  const Index rows = followed.q.rows();
  ASSERT_EQ(std::ssize(followed.time), rows);
  ASSERT_EQ(std::ssize(followed.sample), rows);
  const Pose world_from_vehicle = ws.surroundings().world_from_vehicle.at(0.0);
  for (Index i = 0; i < rows; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (i > 0) {
      EXPECT_GT(followed.time[at], followed.time[at - 1]);
    }
    EXPECT_TRUE(within_limits(ws.arm(), JointView(followed.q.row(i).data(), 1, rows ? 7 : 0))[0]);
    if (followed.sample[at] < 0 || followed.fraction[at] > 0.0) continue;
    const Pose tip = world_from_vehicle * row_frames(ws.arm(), row(followed.q, i)).world_from_tool;
    const auto j = static_cast<std::size_t>(followed.sample[at]);
    EXPECT_LT((tip.translation() - path.position[j]).norm(), 1e-4);
    EXPECT_LT(std::acos(std::min(1.0, -tip.linear().col(2).dot(path.approach[j]))), 1e-3);
  }
  EXPECT_LT(followed.position_error, 1e-4);
  EXPECT_LT(followed.angle_error, 1e-3);
  EXPECT_LE(worst_rate(ws.arm(), followed), 1.0 + 1e-9);
  EXPECT_TRUE(ws.check_motion(view_of(followed.q), {.tip_contact = contact}).free);
}

/// Samples that have a row of their own.
std::vector<bool> visited(const ToolPath& path, const Followed& followed) {
  std::vector<bool> seen(path.size(), false);
  for (std::size_t i = 0; i < followed.sample.size(); ++i) {
    if (followed.sample[i] >= 0 && followed.fraction[i] == 0.0) {
      seen[static_cast<std::size_t>(followed.sample[i])] = true;
    }
  }
  return seen;
}

TEST(FollowToolpath, AFlatBottomIsFollowedFromEndToEnd) {
  const Site site(0.0);
  const Workspace ws = site.workspace();
  const ToolPath path = site.path({{0.3, -0.2}, {0.45, 0.0}, {0.3, 0.2}});
  const Followed followed = follow_toolpath(ws, path);
  ASSERT_TRUE(followed.cut.empty()) << to_text(followed.cut[0].reason);
  verify(ws, path, followed, TipContact::kAllowed);
  const std::vector<bool> seen = visited(path, followed);
  EXPECT_EQ(std::ranges::count(seen, true), std::ssize(path.position));
  EXPECT_EQ(std::ranges::count(followed.sample, -1), 0);
  EXPECT_GE(followed.time.back(), path.time.back() - 1e-9);
  EXPECT_LT(followed.time.back(), 2.0 * path.time.back());
}

TEST(FollowToolpath, ARoughBottomIsFollowedWithAHullAbove) {
  Site site(0.03);
  site.around.hull = Hull(test::box(Vec3(0.5, 0.3, 0.15), Vec3(-0.5, 0.0, 0.15)));
  const Workspace ws = site.workspace();
  const ToolPath path = site.path({{0.3, -0.25}, {0.4, 0.25}});
  const Followed followed = follow_toolpath(ws, path);
  ASSERT_TRUE(followed.cut.empty()) << to_text(followed.cut[0].reason);
  verify(ws, path, followed, TipContact::kAllowed);
}

TEST(FollowToolpath, WithStandoffNothingTouches) {
  const Site site(0.02);
  const Workspace ws = site.workspace();
  const ToolPath path = site.path({{0.3, -0.2}, {0.4, 0.2}}, 0.06);
  const Followed followed = follow_toolpath(ws, path);
  ASSERT_TRUE(followed.cut.empty()) << to_text(followed.cut[0].reason);
  verify(ws, path, followed, TipContact::kForbidden);
}

TEST(FollowToolpath, WhatRunsOutOfReachIsCutOut) {
  const Site site(0.0);
  const Workspace ws = site.workspace();
  const ToolPath path = site.path({{0.3, 0.0}, {1.4, 0.1}, {0.3, 0.2}});
  const Followed followed = follow_toolpath(ws, path);
  ASSERT_FALSE(followed.cut.empty());
  const FollowCut &first = followed.cut.front(), &last = followed.cut.back();
  EXPECT_TRUE(std::ranges::any_of(followed.cut, [](const FollowCut& cut) {
    return cut.reason == CutReason::kUnreachable && cut.last > cut.first + 1;
  }));
  verify(ws, path, followed, TipContact::kAllowed);
  const std::vector<bool> seen = visited(path, followed);
  for (std::size_t j = 0; j < path.size(); ++j) {
    const auto sample = static_cast<std::int32_t>(j);
    EXPECT_EQ(seen[j], sample <= first.first || sample >= last.last) << j;
  }
  for (std::size_t i = 1; i < followed.cut.size(); ++i) {
    EXPECT_EQ(followed.cut[i].first, followed.cut[i - 1].last);
    EXPECT_NE(followed.cut[i].reason, followed.cut[i - 1].reason);
  }
  // From its shoulder the Panda's wrist reaches 0.7 m, less than 0.8 m in the plane of the bottom.
  const double reach = path.position[static_cast<std::size_t>(first.first)].head<2>().norm();
  EXPECT_LT(reach, 0.8);
  EXPECT_GT(reach, 0.5);
  EXPECT_GT(std::ranges::count(followed.sample, -1), 10);  // back to the path's last stretch
}

TEST(FollowToolpath, AGapIsCrossedLifted) {
  const Site site(0.0);
  const Workspace ws = site.workspace();
  const ToolPath path =
      site.path({{0.3, -0.25}, {0.4, -0.15}, {1e3, 0.0}, {0.4, 0.15}, {0.3, 0.25}});
  ASSERT_EQ(std::ranges::count(path.gap, true), 1);
  const Followed followed = follow_toolpath(ws, path);
  ASSERT_TRUE(followed.cut.empty()) << to_text(followed.cut[0].reason);
  verify(ws, path, followed, TipContact::kAllowed);
  const Pose world_from_vehicle = ws.surroundings().world_from_vehicle.at(0.0);
  double highest = 0.0;
  int transit = 0;
  for (Index i = 0; i < followed.q.rows(); ++i) {
    if (followed.sample[static_cast<std::size_t>(i)] >= 0) continue;
    ++transit;
    const Pose tip = world_from_vehicle * row_frames(ws.arm(), row(followed.q, i)).world_from_tool;
    if (std::abs(tip.translation().y()) < 0.1) {
      EXPECT_GT(tip.translation().z(), 0.09);
    }
    highest = std::max(highest, tip.translation().z());
  }
  EXPECT_GT(transit, 10);
  EXPECT_NEAR(highest, 0.1, 0.01);
}

TEST(FollowToolpath, AKeepOutOverThePathIsCutOutWithItsName) {
  Site site(0.0);
  site.around.keepouts.push_back(
      KeepOut::sphere(0.06, Vec3(0.35, 0.0, 0.0), {.frame = "world", .name = "stone"}));
  const Workspace ws = site.workspace();
  const ToolPath path = site.path({{0.35, -0.25}, {0.35, -0.1}, {0.35, 0.1}, {0.35, 0.25}});
  const Followed followed = follow_toolpath(ws, path);
  ASSERT_EQ(followed.cut.size(), 1);
  EXPECT_EQ(followed.cut[0].reason, CutReason::kCollision);
  ASSERT_GE(followed.cut[0].obstacle, 0);
  EXPECT_EQ(ws.obstacles()[static_cast<std::size_t>(followed.cut[0].obstacle)], "stone");
  verify(ws, path, followed, TipContact::kAllowed);
  EXPECT_TRUE(visited(path, followed).back());
}

TEST(FollowToolpath, SameBytesEachTime) {
  const Site site(0.02);
  const Workspace ws = site.workspace();
  const ToolPath path = site.path({{0.3, -0.2}, {0.42, 0.1}});
  const Followed one = follow_toolpath(ws, path), two = follow_toolpath(ws, path);
  ASSERT_EQ(one.q.size(), two.q.size());
  EXPECT_EQ(std::memcmp(one.q.data(), two.q.data(), sizeof(double) * one.q.size()), 0);
  EXPECT_EQ(one.time, two.time);
}

TEST(FollowToolpath, Refusals) {
  const Site site(0.0);
  const Workspace ws = site.workspace();
  const ToolPath path = site.path({{0.3, 0.0}, {0.35, 0.1}});
  EXPECT_THROW(follow_toolpath(ws, ToolPath{}), std::invalid_argument);
  ToolPath broken = path;
  broken.position[0].x() = NAN;
  EXPECT_THROW(follow_toolpath(ws, broken), std::invalid_argument);
  const Pose here = site.around.world_from_vehicle.at(0.0);
  const Workspace moving = ws.with_vehicle_pose(
      Trajectory({0.0, 1.0}, {here, Pose(Eigen::Translation3d(0.1, 0.0, 0.0) * here)}));
  EXPECT_THROW(follow_toolpath(moving, path), std::invalid_argument);
  for (const auto& change : std::vector<void (*)(FollowOptions&)>{
           [](FollowOptions& o) { o.step = 0.0; }, [](FollowOptions& o) { o.lift = -0.1; },
           [](FollowOptions& o) { o.candidates = 0; }, [](FollowOptions& o) { o.q_start = {1.0}; },
           [](FollowOptions& o) { o.position_tolerance = NAN; },
           [](FollowOptions& o) { o.velocity.assign(7, 0.0); }}) {
    FollowOptions options;
    change(options);
    EXPECT_THROW(follow_toolpath(ws, path, options), std::invalid_argument);
  }
}

}  // namespace
}  // namespace bathyal
