// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/touch_planning/internal/tip_model.hpp"
#include "bathyal/touch_planning/plan_touches.hpp"

// Poses that a plan may choose from. For use inside the room.

namespace bathyal {

/// Rows of `q` that limits, floor and `feasible` allow.
RowMatrix allowed_rows(const Arm& arm, const RowMatrix& q, const PlanTouchesOptions& options);

/// Poses drawn at random that are allowed: `forecast.workspace_poses` of them, fewer where little
/// is allowed.
/// \throw std::invalid_argument where nothing is
RowMatrix allowed_workspace(const Arm& arm, const PlanTouchesOptions& options);

/// Allowed poses with the tip on `point`, to rounding, each once: `options.candidates` of them, or
/// as many as were found (three joints have a few).
/// \throw std::invalid_argument that names point `number` where there is none
RowMatrix poses_on_point(const Arm& arm, const TouchModel& model, const Vec3& point, int number,
                         const PlanTouchesOptions& options);

/// (3, k) points, to the centimetre, that most of the poses drawn at random can be brought onto,
/// apart from each other; fewer than asked for where no more are found.
/// \throw std::invalid_argument where there is none
Eigen::Matrix3Xd choose_points(const Arm& arm, const TouchModel& model, const RowMatrix& workspace,
                               const PlanTouchesOptions& options);

}  // namespace bathyal
