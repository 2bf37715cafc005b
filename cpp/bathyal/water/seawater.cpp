// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/water/seawater.hpp"

#include <algorithm>
#include <cmath>

namespace bathyal {
namespace {

constexpr double kGravityGradient = 2.26e-7;      // γ: gravity grows with depth, g (1 + γ depth)
constexpr double kStandardConductivity = 4.2914;  // of S = 35 at 15 °C on IPTS-68, 0 dbar [S/m]

double surface_gravity(double latitude) {
  const double sine2 = std::sin(latitude) * std::sin(latitude);
  return 9.780327 * (1.0 + (5.2792e-3 + 2.32e-5 * sine2) * sine2);
}

/// Enthalpy of the standard ocean at 0 °C above that at the surface [J/kg]; the integral of the
/// specific volume over pressure.
double standard_enthalpy(double pressure) {
  const double z = pressure * 1e-4;
  return 1e8 * z *
         (9.726613854843870e-4 +
          z * (-2.252956605630465e-5 +
               z * (2.376909655387404e-6 +
                    z * (-1.664294869986011e-7 +
                         z * (-5.988108894465758e-9 +
                              z * (-2.1078768810e-9 + z * 2.8019291329e-10))))));
}

/// [m³/kg]
double standard_specific_volume(double pressure) {
  const double z = pressure * 1e-4;
  return 9.726613854843870e-4 +
         z * (-4.505913211160929e-05 +
              z * (7.130728965927127e-06 +
                   z * (-6.657179479768312e-07 +
                        z * (-2.994054447232880e-08 +
                             z * (-1.2647261286e-8 + z * 1.9613503930e-9)))));
}

/// Density at the surface, eq 13 and 14 of Fofonoff and Millard.
double surface_density(double t, double s) {
  const double pure =
      999.842594 +
      t * (6.793952e-2 +
           t * (-9.095290e-3 + t * (1.001685e-4 + t * (-1.120083e-6 + t * 6.536332e-9))));
  const double a =
      8.24493e-1 + t * (-4.0899e-3 + t * (7.6438e-5 + t * (-8.2467e-7 + t * 5.3875e-9)));
  const double b = -5.72466e-3 + t * (1.0227e-4 - t * 1.6546e-6);
  return pure + s * a + s * std::sqrt(s) * b + 4.8314e-4 * s * s;
}

/// Secant bulk modulus [bar], eq 15 to 19; p in bar.
double bulk_modulus(double t, double s, double p) {
  const double root = s * std::sqrt(s);
  const double pure =
      19652.21 + t * (148.4206 + t * (-2.327105 + t * (1.360477e-2 - t * 5.155288e-5)));
  const double surface = pure + s * (54.6746 + t * (-0.603459 + t * (1.09987e-2 - t * 6.1670e-5))) +
                         root * (7.944e-2 + t * (1.6483e-2 - t * 5.3009e-4));
  const double a = 3.239908 + t * (1.43713e-3 + t * (1.16092e-4 - t * 5.77905e-7)) +
                   s * (2.2838e-3 + t * (-1.0981e-5 - t * 1.6078e-6)) + root * 1.91075e-4;
  const double b = 8.50935e-5 + t * (-6.12293e-6 + t * 5.2787e-8) +
                   s * (-9.9348e-7 + t * (2.0816e-8 + t * 9.1697e-10));
  return surface + p * (a + p * b);
}

}  // namespace

double depth_from_pressure(double pressure, double latitude) {
  const double gravity = surface_gravity(latitude);
  const double enthalpy = standard_enthalpy(pressure);
  return 2.0 * enthalpy /
         (gravity + std::sqrt(gravity * gravity + 2.0 * kGravityGradient * gravity * enthalpy));
}

double pressure_from_depth(double depth, double latitude) {
  const double gravity = surface_gravity(latitude);
  // Of depth d the enthalpy is g d (1 + γ d / 2): Newton's method on the pressure.
  const double enthalpy = gravity * depth * (1.0 + 0.5 * kGravityGradient * depth);
  double pressure = enthalpy / (1e4 * standard_specific_volume(0.0));
  for (int step = 0; step < 6; ++step) {
    pressure +=
        (enthalpy - standard_enthalpy(pressure)) / (1e4 * standard_specific_volume(pressure));
  }
  return pressure;
}

double seawater_density(double temperature, double salinity, double pressure) {
  const double t = ipts68(temperature);
  const double p = pressure * 0.1;
  return surface_density(t, salinity) / (1.0 - p / bulk_modulus(t, salinity, p));
}

double practical_salinity(double conductivity, double temperature, double pressure) {
  if (!(conductivity > 0.0)) return conductivity <= 0.0 ? 0.0 : conductivity;  // NaN stays
  const double t = ipts68(temperature);
  const double ratio = conductivity / kStandardConductivity;
  const double rt =
      0.6766097 + t * (2.00564e-2 + t * (1.104259e-4 + t * (-6.9698e-7 + t * 1.0031e-9)));
  const double rp =
      1.0 + pressure * (2.070e-5 + pressure * (-6.370e-10 + pressure * 3.989e-15)) /
                (1.0 + t * (3.426e-2 + t * 4.464e-4) + ratio * (4.215e-1 - t * 3.107e-3));
  const double x = std::sqrt(std::max(ratio / (rp * rt), 0.0));
  const double shift = (t - 15.0) / (1.0 + 0.0162 * (t - 15.0));
  const double salinity =
      0.0080 + x * (-0.1692 + x * (25.3851 + x * (14.0941 + x * (-7.0261 + x * 2.7081)))) +
      shift * (0.0005 + x * (-0.0056 + x * (-0.0066 + x * (-0.0375 + x * (0.0636 - x * 0.0144)))));
  return std::max(salinity, 0.0);
}

}  // namespace bathyal
