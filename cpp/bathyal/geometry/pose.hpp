// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "bathyal/geometry/shared_array.hpp"

namespace bathyal {

/// A rigid motion, named target_from_source and composed by reading:
/// world_from_tool = world_from_vehicle * vehicle_from_tool.
using Pose = Eigen::Isometry3d;

}  // namespace bathyal
