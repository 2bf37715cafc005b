// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/workspace/motion/internal/plan_check.hpp"

namespace bathyal::workspace {

using Postures = std::vector<JointRow>;

/// Postures joined by straight motions that are free, from the start to one of the goals; empty
/// where the checks were spent before one was found. `attempt` chooses another random stream.
Postures find_path(PlanCheck& check, const JointRow& start, const Postures& goals, int attempt);

/// The same, shorter: by motions straight between points along it, where they are free.
Postures shortened(PlanCheck& check, Postures path, int attempt);

}  // namespace bathyal::workspace
