// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "bathyal/vehicle/vehicle.hpp"

namespace bathyal {

/// Depth, heading, pitch and roll, position: of one vehicle that can push in these directions.
struct PoseHoldOptions {
  std::array<double, 6> frequency{1.5, 1.5, 1.5, 2.0, 2.0, 1.5};  ///< natural, of each [rad/s]
  double damping = 1.0;                                           ///< ratio, above 0
  double integral = 1.0;     ///< third pole, times the frequency; 0: no integral part
  FreeAxes axes = kAllFree;  ///< what is controlled, surge to yaw of the vehicle

  /// \throw std::invalid_argument that names the field
  void check() const;
};

struct PoseTarget {
  Pose world_from_vehicle = Pose::Identity();
  Vec6 velocity = Vec6::Zero();  ///< over ground, in the vehicle's frame
};

struct PoseHoldState {
  Vec6 integral = Vec6::Zero();   ///< accelerations; the linear ones in the world [m/s², rad/s²]
  Vec6 shortfall = Vec6::Zero();  ///< to be set: what was given less what was asked for [N, N m]
};

/// A PID whose gains are the model's: in each direction the error obeys
/// (s + i ω)(s² + 2 ζ ω s + ω²) = 0, times the vehicle's mass matrix with its added mass, with
/// weight, buoyancy and the drag of the current fed forward (Fossen 2011, sect. 12.2). The integral
/// of position is kept in the world, so that a turn of the vehicle does not turn a current's share.
/// It does not wind up: it follows what the thrusters gave.
class PoseHold {
 public:
  /// \throw std::invalid_argument as PoseHoldOptions::check
  PoseHold(Vehicle vehicle, PoseHoldOptions options);

  const PoseHoldOptions& options() const { return options_; }

  /// The wrench to ask for, about the vehicle's origin, in its frame; then the state for the next
  /// step. \param current what is known of the water's velocity, in the world [m/s]
  Vec6 step(PoseHoldState& state, const VehicleState& measured, const PoseTarget& target,
            const Vec3& current, double time) const;

 private:
  /// What is not held does not count, so that a tilt does not make depth of a way gone.
  Vec3 watched(const Vec3& in_world) const;

  Vehicle vehicle_;
  PoseHoldOptions options_;
};

}  // namespace bathyal
