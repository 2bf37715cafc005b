// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bathyal/touch_planning/plan_touches.hpp"

namespace bathyal {

/// What one more known distance would bring.
struct DistanceAdvice {
  int first = 0;
  int second = 0;
  double worst_tip_std = 0.0;  ///< [m]
};

/// What the one who asked for `count` touches should know, in sentences. For use inside the room.
std::vector<std::string> warnings_of(const Arm& arm, const TouchPlan& plan, int count,
                                     const PlanTouchesOptions& options,
                                     const std::optional<DistanceAdvice>& advice);

}  // namespace bathyal
