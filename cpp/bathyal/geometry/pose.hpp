// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string_view>

#include "bathyal/geometry/shared_array.hpp"

namespace bathyal {

/// A rigid motion, named target_from_source and composed by reading:
/// world_from_tool = world_from_vehicle * vehicle_from_tool.
using Pose = Eigen::Isometry3d;

/// \throw std::invalid_argument for a matrix that is no rigid motion: not finite, a rotation that
/// is off by more than 1e-6 or left-handed, a last row other than 0 0 0 1.
void check_rigid(std::string_view name, const Pose& pose);

/// The sixteen numbers of its matrix, row by row: what arrays of poses are made of.
std::array<double, 16> row_major(const Pose& pose);

/// Of sixteen numbers as row_major gives them; that they are rigid is not checked.
Pose pose_of_rows(const double* numbers);

}  // namespace bathyal
