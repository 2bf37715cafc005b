// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/internal/pulse.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bathyal::sonar {
namespace {

/// Over `length` samples from the one it comes from: the part of each that it covers.
std::vector<double> rectangle(double length) {
  std::vector<double> energy;
  for (double at = 0.0; at < length; at += 1.0) energy.push_back(std::min(1.0, length - at));
  return energy;
}

/// A sinc of `width` samples under a Hann window of four lobes a side.
std::vector<double> compressed(double width) {
  const auto half = static_cast<int>(std::ceil(4.0 * width));
  std::vector<double> shape;
  for (int i = -half; i <= half; ++i) {
    const double x = std::numbers::pi * i / width;
    const double window = std::pow(std::cos(0.5 * std::numbers::pi * i / (half + 1.0)), 2);
    shape.push_back(window * (i == 0 ? 1.0 : std::sin(x) / x));
  }
  return shape;
}

}  // namespace

Pulse pulse_of(const SonarOptions& options, double sound_speed) {
  Pulse pulse{0, {1.0}};
  const double cell = options.sample_length();
  if (options.pulse == PulseModel::kRectangle) {
    pulse.shape = rectangle(0.5 * sound_speed * options.pulse_length / cell);
    for (double& value : pulse.shape) value = std::sqrt(value);
  } else if (options.pulse == PulseModel::kChirp) {
    pulse.shape = compressed(0.5 * sound_speed / options.bandwidth / cell);
    pulse.first = -static_cast<std::ptrdiff_t>(pulse.shape.size() / 2);
  }
  double energy = 0.0;
  for (const double value : pulse.shape) energy += value * value;
  for (double& value : pulse.shape) value /= std::sqrt(energy);
  return pulse;
}

}  // namespace bathyal::sonar
