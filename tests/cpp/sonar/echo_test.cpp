// SPDX-License-Identifier: BSD-3-Clause
// The echo against what geometry says of it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "worlds.hpp"

namespace bathyal {
namespace {

using test::at;
using test::ball;
using test::flat;
using test::mesh_of;
using test::sum;
using test::world_of;

constexpr double kPi = std::numbers::pi;

double decibels(double ratio) { return 10.0 * std::log10(ratio); }

/// One beam to port about the horizontal, as wide in both planes.
SonarOptions narrow(double width, int rays) {
  SonarOptions options;
  options.beams = 1;
  options.beam_width = options.fan_width = options.fan_span = width;
  options.tilt = options.axis_tilt = 0.0;
  options.rays_across_beam = options.rays_along_fan = rays;
  return options;
}

double ball_energy(int rays) {
  const WorldSnapshot world = world_of({ball(Vec3(0, 1000, 0), 0.5)}, {0.3});
  SonarOptions options = narrow(0.00125, rays);
  options.range = 1100.0;
  const Echo echo = Sonar(options).echo(world, Water(), at(0, 0, 0));
  return sum(echo.power, 0, echo.power.size());
}

TEST(Echo, OfALambertSphereHasTheEnergyOfItsHalf) {
  const double exact = 2.0 * kPi * 0.3 * 0.25 / 3.0;
  EXPECT_NEAR(ball_energy(256) / exact, 1.0, 5e-3);
}

/// (μ φ / H²) (sin θ − sin³θ / 3) of a line array over a flat bottom, from straight down to θ.
double bottom_energy_error(int rays) {
  SonarOptions options;
  options.beams = 1;
  options.spreading = true;
  options.range = 1000.0;
  options.samples = 20000;
  options.fan_span = 1.2;
  options.tilt = 0.5 * kPi - 0.6;
  options.rays_along_fan = rays;
  options.rays_across_beam = 1;
  const WorldSnapshot world = world_of({flat(0.0, 5000.0)}, {0.2});
  const Echo echo = Sonar(options).echo(world, Water(), at(0, 0, 10));
  const double s = std::sin(1.2);
  const double exact = 0.2 * options.beam_width / 100.0 * (s - s * s * s / 3.0);
  return std::abs(sum(echo.power, 0, echo.power.size()) / exact - 1.0);
}

TEST(Echo, OfAFlatBottomHasTheEnergyOfTheIntegralAndConverges) {
  double last = bottom_energy_error(16);
  EXPECT_LT(last, 5e-3);
  for (const int rays : {64, 256}) {
    const double error = bottom_energy_error(rays);
    EXPECT_LT(error, std::max(0.5 * last, 2e-5)) << rays;  // the beam's own width: φ² / 24
    last = error;
  }
}

struct Row {
  SonarOptions options;
  Echo echo;

  double level(double range) const {  // of the samples within 1 % of it, by the metre
    const auto first = static_cast<std::size_t>(0.99 * range / options.sample_length());
    const auto last = static_cast<std::size_t>(1.01 * range / options.sample_length());
    return sum(echo.power, first, last - first) / static_cast<double>(last - first);
  }
};

Row flat_row(double altitude, bool spreading) {
  SonarOptions options;
  options.spreading = spreading;
  options.range = 100.0;
  options.samples = 2000;
  options.rays_along_fan = 8000;
  const WorldSnapshot world = world_of({flat(0.0)}, {1.0});
  return {options, Sonar(options).echo(world, Water(), at(0, 0, altitude))};
}

TEST(Echo, OfAFlatBottomFallsWithAngleAndRange) {
  const Row row = flat_row(10.0, true);
  const double at_60 = row.level(10.0 / std::cos(kPi / 3.0));
  const double at_70 = row.level(10.0 / std::cos(70.0 * kPi / 180.0));
  EXPECT_NEAR(decibels(at_70 / at_60), -8.60, 0.05);
}

TEST(Echo, FallsByNineDecibelsAPulseAndTwelveATargetWhenTheRangeDoubles) {
  const double near = flat_row(10.0, true).level(20.0);
  const double far = flat_row(20.0, true).level(40.0);
  EXPECT_NEAR(decibels(far / near), -9.03, 0.05);

  SonarOptions options = narrow(0.03, 200);
  options.spreading = true;
  const auto energy = [&](double range) {
    const WorldSnapshot world = world_of({ball(Vec3(0, range, 0), 0.2, 60)}, {1.0});
    const Echo echo = Sonar(options).echo(world, Water(), at(0, 0, 0));
    return sum(echo.power, 0, echo.power.size());
  };
  EXPECT_NEAR(decibels(energy(60.0) / energy(30.0)), -12.04, 0.15);
}

TEST(Echo, PowerPerAreaFollowsLambert) {
  const Row row = flat_row(10.0, false);
  const auto per_area = [&](double angle) {
    const double range = 10.0 / std::cos(angle);
    return row.level(range) / (range / std::sin(angle));  // R φ Δ / sin θ
  };
  EXPECT_NEAR(decibels(per_area(70.0 * kPi / 180.0) / per_area(kPi / 3.0)), -9.32 + 6.02, 0.05);
}

TEST(Echo, AWallThrowsTheShadowOfItsHeight) {
  const TriangleMesh wall =
      mesh_of({Vec3(-50, 30, 0), Vec3(50, 30, 0), Vec3(50, 30, 1), Vec3(-50, 30, 1)},
              {{0, 1, 2}, {0, 2, 3}});
  const WorldSnapshot world = world_of({flat(0.0), wall}, {1.0, 1.0});
  SonarOptions options;
  options.range = 50.0;
  options.samples = 2500;
  const Echo echo = Sonar(options).echo(world, Water(), at(0, 0, 10));
  const double length = options.sample_length();
  const auto sample = [&](double range) { return static_cast<int>(range / length); };
  const double foot = std::hypot(30.0, 10.0);
  // Port sees the wall: nothing from behind the foot to where the ray over its top comes down.
  int first_dark = -1, last_dark = -1;
  for (int i = sample(foot) - 60; i < sample(foot) + 300; ++i) {
    if (echo.power[static_cast<std::size_t>(i)] > 0.0) continue;
    if (first_dark < 0) first_dark = i;
    last_dark = i;
  }
  EXPECT_NEAR((last_dark + 1) * length - foot, 3.178, 2 * length);
  EXPECT_NEAR((last_dark + 1) * length - std::hypot(30.0, 9.0), 3.480, 2 * length);
  EXPECT_NEAR(first_dark * length, foot, 2 * length);
  const double ground = std::sqrt(std::pow((last_dark + 1) * length, 2) - 100.0) - 30.0;
  EXPECT_NEAR(ground, 3.333, 2 * length * 1.1);
  // Starboard does not.
  for (int i = sample(11.0); i < sample(49.0); ++i) {
    EXPECT_GT(echo.power[static_cast<std::size_t>(options.samples + i)], 0.0);
  }
}

TEST(Echo, TruthSaysWhatWasHit) {
  const Row row = flat_row(10.0, true);
  for (int i = 250; i < 1900; i += 50) {
    const auto sample = static_cast<std::size_t>(i);
    const double middle = (i + 0.5) * row.options.sample_length();
    EXPECT_NEAR(row.echo.truth.range[sample], middle, 0.5 * row.options.sample_length() + 1e-9);
    EXPECT_NEAR(row.echo.truth.incidence[sample], std::acos(10.0 / middle), 0.01);
    EXPECT_EQ(row.echo.truth.material[sample], 0);
    EXPECT_NEAR(row.echo.truth.point[3 * sample + 2], 0.0, 1e-9);
    EXPECT_GT(row.echo.truth.point[3 * sample + 1], 0.0);  // port
    EXPECT_LT(row.echo.truth.point[3 * (sample + 2000) + 1], 0.0);
  }
  EXPECT_TRUE(std::isnan(row.echo.truth.range[100]));  // the water column
  EXPECT_EQ(row.echo.truth.material[100], -1);
}

TEST(Echo, NothingIsHeardBeforeTheBottomStraightBelow) {
  const Row row = flat_row(10.0, true);
  EXPECT_EQ(sum(row.echo.power, 0, 200), 0.0);  // samples of 5 cm, the last ends at 10 m
  EXPECT_GT(row.echo.power[200], 0.0);
}

TEST(Echo, AnyNumberOfThreadsGivesTheSameBytes) {
  const WorldSnapshot world = world_of({flat(0.0), ball(Vec3(3, 15, 0), 2.0, 40)}, {0.5, 1.0});
  const Sonar sonar{side_scan_sonar()};
  const Echo one = sonar.echo(world, Water(), at(0, 0, 8), 0, 1);
  const Echo four = sonar.echo(world, Water(), at(0, 0, 8), 0, 4);
  EXPECT_EQ(one.power, four.power);
  EXPECT_EQ(one.truth.material, four.truth.material);
}

TEST(Echo, ThePapersModelAddsPixels) {
  SonarOptions options = paper_side_scan_sonar();
  options.rays_across_beam = 4;
  options.rays_along_fan = 1000;
  const WorldSnapshot world = world_of({flat(0.0)}, {0.7});
  const Echo echo = Sonar(options).echo(world, Water(), at(0, 0, 10));
  // Σ K_d cos θ over the pixels that meet the bottom within the range, written once more.
  double exact = 0.0;
  const double half = std::tan(kPi / 8.0), narrow = std::tan(0.3 * kPi / 180.0);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 1000; ++j) {
      const double x = narrow * ((2.0 * i + 1.0) / 4.0 - 1.0),
                   y = half * ((2.0 * j + 1.0) / 1000.0 - 1.0);
      const double tilt = kPi / 8.0;
      Vec3 u = Vec3(0, std::cos(tilt), -std::sin(tilt)) + x * Vec3::UnitX() +
               y * Vec3(0, std::sin(tilt), std::cos(tilt));
      u.normalize();
      if (u.z() < 0.0 && 10.0 / -u.z() < 120.0) exact += 0.7 * -u.z();
    }
  }
  EXPECT_NEAR(sum(echo.power, 0, 2000) / exact, 1.0, 1e-12);
  EXPECT_NEAR(sum(echo.power, 2000, 2000) / exact, 1.0, 1e-12);
}

TEST(Echo, RefusesAPlaceWithoutWater) {
  const WorldSnapshot world = world_of({flat(0.0), ball(Vec3(0, 0, 20), 3.0, 20)}, {1.0, 1.0});
  const Sonar sonar{side_scan_sonar()};
  EXPECT_THROW(sonar.echo(world, Water(), at(100, 0, -1)), std::invalid_argument);
  EXPECT_THROW(sonar.echo(world, Water(), at(0, 0, 20)), std::invalid_argument);
  EXPECT_THROW(sonar.echo(world, Water(), at(0, 0, std::nan(""))), std::invalid_argument);
  EXPECT_NO_THROW(sonar.echo(world, Water(), at(0, 0, 10)));
  const Echo far = sonar.echo(world, Water(), at(500, 0, 90));
  ASSERT_EQ(far.warnings.size(), 1U);
  EXPECT_EQ(sum(far.power, 0, far.power.size()), 0.0);
}

TEST(Echo, WithoutTruthIsTheSamePower) {
  const WorldSnapshot world = world_of({flat(0.0)}, {1.0});
  const Sonar sonar;
  const Echo with = sonar.echo(world, Water(), at(0, 0, 10));
  const Echo without = sonar.echo(world, Water(), at(0, 0, 10), 0, 0, {}, false);
  EXPECT_EQ(with.power, without.power);
  EXPECT_EQ(with.truth.point.size(), 3 * with.power.size());
  EXPECT_TRUE(without.truth.range.empty() && without.truth.point.empty());
}

}  // namespace
}  // namespace bathyal
