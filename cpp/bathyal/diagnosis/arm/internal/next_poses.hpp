// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/diagnosis/arm/internal/model.hpp"
#include "bathyal/selection/selection.hpp"

namespace bathyal::diagnosis {

/// Poses (m, n) at which alternatives that these data cannot distinguish predict tips furthest from
/// each other. The model is left fitted with the selected terms.
RowMatrix next_poses(ArmModel& arm_model, const selection::SelectionResult& found,
                     double rival_odds, int count);

}  // namespace bathyal::diagnosis
