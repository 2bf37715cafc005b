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

/// The compressed chirp of a spectrum under a Hann window, sinc(x) / (1 − x²) with x in cells of
/// `width` samples, out to six of them.
std::vector<double> compressed(double width) {
  const auto half = static_cast<int>(std::ceil(6.0 * width));
  std::vector<double> shape;
  for (int i = -half; i <= half; ++i) {
    const double x = std::abs(i / width);
    const double angle = std::numbers::pi * x;
    if (x < 1e-6) {
      shape.push_back(1.0);
    } else if (std::abs(x - 1.0) < 1e-6) {
      shape.push_back(0.5);
    } else {
      shape.push_back(std::sin(angle) / (angle * (1.0 - x * x)));
    }
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
