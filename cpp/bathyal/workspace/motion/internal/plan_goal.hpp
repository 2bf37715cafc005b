// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bathyal/workspace/motion/internal/plan_check.hpp"

namespace bathyal::workspace {

/// Postures that reach a goal and touch nothing, the nearest to the start first; or why none.
struct GoalPostures {
  std::vector<JointRow> q;
  PlanStatus status = PlanStatus::kSolved;
  std::string reason;
};

/// \throw std::invalid_argument as plan_motion
void check_goal(const Arm& arm, const PlanGoal& goal);

GoalPostures goal_postures(PlanCheck& check, const JointRow& start, const PlanGoal& goal);

}  // namespace bathyal::workspace
