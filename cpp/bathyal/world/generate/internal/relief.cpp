// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/world/generate/internal/relief.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bathyal/base/random.hpp"

namespace bathyal::generate {

Relief::Relief(std::uint64_t seed, std::uint64_t stream, double rms, double exponent,
               double longest, double shortest) {
  if (rms == 0.0) return;
  constexpr double kTau = 2.0 * std::numbers::pi;
  constexpr double kWavesAnOctave = 32.0;
  const double octaves = std::log2(longest / shortest);
  const auto count =
      static_cast<std::size_t>(std::max(kWavesAnOctave, std::ceil(kWavesAnOctave * octaves)));
  RandomStream random(seed, stream);
  const double turn = random.uniform();
  double power = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto number = static_cast<double>(i);
    const double share = (number + random.uniform()) / static_cast<double>(count);
    const double k = kTau / longest * std::exp2(octaves * share);
    const double angle = kTau * (turn + number / std::numbers::phi + 0.02 * random.uniform());
    // Equal steps of ln k: the power of each is k² · k^−exponent.
    const double amplitude = std::pow(k * longest, 0.5 * (2.0 - exponent));
    power += 0.5 * amplitude * amplitude;
    waves_.push_back(
        {k * std::cos(angle), k * std::sin(angle), random.uniform(0.0, kTau), amplitude});
  }
  for (Wave& wave : waves_) wave.amplitude *= rms / std::sqrt(power);
}

double Relief::at(double x, double y) const {
  double sum = 0.0;
  for (const Wave& wave : waves_) {
    const double across = wave.ky * y + wave.phase;
    const double c = wave.amplitude * std::cos(across);
    const double s = wave.amplitude * std::sin(across);
    sum += std::sin(wave.kx * x) * c + std::cos(wave.kx * x) * s;
  }
  return sum;
}

Relief::Columns Relief::columns(const double* x, std::size_t count) const {
  Columns columns{count, std::vector<double>(count * waves_.size()),
                  std::vector<double>(count * waves_.size())};
  for (std::size_t w = 0; w < waves_.size(); ++w) {
    for (std::size_t i = 0; i < count; ++i) {
      columns.sine[w * count + i] = std::sin(waves_[w].kx * x[i]);
      columns.cosine[w * count + i] = std::cos(waves_[w].kx * x[i]);
    }
  }
  return columns;
}

void Relief::row(const Columns& columns, double y, double* height) const {
  std::fill_n(height, columns.count, 0.0);
  for (std::size_t w = 0; w < waves_.size(); ++w) {
    const double across = waves_[w].ky * y + waves_[w].phase;
    const double c = waves_[w].amplitude * std::cos(across);
    const double s = waves_[w].amplitude * std::sin(across);
    const double* sine = columns.sine.data() + w * columns.count;
    const double* cosine = columns.cosine.data() + w * columns.count;
    for (std::size_t i = 0; i < columns.count; ++i) height[i] += sine[i] * c + cosine[i] * s;
  }
}

}  // namespace bathyal::generate
