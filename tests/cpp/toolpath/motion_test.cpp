// SPDX-License-Identifier: BSD-3-Clause
// Frames and time stamps: what an arm has to follow.
#include <gtest/gtest.h>

#include <cmath>

#include "bathyal/base/random.hpp"
#include "bathyal/toolpath/internal/frames.hpp"
#include "bathyal/toolpath/internal/timing.hpp"
#include "bottoms.hpp"

namespace bathyal {
namespace {

using namespace toolpath;

using test::down;
using test::grid;
using test::piecewise_constant;
using test::scene_of;

Scene rough(double height = 0.1) {
  RandomStream random(7);
  return scene_of(
      grid([&](double, double) { return height * random.normal(); }, 0, 6, 24, 0, 6, 24));
}

const Aims kTour = down({{0.6, 0.7}, {5.1, 1.3}, {4.2, 5.2}, {1.1, 4.4}, {1.7, 0.9}});

/// Frames are rotations and belong to approach, travel and side; quaternions say the same.
void expect_frames(const ToolPath& path) {
  for (std::size_t j = 0; j < path.size(); ++j) {
    const Eigen::Matrix3d r = path.frame(j).linear();
    EXPECT_LT((r.transpose() * r - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_NEAR(r.determinant(), 1.0, 1e-12);
    EXPECT_EQ(Vec3(r.col(0)), path.travel[j]);
    EXPECT_EQ(Vec3(r.col(2)), -path.approach[j]);
    EXPECT_LT((path.side[j] - path.approach[j].cross(path.travel[j])).norm(), 1e-12);
    const auto& q = path.quaternion[j];
    const Eigen::Quaterniond quaternion(q[3], q[0], q[1], q[2]);
    EXPECT_LT((quaternion.toRotationMatrix() - r).norm(), 1e-12);
    if (j == 0) continue;
    const auto& before = path.quaternion[j - 1];
    EXPECT_GE(before[0] * q[0] + before[1] * q[1] + before[2] * q[2] + before[3] * q[3], 0.0);
  }
}

/// Speed, acceleration and angular rate by finite differences of the samples themselves.
void expect_limits(const ToolPath& path, const ToolPathOptions& options) {
  const double slack = 1.0 + 1e-6;
  double last_speed = 0.0, last_step = 0.0;
  for (std::size_t j = 0; j + 1 < path.size(); ++j) {
    const double step = path.time[j + 1] - path.time[j];
    const double length = (path.position[j + 1] - path.position[j]).norm();
    ASSERT_GE(step, 0.0);
    EXPECT_LE(length, options.speed * step * slack + 1e-9);
    EXPECT_LE(turn_between(path, j, j + 1), options.angular_rate * step * slack + 1e-9);
    EXPECT_NEAR(path.arc_length[j + 1] - path.arc_length[j], length, 1e-9);
    if (step < 1e-6) continue;
    // Mean speeds lie half a step from their ends; from rest at the beginning.
    const double speed = length / step;
    EXPECT_LE(std::abs(speed - last_speed),
              options.acceleration * 0.5 * (step + last_step) * slack + 1e-5);
    last_speed = speed;
    last_step = step;
  }
  EXPECT_LE(last_speed, options.acceleration * 0.5 * last_step * slack + 1e-9) << "ends at rest";
}

TEST(Frames, AreRotationsInBothForms) {
  for (const Orientation orientation : {Orientation::kBlended, Orientation::kPiecewiseConstant}) {
    ToolPathOptions options;
    options.orientation = orientation;
    expect_frames(plan_toolpath(rough(), kTour, options));
  }
}

// Erratum: the printed n_j, parallel to T_jT_{j+1}, is not perpendicular to a_j across a crease.
TEST(Frames, PrintedTravelIsNotPerpendicularToABlendedApproach) {
  const auto roof = [](double x, double) { return -std::abs(x); };
  const Scene scene = scene_of(grid(roof, -4, 4, 2, -2, 2, 1));
  const ToolPath path = plan_toolpath(scene, down({{-2, 0.5}, {2, 0.5}}));
  double printed_worst = 0.0;
  for (std::size_t j = 0; j + 1 < path.size(); ++j) {
    const Vec3 printed = (path.surface[j + 1] - path.surface[j]).normalized();
    printed_worst = std::max(printed_worst, std::abs(printed.dot(path.approach[j])));
    EXPECT_NEAR(path.travel[j].dot(path.approach[j]), 0.0, 1e-12);
  }
  EXPECT_GT(printed_worst, 0.5);
}

TEST(Frames, BlendedIsTheFacetsOwnAwayFromEdgesAndHalfTurnedOnThem) {
  const auto roof = [](double x, double) { return -std::abs(x); };
  const Scene scene = scene_of(grid(roof, -4, 4, 2, -2, 2, 1));
  ToolPathOptions options;
  options.blend_length = 0.4;
  options.step = 0.03;
  const ToolPath path = plan_toolpath(scene, down({{-2, 0.5}, {2, 0.5}}), options);
  const Vec3 left = Vec3(-1, 0, 1).normalized(), right = Vec3(1, 0, 1).normalized();
  bool crest = false;
  for (std::size_t j = 0; j < path.size(); ++j) {
    const double s = path.surface[j].x() * std::sqrt(2.0);
    if (s <= -0.2) {
      EXPECT_LT((path.approach[j] - left).norm(), 1e-12);
    }
    if (s >= 0.2) {
      EXPECT_LT((path.approach[j] - right).norm(), 1e-12);
    }
    if (std::abs(s) > 1e-9) continue;
    crest = true;
    EXPECT_LT((path.approach[j] - Vec3::UnitZ()).norm(), 1e-9);
    EXPECT_LT((path.travel[j] - Vec3::UnitX()).norm(), 1e-9);
  }
  EXPECT_TRUE(crest) << "T_j stays among the samples";
}

TEST(Frames, BlendedTurnsInStepsAnEighthOfTheBlendLength) {
  const ToolPath path = plan_toolpath(Plane(Vec3::UnitZ(), 0.0), down({{0, 0}, {1, 0}, {1, 1}}));
  for (std::size_t j = 0; j + 1 < path.size(); ++j) {
    if ((path.surface[j] - Vec3(1, 0, 0)).norm() > 0.05 - 1e-9) continue;
    EXPECT_LE((path.surface[j + 1] - path.surface[j]).norm(), 0.1 / 8 + 1e-9);
    // The steepest part of w is 1.5 / blend_length.
    EXPECT_LE(
        turn_between(path, j, j + 1),
        std::numbers::pi / 2 * 1.5 / 0.1 * (path.surface[j + 1] - path.surface[j]).norm() + 1e-9);
  }
  EXPECT_GT(path.size(), 8U);
}

TEST(Frames, AReturnOnTheSameLineTurnsAboutTheApproach) {
  const ToolPath path = plan_toolpath(Plane(Vec3::UnitZ(), 0.0), down({{0, 0}, {1, 0}, {0, 0}}));
  for (const Vec3& a : path.approach) EXPECT_LT((a - Vec3::UnitZ()).norm(), 1e-9);
  EXPECT_LT((path.travel.back() + Vec3::UnitX()).norm(), 1e-9);
}

TEST(Frames, ATravelAlongTheApproachFallsBackToTheLastHeading) {
  const Eigen::Matrix3d frame = tool_frame(Vec3::UnitX(), Vec3::UnitX(), Vec3(1, 1, 0));
  EXPECT_EQ(Vec3(frame.col(0)), Vec3::UnitY());
  EXPECT_EQ(Vec3(tool_frame(Vec3::UnitX(), Vec3::Zero(), Vec3::Zero()).col(0)), Vec3::UnitY());
}

TEST(Timing, KeepsEveryLimitOnRoughGround) {
  for (const Orientation orientation : {Orientation::kBlended, Orientation::kPiecewiseConstant}) {
    for (const double standoff : {0.0, 0.15}) {
      ToolPathOptions options;
      options.orientation = orientation;
      options.standoff = standoff;
      options.angular_rate = 0.3;
      options.speed = 0.25;
      options.acceleration = 0.2;
      expect_limits(plan_toolpath(rough(), kTour, options), options);
    }
  }
}

TEST(Timing, OfTwoSamplesIsATrapezoidOrATriangle) {
  const Plane plane(Vec3::UnitZ(), 0.0);
  ToolPathOptions options;
  options.speed = 0.5;
  options.acceleration = 0.25;
  // 3 m: 2 s and 0.5 m up, 4 s at 0.5 m/s, 2 s down.
  EXPECT_NEAR(plan_toolpath(plane, down({{0, 0}, {3, 0}}), options).time.back(), 8.0, 1e-12);
  // 0.25 m never reaches the speed: 2 √(d / a).
  EXPECT_NEAR(plan_toolpath(plane, down({{0, 0}, {0.25, 0}}), options).time.back(), 2.0, 1e-12);
}

TEST(Timing, DoesNotDependOnHowFinelyAStraightPathIsSampled) {
  const Plane plane(Vec3(0.1, 0, 1), 0.0);
  ToolPathOptions options;
  const double coarse = plan_toolpath(plane, down({{0, 0}, {3, 0}}), options).time.back();
  options.step = 0.01;
  const ToolPath fine = plan_toolpath(plane, down({{0, 0}, {3, 0}}), options);
  EXPECT_GT(fine.size(), 300U);
  EXPECT_NEAR(fine.time.back(), coarse, 1e-9);
  expect_limits(fine, options);
}

TEST(Timing, FeedSlowsOnlyWhereTheFrameTurns) {
  const auto roof = [](double x, double) { return -std::abs(x); };
  const Scene scene = scene_of(grid(roof, -4, 4, 2, -2, 2, 1));
  ToolPathOptions options;
  options.step = 0.01;
  options.acceleration = 10.0;
  options.angular_rate = 0.2;
  const ToolPath path = plan_toolpath(scene, down({{-2, 0.5}, {2, 0.5}}), options);
  double slowest = 1.0, away = 1.0;
  for (std::size_t j = 1; j + 2 < path.size(); ++j) {
    const double speed =
        (path.arc_length[j + 1] - path.arc_length[j]) / (path.time[j + 1] - path.time[j]);
    slowest = std::min(slowest, speed);
    const double x = path.surface[j].x();
    if (std::abs(x) > 0.1 && std::abs(x) < 1.9) away = std::min(away, speed);
  }
  // π/2 over 0.1 m at 0.2 rad/s: 0.2 / (1.5 · π/2 / 0.1) = 0.0085 m/s where it is steepest.
  EXPECT_NEAR(slowest, 0.2 / (1.5 * std::numbers::pi / 2 / 0.1), 3e-4);
  EXPECT_NEAR(away, options.speed, 1e-9);
}

TEST(Timing, PiecewiseConstantTurnsInPlace) {
  const auto roof = [](double x, double) { return -std::abs(x); };
  const Scene scene = scene_of(grid(roof, -4, 4, 2, -2, 2, 1));
  const ToolPathOptions options = piecewise_constant();
  const ToolPath path = plan_toolpath(scene, down({{-2, 0.5}, {2, 0.5}}), options);
  bool turned = false;
  for (std::size_t j = 0; j + 1 < path.size(); ++j) {
    if (turn_between(path, j, j + 1) < 1e-6) continue;
    turned = true;
    EXPECT_EQ(path.surface[j], path.surface[j + 1]);
    EXPECT_NEAR(path.time[j + 1] - path.time[j], std::numbers::pi / 2 / options.angular_rate, 1e-9);
  }
  EXPECT_TRUE(turned);
}

TEST(Timing, RestsAtBothEndsOfAGap) {
  const auto keep = [](int c, int) { return c != 4; };
  const Scene scene =
      scene_of(grid([](double, double) { return 0.0; }, 0, 9, 9, 0, 3, 3, Vec3::Zero(), keep));
  ToolPathOptions options;
  options.step = 0.02;
  options.acceleration = 0.02;
  const ToolPath path = plan_toolpath(scene, down({{1, 1.3}, {8, 1.3}}), options);
  const auto speed = [&](std::size_t j) {
    return (path.arc_length[j + 1] - path.arc_length[j]) / (path.time[j + 1] - path.time[j]);
  };
  for (std::size_t j = 1; j + 2 < path.size(); ++j) {
    if (!path.gap[j]) continue;
    // From rest over at most 0.02 m: a mean of √(2 a s) / 2.
    const double slow = 0.5 * std::sqrt(2 * options.acceleration * options.step) * 1.001;
    EXPECT_LE(speed(j - 1), slow);
    EXPECT_LE(speed(j + 1), slow);
    // 1 m across from rest to rest: √2 m/s² … a trapezoid at 0.1 m/s.
    EXPECT_NEAR(path.time[j + 1] - path.time[j], 1.0 / 0.1 + 0.1 / 0.02, 1e-9);
  }
  expect_limits(path, options);
}

TEST(Options, AreChecked) {
  const Plane plane(Vec3::UnitZ(), 0.0);
  const Aims aims = down({{0, 0}, {1, 0}});
  const auto refused = [&](auto change) {
    ToolPathOptions options;
    change(options);
    EXPECT_THROW(plan_toolpath(plane, aims, options), std::invalid_argument);
  };
  for (const double bad : {0.0, -1.0, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
    refused([&](ToolPathOptions& o) { o.speed = bad; });
    refused([&](ToolPathOptions& o) { o.acceleration = bad; });
    refused([&](ToolPathOptions& o) { o.angular_rate = bad; });
    refused([&](ToolPathOptions& o) { o.blend_length = bad; });
    if (bad == 0.0) continue;
    refused([&](ToolPathOptions& o) { o.standoff = bad; });
    refused([&](ToolPathOptions& o) { o.step = bad; });
    refused([&](ToolPathOptions& o) { o.normal_radius = bad; });
    refused([&](ToolPathOptions& o) { o.tool_radius = bad; });
    refused([&](ToolPathOptions& o) { o.tool_length = bad; });
    refused([&](ToolPathOptions& o) { o.contact_tolerance = bad; });
  }
  refused([](ToolPathOptions& o) {
    o.tool_radius = 0.3;
    o.tool_length = 0.5;
  });
}

TEST(Options, AStepThatWouldFillTheMemoryIsRefused) {
  const Scene scene = rough();
  ToolPathOptions options;
  options.step = 1e-12;
  EXPECT_THROW(plan_toolpath(scene, kTour, options), std::invalid_argument);
  options.step = 0.0;
  options.normal_radius = 1e-12;
  EXPECT_THROW(plan_toolpath(scene, kTour, options), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
