// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/workspace.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/meshes.hpp"
#include "support/arms.hpp"

namespace bathyal {
namespace {

using enum TipContact;

JointView view(const JointMatrix& q) { return view_of(q); }

/// A square of ±`half` in the plane x = `x`.
TriangleMesh wall(double x, double half = 5.0) {
  return test::mesh_of({{x, -half, -half}, {x, half, -half}, {x, half, half}, {x, -half, half}},
                       {{0, 1, 2}, {0, 2, 3}});
}

TriangleMesh box(const Vec3& low, const Vec3& high) {
  return test::box(0.5 * (high - low), 0.5 * (low + high));
}

Surroundings with_radius(const Arm& arm, double radius) {
  Surroundings around;
  around.capsules = capsules_of_rows(arm, std::vector<double>{radius});
  return around;
}

TEST(Workspace, NothingAroundIsInfinitelyFar) {
  const Workspace ws(planar_arm(), {});
  const JointMatrix q = JointMatrix::Zero(1, 2);
  const Clearance clear = ws.clearance(view(q))[0];
  EXPECT_EQ(clear.distance, std::numeric_limits<double>::infinity());
  EXPECT_EQ(clear.obstacle, -1);
  EXPECT_TRUE(ws.check_motion(view(q)).free);
  EXPECT_TRUE(std::isnan(ws.check_motion(view(q)).contact));
}

TEST(Workspace, DistancesOfAPlanarArmAreThoseOfItsDrawing) {
  const Arm arm = planar_arm();
  Surroundings around = with_radius(arm, 0.05);
  around.keepouts.push_back(KeepOut::sphere(0.2, Vec3(0.9, 0.6, 0.0), {.name = "ball"}));
  around.keepouts.push_back(
      KeepOut::half_space(Plane(Vec3::UnitY(), -1.0), {.frame = "world", .name = "floor"}));
  Pose world_from_vehicle = Pose::Identity();
  world_from_vehicle.translation().y() = 0.4;
  around.world_from_vehicle = world_from_vehicle;
  around.scene = Scene({wall(1.2)});
  const Workspace ws(arm, around);
  ASSERT_EQ(ws.obstacles(), (std::vector<std::string>{"ball", "floor", "scene"}));
  JointMatrix q(3, 2);
  q << 0.0, 0.0, kPi / 2, 0.0, -kPi / 2, 0.0;
  const std::vector<Clearance> clear = ws.clearance(view(q));
  EXPECT_NEAR(clear[0].distance, 0.25, 1e-12);  // the tip at x = 0.9, the wall at 1.2
  EXPECT_EQ(clear[0].obstacle, 2);
  EXPECT_EQ(clear[0].link, 2);
  EXPECT_NEAR((clear[0].obstacle_point - Vec3(1.2, 0.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((clear[0].axis_point - Vec3(0.9, 0.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(clear[1].distance, 0.65, 1e-9);  // the ball, 0.9 from the axis
  EXPECT_EQ(clear[1].obstacle, 0);
  EXPECT_NEAR(clear[2].distance, 0.45, 1e-9);  // tip at y = −0.5 in the world, floor at −1
  EXPECT_EQ(clear[2].obstacle, 1);
  for (const Clearance& one : clear) EXPECT_EQ(one.self_distance, INFINITY);
}

TEST(Workspace, WhatIsInsideOrCrossesIsBelowZero) {
  const Arm arm = planar_arm();
  Surroundings around = with_radius(arm, 0.05);
  around.scene = Scene({wall(0.7)});
  JointMatrix q = JointMatrix::Zero(1, 2);
  EXPECT_NEAR(Workspace(arm, around).clearance(view(q))[0].distance, -0.05, 1e-12);
  around.scene.reset();
  around.hull = Hull(box(Vec3(0.6, -1.0, -1.0), Vec3(2.0, 1.0, 1.0)));
  // The tip lies 0.3 behind the face.
  EXPECT_NEAR(Workspace(arm, around).clearance(view(q))[0].distance, -0.35, 1e-12);
}

TEST(Workspace, FootNeighboursAndWhatIsBuiltSoAreLeftOut) {
  const Arm arm = planar_arm();
  Surroundings around = with_radius(arm, 0.05);
  around.hull = Hull(box(Vec3(-0.5, -0.2, -0.2), Vec3(0.3, 0.2, 0.2)));
  const Workspace ws(arm, around);
  const auto is = [&](int link, int other, int obstacle, const std::string& reason) {
    return std::ranges::any_of(ws.excluded(), [&](const ExcludedPair& p) {
      return p.link == link && p.other_link == other && p.obstacle == obstacle &&
             p.reason == reason;
    });
  };
  EXPECT_TRUE(is(1, -1, 0, "touch in every posture"));  // it turns about a point in the hull
  EXPECT_TRUE(is(2, 1, -1, "neighbours"));
  EXPECT_FALSE(is(2, -1, 0, "touch in every posture"));
  JointMatrix q(1, 2);
  q << 0.0, kPi;  // folded back: the tip at x = 0.1
  EXPECT_LT(ws.clearance(view(q))[0].distance, 0.0);
  EXPECT_EQ(ws.clearance(view(q))[0].link, 2);
}

TEST(Workspace, NoThinPlateIsSteppedOver) {
  const Arm arm = planar_arm();
  Surroundings around = with_radius(arm, 0.01);
  around.scene = Scene({wall(0.0, 0.5)});  // the plane x = 0 up to |y| = 0.5
  JointMatrix q(2, 2);
  q << 0.2, 0.0, kPi - 0.2, 0.0;
  const MotionCheck swing = Workspace(arm, around).check_motion(view(q));
  EXPECT_FALSE(swing.free);
  // Small: a plate of 2 cm that only the tip passes.
  around.scene = Scene(
      {test::mesh_of({{0.0, 0.88, -0.01}, {0.0, 0.92, -0.01}, {0.0, 0.9, 0.01}}, {{0, 1, 2}})});
  const MotionCheck passing = Workspace(arm, around).check_motion(view(q));
  EXPECT_FALSE(passing.free);
  // The arm of 0.9 m points at it where the tip's ball of 1 cm first meets its near corner.
  EXPECT_NEAR(passing.contact, 0.5, 0.01);
  EXPECT_LT(passing.contact, 0.5);
  EXPECT_EQ(passing.link, 2);
}

TEST(Workspace, MotionsAgreeWithDenseSampling) {
  const Arm arm = panda();
  Surroundings around = with_radius(arm, 0.06);
  around.keepouts.push_back(KeepOut::sphere(0.15, Vec3(0.45, 0.1, 0.5), {.name = "ball"}));
  around.keepouts.push_back(
      KeepOut::half_space(Plane(Vec3::UnitZ(), -0.3), {.frame = "world", .name = "floor"}));
  around.hull = Hull(box(Vec3(-0.9, -0.3, -0.4), Vec3(-0.25, 0.3, 0.4)));
  const Workspace ws(arm, around);
  const JointMatrix ends = random_poses(arm, 120, 3);
  constexpr Index kSamples = 1000;
  int contacts = 0;
  for (Index i = 0; i + 1 < ends.rows(); i += 2) {
    const JointMatrix q = ends.middleRows(i, 2);
    JointMatrix dense(kSamples + 1, q.cols());
    for (Index k = 0; k <= kSamples; ++k) {
      dense.row(k) = q.row(0) + static_cast<double>(k) / kSamples * (q.row(1) - q.row(0));
    }
    const std::vector<Clearance> clear = ws.clearance(view(dense));
    const auto distance = [](const Clearance& c) { return std::min(c.distance, c.self_distance); };
    const auto first =
        std::ranges::find_if(clear, [&](const auto& c) { return distance(c) <= 0.0; });
    const MotionCheck motion = ws.check_motion(view(q));
    if (motion.free) {
      EXPECT_EQ(first, clear.end()) << i;
      continue;
    }
    ++contacts;
    const double sampled =
        first == clear.end() ? 1.0 : static_cast<double>(first - clear.begin()) / kSamples;
    EXPECT_LE(motion.contact, sampled + 1e-3) << i;
    JointMatrix at = q.row(0) + motion.contact * (q.row(1) - q.row(0));
    EXPECT_LT(distance(ws.clearance(view(at))[0]), 1e-4) << i;
  }
  EXPECT_GT(contacts, 15);
  EXPECT_LT(contacts, 60);
}

TEST(Workspace, SameBytesOnAnyNumberOfThreads) {
  const Arm arm = panda();
  Surroundings around = with_radius(arm, 0.06);
  around.hull = Hull(box(Vec3(-0.9, -0.3, -0.4), Vec3(-0.25, 0.3, 0.4)));
  const Workspace ws(arm, around);
  const JointMatrix q = random_poses(arm, 60, 4);
  const std::vector<Clearance> one = ws.clearance(view(q), {}, kForbidden, 1),
                               four = ws.clearance(view(q), {}, kForbidden, 4);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].distance, four[i].distance);
    EXPECT_EQ(one[i].self_distance, four[i].self_distance);
  }
}

TEST(Workspace, Refusals) {
  const Arm arm = planar_arm();
  Surroundings around;
  around.keepouts.push_back(KeepOut::sphere(0.1, Vec3::Zero(), {.frame = "elbow"}));
  EXPECT_THROW(Workspace(arm, around), std::invalid_argument);
  around = {};
  around.vehicle_from_base.linear() *= 2.0;
  EXPECT_THROW(Workspace(arm, around), std::invalid_argument);
  around = {};
  around.allowed = {{0, 7}};
  EXPECT_THROW(Workspace(arm, around), std::invalid_argument);
  const Workspace ws(arm, {});
  const JointMatrix wrong = JointMatrix::Zero(1, 3), none(0, 2);
  EXPECT_THROW(ws.clearance(view(wrong)), std::invalid_argument);
  EXPECT_THROW(ws.check_motion(view(none)), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
