// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/vehicle/vehicle.hpp"

// A vehicle's motion as numbers that Runge–Kutta's method adds: position, quaternion (x, y, z, w),
// velocity.

namespace bathyal::vehicle {

using FlatMotion = Eigen::Matrix<double, 13, 1>;

inline FlatMotion flat_of(const VehicleState& state) {
  const Eigen::Quaterniond turn(state.world_from_vehicle.linear());
  FlatMotion flat;
  flat << state.world_from_vehicle.translation(), turn.coeffs(), state.velocity;
  return flat;
}

inline VehicleState motion_of(const FlatMotion& flat) {
  const Eigen::Quaterniond turn(flat.segment<4>(3));
  VehicleState state;
  state.world_from_vehicle.linear() = turn.normalized().toRotationMatrix();
  state.world_from_vehicle.translation() = flat.head<3>();
  state.velocity = flat.tail<6>();
  return state;
}

inline FlatMotion rate_of(const FlatMotion& flat, const VehicleState& state,
                          const Vec6& acceleration) {
  const Eigen::Quaterniond turn(flat.segment<4>(3));
  const Vec3 spin = state.velocity.tail<3>();
  const Eigen::Quaterniond turned = turn * Eigen::Quaterniond(0.0, spin.x(), spin.y(), spin.z());
  FlatMotion rate;
  rate << state.world_from_vehicle.linear() * state.velocity.head<3>(), 0.5 * turned.coeffs(),
      acceleration;
  return rate;
}

/// The attitude after a small turn in the vehicle's frame.
inline Eigen::Matrix3d turned(const Eigen::Matrix3d& attitude, const Vec3& turn) {
  const double angle = turn.norm();
  if (!(angle > 0.0)) return attitude;
  return attitude * Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
}

}  // namespace bathyal::vehicle
