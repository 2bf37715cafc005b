// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/control/allocation.hpp"
#include "bathyal/control/pose_hold.hpp"
#include "bathyal/uvms/arm_on_vehicle.hpp"

namespace bathyal {

struct TrimHoldOptions {
  double duration = 0.0;       ///< [s], 0 or more
  double step = 0.01;          ///< of the integration [s], above 0
  double period = 0.05;        ///< of the controller, steps of it in whole numbers [s]
  double voltage = 16.0;       ///< of the thrusters [V], above 0
  WrenchRows tip_wrench = {};  ///< on the tool at its centre point, along the vehicle's axes
  /// What arm and bottom are expected to exert on the vehicle: its negative is fed forward.
  WrenchRows expected_wrench = {};
  Vec3 current = Vec3::Zero();

  /// \throw std::invalid_argument
  void check() const;
};

struct TrimHoldRecord {
  ArmMotionRecord motion;
  std::vector<Vec6> thrust;  ///< of the thrusters, about the vehicle's origin, a state
  bool saturated = false;    ///< a thruster was at its limit
};

/// How a vehicle holds its pose by its thrusters while the arm works: the controller with the model
/// that it was given, the truth as `system` is. Pose and velocity are measured without error.
/// The thrusters begin with the speeds of the first commands.
/// \throw std::invalid_argument for an expected wrench that the thrusters cannot balance (its axis
///        and time are named), and as simulate_arm_motion
TrimHoldRecord hold_trim(const ArmOnVehicle& system, const Allocation& allocation,
                         const PoseHold& controller, const VehicleState& start,
                         const JointSpline& motion, const TrimHoldOptions& options);

}  // namespace bathyal
