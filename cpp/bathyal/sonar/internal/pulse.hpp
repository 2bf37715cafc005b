// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "bathyal/sonar/sonar.hpp"

namespace bathyal::sonar {

/// Amplitudes by which what comes from sample i is heard in samples i + first, i + first + 1, …;
/// their squares add up to 1.
struct Pulse {
  std::ptrdiff_t first = 0;
  std::vector<double> shape;
};

Pulse pulse_of(const SonarOptions& options, double sound_speed);

}  // namespace bathyal::sonar
