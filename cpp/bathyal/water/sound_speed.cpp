// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/water/sound_speed.hpp"

#include <cmath>

#include "bathyal/base/check.hpp"
#include "bathyal/water/internal/ranges.hpp"

namespace bathyal {
namespace {

double mackenzie(double t, double s, double d) {
  return 1448.96 + 4.591 * t - 5.304e-2 * t * t + 2.374e-4 * t * t * t + 1.340 * (s - 35.0) +
         1.630e-2 * d + 1.675e-7 * d * d - 1.025e-2 * t * (s - 35.0) - 7.139e-13 * t * d * d * d;
}

/// Eq 37 to 41 of Fofonoff and Millard; p in bar.
double chen_millero(double t, double s, double p) {
  const double c0 =
      1402.388 +
      t * (5.03711 + t * (-5.80852e-2 + t * (3.3420e-4 + t * (-1.47800e-6 + t * 3.1464e-9))));
  const double c1 =
      0.153563 + t * (6.8982e-4 + t * (-8.1788e-6 + t * (1.3621e-7 - t * 6.1185e-10)));
  const double c2 =
      3.1260e-5 + t * (-1.7107e-6 + t * (2.5974e-8 + t * (-2.5335e-10 + t * 1.0405e-12)));
  const double c3 = -9.7729e-9 + t * (3.8504e-10 - t * 2.3643e-12);
  const double a0 = 1.389 + t * (-1.262e-2 + t * (7.164e-5 + t * (2.006e-6 - t * 3.21e-8)));
  const double a1 =
      9.4742e-5 + t * (-1.2580e-5 + t * (-6.4885e-8 + t * (1.0507e-8 - t * 2.0122e-10)));
  const double a2 = -3.9064e-7 + t * (9.1041e-9 + t * (-1.6002e-10 + t * 7.988e-12));
  const double a3 = 1.100e-10 + t * (6.649e-12 - t * 3.389e-13);
  const double b = -1.922e-2 - 4.42e-5 * t + (7.3637e-5 + 1.7945e-7 * t) * p;
  const double d = 1.727e-3 - 7.9836e-6 * p;
  const double water = c0 + p * (c1 + p * (c2 + p * c3));
  const double a = a0 + p * (a1 + p * (a2 + p * a3));
  return water + s * (a + std::sqrt(s) * b + s * d);
}

/// Eq 1 to 6 of Del Grosso; p in kg/cm².
double del_grosso(double t, double s, double p) {
  const double by_t = t * (0.501109398873e1 + t * (-0.550946843172e-1 + t * 0.221535969240e-3));
  const double by_s = s * (0.132952290781e1 + s * 0.128955756844e-3);
  const double by_p = p * (0.156059257041 + p * (0.244998688441e-4 - p * 0.883392332513e-8));
  const double mixed = -0.127562783426e-1 * t * s + 0.635191613389e-2 * t * p +
                       0.265484716608e-7 * t * t * p * p - 0.159349479045e-5 * t * p * p +
                       0.522116437235e-9 * t * p * p * p - 0.438031096213e-6 * t * t * t * p -
                       0.161674495909e-8 * s * s * p * p + 0.968403156410e-4 * t * t * s +
                       0.485639620015e-5 * t * s * s * p - 0.340597039004e-3 * t * s * p;
  return 1402.392 + by_t + by_s + by_p + mixed;
}

}  // namespace

double sound_speed(SoundSpeedFormula formula, double temperature, double salinity,
                   SoundSpeedPlace place) {
  switch (formula) {
    case SoundSpeedFormula::kMackenzie:
      return mackenzie(temperature, salinity, place.depth);
    case SoundSpeedFormula::kChenMillero:
      return chen_millero(temperature, salinity, 0.1 * place.pressure);
    case SoundSpeedFormula::kDelGrosso:
      return del_grosso(temperature, salinity, place.pressure / 9.80665);
  }
  return 0.0;  // not reached
}

std::string outside_sound_speed(SoundSpeedFormula formula, double temperature, double salinity,
                                SoundSpeedPlace place) {
  OutsideRanges outside;
  switch (formula) {
    case SoundSpeedFormula::kMackenzie:
      outside.add("temperature", temperature, 2.0, 30.0, " °C");
      outside.add("salinity", salinity, 25.0, 40.0);
      outside.add("depth", place.depth, 0.0, 8000.0, " m");
      break;
    case SoundSpeedFormula::kChenMillero:
      outside.add("temperature", temperature, 0.0, 40.0, " °C");
      outside.add("salinity", salinity, 0.0, 40.0);
      outside.add("pressure", place.pressure, 0.0, 10000.0, " dbar");
      break;
    case SoundSpeedFormula::kDelGrosso:
      outside.add("temperature", temperature, 0.0, 30.0, " °C");
      outside.add("salinity", salinity, 30.0, 40.0);
      outside.add("pressure", place.pressure, 0.0, 9806.65, " dbar");
      break;
  }
  return outside.text();
}

void check_seawater(double temperature, double salinity) {
  check_range("temperature", temperature, -10.0, 60.0);
  check_range("salinity", salinity, 0.0, 100.0);
}

}  // namespace bathyal
