// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace bathyal {

/// As printed. Each takes the temperature on the scale of its authors, IPTS-68; on ITS-90 it is
/// 0.024 % less, which is 0.02 m/s at most (`ipts68`).
enum class SoundSpeedFormula {
  kMackenzie,  ///< Mackenzie (1981): nine terms in depth. 2–30 °C, 25–40, 0–8 000 m; ±0.07 m/s
  kChenMillero,  ///< Chen, Millero (1977) in UNESCO 44 (Fofonoff, Millard 1983), of pressure.
                 ///< 0–40 °C, 0–40, 0–10 000 dbar; ±0.19 m/s
  kDelGrosso,    ///< Del Grosso (1974), NRL II, of pressure. 0–30 °C, 30–40, 0–9 807 dbar
                 ///< (1 000 kg/cm²); ±0.05 m/s
};

/// Where in the water, by what the formula is a function of: the other is not read.
struct SoundSpeedPlace {
  double depth = 0.0;     ///< [m], Mackenzie
  double pressure = 0.0;  ///< above the atmosphere's [dbar], the others
};

/// [m/s] at a temperature [°C, IPTS-68] and a practical salinity. Not checked: outside the
/// formula's range it extrapolates, and `outside_sound_speed` says so.
double sound_speed(SoundSpeedFormula formula, double temperature, double salinity,
                   SoundSpeedPlace place);

/// "temperature 41 °C (0 to 40)": what of a place is outside the formula's range, by name; empty
/// where all is inside.
std::string outside_sound_speed(SoundSpeedFormula formula, double temperature, double salinity,
                                SoundSpeedPlace place);

/// What no formula is asked for, whatever its range. \throw std::invalid_argument for a temperature
/// that is not from −10 to 60 °C, or a salinity not from 0 to 100; NaN is in neither.
void check_seawater(double temperature, double salinity);

}  // namespace bathyal
