// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/sonar/sonar.hpp"

namespace bathyal {

// Sonars by class, with values as their data sheets give them; all physics off.

/// Port and starboard, 600 kHz, 75 m, from straight down to the horizon.
SonarOptions side_scan_sonar();

/// For far ranges: 100 kHz, 200 m.
SonarOptions side_scan_100khz_sonar();

/// The model of Bobkov and others (2014): ideal cameras of 45° × 0.6°, from the horizontal to 45°
/// down, 100 × 8,000 pixels a side, to 120 m.
SonarOptions paper_side_scan_sonar();

/// 400 kHz, 256 beams of 1° × 1° over 120°, straight down.
SonarOptions multibeam_sonar();

/// One round beam of 10°, straight down, 200 kHz.
SonarOptions echo_sounder_sonar();

/// Five echo sounders that look ahead, from 60° down to 30° up (Bobkov and others 2014).
SonarOptions paper_forward_sounders();

/// Forward looking, 900 kHz, 512 beams over 130°, 20° high.
SonarOptions imaging_sonar();

/// A mechanically scanning head, 675 kHz, 1.8° × 30°, 0.9° a ping.
SonarOptions scanning_sonar();

/// The same sonar with every physical effect on: the `real` preset.
SonarOptions with_real_physics(SonarOptions options);

}  // namespace bathyal
