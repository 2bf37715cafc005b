// SPDX-License-Identifier: BSD-3-Clause
// Switches of the physics, each against its formula.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bathyal/sonar/backscatter.hpp"
#include "bathyal/sonar/vehicle_motion.hpp"
#include "bathyal/water/sound_path.hpp"
#include "bathyal/world/materials.hpp"
#include "worlds.hpp"

namespace bathyal {
namespace {

using test::at;
using test::ball;
using test::flat;
using test::mesh_of;
using test::sum;
using test::world_of;

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// Surface at z = 0, sound speed linear between depths.
Water water_of(std::vector<double> depth, std::vector<double> speed) {
  WaterOptions options;
  options.surface = 0.0;
  WaterProfile profile;
  profile.depth = std::move(depth);
  profile.sound_speed = std::move(speed);
  options.profiles = {profile};
  return Water(options);
}

/// A pencil beam to port, `down` below the horizontal.
SonarOptions pencil(double down, double width, double range) {
  SonarOptions options;
  options.beams = 1;
  options.beam_width = options.fan_width = options.fan_span = width;
  options.tilt = options.axis_tilt = down;
  options.rays_across_beam = options.rays_along_fan = 9;
  options.range = range;
  options.samples = 4000;
  return options;
}

std::size_t strongest(const Echo& echo) {
  return static_cast<std::size_t>(std::max_element(echo.power.begin(), echo.power.end()) -
                                  echo.power.begin());
}

Vec3 point_of(const Echo& echo, std::size_t sample) {
  return {echo.truth.point[3 * sample], echo.truth.point[3 * sample + 1],
          echo.truth.point[3 * sample + 2]};
}

/// In a constant gradient g a ray launched θ below the horizontal meets the depth z after
/// t = ln((c₁ / c₀)(1 + sin θ₀) / (1 + sin θ₁)) / g, at x = c₀ (sin θ₀ − sin θ₁) / (g cos θ₀).
TEST(Physics, ConstantGradientBendsRaysToCircles) {
  const double g = 0.1, surface_speed = 1480.0, bottom = 600.0, start = 100.0;
  const Water water = water_of({0.0, 2000.0}, {surface_speed, surface_speed + 2000.0 * g});
  const WorldSnapshot world = world_of({flat(-bottom, 5000.0)}, {1.0});
  for (const double degrees : {35.0, 50.0, 70.0, 90.0}) {
    SonarOptions options = pencil(radians(degrees), 1e-6, 1000.0);
    options.refraction = true;
    const Echo echo = Sonar(options).echo(world, water, at(0, 0, -start));
    const double c0 = surface_speed + g * start, c1 = surface_speed + g * bottom;
    const double sine = std::sin(radians(degrees));
    const double cosine = std::cos(radians(degrees));
    const double sine_1 = std::sqrt(1.0 - std::pow(cosine * c1 / c0, 2));
    const double time = std::log(c1 / c0 * (1.0 + sine) / (1.0 + sine_1)) / g;
    const std::size_t best = strongest(echo);
    EXPECT_NEAR(echo.truth.range[best], c0 * time, 2e-3) << degrees;
    const Vec3 point = point_of(echo, best);
    if (degrees < 90.0) {
      const double out = c0 * (sine - sine_1) / (g * cosine);
      EXPECT_NEAR(point.y(), out, 0.02) << degrees;
    }
    EXPECT_NEAR(point.z(), -bottom, 1e-6);
    EXPECT_NEAR(echo.truth.incidence[best], std::acos(sine_1), 1e-3) << degrees;
  }
}

/// What range and launch angle alone make of a flat bottom: a smile or a frown.
TEST(Physics, AMultibeamShowsTheSmileOfItsGradient) {
  const double g = -0.2, c0 = 1500.0, height = 80.0;
  const Water water = water_of({0.0, 500.0}, {c0, c0 + 500.0 * g});
  const WorldSnapshot world = world_of({flat(-10.0 - height, 2000.0)}, {1.0});
  SonarOptions options = multibeam_sonar();
  options.beams = 31;
  options.beam_width = options.fan_width = options.fan_span = radians(0.05);
  options.range = 200.0;
  options.samples = 20000;
  options.refraction = true;
  const Echo echo = Sonar(options).echo(world, water, at(0, 0, -10));
  const double start = c0 + 10.0 * g, end = start + height * g;
  for (int beam = 0; beam < 31; ++beam) {
    const double off = radians(120.0) * (beam / 30.0 - 0.5);
    const double cosine = std::sin(std::abs(off)), sine = std::cos(off);
    const double sine_1 = std::sqrt(1.0 - std::pow(cosine * end / start, 2));
    const double time = std::log(end / start * (1.0 + sine) / (1.0 + sine_1)) / g;
    const double smile = start * time * sine - height;  // deeper than it is, by this
    double energy = 0.0, mean = 0.0;
    for (std::size_t i = 0; i < 20000; ++i) {
      const double power = echo.power[static_cast<std::size_t>(beam) * 20000 + i];
      energy += power;
      mean += power * (static_cast<double>(i) + 0.5) * options.sample_length();
    }
    EXPECT_NEAR(mean / energy * sine - height, smile, 0.01) << beam;
  }
}

TEST(Physics, AThermoclineAgreesWithTheExactPath) {
  const Water water = water_of({0, 20, 25, 60, 200}, {1515, 1514, 1490, 1486, 1488});
  const WorldSnapshot world = world_of({flat(-80.0, 2000.0)}, {1.0});
  for (const double degrees : {15.0, 25.0, 40.0, 65.0}) {
    SonarOptions options = pencil(radians(degrees), 1e-5, 400.0);
    options.refraction = true;
    const Echo echo = Sonar(options).echo(world, water, at(0, 0, -10));
    const SoundPath path(water.speed_profile(0.0), 10.0, radians(degrees), {.max_time = 1.0});
    double low = 0.0, high = 0.5;  // [s]
    for (int i = 0; i < 60; ++i)
      (path.at(0.5 * (low + high)).depth < 80.0 ? low : high) = 0.5 * (low + high);
    const SoundState there = path.at(low);
    const std::size_t best = strongest(echo);
    EXPECT_NEAR(echo.truth.range[best], low * echo.sound_speed, 0.02) << degrees;
    EXPECT_NEAR(point_of(echo, best).y(), there.distance, 0.05) << degrees;
  }
}

TEST(Physics, RefractionKeepsTheEnergyOfATube) {
  // The area that a beam lights is the tube's over the cosine; without spreading that is the echo.
  const Water water = water_of({0.0, 2000.0}, {1480.0, 1680.0});
  const WorldSnapshot world = world_of({flat(-400.0, 5000.0)}, {1.0});
  const double width = 1e-4;
  SonarOptions options = pencil(radians(40.0), width, 1000.0);
  options.refraction = true;
  const Echo echo = Sonar(options).echo(world, water, at(0, 0, -50));
  const auto out = [&](double launch) {
    const double c0 = 1485.0, c1 = 1520.0, g = 0.1;
    return c0 * (std::sin(launch) - std::sqrt(1.0 - std::pow(std::cos(launch) * c1 / c0, 2))) /
           (g * std::cos(launch));
  };
  const double along = out(radians(40.0) - 0.5 * width) - out(radians(40.0) + 0.5 * width);
  const double across = out(radians(40.0)) * width / std::cos(radians(40.0));
  const double sine = std::sqrt(1.0 - std::pow(std::cos(radians(40.0)) * 1520.0 / 1485.0, 2));
  EXPECT_NEAR(sum(echo.power, 0, 4000) / (along * across * sine * sine), 1.0, 2e-3);
}

TEST(Physics, InUniformWaterRefractionChangesNothing) {
  const WorldSnapshot world = world_of({flat(-30.0), ball(Vec3(2, 20, -25), 2.0, 30)}, {1.0, 0.5});
  SonarOptions options = side_scan_sonar();
  const Echo off = Sonar(options).echo(world, Water(), at(0, 0, -20));
  options.refraction = true;
  const Echo on = Sonar(options).echo(world, Water(), at(0, 0, -20));
  EXPECT_EQ(off.power, on.power);
  // A profile of one speed: to rounding.
  const Echo same = Sonar(options).echo(world, water_of({0, 100}, {1500, 1500}), at(0, 0, -20));
  for (std::size_t i = 0; i < off.power.size(); ++i)
    EXPECT_NEAR(same.power[i], off.power[i], 1e-6 * (off.power[i] + 1e-3)) << i;
}

TEST(Physics, BackscatterOfTheMaterialIsThatOfItsLaw) {
  WorldSnapshot world = world_of({flat(0.0)}, {1.0});
  auto materials = std::make_shared<std::vector<Material>>(*world.materials);
  materials->front().sediment = Sediment{};
  world.materials = materials;
  SonarOptions options;
  options.frequency = 30e3;
  options.range = 60.0;
  const Echo lambert = Sonar(options).echo(world, Water(), at(0, 0, 10));
  options.backscatter = BackscatterModel::kMaterial;
  const Echo sediment = Sonar(options).echo(world, Water(), at(0, 0, 10));
  for (std::size_t i = 300; i < 1400; i += 100) {
    const double cosine = 10.0 / ((static_cast<double>(i) + 0.5) * options.sample_length());
    const double exact = sediment_backscatter(Sediment{}, cosine, 30e3) / (cosine * cosine);
    EXPECT_NEAR(sediment.power[i] / lambert.power[i] / exact, 1.0, 5e-3) << i;
  }
  EXPECT_TRUE(sediment.notes.empty());
  options.frequency = 600e3;
  const Echo high = Sonar(options).echo(world, Water(), at(0, 0, 10));
  ASSERT_EQ(high.notes.size(), 1U);
  EXPECT_NE(high.notes[0].find("extrapolated"), std::string::npos);
}

/// A sonar that looks at several worlds by turns hears in each what one of its own would.
TEST(Physics, EachWorldHasTablesOfItsOwn) {
  SonarOptions options = pencil(radians(60.0), radians(1.0), 30.0);
  options.frequency = 30e3;
  options.backscatter = BackscatterModel::kMaterial;
  const Sonar shared(options);
  std::vector<WorldSnapshot> worlds;
  for (int i = 0; i < 6; ++i) {  // more than are kept
    WorldSnapshot world = world_of({flat(0.0)}, {1.0});
    auto materials = std::make_shared<std::vector<Material>>(*world.materials);
    materials->front().sediment = Sediment{};
    materials->front().sediment->spectral_strength *= i + 1;
    world.materials = materials;
    worlds.push_back(world);
  }
  for (int turn = 0; turn < 2; ++turn) {
    for (const WorldSnapshot& world : worlds) {
      EXPECT_EQ(shared.echo(world, Water(), at(0, 0, 10)).power,
                Sonar(options).echo(world, Water(), at(0, 0, 10)).power);
    }
  }
}

/// Sonar 20 m above the bottom, 10 m below the surface.
Echo echo_sounder_echo(int multiples, bool surface) {
  WorldSnapshot world = world_of({flat(-30.0)}, {0.1});
  SonarOptions options = pencil(radians(90.0), radians(0.2), 150.0);
  options.spreading = true;
  options.multiples = multiples;
  WaterOptions water;
  if (surface) water.surface = 0.0;
  return Sonar(options).echo(world, Water(water), at(0, 0, -10));
}

TEST(Physics, MultiplesComeAtTheirRangesWithTheirPower) {
  const double delta = 150.0 / 4000;
  const auto near = [&](const Echo& echo, double range) {
    return sum(echo.power, static_cast<std::size_t>(range / delta) - 3, 7);
  };
  const Echo echo = echo_sounder_echo(3, true);
  const double first = near(echo, 20.0);
  const double once = std::norm(reflection(Sediment{}, 1.0));
  // Off the bottom, scattered by the surface: 2 H + d. On to the bottom again: 3 H + 2 d.
  const double by_surface = once * once * surface_backscatter(1.0, 5.0) / 0.1;
  EXPECT_NEAR(near(echo, 50.0) / first / (by_surface * 20.0 * 20.0 / (50.0 * 50.0)), 1.0, 1e-2);
  EXPECT_NEAR(near(echo, 80.0) / first / (once * once * 20.0 * 20.0 / (80.0 * 80.0)), 1.0, 1e-2);
  const double third = std::pow(once, 4) * surface_backscatter(1.0, 5.0) / 0.1;
  EXPECT_NEAR(near(echo, 110.0) / first / (third * 20.0 * 20.0 / (110.0 * 110.0)), 1.0, 1e-2);
  EXPECT_NEAR(first + near(echo, 50.0) + near(echo, 80.0) + near(echo, 110.0),
              sum(echo.power, 0, 4000), 1e-12 * first);
  const std::size_t sample = static_cast<std::size_t>(50.0 / delta);
  EXPECT_EQ(echo.truth.material[sample], -2);
  EXPECT_NEAR(point_of(echo, sample).z(), 0.0, 1e-6);

  EXPECT_EQ(near(echo_sounder_echo(1, true), 80.0), 0.0);
  EXPECT_EQ(near(echo_sounder_echo(0, true), 50.0), 0.0);
  const Echo deep = echo_sounder_echo(3, false);  // no surface within reach
  EXPECT_DOUBLE_EQ(sum(deep.power, 0, 4000), near(deep, 20.0));
}

TEST(Physics, WhatLiesAboveTheSurfaceIsNotSeen) {
  const TriangleMesh wall =
      mesh_of({Vec3(-50, 30, -20), Vec3(50, 30, -20), Vec3(50, 30, 20), Vec3(-50, 30, 20)},
              {{0, 1, 2}, {0, 2, 3}});
  const WorldSnapshot world = world_of({wall}, {1.0});
  SonarOptions options = pencil(radians(-30.0), radians(1.0), 100.0);  // upwards
  WaterOptions water;
  EXPECT_GT(sum(Sonar(options).echo(world, Water(water), at(0, 0, -5)).power, 0, 4000), 0.0);
  water.surface = 0.0;
  EXPECT_EQ(sum(Sonar(options).echo(world, Water(water), at(0, 0, -5)).power, 0, 4000), 0.0);
  options.refraction = true;
  EXPECT_EQ(sum(Sonar(options)
                    .echo(world, water_of({0, 50, 100}, {1500, 1510, 1490}), at(0, 0, -5))
                    .power,
                0, 4000),
            0.0);
}

TEST(Physics, MotionShiftsTheRangeByTheWayBack) {
  const WorldSnapshot world = world_of({ball(Vec3(0, 500, 0), 0.5, 40)}, {1.0});
  SonarOptions options = pencil(0.0, 1e-3, 600.0);
  options.motion = true;
  const Sonar sonar(options);
  const double c = Water().sound_speed(0.0);
  for (const double speed : {-20.0, 5.0, 20.0}) {
    const Echo echo =
        sonar.echo(world, Water(), at(0, 0, 0), 0, 1, {Vec3(0, speed, 0), Vec3::Zero()});
    const double range = 499.5;  // there R, back R − v t
    const double time = 2.0 * range / (c + speed);
    const auto first = std::find_if(echo.power.begin(), echo.power.end(),
                                    [](double power) { return power > 0.0; });
    EXPECT_NEAR(static_cast<double>(first - echo.power.begin()) * options.sample_length(),
                0.5 * c * time, 1.5 * options.sample_length())
        << speed;
  }
}

TEST(Physics, MotionMovesAllOfARaysCell) {
  // One ray 5° off straight down, whose cell is cut off at the nearest place of the bottom.
  const WorldSnapshot world = world_of({flat(0.0, 4000.0)}, {1.0});
  SonarOptions options = pencil(radians(85.0), radians(10.0), 200.0);
  options.rays_across_beam = options.rays_along_fan = 1;
  options.samples = 20000;
  options.motion = true;
  const auto middle = [&](const Vec3& velocity) {
    const Echo echo =
        Sonar(options).echo(world, Water(), at(0, 0, 100), 0, 1, {velocity, Vec3::Zero()});
    double energy = 0.0, mean = 0.0;
    for (std::size_t i = 0; i < echo.power.size(); ++i) {
      energy += echo.power[i];
      mean += echo.power[i] * (static_cast<double>(i) + 0.5);
    }
    return mean / energy;
  };
  const double speed = 20.0, c = Water().sound_speed(100.0);
  const double towards = speed * std::cos(radians(5.0));
  EXPECT_NEAR(middle(Vec3(0, 0, -speed)) / middle(Vec3::Zero()),
              c * (c - towards) / (c * c - speed * speed), 1e-4);
}

TEST(Physics, ATurningBeamLosesWhatItNoLongerLooksAt) {
  const WorldSnapshot world = world_of({flat(0.0, 4000.0)}, {1.0});
  SonarOptions options;
  options.beams = 1;
  options.rays_across_beam = 200;
  options.rays_along_fan = 400;
  options.range = 200.0;
  const Echo still = Sonar(options).echo(world, Water(), at(0, 0, 20));
  options.motion = true;
  const double rate = 0.03;  // about z [rad/s]
  const Sonar sonar(options);
  const Echo turning =
      sonar.echo(world, Water(), at(0, 0, 20), 0, 0, {Vec3::Zero(), Vec3(0, 0, rate)});
  for (const double range : {60.0, 120.0, 180.0}) {
    const auto first = static_cast<std::size_t>(range / options.sample_length());
    // About z a ray that is `below` the horizontal turns by cos(below) of it about the array.
    const double turned =
        rate * 2.0 * range / turning.sound_speed * std::sqrt(1.0 - std::pow(20.0 / range, 2));
    EXPECT_NEAR(sum(turning.power, first, 20) / sum(still.power, first, 20),
                1.0 - turned / options.beam_width, 0.01)
        << range;
  }
  const Echo resting = sonar.echo(world, Water(), at(0, 0, 20));
  EXPECT_EQ(resting.power, still.power);
  options.motion = false;  // it counts where the switch is on
  const Echo off =
      Sonar(options).echo(world, Water(), at(0, 0, 20), 0, 0, {Vec3::Zero(), Vec3(0, 0, rate)});
  EXPECT_EQ(off.power, still.power);
}

TEST(Physics, ABeamThatTurnsAwayLosesATargetThatOneTurningTowardsItKeeps) {
  const double ahead = radians(0.2);  // within the beam of 0.6°, to the side of x
  const WorldSnapshot world =
      world_of({ball(200.0 * Vec3(std::sin(ahead), std::cos(ahead), 0), 0.1, 20)}, {1.0});
  SonarOptions options = pencil(0.0, radians(0.6), 220.0);
  options.rays_across_beam = options.rays_along_fan = 400;
  const auto energy = [&](const SonarOptions& sonar, double rate) {
    const VehicleMotion motion{Vec3::Zero(), Vec3(0, 0, rate)};
    const Echo echo = Sonar(sonar).echo(world, Water(), at(0, 0, 0), 0, 0, motion);
    return sum(echo.power, 0, echo.power.size());
  };
  const double still = energy(options, 0.0);
  ASSERT_GT(still, 0.0);
  options.motion = true;
  const double rate = radians(0.3) / (2.0 * 200.0 / 1490.0);  // 0.3° until it is back
  EXPECT_EQ(energy(options, rate), 0.0);                      // +z: from y towards −x
  EXPECT_NEAR(energy(options, -rate) / still, 1.0, 1e-12);
}

/// At next to no speed what is transmitted and what is received make what a beam at rest has.
TEST(Physics, TransmissionAndReceptionMakeTheBeam) {
  const WorldSnapshot world = world_of({flat(0.0)}, {1.0});
  const VehicleMotion creeping{Vec3(1e-9, 0, 0), Vec3(0, 0, 1e-12)};
  for (const BeamPattern pattern :
       {BeamPattern::kNone, BeamPattern::kUniform, BeamPattern::kHann, BeamPattern::kGaussian}) {
    for (SonarOptions options : {side_scan_sonar(), multibeam_sonar(), echo_sounder_sonar(),
                                 imaging_sonar(), scanning_sonar()}) {
      options.beam_pattern = pattern;
      options.beams = std::min(options.beams, 3);
      const Echo still = Sonar(options).echo(world, Water(), at(0, 0, 8));
      options.motion = true;
      const Echo moved = Sonar(options).echo(world, Water(), at(0, 0, 8), 0, 0, creeping);
      const double most = *std::max_element(still.power.begin(), still.power.end());
      ASSERT_GT(most, 0.0) << options.name;
      for (std::size_t i = 0; i < still.power.size(); ++i)
        ASSERT_NEAR(moved.power[i], still.power[i], 1e-4 * most) << options.name << " " << i;
    }
  }
}

TEST(Physics, AMultibeamReceivesOverAllAnglesAlongTheTrack) {
  const WorldSnapshot world = world_of({flat(0.0)}, {1.0});
  SonarOptions options = multibeam_sonar();
  options.beams = 1;
  options.beam_pattern = BeamPattern::kUniform;
  options.motion = true;
  const Sonar sonar(options);
  const VehicleMotion pitching{Vec3::Zero(), Vec3(0, 0.3, 0)};  // by 2.3° until it is back
  const Echo still = sonar.echo(world, Water(), at(0, 0, 50));
  const Echo moved = sonar.echo(world, Water(), at(0, 0, 50), 0, 0, pitching);
  EXPECT_NEAR(sum(moved.power, 0, 2000) / sum(still.power, 0, 2000), 1.0, 1e-3);
}

TEST(Physics, MotionOfATrajectoryIsThatOfItsStretch) {
  Pose turned = at(4, 2, 0);
  turned.linear() = Eigen::AngleAxisd(0.5, Vec3::UnitZ()).toRotationMatrix();
  const Trajectory track({1.0, 3.0, 4.0}, {at(0, 0, 0), turned, turned});
  const VehicleMotion first = motion_at(track, 1.0);
  EXPECT_TRUE(first.velocity.isApprox(Vec3(2, 1, 0)));
  EXPECT_TRUE(first.rate.isApprox(Vec3(0, 0, 0.25)));
  EXPECT_FALSE(motion_at(track, 3.5).moves());
  EXPECT_FALSE(motion_at(track, 0.5).moves());
  EXPECT_FALSE(motion_at(Trajectory(), 0.0).moves());
  const Trajectory straight({0.0, 1.0}, {at(0, 0, 0), at(3, 0, 0)});
  EXPECT_TRUE(motion_at(straight, 1.0).velocity.isApprox(Vec3(3, 0, 0)));  // at its end
}

TEST(Physics, AllOfItIsTheSameForAnyNumberOfThreads) {
  const WorldSnapshot world = world_of({flat(-40.0), ball(Vec3(3, 15, -32), 4.0, 40)}, {0.5, 1.0});
  const Sonar sonar(with_real_physics(side_scan_sonar()));
  const Water water = water_of({0, 10, 20, 50}, {1520, 1515, 1495, 1490});
  const VehicleMotion motion{Vec3(2, 0.1, 0), Vec3(0.01, 0.02, -0.03)};
  const Echo one = sonar.echo(world, water, at(0, 0, -25), 0, 1, motion);
  const Echo four = sonar.echo(world, water, at(0, 0, -25), 0, 4, motion);
  EXPECT_GT(sum(one.power, 0, one.power.size()), 0.0);
  EXPECT_EQ(one.power, four.power);
  EXPECT_EQ(one.truth.material, four.truth.material);
}

TEST(Physics, SaysThatAProfileEndsAboveTheBottom) {
  const WorldSnapshot world = world_of({flat(-60.0)}, {1.0});
  SonarOptions options = side_scan_sonar();
  options.refraction = true;
  const Water water = water_of({0, 30}, {1500, 1490});
  const Echo echo = Sonar(options).echo(world, water, at(0, 0, -20));
  ASSERT_EQ(echo.warnings.size(), 1U);
  EXPECT_NE(echo.warnings[0].find("30 m"), std::string::npos);
}

TEST(Physics, RefusesNonsense) {
  SonarOptions options;
  options.multiples = 9;
  EXPECT_THROW(Sonar{options}, std::invalid_argument);
  options.multiples = 0;
  options.wind_speed = -1.0;
  EXPECT_THROW(Sonar{options}, std::invalid_argument);
  const WorldSnapshot world = world_of({flat(0.0)}, {1.0});
  const VehicleMotion motion{Vec3(std::nan(""), 0, 0), Vec3::Zero()};
  EXPECT_THROW(Sonar().echo(world, Water(), at(0, 0, 10), 0, 0, motion), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
