// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bathyal {

struct AmbientNoiseOptions {
  double wind_speed = 5.0;  ///< at 10 m [m/s], 0 to 50
  double shipping = 0.5;    ///< from 0 (none near) to 1 (heavy)
};

/// Noise of the sea, as Wenz (1962) drew it: the sum of turbulence, ships, wind and, above some
/// 100 kHz, the motion of molecules, by the formulas of Coates (1990). [dB re 1 µPa²/Hz] at a
/// frequency [Hz].
/// \throw std::invalid_argument for a frequency outside 1 Hz to 10 MHz, or an option out of range.
double ambient_noise(double frequency, const AmbientNoiseOptions& options = {});

}  // namespace bathyal
