// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/navigation/allan_deviation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "bathyal/navigation/sensor.hpp"

namespace bathyal {
namespace {

/// Samples of the first channel of a sensor whose truth is 0.
std::vector<double> samples(const SensorChannel& channel, double rate, int count) {
  SensorOptions options;
  options.name = "gyro";
  options.kind = SensorKind::rpm;
  options.rate = rate;
  options.channels[0] = channel;
  SensorState state;
  std::vector<double> values;
  for (int k = 0; k < count; ++k) {
    SensorTruth truth;
    truth.time = next_time(options, state);
    values.push_back(sample(options, state, truth, 3)->values[0]);
  }
  return values;
}

void expect_within(double got, double expected, double part) {
  EXPECT_NEAR(got, expected, part * expected);
}

TEST(AllanDeviation, WhiteNoiseFallsByTheRootOfTime) {
  const double density = 1e-3, rate = 100.0;
  const auto result =
      allan_deviation(samples({.noise = density * std::sqrt(rate)}, rate, 200000), rate);
  for (std::size_t i = 0; result.interval[i] < 5.0; ++i) {
    expect_within(result.deviation[i], density / std::sqrt(result.interval[i]), 0.05);
  }
}

TEST(AllanDeviation, RandomWalkRisesByTheRootOfTime) {
  const double walk = 1e-4, rate = 10.0;
  const auto result =
      allan_deviation(samples({.walk = walk}, rate, 1000000), rate, {64, 256, 1024});
  for (std::size_t i = 0; i < 3; ++i) {
    expect_within(result.deviation[i], walk * std::sqrt(result.interval[i] / 3.0), 0.05);
  }
}

/// IEEE Std 952-1997, C.1.5: of a Markov process of deviation s and correlation time T,
/// sigma²(t) = 2 s² T / t (1 − T / (2 t) (3 − 4 exp(−t / T) + exp(−2 t / T))).
TEST(AllanDeviation, DriftHasItsPlateau) {
  const double s = 2e-3, correlation = 5.0, rate = 10.0;
  const auto result = allan_deviation(
      samples({.markov = s, .markov_time = correlation}, rate, 1000000), rate, {20, 94, 200, 400});
  for (std::size_t i = 0; i < 4; ++i) {
    const double x = result.interval[i] / correlation;
    const double variance =
        2.0 * s * s / x * (1.0 - (3.0 - 4.0 * std::exp(-x) + std::exp(-2.0 * x)) / (2.0 * x));
    expect_within(result.deviation[i], std::sqrt(variance), 0.05);
  }
}

TEST(AllanDeviation, RefusesWhatHasNone) {
  EXPECT_THROW(allan_deviation({1.0, 2.0, 3.0}, 1.0), std::invalid_argument);
  EXPECT_THROW(allan_deviation({1.0, 2.0, std::nan(""), 1.0}, 1.0), std::invalid_argument);
  EXPECT_THROW(allan_deviation({1.0, 2.0, 3.0, 4.0}, 0.0), std::invalid_argument);
  EXPECT_THROW(allan_deviation({1.0, 2.0, 3.0, 4.0}, 1.0, {3}), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
