// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/vehicle/vehicle.hpp"

namespace bathyal {

/// A cable from a point that is fixed in the world (a ship, a cage, a clump) to the vehicle,
/// without motion of its own: it hangs as an elastic catenary (Irvine 1981, Cable Structures, ch.
/// 2) under its weight in water and the drag of the current across it. The drag is that of a
/// straight cable from end to end, spread evenly (Morison's square law with the speed square to
/// it), so that the cable lies in one plane; the bottom does not carry it.
struct TetherOptions {
  Vec3 anchor = Vec3::Zero();      ///< in the world [m]
  Vec3 attachment = Vec3::Zero();  ///< on the vehicle, in its frame [m]
  double length = 0.0;             ///< without load [m], above 0
  double weight = 0.0;             ///< in water, a metre; below 0: it floats [N/m]
  double diameter = 0.0;           ///< [m], 0 or more
  double drag = 1.2;               ///< coefficient of the flow across it, 0 or more
  double stiffness = 1e5;          ///< E A, force a unit strain [N], above 0
  double water_density = 1025.0;   ///< [kg/m³]

  /// \throw std::invalid_argument that names the field
  void check() const;
};

/// Force of an elastic catenary on its far end. \param span from its fixed end [m]
/// \param load force a metre, evenly along it [N/m]
Vec3 catenary_force(const Vec3& span, const Vec3& load, double length, double stiffness);

/// Force and moment about the vehicle's origin, in its frame. \param relative_water velocity of
/// the water past the cable, in the world [m/s]
Vec6 tether_wrench(const TetherOptions& tether, const Pose& world_from_vehicle,
                   const Vec3& relative_water);

}  // namespace bathyal
