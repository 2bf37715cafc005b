// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What seawater is at a place: depth and pressure, density, salinity from conductivity. Depths and
// pressures count from the surface, latitudes are in radians. Arguments are not checked here.

namespace bathyal {

/// IPTS-68 from ITS-90 and back [°C] (Saunders 1990, T68 = 1.00024 T90).
inline double ipts68(double its90) { return 1.00024 * its90; }
inline double its90(double ipts68) { return ipts68 / 1.00024; }

/// Depth [m] at a pressure [dbar], of water of salinity 35 at 0 °C: TEOS-10's z_from_p (Roquet,
/// Madec, McDougall, Barker 2015; gravity after Moritz 2000), what gsw gives.
double depth_from_pressure(double pressure, double latitude);

/// Its inverse, to rounding. Pressure [dbar] at a depth [m].
double pressure_from_depth(double depth, double latitude);

/// [kg/m³] by EOS-80 (UNESCO 1981; Fofonoff, Millard 1983), temperature on ITS-90 [°C], practical
/// salinity, pressure [dbar]. Fitted to −2 … 40 °C, 0 … 42, 0 … 10 000 dbar.
double seawater_density(double temperature, double salinity, double pressure);

/// Practical salinity (PSS-78; Fofonoff, Millard 1983) from conductivity [S/m], temperature on
/// ITS-90 [°C] and pressure [dbar]. Fitted to 2 … 42 and −2 … 35 °C; 0 or less conducts nothing: 0.
double practical_salinity(double conductivity, double temperature, double pressure);

}  // namespace bathyal
