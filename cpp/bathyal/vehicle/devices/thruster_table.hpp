// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace bathyal {

/// What a thruster gives in still water when its speed has settled.
struct ThrusterPoint {
  double thrust = 0.0;  ///< ahead positive [N]
  double power = 0.0;   ///< electrical [W]
  double speed = 0.0;   ///< of the propeller, ahead positive [1/s]
};

/// Measured at commands and supply voltages. The values are rows of voltage, columns of command.
struct ThrusterTable {
  std::vector<double> command;  ///< (K,) rising, within −1 to 1
  std::vector<double> voltage;  ///< (L,) rising [V]
  std::vector<double> thrust;   ///< (L, K), ahead positive [N]
  std::vector<double> power;    ///< (L, K) [W], 0 or more
  std::vector<double> speed;    ///< (L, K), ahead positive [1/s]

  /// \throw std::invalid_argument that names the field
  void check() const;

  /// Bilinear; beyond the ends as at the ends.
  ThrusterPoint at(double command, double voltage) const;

  /// Of one row. \pre row < L
  ThrusterPoint measured(std::size_t row, std::size_t column) const;
};

}  // namespace bathyal
