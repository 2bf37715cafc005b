// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace bathyal {

/// Each is the sum of boric acid, magnesium sulphate and pure water.
enum class AbsorptionFormula {
  kFrancoisGarrison,  ///< Francois, Garrison (1982), ±5 %. Below 500 kHz −2–22 °C, 30–35, to
                      ///< 3 500 m; above, where water itself absorbs most, 0–30 °C, 0–40, to 10 km
  kAinslieMcColm,  ///< Ainslie, McColm (1998): within 10 % of it, 100 Hz to 1 MHz, −6–35 °C,
                   ///< 5–50, to 7 km, pH 7.7 to 8.3
};

/// Where, and in which water.
struct AbsorptionPlace {
  double temperature = 10.0;  ///< [°C]
  double salinity = 35.0;     ///< practical
  double depth = 50.0;        ///< [m]
  double ph = 8.0;            ///< total scale's and NBS's are alike within the formulas' accuracy
};

/// [dB/km] at a frequency [Hz] (10 log of power). Not checked.
double absorption(AbsorptionFormula formula, double frequency, const AbsorptionPlace& place);

/// What lies outside the formula's range, by name; empty where all is inside.
std::string outside_absorption(AbsorptionFormula formula, double frequency,
                               const AbsorptionPlace& place);

/// \throw std::invalid_argument for a frequency that is not above 0 Hz and at most 10⁹, water as
/// check_seawater refuses it, a depth not from 0 to 12 000 m, or a pH not from 6 to 10.
void check_absorption(double frequency, const AbsorptionPlace& place);

/// Np/m of the amplitude from dB/km: the power falls as exp(−2 α R) on a way of length R.
inline double nepers_per_metre(double decibels_per_km) {
  return decibels_per_km * 1.1512925464970229e-4;  // ln(10) / 20 / 1000
}

}  // namespace bathyal
