// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/geometry/shared_array.hpp"

namespace bathyal {

/// world_from_vehicle = Rz(yaw) Ry(pitch) Rx(roll) [rad]: yaw counterclockwise from the world's x,
/// pitch positive bow down.
Eigen::Matrix3d rotation_of_angles(const Vec3& roll_pitch_yaw);

/// Positions in the world, from 0 at the first time on: velocities in the vehicle's frame [m/s],
/// turned by their attitudes, integrated by the trapezoidal rule.
/// \param attitude one row of roll, pitch, yaw a time [rad]
/// \throw std::invalid_argument for no row, times that do not rise, another count of rows, or a
///        number that is not finite
PointMatrix dead_reckon(const std::vector<double>& time, const PointMatrix& attitude,
                        const PointMatrix& velocity);

}  // namespace bathyal
