// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/world/generate/seabed.hpp"

namespace bathyal::generate {

/// Boulders at random places of an endless plane, half buried, with a hollow around each.
class BoulderField {
 public:
  explicit BoulderField(const SeabedOptions& options);

  bool any() const { return density_ > 0.0; }

  struct Part {
    double height = 0.0;  ///< of the highest dome here, less the deepest hollow [m]
    double bare = 1.0;    ///< 0 on a boulder, 1 well off: the share of ripples there
    bool rock = false;
  };
  Part at(double x, double y) const;

  /// Of a cell: so many boulders on average, at most this.
  static double side(double radius) { return 4.0 * radius; }
  static constexpr double kMostInACell = 8.0;

 private:
  std::uint64_t seed_;
  double density_, radius_, scour_;
};

}  // namespace bathyal::generate
