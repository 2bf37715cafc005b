// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/geometry/pose.hpp"
#include "bathyal/geometry/trajectory.hpp"

namespace bathyal {

/// How a vehicle moves while a ping is under way, in the world: where it receives is not where it
/// transmitted.
struct VehicleMotion {
  Vec3 velocity = Vec3::Zero();  ///< of the vehicle's origin [m/s]
  Vec3 rate = Vec3::Zero();      ///< at which it turns [rad/s]

  bool moves() const { return !velocity.isZero(0.0) || !rate.isZero(0.0); }

  /// \throw std::invalid_argument for a number that is not finite, or faster than 100 m/s or
  ///        100 rad/s.
  void check() const;
};

/// That of a trajectory from a time on; at its end, that which led there. At rest before the start.
VehicleMotion motion_at(const Trajectory& world_from_vehicle, double time);

}  // namespace bathyal
