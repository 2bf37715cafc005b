// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "bathyal/vehicle/vehicle.hpp"

namespace bathyal {

/// Ballast that is held until it is let go. Only its weight in water counts: its inertia, a few
/// per cent of the vehicle's, does not.
struct DropWeightOptions {
  std::string name = "drop_weight";
  Vec3 position = Vec3::Zero();  ///< in the vehicle's frame [m]
  double mass = 0.0;             ///< [kg], 0 or more
  double volume = 0.0;           ///< [m³], 0 or more

  /// \throw std::invalid_argument that names the field
  void check() const;
};

struct DropWeightState {
  int released = 0;  ///< 1 once it is let go; it does not come back
};

/// Force and moment of what is still held, about the vehicle's origin, in its frame.
Vec6 drop_weight_wrench(const DropWeightOptions& weight, const DropWeightState& state,
                        const VehicleOptions& vehicle, const Pose& world_from_vehicle);

}  // namespace bathyal
