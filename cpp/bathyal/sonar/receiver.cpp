// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/receiver.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>

#include "bathyal/base/check.hpp"
#include "bathyal/base/random.hpp"
#include "bathyal/sonar/echo.hpp"
#include "bathyal/sonar/internal/pulse.hpp"

namespace bathyal {
namespace sonar {
namespace {

using Amplitude = std::complex<double>;

enum Purpose : std::uint64_t { kSpeckle = 1, kNoise, kDropout };

/// One number of several, by the mixing of SplitMix64.
class Key {
 public:
  Key(std::uint64_t seed, Purpose purpose) : value_(RandomStream(seed, purpose).next()) {}

  Key& with(std::uint64_t number) {
    value_ = RandomStream(value_, number).next();
    return *this;
  }
  Key& with(double number, double cell) {
    return with(static_cast<std::uint64_t>(std::llround(number / cell)));
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_;
};

std::uint64_t place_key(const SonarOptions& options, double sound_speed, const ReceiverKey& key) {
  Key made(key.seed, kSpeckle);
  const Vec3 place = key.world_from_sonar.translation();
  const Eigen::Matrix3d turn = key.world_from_sonar.linear();
  for (int axis = 0; axis < 3; ++axis) {
    made.with(place[axis], 0.25 * options.wavelength(sound_speed));
  }
  for (int column = 0; column < 2; ++column) {
    for (int axis = 0; axis < 3; ++axis) made.with(turn(axis, column), 0.125 * options.beam_width);
  }
  return made.value();
}

std::uint64_t time_key(Purpose purpose, const ReceiverKey& key) {
  return Key(key.seed, purpose).with(std::bit_cast<std::uint64_t>(key.time + 0.0)).value();
}

/// A circular complex normal number with a mean power of 1.
Amplitude circular(RandomStream& random) {
  const double radius = std::sqrt(-std::log(1.0 - random.uniform()));
  return std::polar(radius, 2.0 * std::numbers::pi * random.uniform());
}

/// Gamma of a mean of 1 (Marsaglia, Tsang 2000).
double texture(RandomStream& random, double shape) {
  const double boosted = shape < 1.0 ? shape + 1.0 : shape;
  const double d = boosted - 1.0 / 3.0;
  const double c = 1.0 / std::sqrt(9.0 * d);
  double value = 0.0;
  while (value == 0.0) {
    const double x = random.normal();
    const double v = std::pow(1.0 + c * x, 3);
    if (v <= 0.0) continue;
    if (std::log(1.0 - random.uniform()) < 0.5 * x * x + d - d * v + d * std::log(v)) value = d * v;
  }
  if (shape < 1.0) value *= std::pow(1.0 - random.uniform(), 1.0 / shape);
  return value / shape;
}

/// What arrives from each sample's range, as an amplitude.
std::vector<Amplitude> scattered(const SonarOptions& options, const double* power,
                                 std::size_t samples, RandomStream random) {
  std::vector<Amplitude> amplitude(samples);
  for (std::size_t i = 0; i < samples; ++i) {
    if (options.speckle == SpeckleModel::kNone) {
      amplitude[i] = std::sqrt(power[i]);
      continue;
    }
    const Amplitude drawn = circular(random);  // of every sample, so that each keeps its own
    const double patch =
        options.speckle == SpeckleModel::kK ? texture(random, options.speckle_shape) : 1.0;
    amplitude[i] = std::sqrt(power[i] * patch) * drawn;
  }
  return amplitude;
}

/// Filtered by the pulse: without speckle powers add, for there are no phases.
std::vector<Amplitude> through_pulse(const Pulse& pulse, const SonarOptions& options,
                                     const std::vector<Amplitude>& from) {
  if (pulse.shape.size() == 1) return from;
  const auto samples = static_cast<std::ptrdiff_t>(from.size());
  const bool phases = options.speckle != SpeckleModel::kNone;
  std::vector<Amplitude> to(from.size());
  for (std::ptrdiff_t i = 0; i < samples; ++i) {
    Amplitude sum = 0.0;
    for (std::size_t k = 0; k < pulse.shape.size(); ++k) {
      const std::ptrdiff_t at = i - static_cast<std::ptrdiff_t>(k) - pulse.first;
      if (at < 0 || at >= samples) continue;
      const Amplitude& one = from[static_cast<std::size_t>(at)];
      sum += phases ? pulse.shape[k] * one : pulse.shape[k] * pulse.shape[k] * std::norm(one);
    }
    to[static_cast<std::size_t>(i)] = phases ? sum : std::sqrt(sum.real());
  }
  return to;
}

/// Of the sea in the receiver's band, over the power transmitted at 1 m.
double noise_power(const SonarOptions& options) {
  const double directivity = 4.0 * std::numbers::pi / (options.beam_width * options.fan_width);
  return std::pow(10.0, 0.1 * (options.noise_level - options.source_level)) * options.bandwidth /
         std::max(1.0, directivity);
}

double gain(const SonarOptions& options, double range) {
  if (!options.tvg) return 1.0;
  return std::pow(10.0, 0.1 * (options.tvg_spreading * std::log10(range) +
                               options.tvg_absorption * 2.0 * range));
}

/// Intensity after the steps of the amplitude's converter.
double quantised(const SonarOptions& options, double intensity, std::int64_t& clipped) {
  if (options.bits == 0) return intensity;
  const double full = std::pow(10.0, 0.1 * options.full_scale);
  const double levels = std::exp2(options.bits) - 1.0;
  const double level = std::round(std::sqrt(intensity / full) * levels);
  if (level >= levels) ++clipped;
  const double kept = std::min(level, levels) / levels;
  return kept * kept * full;
}

}  // namespace
}  // namespace sonar

void ReceiverOptions::check() const {
  check_range("speckle_shape", speckle_shape, 0.1, 1000.0);
  check_finite("noise_level", noise_level);
  check_range("dropout_rate", dropout_rate, 0.0, 1.0);
  check_range("tvg_spreading", tvg_spreading, 0.0, 100.0);
  check_range("tvg_absorption", tvg_absorption, 0.0, 10.0);
  check_range("bits", bits, 0, 32);
  check_range("full_scale", full_scale, -300.0, 300.0);
}

Received receive(const SonarOptions& options, const Echo& echo, const ReceiverKey& key) {
  const auto samples = static_cast<std::size_t>(echo.samples);
  Received received;
  received.intensity.assign(echo.power.size(), 0.0);
  received.dropped =
      RandomStream(sonar::time_key(sonar::kDropout, key)).uniform() < options.dropout_rate;
  if (received.dropped) return received;

  const sonar::Pulse pulse = sonar::pulse_of(options, echo.sound_speed);
  const std::uint64_t place = sonar::place_key(options, echo.sound_speed, key);
  const std::uint64_t moment = sonar::time_key(sonar::kNoise, key);
  const double noise = options.noise ? std::sqrt(sonar::noise_power(options)) : 0.0;
  std::vector<double> gains(samples);
  for (std::size_t i = 0; i < samples; ++i) {
    gains[i] = sonar::gain(options, (static_cast<double>(i) + 0.5) * options.sample_length());
  }
  const bool phases =
      options.noise || options.speckle != SpeckleModel::kNone || pulse.shape.size() > 1;
  for (std::size_t beam = 0; beam < static_cast<std::size_t>(echo.beams); ++beam) {
    const double* power = echo.power.data() + beam * samples;
    double* row = received.intensity.data() + beam * samples;
    if (!phases) {
      for (std::size_t i = 0; i < samples; ++i) {
        row[i] = sonar::quantised(options, gains[i] * power[i], received.clipped);
      }
      continue;
    }
    const std::vector<sonar::Amplitude> heard = sonar::through_pulse(
        pulse, options, sonar::scattered(options, power, samples, RandomStream(place, beam)));
    RandomStream random(moment, beam);
    for (std::size_t i = 0; i < samples; ++i) {
      sonar::Amplitude amplitude = heard[i];
      if (options.noise) amplitude += noise * sonar::circular(random);
      row[i] = sonar::quantised(options, gains[i] * std::norm(amplitude), received.clipped);
    }
  }
  return received;
}

}  // namespace bathyal
