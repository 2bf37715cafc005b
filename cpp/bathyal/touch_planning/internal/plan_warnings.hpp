// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bathyal/touch_planning/plan_touches.hpp"

namespace bathyal::touch_planning {

/// The predicted gain of one more known distance.
struct DistanceAdvice {
  int first = 0;
  int second = 0;
  double worst_tip_std = 0.0;  ///< [m]
};

/// Warnings about a plan of `count` touches, as sentences.
std::vector<std::string> warnings_of(const Arm& arm, const TouchPlan& plan, int count,
                                     const PlanTouchesOptions& options,
                                     const std::optional<DistanceAdvice>& advice);

}  // namespace bathyal::touch_planning
