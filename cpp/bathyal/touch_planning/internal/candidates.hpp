// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/touch_planning/internal/tip_model.hpp"
#include "bathyal/touch_planning/plan_touches.hpp"

// Candidate poses of a plan.

namespace bathyal::touch_planning {

/// Rows of `q` that limits, floor and `feasible` allow.
RowMatrix allowed_rows(const Arm& arm, const RowMatrix& q, const PlanTouchesOptions& options);

/// Random poses that are allowed: `forecast.workspace_poses` of them, fewer where few are allowed.
/// \throw std::invalid_argument where none is
RowMatrix allowed_workspace(const Arm& arm, const PlanTouchesOptions& options);

/// Allowed poses with the tip on `point`, to rounding errors, without repetition:
/// `options.candidates` of them, or as many as were found (three joints have a few).
/// \throw std::invalid_argument that names point `number` where there is none
RowMatrix poses_on_point(const Arm& arm, const TouchModel& model, const Vec3& point, int number,
                         const PlanTouchesOptions& options);

/// (3, k) points, rounded to centimetres, that most of the random poses can be moved onto, apart
/// from each other; fewer than requested where no more are found.
/// \throw std::invalid_argument where there is none
Eigen::Matrix3Xd choose_points(const Arm& arm, const TouchModel& model, const RowMatrix& workspace,
                               const PlanTouchesOptions& options);

}  // namespace bathyal::touch_planning
