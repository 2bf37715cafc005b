// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/water/ambient_noise.hpp"

#include <cmath>

#include "bathyal/base/check.hpp"

namespace bathyal {
namespace {

double power(double decibels) { return std::pow(10.0, 0.1 * decibels); }

}  // namespace

double ambient_noise(double frequency, const AmbientNoiseOptions& options) {
  check_range("frequency", frequency, 1.0, 1e7);
  check_range("wind_speed", options.wind_speed, 0.0, 50.0);
  check_range("shipping", options.shipping, 0.0, 1.0);
  const double kilohertz = 1e-3 * frequency;
  const double decades = std::log10(kilohertz);
  const double turbulence = 17.0 - 30.0 * decades;
  const double ships =
      40.0 + 20.0 * (options.shipping - 0.5) + 26.0 * decades - 60.0 * std::log10(kilohertz + 0.03);
  const double wind = 50.0 + 7.5 * std::sqrt(options.wind_speed) + 20.0 * decades -
                      40.0 * std::log10(kilohertz + 0.4);
  const double thermal = -15.0 + 20.0 * decades;
  return 10.0 * std::log10(power(turbulence) + power(ships) + power(wind) + power(thermal));
}

}  // namespace bathyal
