// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "bathyal/arm/kinematics.hpp"

namespace bathyal {

struct StaticsOptions {
  /// In the arm's base frame, which turns with the vehicle: a pitched vehicle has another gravity
  /// here [m/s²].
  Vec3 gravity = {0.0, 0.0, -9.80665};
  double water_density = 1025.0;      ///< [kg/m³], 0 or more; 0 in air
  RigidBody payload;                  ///< what the arm carries, in the tool's frame
  TipFrame frame = TipFrame::kWorld;  ///< axes along which the wrench is given
  int num_threads = 0;

  /// \throw std::invalid_argument
  void check() const;
};

/// Force and moment that the tool exerts on its surroundings, at the tool centre point [N, N m].
using Wrenches = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>>;

/// Joint torques [N m] (sliding joints: forces [N]), (N, n), that the drives hold when the arm
/// is at rest: Jᵀ wrench, against the weight of every link and of the payload, less the buoyancy
/// of the volumes given. Positive along the coordinate. A mimic joint's torque is added to its
/// leader's, times its multiplier.
/// `wrenches` has no row (nothing is pushed), one for all poses, or one a pose.
/// \throw std::invalid_argument as check_joint_values does, and for wrenches of another count or
///        that are not finite.
std::vector<double> statics(const Arm& arm, JointView q, Wrenches wrenches,
                            const StaticsOptions& options = {});

}  // namespace bathyal
