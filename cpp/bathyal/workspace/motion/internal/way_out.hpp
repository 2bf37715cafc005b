// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/workspace/motion/internal/plan_check.hpp"

namespace bathyal::workspace {

/// Plan::way_out of a start that touches something.
JointMatrix way_out_of_contact(PlanCheck& check, const JointRow& start);

/// Plan::way_out of a start outside the limits.
JointMatrix way_out_to_limits(PlanCheck& check, const JointRow& start);

}  // namespace bathyal::workspace
