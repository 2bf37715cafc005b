// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/water/absorption.hpp"

#include <cmath>

#include "bathyal/base/check.hpp"
#include "bathyal/water/internal/ranges.hpp"
#include "bathyal/water/sound_speed.hpp"

namespace bathyal {
namespace {

/// A P f_r f² / (f² + f_r²), frequencies in kHz.
double relaxation(double strength, double resonance, double f) {
  return strength * resonance * f * f / (f * f + resonance * resonance);
}

double francois_garrison(double f, const AbsorptionPlace& at) {
  const double t = at.temperature;
  const double s = at.salinity;
  const double d = at.depth;
  const double kelvin = 273.0 + t;
  const double c = 1412.0 + 3.21 * t + 1.19 * s + 0.0167 * d;

  const double boric = 8.86 / c * std::pow(10.0, 0.78 * at.ph - 5.0);
  const double boric_resonance = 2.8 * std::sqrt(s / 35.0) * std::pow(10.0, 4.0 - 1245.0 / kelvin);

  const double sulphate = 21.44 * s / c * (1.0 + 0.025 * t) * (1.0 + d * (-1.37e-4 + d * 6.2e-9));
  const double sulphate_resonance =
      8.17 * std::pow(10.0, 8.0 - 1990.0 / kelvin) / (1.0 + 0.0018 * (s - 35.0));

  const double water = (t <= 20.0 ? 4.937e-4 + t * (-2.59e-5 + t * (9.11e-7 - t * 1.50e-8))
                                  : 3.964e-4 + t * (-1.146e-5 + t * (1.45e-7 - t * 6.5e-10))) *
                       (1.0 + d * (-3.83e-5 + d * 4.9e-10));

  return relaxation(boric, boric_resonance, f) + relaxation(sulphate, sulphate_resonance, f) +
         water * f * f;
}

double ainslie_mccolm(double f, const AbsorptionPlace& at) {
  const double t = at.temperature;
  const double s = at.salinity;
  const double km = 1e-3 * at.depth;
  const double boric_resonance = 0.78 * std::sqrt(s / 35.0) * std::exp(t / 26.0);
  const double sulphate_resonance = 42.0 * std::exp(t / 17.0);
  return relaxation(0.106 * std::exp((at.ph - 8.0) / 0.56), boric_resonance, f) +
         relaxation(0.52 * (1.0 + t / 43.0) * (s / 35.0) * std::exp(-km / 6.0), sulphate_resonance,
                    f) +
         0.00049 * f * f * std::exp(-(t / 27.0 + km / 17.0));
}

}  // namespace

double absorption(AbsorptionFormula formula, double frequency, const AbsorptionPlace& place) {
  const double kilohertz = 1e-3 * frequency;
  return formula == AbsorptionFormula::kFrancoisGarrison ? francois_garrison(kilohertz, place)
                                                         : ainslie_mccolm(kilohertz, place);
}

std::string outside_absorption(AbsorptionFormula formula, double frequency,
                               const AbsorptionPlace& place) {
  OutsideRanges outside;
  if (formula == AbsorptionFormula::kAinslieMcColm) {
    outside.add("frequency", frequency, 100.0, 1e6, " Hz");
    outside.add("temperature", place.temperature, -6.0, 35.0, " °C");
    outside.add("salinity", place.salinity, 5.0, 50.0);
    outside.add("depth", place.depth, 0.0, 7000.0, " m");
    outside.add("ph", place.ph, 7.7, 8.3);
    return outside.text();
  }
  const bool high = frequency > 500e3;
  outside.add("frequency", frequency, 400.0, 1e6, " Hz");
  outside.add("temperature", place.temperature, high ? 0.0 : -2.0, high ? 30.0 : 22.0, " °C");
  outside.add("salinity", place.salinity, high ? 0.0 : 30.0, high ? 40.0 : 35.0);
  outside.add("depth", place.depth, 0.0, high ? 10000.0 : 3500.0, " m");
  return outside.text();
}

void check_absorption(double frequency, const AbsorptionPlace& place) {
  if (!(frequency > 0.0 && frequency <= 1e9)) {
    throw_argument("frequency", "a number above 0 and at most 10⁹ Hz", to_text(frequency));
  }
  check_seawater(place.temperature, place.salinity);
  check_range("depth", place.depth, 0.0, 12000.0);
  check_range("ph", place.ph, 6.0, 10.0);
}

}  // namespace bathyal
