// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/receiver.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "bathyal/base/check.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/base/random.hpp"
#include "bathyal/sonar/echo.hpp"
#include "bathyal/sonar/internal/speckle.hpp"
#include "bathyal/water/ambient_noise.hpp"

namespace bathyal {
namespace sonar {
namespace {

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

double linear(double decibels) { return std::pow(10.0, 0.1 * decibels); }

/// The gain of each sample.
std::vector<double> gains_of(const SonarOptions& options) {
  std::vector<double> gains(static_cast<std::size_t>(options.samples), 1.0);
  if (!options.tvg) return gains;
  for (std::size_t i = 0; i < gains.size(); ++i) {
    const double range = (static_cast<double>(i) + 0.5) * options.sample_length();
    gains[i] = linear(options.tvg_spreading * std::log10(range) +
                      options.tvg_absorption * 2.0 * range + options.tvg_offset);
  }
  return gains;
}

/// Steps of the amplitude's converter.
class Converter {
 public:
  explicit Converter(const SonarOptions& options)
      : on_(options.bits > 0),
        full_(linear(options.full_scale)),
        levels_(std::exp2(options.bits) - 1.0) {}

  double operator()(double intensity, std::int64_t& clipped) const {
    if (!on_) return intensity;
    const double level = std::sqrt(intensity / full_) * levels_;
    if (level < levels_ - 0.5) {
      const auto step = static_cast<double>(static_cast<std::int64_t>(level + 0.5));
      return step * step * (full_ / (levels_ * levels_));
    }
    ++clipped;
    return full_;
  }

 private:
  bool on_;
  double full_;    ///< intensity
  double levels_;  ///< above 0
};

/// What all rows of a ping have in common.
struct Chain {
  const SonarOptions& options;
  Pulse pulse;
  std::vector<double> energy;  ///< of the pulse, by sample
  std::vector<double> gains;
  double noise = 0.0;  ///< amplitude
  Converter converter;
  std::uint64_t place = 0;
  std::uint64_t moment = 0;

  Chain(const SonarOptions& sonar, double sound_speed, const ReceiverKey& key)
      : options(sonar),
        pulse(pulse_of(sonar, sound_speed)),
        gains(gains_of(sonar)),
        noise(sonar.noise ? std::sqrt(noise_intensity(sonar, sound_speed)) : 0.0),
        converter(sonar),
        place(place_key(sonar, sound_speed, key)),
        moment(time_key(kNoise, key)) {
    for (const double value : pulse.shape) energy.push_back(value * value);
  }
};

/// Rows of one worker, used over and over.
struct Workspace {
  Amplitudes drawn, heard;
  std::vector<double> power;
};

void add_noise(const Chain& chain, std::uint64_t beam, Amplitudes& row) {
  RandomStream random(chain.moment, beam);
  for (std::size_t i = 0; i < row.real.size(); ++i) {
    const Phasor one = circular(random);
    row.real[i] += chain.noise * one.real;
    row.imaginary[i] += chain.noise * one.imaginary;
  }
}

/// Amplitudes where there are phases: speckle, noise or both. Without speckle powers add within
/// the pulse, and noise is added to their roots.
void hear_amplitudes(const Chain& chain, const double* power, std::uint64_t beam, Workspace& work) {
  const std::size_t samples = work.power.size();
  const bool speckled = chain.options.speckle != SpeckleModel::kNone;
  work.heard.resize(samples);
  if (speckled) {
    Amplitudes& drawn = chain.pulse.shape.size() > 1 ? work.drawn : work.heard;
    drawn.resize(samples);
    draw_speckle(chain.options, power, RandomStream(chain.place, beam).next(), drawn);
    if (&drawn == &work.drawn) {
      convolve(chain.pulse.shape, chain.pulse.first, drawn.real, work.heard.real);
      convolve(chain.pulse.shape, chain.pulse.first, drawn.imaginary, work.heard.imaginary);
    }
  } else {
    for (std::size_t i = 0; i < samples; ++i) {
      work.heard.real[i] = std::sqrt(work.power[i]);
      work.heard.imaginary[i] = 0.0;
    }
  }
  if (chain.noise > 0.0) add_noise(chain, beam, work.heard);
  for (std::size_t i = 0; i < samples; ++i) {
    const double real = work.heard.real[i], imaginary = work.heard.imaginary[i];
    work.power[i] = real * real + imaginary * imaginary;
  }
}

/// One row, from the power that arrives to what is recorded. \return samples at full scale.
std::int64_t receive_row(const Chain& chain, const double* power, std::uint64_t beam,
                         Workspace& work, double* to) {
  const std::size_t samples = chain.gains.size();
  const bool speckled = chain.options.speckle != SpeckleModel::kNone;
  work.power.assign(power, power + samples);
  if (!speckled && chain.pulse.shape.size() > 1) {
    const std::vector<double> arrived = work.power;
    convolve(chain.energy, chain.pulse.first, arrived, work.power);
  }
  if (speckled || chain.noise > 0.0) hear_amplitudes(chain, power, beam, work);
  std::int64_t clipped = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    to[i] = chain.converter(chain.gains[i] * work.power[i], clipped);
  }
  return clipped;
}

/// Which rows bring nothing.
std::vector<bool> lost_rows(const SonarOptions& options, std::size_t beams,
                            const ReceiverKey& key) {
  RandomStream random(time_key(kDropout, key));
  std::vector<bool> lost(beams, random.uniform() < options.dropout_rate);
  for (std::size_t beam = 0; beam < beams; ++beam) {
    if (random.uniform() < options.beam_dropout_rate) lost[beam] = true;
  }
  return lost;
}

}  // namespace
}  // namespace sonar

void ReceiverOptions::check() const {
  check_range("speckle_shape", speckle_shape, 0.1, 1000.0);
  if (noise_level) check_range("noise_level", *noise_level, -300.0, 300.0);
  check_range("tvg_spreading", tvg_spreading, 0.0, 100.0);
  check_range("tvg_absorption", tvg_absorption, 0.0, 10.0);
  check_range("tvg_offset", tvg_offset, -300.0, 300.0);
  check_range("dropout_rate", dropout_rate, 0.0, 1.0);
  check_range("beam_dropout_rate", beam_dropout_rate, 0.0, 1.0);
  check_range("bits", bits, 0, 32);
  check_range("full_scale", full_scale, -300.0, 300.0);
}

double noise_intensity(const SonarOptions& options, double sound_speed) {
  const double level = options.noise_level
                           ? *options.noise_level
                           : ambient_noise(options.frequency, {.wind_speed = options.wind_speed});
  const double directivity =
      std::max(1.0, 4.0 * std::numbers::pi / (options.beam_width * options.fan_width));
  const double density = sonar::linear(level - options.source_level) / directivity;
  const double cell = options.sample_length();
  switch (options.pulse) {
    case PulseModel::kNone:
      return density * options.bandwidth;
    case PulseModel::kRectangle:
      return density * options.bandwidth * cell / (0.5 * sound_speed * options.pulse_length);
    case PulseModel::kChirp:
      return density / options.pulse_length * cell / (0.5 * sound_speed / options.bandwidth);
  }
  return 0.0;
}

Received receive(const SonarOptions& options, const Echo& echo, const ReceiverKey& key,
                 int num_threads) {
  const auto samples = static_cast<std::size_t>(echo.samples);
  const auto beams = static_cast<std::size_t>(echo.beams);
  const sonar::Chain chain(options, echo.sound_speed, key);
  const std::vector<bool> lost = sonar::lost_rows(options, beams, key);
  Received received;
  received.intensity.assign(echo.power.size(), 0.0);
  received.dropped = std::find(lost.begin(), lost.end(), false) == lost.end();

  constexpr std::size_t kSamplesAtOnce = 16384;
  const std::size_t grain =
      std::max<std::size_t>(1, kSamplesAtOnce / std::max<std::size_t>(samples, 1));
  std::vector<std::int64_t> clipped(beams, 0);
  parallel_for(beams, grain, num_threads, [&](std::size_t begin, std::size_t end) {
    sonar::Workspace work;
    for (std::size_t beam = begin; beam < end; ++beam) {
      if (lost[beam]) continue;
      clipped[beam] = sonar::receive_row(chain, echo.power.data() + beam * samples, beam, work,
                                         received.intensity.data() + beam * samples);
    }
  });
  for (const std::int64_t count : clipped) received.clipped += count;
  return received;
}

}  // namespace bathyal
