// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "bathyal/world/generate/internal/relief.hpp"
#include "bathyal/world/generate/seabed.hpp"

namespace bathyal::generate {

/// Sand ripples: a wave whose crests lean with the current, meander, and fork at dislocations.
class Ripples {
 public:
  explicit Ripples(const SeabedOptions& options);

  bool any() const { return height_ > 0.0 && cover_ > 0.0; }

  /// Share of the full height that ripples have, 0 to 1, dislocations left out, where the relief
  /// `patches` is `patch`.
  double cover(double patch) const;

  /// Height [m] with full cover, where `meander` adds so much to the phase.
  double at(double x, double y, double meander) const;

  const Relief& meander() const { return meander_; }
  const Relief& patches() const { return patches_; }

 private:
  struct Fault {
    double phase = 0.0;      ///< what dislocations add [rad]
    double amplitude = 1.0;  ///< none at the dislocation itself
  };
  Fault faults(double x, double y) const;

  std::uint64_t seed_;
  double height_, wavelength_, cosine_, sine_, lean_, defects_, cover_;
  Relief meander_, patches_;
};

}  // namespace bathyal::generate
