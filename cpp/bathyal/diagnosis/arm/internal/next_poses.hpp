// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/diagnosis/arm/internal/model.hpp"
#include "bathyal/selection/selection.hpp"

namespace bathyal::diagnosis {

/// Poses (m, n) at which explanations that these data cannot tell apart foretell tips that lie
/// furthest from each other. The subject stands where it stood when they are found.
RowMatrix next_poses(ArmModel& arm_model, const selection::SelectionResult& found,
                     double rival_odds, int count);

}  // namespace bathyal::diagnosis
