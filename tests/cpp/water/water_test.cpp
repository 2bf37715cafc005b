// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/water/water.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace bathyal {
namespace {

WaterProfile two_rows() {
  WaterProfile profile;
  profile.depth = {0.0, 100.0};
  profile.temperature = {16.0, 8.0};
  profile.salinity = {34.0, 35.0};
  return profile;
}

TEST(Water, UniformWithoutASurface) {
  const Water water;
  EXPECT_FALSE(water.surface());
  EXPECT_EQ(water.depth(1e3), 50.0);
  EXPECT_EQ(water.sound_speed(10.0), water.sound_speed(-4000.0));
  EXPECT_EQ(water.sound_speed(0.0),
            sound_speed(SoundSpeedFormula::kMackenzie, 10.0, 35.0, {.depth = 50.0}));
  EXPECT_NEAR(water.absorption(100e3, 0.0), 33.4, 0.1);
  EXPECT_TRUE(water.covers(1e4));
  EXPECT_FALSE(water.varies());
  EXPECT_EQ(water.current({1, 2, 3}, 4.0), Vec3::Zero());
  EXPECT_EQ(water.speed_profile().depth().size(), 1U);
  EXPECT_THROW(water.surface_height(0, 0, 0), std::invalid_argument);
}

TEST(Water, ByDepth) {
  const Water water({.surface = 2.0, .profiles = {two_rows()}});
  EXPECT_EQ(water.temperature(2.0), 16.0);
  EXPECT_DOUBLE_EQ(water.temperature(-48.0), 12.0);
  EXPECT_EQ(water.temperature(-500.0), 8.0);
  EXPECT_DOUBLE_EQ(water.salinity(-48.0), 34.5);
  EXPECT_EQ(water.sound_speed(2.0),
            sound_speed(SoundSpeedFormula::kMackenzie, 16.0, 34.0, {.depth = 0.0}));
  EXPECT_GT(water.density(-98.0), water.density(2.0));
  EXPECT_TRUE(water.covers(100.0));
  EXPECT_FALSE(water.covers(100.1));
  EXPECT_THROW((void)water.sound_speed(2.1), std::invalid_argument);
  EXPECT_THROW((void)water.sound_speed(NAN), std::invalid_argument);
}

TEST(Water, ProfilesByTime) {
  WaterProfile later = two_rows();
  later.temperature = {20.0, 10.0};
  const Water water({.surface = 0.0, .profiles = {two_rows(), later}, .time = {100.0, 200.0}});
  EXPECT_EQ(water.temperature(0.0, 0.0), 16.0);
  EXPECT_DOUBLE_EQ(water.temperature(0.0, 150.0), 18.0);
  EXPECT_EQ(water.temperature(0.0, 1e9), 20.0);
  const SpeedProfile between = water.speed_profile(150.0);
  EXPECT_DOUBLE_EQ(between.speed(30.0), water.sound_speed(-30.0, 150.0));
}

TEST(Water, WithoutASurfaceTheProfileIsReadAtOneDepth) {
  const Water water({.reference_depth = 50.0, .profiles = {two_rows()}});
  EXPECT_DOUBLE_EQ(water.temperature(1000.0), 12.0);
  EXPECT_FALSE(water.varies());
  EXPECT_EQ(water.speed_profile().speed(0.0), water.sound_speed(0.0));
}

TEST(Water, Refusals) {
  const auto refused = [](const WaterProfile& profile) {
    EXPECT_THROW(Water({.surface = 0.0, .profiles = {profile}}), std::invalid_argument);
  };
  WaterProfile p = two_rows();
  p.depth = {10.0};
  p.temperature = {10.0};
  p.salinity = {35.0};
  refused(p);  // one row
  p = two_rows();
  p.depth = {100.0, 0.0};
  refused(p);
  p.depth = {5.0, 5.0};
  refused(p);
  p = two_rows();
  p.salinity[1] = NAN;
  refused(p);
  p.salinity = {35.0};
  refused(p);
  p.salinity = {};
  refused(p);  // nothing to compute the sound speed from
  p = two_rows();
  p.depth[0] = -1.0;
  refused(p);
  p = two_rows();
  p.temperature[0] = std::numeric_limits<double>::infinity();
  refused(p);
  EXPECT_THROW(Water({.profiles = {two_rows(), two_rows()}}), std::invalid_argument);
  EXPECT_THROW(Water({.profiles = {two_rows(), two_rows()}, .time = {2.0, 1.0}}),
               std::invalid_argument);
  EXPECT_THROW(Water({.waves = Waves(SeaState{})}), std::invalid_argument);
  EXPECT_THROW(Water({.surface = NAN}), std::invalid_argument);
  EXPECT_THROW(Water({.temperature = 400.0}), std::invalid_argument);
  EXPECT_THROW((void)Water().absorption(-1.0, 0.0), std::invalid_argument);
}

TEST(Water, CleanProfileKeepsTheWayDown) {
  WaterProfile cast;
  cast.depth = {-0.2, 0.5, 0.4, 1.0, 1.0, 2.0, NAN, 3.0, 2.5, 1.0};
  cast.temperature = {99, 10, 11, 12, 14, 15, 16, 17, 18, 19};
  cast.sound_speed = {0, 1500, 1500, 1500, 1500, NAN, 1500, 1500, 1500, 1500};
  const WaterProfile clean = clean_profile(cast);
  EXPECT_EQ(clean.depth, (std::vector<double>{0.5, 1.0, 3.0}));
  EXPECT_EQ(clean.temperature, (std::vector<double>{10, 13, 17}));
  EXPECT_TRUE(clean.salinity.empty());
  const WaterProfile layers = clean_profile(cast, {.step = 2.0});
  EXPECT_EQ(layers.depth.size(), 2U);
  EXPECT_DOUBLE_EQ(layers.temperature[0], 12.0);
  cast.sound_speed.assign(10, NAN);  // a column without a number does not count
  EXPECT_EQ(clean_profile(cast).depth.size(), 4U);
  cast.depth.assign(10, 1.0);
  EXPECT_THROW(clean_profile(cast), std::invalid_argument);
}

TEST(Water, CurrentByDepthAndTime) {
  const Current current({0.0, 10.0}, {{1, 0}, {0, 0}, {0, 2}, {0, 0}}, {0.0, 100.0});
  const Water water({.surface = 0.0, .current = current});
  EXPECT_TRUE(water.current({0, 0, -5}, 0.0).isApprox(Vec3(0.5, 0, 0)));
  EXPECT_TRUE(water.current({9, 9, -5}, 50.0).isApprox(Vec3(0.25, 0.5, 0)));
  EXPECT_TRUE(water.current({0, 0, -50}, 1e6).isZero());
  EXPECT_TRUE(
      Water({.current = Current(0.3, -0.4)}).current({0, 0, 7}).isApprox(Vec3(0.3, -0.4, 0)));
  EXPECT_THROW(Current({0.0, 0.0}, {{1, 0}, {0, 0}}), std::invalid_argument);
  EXPECT_THROW(Current({0.0, 1.0}, {{1, 0}}), std::invalid_argument);
  EXPECT_THROW(Current(NAN, 0.0), std::invalid_argument);
}

TEST(Water, TideByConstituentsAndTable) {
  const Tide m2(std::vector<TideConstituent>{{.amplitude = 1.5, .rate = tide_rate("M2")}});
  EXPECT_DOUBLE_EQ(m2.height(0.0), 1.5);
  EXPECT_NEAR(m2.height(12.4206012 * 3600.0), 1.5, 1e-6);  // its period
  EXPECT_NEAR(m2.height(0.25 * 12.4206012 * 3600.0), 0.0, 1e-6);
  EXPECT_NEAR(m2.rate(1e4), (m2.height(1e4 + 1) - m2.height(1e4 - 1)) / 2, 1e-8);
  const Tide table({0.0, 10.0}, {0.0, 2.0});
  EXPECT_DOUBLE_EQ(table.height(2.5), 0.5);
  EXPECT_EQ(table.height(99.0), 2.0);
  const Water water({.surface = -1.0, .tide = table});
  EXPECT_DOUBLE_EQ(water.surface_height(0, 0, 5.0), 0.0);
  EXPECT_EQ(water.depth(0.5), 0.0);  // under high water, above the mean surface
  EXPECT_THROW((void)water.depth(1.5), std::invalid_argument);
  EXPECT_THROW(tide_rate("M3x"), std::invalid_argument);
  EXPECT_THROW(Tide({1.0, 0.0}, {0.0, 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
