// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/vehicle/devices/thruster.hpp"

namespace bathyal {

/// A law fitted to a table, and how far from it the table lies.
struct ThrusterFit {
  ThrusterOptions options;   ///< the law alone, without the table
  double rms_ahead = 0.0;    ///< of the thrust by measured speed, ahead [N]
  double rms_astern = 0.0;   ///< [N]
  double rms_command = 0.0;  ///< of the thrust by command and voltage, both ways [N]
  double rms_power = 0.0;    ///< of the power by measured speed [W]
};

/// Least squares: thrust against n² (T = k n|n|), power against |n|³ and n⁴, and in logarithms, the
/// weight n⁴, speed against voltage and command past the dead zone. Rows without thrust do not
/// count. \param nominal_voltage of the law [V]
/// \throw std::invalid_argument for a table that is broken, or without thrust ahead or astern
ThrusterFit fit_thruster(const ThrusterTable& table, double nominal_voltage = 16.0);

}  // namespace bathyal
