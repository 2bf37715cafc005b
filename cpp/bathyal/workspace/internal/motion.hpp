// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/workspace/internal/bodies.hpp"

namespace bathyal::workspace {

/// Workspace::check_motion.
MotionCheck first_contact(const Bodies& bodies, const Trajectory& world_from_vehicle,
                          const JointView& q, const MotionOptions& options);

}  // namespace bathyal::workspace
