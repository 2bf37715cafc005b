// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/keepout.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "../scene/meshes.hpp"
#include "bathyal/workspace/internal/convex_distance.hpp"

namespace bathyal {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();

Pose tilted_pose() {
  Pose pose = Pose::Identity();
  pose.rotate(Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, 3.0).normalized()));
  pose.pretranslate(Vec3(0.3, -0.2, 0.5));
  return pose;
}

std::vector<KeepOut> convex_keepouts() {
  return {KeepOut::sphere(0.5, {0.1, 0.2, 0.3}),
          KeepOut::box({1.0, 0.6, 0.3}, tilted_pose()),
          KeepOut::cylinder(0.3, 1.2, tilted_pose()),
          KeepOut::cylinder(0.8, 0.1, tilted_pose()),
          KeepOut::cone(0.4, 1.0, tilted_pose()),
          KeepOut::cone(2.0, 0.5, tilted_pose()),
          KeepOut::half_space(Plane({1.0, -2.0, 0.5}, 0.3))};
}

double distance(const KeepOut& keepout, const Vec3& point) {
  return keepout.distance({point.data(), 1, 3}).front();
}

TEST(KeepOut, DistancesByHand) {
  const KeepOut sphere = KeepOut::sphere(2.0, {1.0, 0.0, 0.0});
  EXPECT_EQ(distance(sphere, {1.0, 0.0, 0.0}), -2.0);
  EXPECT_EQ(distance(sphere, {4.0, 4.0, 0.0}), 3.0);
  const KeepOut box = KeepOut::box({2.0, 4.0, 6.0}, Pose::Identity());
  EXPECT_EQ(distance(box, Vec3::Zero()), -1.0);
  EXPECT_EQ(distance(box, {0.0, 1.75, 0.0}), -0.25);
  EXPECT_EQ(distance(box, {4.0, 6.0, 0.0}), 5.0);
  const KeepOut cylinder = KeepOut::cylinder(1.0, 2.0, Pose::Identity());
  EXPECT_EQ(distance(cylinder, Vec3::Zero()), -1.0);
  EXPECT_EQ(distance(cylinder, {4.0, 0.0, 5.0}), 5.0);
  EXPECT_EQ(distance(cylinder, {0.0, 0.0, 3.0}), 2.0);
  const KeepOut cone = KeepOut::cone(3.0, 4.0, Pose::Identity());
  EXPECT_EQ(distance(cone, {0.0, 0.0, -2.0}), 2.0);
  EXPECT_EQ(distance(cone, {0.0, 0.0, 5.0}), 1.0);
  EXPECT_EQ(distance(cone, {6.0, 0.0, 8.0}), 5.0);
  EXPECT_DOUBLE_EQ(distance(cone, {0.0, 0.0, 1.0}), -0.6);
  EXPECT_DOUBLE_EQ(distance(cone, {0.0, 0.0, 3.75}), -0.25);
  EXPECT_DOUBLE_EQ(distance(cone, {4.0, 0.0, 0.0}), 3.2);
  const KeepOut below = KeepOut::half_space(Plane({0.0, 0.0, 2.0}, 2.0));
  EXPECT_EQ(distance(below, {7.0, 7.0, 0.0}), -1.0);
}

/// A point moved by the distance against the gradient lies on the border; the gradient is that of
/// finite differences; and the function is convex along any line.
TEST(KeepOut, GradientsLeadToTheBorder) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-2.0, 2.0);
  for (const KeepOut& keepout : convex_keepouts()) {
    for (int i = 0; i < 2000; ++i) {
      const Vec3 point(uniform(random), uniform(random), uniform(random));
      const auto [value, gradient] = workspace::signed_distance(keepout, point);
      EXPECT_NEAR(gradient.norm(), 1.0, 1e-12);
      const Vec3 border = point - value * gradient;
      EXPECT_NEAR(workspace::signed_distance(keepout, border).value, 0.0, 1e-12)
          << to_string(keepout.kind());
      const Vec3 other(uniform(random), uniform(random), uniform(random));
      EXPECT_GE(workspace::signed_distance(keepout, other).value,
                value + gradient.dot(other - point) - 1e-12)
          << to_string(keepout.kind());
    }
  }
}

TEST(KeepOut, CapsulesAreTheLeastAlongTheirAxis) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  constexpr Index kCount = 300;
  for (const KeepOut& keepout : convex_keepouts()) {
    PointMatrix a(kCount, 3), b(kCount, 3);
    std::vector<double> radius(kCount);
    for (Index i = 0; i < kCount; ++i) {
      for (int c = 0; c < 3; ++c) a(i, c) = uniform(random), b(i, c) = uniform(random);
      if (i % 10 == 0) b.row(i) = a.row(i);
      radius[static_cast<std::size_t>(i)] = 0.05 * static_cast<double>(i % 3);
    }
    const std::vector<double> found =
        keepout.capsule_distance({a.data(), kCount, 3}, {b.data(), kCount, 3}, radius);
    constexpr int kSteps = 2000;
    PointMatrix axis(kSteps + 1, 3);
    for (Index i = 0; i < kCount; ++i) {
      for (int s = 0; s <= kSteps; ++s) {
        axis.row(s) = a.row(i) + static_cast<double>(s) / kSteps * (b.row(i) - a.row(i));
      }
      const std::vector<double> sampled = keepout.distance({axis.data(), kSteps + 1, 3});
      const double r = radius[static_cast<std::size_t>(i)];
      const double least = *std::min_element(sampled.begin(), sampled.end()) - r;
      const double step = (b.row(i) - a.row(i)).norm() / kSteps;
      EXPECT_LE(found[static_cast<std::size_t>(i)], least + 1e-12) << to_string(keepout.kind());
      EXPECT_GE(found[static_cast<std::size_t>(i)], least - 0.5 * step - 1e-12);
    }
  }
}

TEST(ConvexMinimum, EndsAtTheBound) {
  int calls = 0;
  const auto kink = [&](double t) {
    ++calls;
    return std::pair(std::max(-t, 3.0 * t - 1.0), -t > 3.0 * t - 1.0 ? -1.0 : 3.0);
  };
  EXPECT_NEAR(workspace::convex_minimum(kink, 1e-15), -0.25, 1e-15);
  EXPECT_LE(calls, 6);
  calls = 0;
  const auto parabola = [&](double t) {
    ++calls;
    return std::pair((t - 0.3) * (t - 0.3), 2.0 * (t - 0.3));
  };
  EXPECT_NEAR(workspace::convex_minimum(parabola, 1e-13), 0.0, 1e-13);
  EXPECT_LE(calls, 40);
  const auto rising = [](double t) { return std::pair(t, 1.0); };
  EXPECT_EQ(workspace::convex_minimum(rising, 1e-13), 0.0);
}

TEST(KeepOut, RefusesByName) {
  const auto message = [](const auto& make) {
    try {
      make();
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const Pose pose = Pose::Identity();
  Pose scaled = pose;
  scaled.linear() *= 2.0;
  const auto begins = [](const std::string& text, const std::string& name) {
    return text.rfind("`" + name + "`: expected", 0) == 0;
  };
  EXPECT_TRUE(begins(message([&] { KeepOut::sphere(0.0, {0, 0, 0}); }), "radius"));
  EXPECT_TRUE(begins(message([&] { KeepOut::sphere(-1.0, {0, 0, 0}); }), "radius"));
  EXPECT_TRUE(begins(message([&] { KeepOut::sphere(1.0, {0, kNan, 0}); }), "center"));
  EXPECT_TRUE(begins(message([&] { KeepOut::sphere(1.0, {0, 0, 0}, {"", {}}); }), "frame"));
  EXPECT_TRUE(begins(message([&] { KeepOut::sphere(1.0, {0, 0, 0}, {"hull", " "}); }), "name"));
  EXPECT_TRUE(begins(message([&] { KeepOut::box({1, 0, 1}, pose); }), "size"));
  EXPECT_TRUE(begins(message([&] { KeepOut::box({1, 1, 1}, scaled); }), "pose"));
  EXPECT_TRUE(begins(message([&] { KeepOut::cylinder(kNan, 1.0, pose); }), "radius"));
  EXPECT_TRUE(begins(message([&] { KeepOut::cone(1.0, 0.0, pose); }), "length"));
  EXPECT_TRUE(begins(message([&] { KeepOut::half_space(Plane({0, 0, 0}, 1.0)); }), "normal"));
  const KeepOut mesh = KeepOut::mesh(Hull(test::box({1, 1, 1})));
  const Vec3 at(3, 0, 0);
  EXPECT_EQ(distance(mesh, at), 2.0);
  const std::vector<double> radius{0.1}, wrong{-0.1};
  const PointView one(at.data(), 1, 3);
  const KeepOut ball = KeepOut::sphere(1.0, {0, 0, 0});
  EXPECT_TRUE(begins(message([&] { ball.capsule_distance(one, one, wrong); }), "radius"));
  EXPECT_EQ(ball.name(), "sphere");
  EXPECT_EQ(ball.frame(), "hull");
}

}  // namespace
}  // namespace bathyal
