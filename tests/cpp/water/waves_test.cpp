// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/water/waves.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "bathyal/water/water.hpp"

namespace bathyal {
namespace {

TEST(Waves, DispersionInAnyDepth) {
  for (const double depth : {0.5, 5.0, 40.0, 1e4, std::numeric_limits<double>::infinity()}) {
    for (const double omega : {0.2, 0.8, 3.0}) {
      const double k = wave_number(omega, depth);
      const double back = std::isinf(depth) ? 1.0 : std::tanh(k * depth);
      EXPECT_NEAR(9.80665 * k * back, omega * omega, 1e-10 * omega * omega) << depth << omega;
    }
  }
}

TEST(Waves, RegularWaveInDeepWater) {
  const Waves waves = Waves::regular(2.0, 10.0);
  const double k = waves.components()[0].number.x();
  EXPECT_DOUBLE_EQ(waves.elevation(0, 0, 0), 1.0);
  EXPECT_NEAR(waves.elevation(0, 55.0, 10.0), 1.0, 1e-12);
  EXPECT_NEAR(waves.elevation(std::numbers::pi / k, 0, 0), -1.0, 1e-12);
  // At the crest the water goes with the wave at a ω; half a wave length down e^(−π) of it.
  const double speed = 1.0 * 2.0 * std::numbers::pi / 10.0;
  EXPECT_NEAR(waves.motion({0, 0, 1.0}, 0.0).velocity.x(), speed, 1e-12);
  EXPECT_NEAR(waves.motion({0, 0, 1.0 - std::numbers::pi / k}, 0.0).velocity.x(),
              speed * std::exp(-std::numbers::pi), 1e-12);
  EXPECT_TRUE(waves.motion({0, 0, 1.01}, 0.0).velocity.isZero());  // in the air
}

TEST(Waves, OrbitsMeetTheSurfaceAndTheBottom) {
  const Waves waves = Waves::regular(0.8, 6.0, 0.7, 8.0, 0.3);
  for (const double t : {0.0, 1.7, 3.1}) {
    const double eta = waves.elevation(3.0, -2.0, t);
    // Wheeler: at the actual surface the linear value of z = 0, where w = ∂η/∂t.
    EXPECT_NEAR(waves.motion({3.0, -2.0, eta}, t).velocity.z(), waves.elevation_rate(3.0, -2.0, t),
                1e-12);
    EXPECT_NEAR(waves.motion({3.0, -2.0, -8.0}, t).velocity.z(), 0.0, 1e-15);
    const auto before = waves.motion({3, -2, -4}, t - 1e-4).velocity;
    const auto after = waves.motion({3, -2, -4}, t + 1e-4).velocity;
    const auto at = waves.motion({3, -2, -4}, t).acceleration;
    EXPECT_NEAR(((after - before) / 2e-4 - at).norm(), 0.0, 1e-6 * at.norm());
  }
}

TEST(Waves, SeaStateHasItsHeightAndPeriod) {
  const Waves waves(SeaState{.height = 2.0, .period = 7.0, .seed = 5});
  double variance = 0.0;
  const int count = 40000;
  for (int i = 0; i < count; ++i) variance += std::pow(waves.elevation(1.0, 2.0, 0.53 * i), 2);
  EXPECT_NEAR(4.0 * std::sqrt(variance / count), 2.0, 0.02);
  double energy = 0.0;
  double largest = 0.0;
  double peak = 0.0;
  for (const WaveComponent& c : waves.components()) {
    energy += 0.5 * c.amplitude * c.amplitude;
    if (c.amplitude > largest) {
      largest = c.amplitude;
      peak = c.frequency;
    }
  }
  EXPECT_NEAR(energy, 0.25, 1e-12);
  EXPECT_NEAR(2.0 * std::numbers::pi / peak, 7.0, 0.2);
}

TEST(Waves, MeanPeriodOfPiersonAndMoskowitz) {
  // Of the whole spectrum T_z = 0.710 T_p; cut off at 4 peaks a little more.
  const Waves waves(SeaState{.peak_enhancement = 1.0, .components = 5000});
  double m0 = 0.0;
  double m2 = 0.0;
  for (const WaveComponent& c : waves.components()) {
    m0 += c.amplitude * c.amplitude;
    m2 += c.amplitude * c.amplitude * c.frequency * c.frequency;
  }
  EXPECT_NEAR(2.0 * std::numbers::pi * std::sqrt(m0 / m2) / 8.0, 0.710, 0.03);
}

TEST(Waves, SameSeedSameSea) {
  const Waves a(SeaState{.seed = 3});
  const Waves b(SeaState{.seed = 3});
  const Waves c(SeaState{.seed = 4});
  EXPECT_EQ(a.elevation(1, 2, 3), b.elevation(1, 2, 3));
  EXPECT_NE(a.elevation(1, 2, 3), c.elevation(1, 2, 3));
  const double infinite = std::numeric_limits<double>::infinity();
  const Waves crested(SeaState{.direction = 1.0, .spreading = infinite});
  for (const WaveComponent& w : crested.components()) {
    EXPECT_NEAR(std::atan2(w.number.y(), w.number.x()), 1.0, 1e-12);
  }
}

TEST(Waves, InWaterWithTideAndCurrent) {
  WaterOptions options;
  options.surface = 10.0;
  options.current = Current(0.5, 0.0);
  options.waves = Waves::regular(1.0, 8.0);
  options.tide = Tide({0.0, 1.0}, {2.0, 2.0});
  const Water water(options);
  EXPECT_DOUBLE_EQ(water.surface_height(0, 0, 0), 12.5);
  EXPECT_NEAR(water.motion({0, 0, 12.5}).velocity.x(), 0.5 + 0.5 * 2 * std::numbers::pi / 8, 1e-12);
  EXPECT_TRUE(water.motion({0, 0, 12.6}).velocity.isZero());
}

TEST(Waves, Refusals) {
  EXPECT_THROW(Waves(SeaState{.height = -1.0}), std::invalid_argument);
  EXPECT_THROW(Waves(SeaState{.period = NAN}), std::invalid_argument);
  EXPECT_THROW(Waves(SeaState{.components = 0}), std::invalid_argument);
  EXPECT_THROW(Waves(SeaState{.depth = 0.0}), std::invalid_argument);
  EXPECT_THROW(Waves::regular(1.0, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
