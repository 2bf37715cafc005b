// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/water/sound_path.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "bathyal/base/error.hpp"
#include "bathyal/base/random.hpp"

namespace bathyal {
namespace {

constexpr double kPi = std::numbers::pi;

/// The ray equations dx/dt = c cos θ, dz/dt = c sin θ, dθ/dt = −c′ cos θ, by Runge and Kutta.
std::array<double, 3> runge_kutta(const std::function<double(double)>& speed,
                                  const std::function<double(double)>& slope, double depth,
                                  double angle, double time, int steps) {
  using State = std::array<double, 3>;
  const auto rate = [&](const State& y) {
    const double c = speed(y[1]);
    return State{c * std::cos(y[2]), c * std::sin(y[2]), -slope(y[1]) * std::cos(y[2])};
  };
  const auto step = [](const State& y, const State& k, double h) {
    return State{y[0] + h * k[0], y[1] + h * k[1], y[2] + h * k[2]};
  };
  State y{0.0, depth, angle};
  const double h = time / steps;
  for (int i = 0; i < steps; ++i) {
    const State k1 = rate(y);
    const State k2 = rate(step(y, k1, h / 2));
    const State k3 = rate(step(y, k2, h / 2));
    const State k4 = rate(step(y, k3, h));
    for (int j = 0; j < 3; ++j) y[j] += h / 6 * (k1[j] + 2 * k2[j] + 2 * k3[j] + k4[j]);
  }
  return y;
}

TEST(SoundPath, ConstantGradientIsACircle) {
  // c = 1500 + g z from 100 m: the circle of radius c₀ / (|g| cos θ₀) about the level of c = 0.
  for (const double gradient : {0.017, -0.05, 0.5}) {
    for (const double angle : {-0.6, -0.01, 0.0, 0.3, 1.2}) {
      const SpeedProfile profile({0.0, 4000.0}, {1500.0, 1500.0 + 4000.0 * gradient});
      if (1500.0 + 4000.0 * gradient < 100.0) continue;
      const SoundPath path(profile, 500.0, angle, {.max_time = 5.0, .max_distance = 1000.0});
      const double c0 = 1500.0 + 500.0 * gradient;
      const double radius = c0 / (gradient * std::cos(angle));  // signed
      const double centre_x = radius * std::sin(angle);
      const double centre_z = 500.0 - c0 / gradient;
      for (int i = 0; i <= 40; ++i) {
        const SoundState s = path.at(path.duration() * i / 40);
        if (s.depth <= 0.0 || s.depth >= 4000.0) continue;
        const double off = std::hypot(s.distance - centre_x, s.depth - centre_z);
        EXPECT_NEAR(off, std::abs(radius), 1e-6) << gradient << " " << angle;
        EXPECT_NEAR(s.along * s.along + s.down * s.down, 1.0, 1e-12);
        EXPECT_NEAR(s.speed, 1500.0 + gradient * s.depth, 1e-8);
        EXPECT_NEAR(s.along / s.speed, std::cos(angle) / c0, 1e-15);  // Snell
      }
    }
  }
}

TEST(SoundPath, TravelTimeInAConstantGradient) {
  // Between two points: t = arcosh(1 + g² (x² + z²) / (2 c₁ c₂)) / |g|.
  const double g = 0.02;
  const SpeedProfile profile({0.0, 5000.0}, {1480.0, 1480.0 + 5000.0 * g});
  const SoundPath path(profile, 200.0, 0.4, {.max_time = 3.0});
  const SoundState s = path.at(2.5);
  const double x2 = s.distance * s.distance + (s.depth - 200.0) * (s.depth - 200.0);
  const double c1 = 1484.0;
  EXPECT_NEAR(std::acosh(1.0 + g * g * x2 / (2.0 * c1 * s.speed)) / g, 2.5, 1e-11);
}

TEST(SoundPath, MunkProfileAgainstRungeAndKutta) {
  const auto munk = [](double z) {
    const double eta = 2.0 * (z - 1300.0) / 1300.0;
    return 1500.0 * (1.0 + 0.00737 * (eta - 1.0 + std::exp(-eta)));
  };
  const auto slope = [](double z) {
    const double eta = 2.0 * (z - 1300.0) / 1300.0;
    return 1500.0 * 0.00737 * (2.0 / 1300.0) * (1.0 - std::exp(-eta));
  };
  std::vector<double> depth;
  std::vector<double> speed;
  for (int i = 0; i <= 20000; ++i) {
    depth.push_back(0.25 * i);
    speed.push_back(munk(0.25 * i));
  }
  const SpeedProfile profile(depth, speed);
  for (const double angle : {-0.2, -0.03, 0.0, 0.1, 0.7, 1.3}) {
    const double start = 700.0;
    const SoundPath path(profile, start, angle, {.max_time = 5.0});
    // 1 mm after 1 000 m of way, by rows of 0.25 m.
    const double time = 1000.0 / 1500.0;
    if (path.duration() < time) continue;
    const auto y = runge_kutta(munk, slope, start, angle, time, 4000);
    const SoundState s = path.at(time);
    EXPECT_NEAR(s.distance, y[0], 1e-3) << angle;
    EXPECT_NEAR(s.depth, y[1], 1e-3) << angle;
    EXPECT_NEAR(std::atan2(s.down, s.along), y[2], 1e-6) << angle;
  }
}

TEST(SoundPath, RoughProfilesAgainstRungeAndKutta) {
  // Layers of any gradient, isospeed ones among them, taken as they are: no discretisation between.
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    RandomStream random(seed);
    std::vector<double> depth{0.0};
    std::vector<double> speed{1500.0};
    for (int i = 0; i < 12; ++i) {
      depth.push_back(depth.back() + random.uniform(20.0, 120.0));
      speed.push_back(i % 4 == 3 ? speed.back() : speed.back() + random.uniform(-4.0, 4.0));
    }
    const SpeedProfile profile(depth, speed);
    const double start = random.uniform(100.0, 300.0);
    const double angle = random.uniform(-0.3, 1.4);
    const SoundPath path(profile, start, angle, {.max_time = 0.4});
    const auto slope = [&](double z) { return profile.gradient(profile.layer(z)); };
    const auto c = [&](double z) { return profile.speed(z); };
    const double time = std::min(0.4, path.duration());
    const auto y = runge_kutta(c, slope, start, angle, time, 40000);
    const SoundState s = path.at(time);
    EXPECT_NEAR(s.distance, y[0], 1e-3) << seed;
    EXPECT_NEAR(s.depth, y[1], 1e-3) << seed;
  }
}

TEST(SoundPath, StraightInUniformWater) {
  const SpeedProfile profile(1500.0);
  for (const double angle : {-kPi / 2, -0.4, 0.0, 0.9, kPi / 2}) {
    const SoundPath path(profile, 800.0, angle, {.max_time = 0.5});
    const SoundState s = path.at(0.4);
    EXPECT_NEAR(s.distance, 600.0 * std::cos(angle), 1e-9);
    EXPECT_NEAR(s.depth, 800.0 + 600.0 * std::sin(angle), 1e-9);
    EXPECT_EQ(path.nodes().size(), 2U);
    EXPECT_EQ(path.chords(0.01).size(), 2U);
  }
}

TEST(SoundPath, VerticalTakesTheIntegralOfSlowness) {
  const SpeedProfile profile({0.0, 100.0, 400.0}, {1480.0, 1500.0, 1495.0});
  const SoundPath path(profile, 0.0, kPi / 2, {.max_time = 1.0});
  const double first = 100.0 / 20.0 * std::log(1500.0 / 1480.0);
  const double second = 300.0 / -5.0 * std::log(1495.0 / 1500.0);
  EXPECT_NEAR(path.nodes()[1].time, first, 1e-13);
  EXPECT_NEAR(path.nodes()[2].time, first + second, 1e-13);
  EXPECT_EQ(path.nodes()[2].distance, 0.0);
  EXPECT_EQ(path.nodes()[2].depth, 400.0);
}

TEST(SoundPath, TurnsWhereSnellSaysSo) {
  const SpeedProfile profile({0.0, 1000.0}, {1500.0, 1517.0});
  const double angle = 0.08;  // turns where c = c₀ / cos θ₀
  const SoundPath path(profile, 300.0, angle, {.max_time = 12.0, .surface_reflects = true});
  const double deepest = 300.0 + (1505.1 / std::cos(angle) - 1505.1) / 0.017;
  double found = 0.0;
  for (int i = 0; i < 200000; ++i) found = std::max(found, path.at(12.0 * i / 200000).depth);
  EXPECT_NEAR(found, deepest, 1e-4);
  ASSERT_EQ(path.nodes().size(), 3U);  // up to the surface, which reflects it
  EXPECT_EQ(path.nodes()[1].depth, 0.0);
}

TEST(SoundPath, TheAxisOfAChannelHoldsAHorizontalRay) {
  const SpeedProfile profile({0.0, 500.0, 1000.0}, {1500.0, 1480.0, 1500.0});
  const SoundPath path(profile, 500.0, 0.0, {.max_time = 10.0});
  EXPECT_EQ(path.nodes().back().depth, 500.0);
  EXPECT_NEAR(path.nodes().back().distance, 14800.0, 1e-9);
  const SoundPath near(profile, 500.0, 0.01, {.max_time = 100.0});  // trapped about it
  for (const SoundState& s : near.nodes()) EXPECT_NEAR(s.depth, 500.0, 2.0);
  const SpeedProfile ridge({0.0, 500.0, 1000.0}, {1480.0, 1500.0, 1480.0});
  EXPECT_GT(SoundPath(ridge, 500.0, 0.0, {.max_time = 1.0}).at(1.0).depth, 500.0);
}

TEST(SoundPath, BackTheSameWay) {
  const SpeedProfile profile({0.0, 50.0, 200.0, 201.0, 900.0},
                             {1510.0, 1511.0, 1490.0, 1490.0, 1496.0});
  for (const double angle : {0.05, 0.3, 1.0}) {
    const SoundPath out(profile, 30.0, angle, {.max_time = 0.9});
    const SoundState end = out.nodes().back();
    const SoundPath back(profile, end.depth, -std::atan2(end.down, end.along), {.max_time = 0.9});
    // Travelled backwards, x decreases: the same depth after the same time.
    EXPECT_NEAR(back.nodes().back().depth, 30.0, 1e-6);
    EXPECT_NEAR(back.nodes().back().distance, end.distance, 1e-6);
  }
}

TEST(SoundPath, ByDistanceIsByTime) {
  const SpeedProfile profile({0.0, 60.0, 300.0, 1200.0}, {1520.0, 1500.0, 1490.0, 1505.0});
  for (const double angle : {-0.02, 0.1, 1.4}) {
    const SoundPath path(profile, 100.0, angle, {.max_time = 0.7});
    for (const double t : {0.1, 0.33, 0.69}) {
      const SoundState a = path.at(t);
      const SoundState b = path.at_distance(a.distance);
      EXPECT_NEAR(b.time, t, 1e-11);
      EXPECT_NEAR(b.depth, a.depth, 1e-8);
      EXPECT_NEAR(b.down, a.down, 1e-11);
    }
  }
}

TEST(SoundPath, ChordsStayWithinTheirTolerance) {
  const SpeedProfile profile({0.0, 30.0, 400.0}, {1530.0, 1500.0, 1520.0});
  const SoundPath path(profile, 5.0, 0.1, {.max_time = 0.6});
  for (const double tolerance : {1.0, 0.01, 1e-4}) {
    const auto points = path.chords(tolerance);
    double worst = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const SoundState& a = points[i - 1];
      const SoundState& b = points[i];
      EXPECT_GT(b.time, a.time);
      const double length = std::hypot(b.distance - a.distance, b.depth - a.depth);
      for (int j = 0; j <= 10; ++j) {
        const SoundState s = path.at(a.time + (b.time - a.time) * j / 10);
        worst = std::max(worst, std::abs((b.distance - a.distance) * (s.depth - a.depth) -
                                         (b.depth - a.depth) * (s.distance - a.distance)) /
                                    length);
      }
      EXPECT_NEAR(path.at(b.time).depth, b.depth, 1e-9);
    }
    EXPECT_LE(worst, tolerance);
    EXPECT_GT(worst, 0.02 * tolerance);  // and not with many more chords than needed
  }
}

TEST(SoundPath, EndsAtTheSurfaceOrIsReflected) {
  const SpeedProfile profile(1500.0);
  const SoundPath up(profile, 30.0, -0.5, {.max_time = 1.0});
  EXPECT_EQ(up.end(), SoundPathEnd::kSurface);
  EXPECT_EQ(up.nodes().back().depth, 0.0);
  EXPECT_NEAR(up.duration(), 30.0 / std::sin(0.5) / 1500.0, 1e-14);
  const SoundPath mirror(profile, 30.0, -0.5, {.max_time = 1.0, .surface_reflects = true});
  EXPECT_NEAR(mirror.nodes().back().depth, 1500.0 * std::sin(0.5) - 30.0, 1e-9);
}

TEST(SoundPath, Refusals) {
  const SpeedProfile profile(1500.0);
  EXPECT_THROW(SoundPath(profile, -1.0, 0.0), std::invalid_argument);
  EXPECT_THROW(SoundPath(profile, NAN, 0.0), std::invalid_argument);
  EXPECT_THROW(SoundPath(profile, 1.0, 1.6), std::invalid_argument);
  EXPECT_THROW(SoundPath(profile, 1.0, NAN), std::invalid_argument);
  EXPECT_THROW(SoundPath(profile, 1.0, 0.0, {.max_time = 0.0}), std::invalid_argument);
  EXPECT_THROW(SpeedProfile({0.0, 0.0}, {1500.0, 1500.0}), std::invalid_argument);
  EXPECT_THROW(SpeedProfile({0.0, 1.0}, {1500.0, -1.0}), std::invalid_argument);
  const SpeedProfile duct({0.0, 1.0, 2.0}, {1500.0, 1400.0, 1500.0});
  EXPECT_THROW(SoundPath(duct, 1.0, 0.1, {.max_time = 1e4, .max_arcs = 1000}), Error);
}

TEST(Eigenrays, StraightLinesInUniformWater) {
  const auto rays = eigenrays(SpeedProfile(1500.0), 100.0, 40.0, 80.0);
  ASSERT_EQ(rays.size(), 1U);
  EXPECT_NEAR(rays[0].time, 100.0 / 1500.0, 1e-12);
  EXPECT_NEAR(rays[0].launch, std::atan2(-60.0, 80.0), 1e-12);
  const auto down = eigenrays(SpeedProfile(1500.0), 10.0, 40.0, 0.0);
  ASSERT_EQ(down.size(), 1U);
  EXPECT_NEAR(down[0].time, 0.02, 1e-12);
}

TEST(Eigenrays, TimesInAConstantGradientAndReciprocity) {
  const double g = -0.06;
  const SpeedProfile profile({0.0, 800.0}, {1530.0, 1530.0 + 800.0 * g});
  const auto there = eigenrays(profile, 20.0, 150.0, 900.0);
  const auto back = eigenrays(profile, 150.0, 20.0, 900.0);
  ASSERT_EQ(there.size(), 1U);
  ASSERT_EQ(back.size(), 1U);
  const double c1 = 1530.0 + 20.0 * g;
  const double c2 = 1530.0 + 150.0 * g;
  const double x2 = 900.0 * 900.0 + 130.0 * 130.0;
  EXPECT_NEAR(there[0].time, std::acosh(1.0 + g * g * x2 / (2.0 * c1 * c2)) / -g, 1e-11);
  EXPECT_NEAR(there[0].time, back[0].time, 1e-11);
  EXPECT_NEAR(there[0].launch, -back[0].arrival, 1e-9);
}

TEST(Eigenrays, SeveralInAChannelNoneInAShadow) {
  const SpeedProfile channel({0.0, 1000.0, 2000.0}, {1520.0, 1480.0, 1520.0});
  const auto rays = eigenrays(channel, 1000.0, 1000.0, 40000.0);
  EXPECT_GT(rays.size(), 3U);
  for (const Eigenray& ray : rays) {
    const SoundPath path(channel, 1000.0, ray.launch, {.max_time = 60.0, .max_distance = 40000.0});
    EXPECT_NEAR(path.nodes().back().depth, 1000.0, 1e-3);
    EXPECT_NEAR(path.nodes().back().time, ray.time, 1e-9);
  }
  const SpeedProfile downward({0.0, 1000.0}, {1540.0, 1480.0});
  EXPECT_TRUE(eigenrays(downward, 10.0, 10.0, 5000.0).empty());
  // Above a layer of greatest speed rays turn back, below it they go down: neither passes between.
  const SpeedProfile ridge({0.0, 500.0, 1000.0}, {1480.0, 1500.0, 1480.0});
  EXPECT_TRUE(eigenrays(ridge, 100.0, 500.0, 10000.0).empty());
}

}  // namespace
}  // namespace bathyal
