// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <complex>
#include <limits>

namespace bathyal::vehicle {

/// |1 + z + z²/2 + z³/6 + z⁴/24|: by how much Runge–Kutta's method multiplies a mode in a step.
inline double growth(std::complex<double> z) {
  return std::abs(1.0 + z * (1.0 + z * (0.5 + z * (1.0 / 6.0 + z / 24.0))));
}

/// The largest step at which a mode that dies down, or swings, does so in the method as well.
inline double largest_step(std::complex<double> rate) {
  if (std::abs(rate) < 1e-12 || rate.real() > 1e-9 * std::abs(rate)) {
    return std::numeric_limits<double>::infinity();
  }
  double low = 0.0, high = 6.0 / std::abs(rate);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (growth(middle * rate) <= 1.0 + 1e-12 ? low : high) = middle;
  }
  return low;
}

}  // namespace bathyal::vehicle
