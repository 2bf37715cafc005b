// SPDX-License-Identifier: BSD-3-Clause
// The receiver on rows of known power: each step against its formula.
#include "bathyal/sonar/receiver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bathyal/sonar/echo.hpp"
#include "bathyal/sonar/presets.hpp"
#include "bathyal/water/ambient_noise.hpp"

namespace bathyal {
namespace {

constexpr double kSoundSpeed = 1500.0;

/// Samples of 1 cm, and nothing switched on.
SonarOptions bare(int samples) {
  SonarOptions options;
  options.samples = samples;
  options.range = 0.01 * samples;
  return options;
}

Echo echo_of(const SonarOptions& options, double power, Index beams = 2) {
  Echo echo;
  echo.beams = beams;
  echo.samples = options.samples;
  echo.power.assign(static_cast<std::size_t>(beams * echo.samples), power);
  echo.sound_speed = kSoundSpeed;
  return echo;
}

ReceiverKey key_at(double x, double time = 0.0, double turn = 0.0, std::uint64_t seed = 1) {
  Pose pose = Pose(Eigen::Translation3d(x, 0.0, 0.0));
  pose.rotate(Eigen::AngleAxisd(turn, Vec3::UnitZ()));
  return {seed, pose, time};
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Correlation of two rows, `lag` samples apart.
double correlation(const std::vector<double>& a, const std::vector<double>& b,
                   std::size_t lag = 0) {
  const double mean_a = mean(a), mean_b = mean(b);
  double both = 0.0, square_a = 0.0, square_b = 0.0;
  for (std::size_t i = 0; i + lag < a.size(); ++i) {
    const double one = a[i] - mean_a, other = b[i + lag] - mean_b;
    both += one * other;
    square_a += one * one;
    square_b += other * other;
  }
  return both / std::sqrt(square_a * square_b);
}

/// Standard deviation over mean.
double contrast(const std::vector<double>& values) {
  const double middle = mean(values);
  double square = 0.0;
  for (const double value : values) square += (value - middle) * (value - middle);
  return std::sqrt(square / static_cast<double>(values.size())) / middle;
}

std::vector<double> roots(std::vector<double> values) {
  for (double& value : values) value = std::sqrt(value);
  return values;
}

double decibels(double ratio) { return 10.0 * std::log10(ratio); }

TEST(Receiver, NothingIsChangedWhereNothingIsOn) {
  const SonarOptions options = bare(100);
  Echo echo = echo_of(options, 1.0);
  for (std::size_t i = 0; i < echo.power.size(); ++i) echo.power[i] = 0.1 * static_cast<double>(i);
  const Received received = receive(options, echo, key_at(0.0));
  EXPECT_EQ(received.intensity, echo.power);
  EXPECT_EQ(received.clipped, 0);
  EXPECT_FALSE(received.dropped);
}

/// Intensity is exponential: contrast 1, of the amplitude √(4/π − 1) = 0.5227.
TEST(Receiver, RayleighSpeckleHasAContrastOfOne) {
  SonarOptions options = bare(200'000);
  options.speckle = SpeckleModel::kRayleigh;
  const std::vector<double> got = receive(options, echo_of(options, 3e-5), key_at(0.0)).intensity;
  EXPECT_NEAR(mean(got) / 3e-5, 1.0, 0.01);
  EXPECT_NEAR(contrast(got), 1.0, 0.02);
  EXPECT_NEAR(contrast(roots(got)), std::sqrt(4.0 / std::numbers::pi - 1.0), 0.005);
  for (const double times : {0.1, 1.0, 3.0, 6.0}) {
    const auto above = std::count_if(got.begin(), got.end(),
                                     [times](double value) { return value > times * 3e-5; });
    const double part = static_cast<double>(above) / static_cast<double>(got.size());
    EXPECT_NEAR(part, std::exp(-times), 5.0 * std::sqrt(std::exp(-times) / 4e5)) << times;
  }
  for (const std::size_t lag : {1U, 2U, 7U}) EXPECT_NEAR(correlation(got, got, lag), 0.0, 0.01);
}

TEST(Receiver, KSpeckleHasTheContrastOfItsShape) {
  for (const double shape : {0.5, 1.0, 4.0, 50.0}) {
    SonarOptions options = bare(500'000);
    options.speckle = SpeckleModel::kK;
    options.speckle_shape = shape;
    const std::vector<double> got = receive(options, echo_of(options, 2.0), key_at(0.0)).intensity;
    EXPECT_NEAR(mean(got), 2.0, 0.02) << shape;
    const double expected = std::sqrt(1.0 + 2.0 / shape);
    EXPECT_NEAR(contrast(got), expected, 0.03 * expected) << shape;
  }
}

/// Of n samples, its correlation at a lag of k is (1 − k/n)², and 0 from n on.
TEST(Receiver, SpeckleIsAsLongAsThePulse) {
  SonarOptions options = bare(200'000);
  options.speckle = SpeckleModel::kRayleigh;
  options.pulse = PulseModel::kRectangle;
  options.pulse_length = 10.0 * options.sample_length() / (0.5 * kSoundSpeed);
  const std::vector<double> got = receive(options, echo_of(options, 1.0), key_at(0.0)).intensity;
  EXPECT_NEAR(mean(got), 1.0, 0.02);
  EXPECT_NEAR(contrast(got), 1.0, 0.02);
  for (const std::size_t lag : {1U, 3U, 5U, 8U, 10U, 15U}) {
    const double rest = std::max(0.0, 1.0 - 0.1 * static_cast<double>(lag));
    EXPECT_NEAR(correlation(got, got, lag), rest * rest, 0.02) << lag;
  }
}

TEST(Receiver, ARectangleSpreadsAPointOverItsLength) {
  SonarOptions options = bare(400);
  options.pulse = PulseModel::kRectangle;
  for (const double cells : {1.0, 7.0, 7.5, 40.0}) {
    options.pulse_length = cells * options.sample_length() / (0.5 * kSoundSpeed);
    Echo echo = echo_of(options, 0.0, 1);
    echo.power[100] = 4.0;
    const std::vector<double> got = receive(options, echo, key_at(0.0)).intensity;
    for (std::size_t i = 0; i < got.size(); ++i) {
      const double covered = std::clamp(cells - (static_cast<double>(i) - 100.0), 0.0, 1.0);
      EXPECT_NEAR(got[i], i < 100 ? 0.0 : 4.0 * covered / cells, 1e-12) << cells << " " << i;
    }
  }
}

/// Under a Hann window: 1.44 c / (2 B) wide at half power, side lobes at −31.5 dB.
TEST(Receiver, AChirpIsCompressedWithSideLobes) {
  SonarOptions options = bare(2000);
  options.pulse = PulseModel::kChirp;
  const double cells = 20.0;
  options.bandwidth = 0.5 * kSoundSpeed / (cells * options.sample_length());
  Echo echo = echo_of(options, 0.0, 1);
  echo.power[1000] = 1.0;
  const std::vector<double> got = receive(options, echo, key_at(0.0)).intensity;
  const double peak = got[1000];
  EXPECT_EQ(std::max_element(got.begin(), got.end()) - got.begin(), 1000);
  double sum = 0.0;
  for (const double value : got) sum += value;
  EXPECT_NEAR(sum, 1.0, 1e-12);
  const auto wide =
      std::count_if(got.begin(), got.end(), [peak](double value) { return value >= 0.5 * peak; });
  EXPECT_NEAR(static_cast<double>(wide), 1.44 * cells, 1.5);
  double highest = 0.0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    if (std::abs(static_cast<double>(i) - 1000.0) > 2.0 * cells) {
      highest = std::max(highest, got[i] / peak);
    }
  }
  EXPECT_NEAR(decibels(highest), -31.5, 0.1);
  for (std::size_t i = 1; i < 1000; ++i) EXPECT_NEAR(got[i], got[2000 - i], 1e-15);
}

TEST(Receiver, NoiseHasItsLevel) {
  SonarOptions options = bare(100'000);
  options.noise = true;
  options.noise_level = 45.0;
  options.source_level = 205.0;
  options.bandwidth = 10e3;
  const double directivity =
      decibels(4.0 * std::numbers::pi / (options.beam_width * options.fan_width));
  const double expected = 45.0 - 205.0 + 40.0 - directivity;
  const std::vector<double> got = receive(options, echo_of(options, 0.0), key_at(0.0)).intensity;
  EXPECT_NEAR(decibels(mean(got)), expected, 0.05);
  EXPECT_NEAR(contrast(got), 1.0, 0.02);
  EXPECT_NEAR(decibels(noise_intensity(options, kSoundSpeed)), expected, 1e-9);

  const double signal = 4.0 * mean(got);
  options.speckle = SpeckleModel::kRayleigh;
  const std::vector<double> both =
      receive(options, echo_of(options, signal), key_at(0.0)).intensity;
  EXPECT_NEAR(mean(both) / mean(got), 5.0, 0.05);
  EXPECT_NEAR(contrast(both), 1.0, 0.02);

  options.noise_level.reset();
  const double level = ambient_noise(options.frequency, {.wind_speed = options.wind_speed});
  EXPECT_NEAR(decibels(noise_intensity(options, kSoundSpeed)), expected + level - 45.0, 1e-9);
}

/// The ratio to a bottom that brings σ a metre: σ c τ / 2 over the noise of the band, after
/// compression σ c / (2 B) · τ over the spectral density.
TEST(Receiver, NoiseComparesWithAPulseAsItDoesInTheSea) {
  SonarOptions options = bare(1000);
  options.noise = true;
  const double density = noise_intensity(options, kSoundSpeed) / options.bandwidth;
  const double per_metre = 1.0;
  const double sample = per_metre * options.sample_length();
  options.pulse = PulseModel::kRectangle;
  options.pulse_length = 1e-3;
  EXPECT_NEAR(sample / noise_intensity(options, kSoundSpeed),
              per_metre * 0.75 / (density * options.bandwidth), 1e-12 / density);
  options.pulse = PulseModel::kChirp;
  EXPECT_NEAR(sample / noise_intensity(options, kSoundSpeed),
              per_metre * (0.5 * kSoundSpeed / options.bandwidth) * 1e-3 / density,
              1e-10 / density);
}

/// Turbulence, ships, wind and molecules: at 1 kHz, 5 m/s and shipping 0.5 the terms are
/// 17, 39.23, 60.92 and −15 dB.
TEST(Receiver, AmbientNoiseIsTheSumOfItsTerms) {
  const double wind = 50.0 + 7.5 * std::sqrt(5.0) - 40.0 * std::log10(1.4);
  const double ships = 40.0 - 60.0 * std::log10(1.03);
  const double sum = std::pow(10.0, 1.7) + std::pow(10.0, 0.1 * ships) +
                     std::pow(10.0, 0.1 * wind) + std::pow(10.0, -1.5);
  EXPECT_NEAR(ambient_noise(1000.0), decibels(sum), 1e-9);
  EXPECT_NEAR(ambient_noise(1e6), 45.0, 0.01);  // molecules alone
  EXPECT_GT(ambient_noise(1e4, {.wind_speed = 15.0}), ambient_noise(1e4) + 5.0);
  EXPECT_THROW(ambient_noise(0.0), std::invalid_argument);
  EXPECT_THROW(ambient_noise(1e3, {.wind_speed = -1.0}), std::invalid_argument);
  EXPECT_THROW(ambient_noise(1e3, {.shipping = std::nan("")}), std::invalid_argument);
}

TEST(Receiver, SpeckleBelongsToThePlaceAndNoiseToTheTime) {
  SonarOptions options = bare(20'000);
  options.speckle = SpeckleModel::kRayleigh;
  const Echo echo = echo_of(options, 1.0);
  const std::vector<double> rest = receive(options, echo, key_at(0.0)).intensity;
  const double wave = options.wavelength(kSoundSpeed);
  EXPECT_EQ(receive(options, echo, key_at(0.0, 9.0)).intensity, rest);
  EXPECT_EQ(receive(options, echo, key_at(0.05 * wave, 1.0)).intensity, rest);
  for (const ReceiverKey& other :
       {key_at(0.5 * wave), key_at(1.0), key_at(0.0, 0.0, 0.5 * options.beam_width),
        key_at(0.0, 0.0, 0.0, 2)}) {
    EXPECT_NEAR(correlation(receive(options, echo, other).intensity, rest), 0.0, 0.03);
  }
  options.speckle = SpeckleModel::kNone;
  options.noise = true;
  const std::vector<double> calm = receive(options, echo, key_at(0.0, 1.0)).intensity;
  EXPECT_EQ(receive(options, echo, key_at(5.0, 1.0)).intensity, calm);
  EXPECT_NE(receive(options, echo, key_at(0.0, 1.5)).intensity, calm);
  EXPECT_NE(receive(options, echo, key_at(0.0, 1.0, 0.0, 2)).intensity, calm);
}

/// A sample keeps its numbers whatever the others hold, and rows differ.
TEST(Receiver, SamplesDrawNumbersOfTheirOwn) {
  SonarOptions options = bare(1000);
  options.speckle = SpeckleModel::kK;
  Echo echo = echo_of(options, 1.0);
  const std::vector<double> all = receive(options, echo, key_at(0.0)).intensity;
  for (std::size_t i = 0; i < 700; ++i) echo.power[i] = 0.0;
  const std::vector<double> part = receive(options, echo, key_at(0.0)).intensity;
  EXPECT_EQ(part[0], 0.0);
  EXPECT_TRUE(std::equal(all.begin() + 700, all.end(), part.begin() + 700));
  EXPECT_FALSE(std::equal(all.begin(), all.begin() + 1000, all.begin() + 1000));
}

TEST(Receiver, GainFollowsItsLaw) {
  SonarOptions options = bare(500);
  options.tvg = true;
  options.tvg_spreading = 30.0;
  options.tvg_absorption = 0.04;
  options.tvg_offset = -7.0;
  const std::vector<double> got = receive(options, echo_of(options, 0.5), key_at(0.0)).intensity;
  for (const std::size_t i : {0U, 99U, 499U}) {
    const double range = (static_cast<double>(i) + 0.5) * options.sample_length();
    EXPECT_NEAR(decibels(got[i] / 0.5), 30.0 * std::log10(range) + 0.08 * range - 7.0, 1e-9);
  }
}

/// Steps are even in amplitude; what is above full scale is counted.
TEST(Receiver, TheConverterHasItsSteps) {
  SonarOptions options = bare(2001);
  options.bits = 8;
  options.full_scale = -20.0;
  Echo echo = echo_of(options, 0.0, 1);
  const double full = 0.1;  // amplitude
  std::int64_t above = 0;
  for (std::size_t i = 0; i < echo.power.size(); ++i) {
    const double amplitude = 1.2 * full * static_cast<double>(i) / 2000.0;
    echo.power[i] = amplitude * amplitude;
    if (amplitude >= full * 254.5 / 255.0) ++above;
  }
  const Received got = receive(options, echo, key_at(0.0));
  EXPECT_EQ(got.clipped, above);
  for (std::size_t i = 0; i < echo.power.size(); ++i) {
    const double steps = std::sqrt(got.intensity[i]) / full * 255.0;
    EXPECT_NEAR(steps, std::round(steps), 1e-9);
    EXPECT_LE(steps, 255.0 + 1e-9);
    if (std::sqrt(echo.power[i]) < full) {
      EXPECT_NEAR(steps, std::sqrt(echo.power[i]) / full * 255.0, 0.5 + 1e-9);
    }
  }
  echo.power.assign(echo.power.size(), 1.0);
  EXPECT_EQ(receive(options, echo, key_at(0.0)).clipped, 2001);
}

TEST(Receiver, DropoutsComeAtTheirRates) {
  SonarOptions options = bare(3);
  options.dropout_rate = 0.2;
  options.beam_dropout_rate = 0.1;
  options.noise = true;
  const Echo echo = echo_of(options, 1.0, 10);
  int dropped = 0, rows = 0;
  const int pings = 4000;
  for (int ping = 0; ping < pings; ++ping) {
    const Received got = receive(options, echo, key_at(0.0, 0.1 * ping));
    if (got.dropped) {
      ++dropped;
      EXPECT_EQ(mean(got.intensity), 0.0);
      continue;
    }
    for (std::size_t beam = 0; beam < 10; ++beam) rows += got.intensity[3 * beam] == 0.0 ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(dropped) / pings, 0.2, 0.025);
  EXPECT_NEAR(rows / (10.0 * (pings - dropped)), 0.1, 0.01);
  options.dropout_rate = 1.0;
  EXPECT_TRUE(receive(options, echo, key_at(0.0)).dropped);
}

TEST(Receiver, ThreadsChangeNoByte) {
  SonarOptions options = with_real_physics(multibeam_sonar());
  options.speckle = SpeckleModel::kK;
  const Echo echo = echo_of(options, 1e-9, 64);
  const Received one = receive(options, echo, key_at(0.0), 1);
  for (const int threads : {2, 8}) {
    const Received many = receive(options, echo, key_at(0.0), threads);
    EXPECT_EQ(many.intensity, one.intensity);
    EXPECT_EQ(many.clipped, one.clipped);
  }
}

TEST(Receiver, OptionsOutOfRangeAreRefused) {
  const auto refused = [](auto change) {
    ReceiverOptions options;
    change(options);
    EXPECT_THROW(options.check(), std::invalid_argument);
  };
  refused([](ReceiverOptions& o) { o.speckle_shape = 0.0; });
  refused([](ReceiverOptions& o) { o.noise_level = std::nan(""); });
  refused([](ReceiverOptions& o) { o.tvg_spreading = -1.0; });
  refused([](ReceiverOptions& o) { o.tvg_absorption = std::nan(""); });
  refused([](ReceiverOptions& o) { o.tvg_offset = 1e9; });
  refused([](ReceiverOptions& o) { o.dropout_rate = 1.5; });
  refused([](ReceiverOptions& o) { o.beam_dropout_rate = -0.1; });
  refused([](ReceiverOptions& o) { o.bits = 33; });
  refused([](ReceiverOptions& o) { o.full_scale = std::nan(""); });
  EXPECT_NO_THROW(ReceiverOptions{}.check());
}

}  // namespace
}  // namespace bathyal
