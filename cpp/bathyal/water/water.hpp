// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "bathyal/geometry/pose.hpp"

namespace bathyal {

/// Properties of the water by depth, linear between rows; above the first row as there.
struct WaterProfile {
  std::vector<double> depth;        ///< [m], rising, the first at least 0
  std::vector<double> temperature;  ///< [°C]
  std::vector<double> salinity;     ///< practical
  std::vector<double> sound_speed;  ///< [m/s]
};

/// The water of a world: one place that sonars and vehicles read.
class Water {
 public:
  /// z of the mean sea surface [m]; without one it is out of reach, and the water is the same
  /// everywhere, as it is at reference_depth().
  std::optional<double> surface() const { return surface_; }
  double reference_depth() const { return reference_depth_; }  ///< [m]

  /// Depth below the mean surface [m] at a height; reference_depth() without a surface.
  /// \throw std::invalid_argument above the surface.
  double depth(double z) const;

  double sound_speed(double z) const;  ///< [m/s] at a height
  double temperature(double z) const;  ///< [°C]
  double salinity(double z) const;     ///< practical

 private:
  std::optional<double> surface_;
  double reference_depth_ = 50.0;
  WaterProfile profile_{{50.0}, {10.0}, {35.0}, {1490.0}};
};

}  // namespace bathyal
