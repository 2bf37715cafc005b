// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "bathyal/arm/kinematics.hpp"

namespace bathyal::workspace {

/// Times for rows that are joined by straight lines, from 0 [s], rising: each leg takes as long as
/// `least_duration` says or longer, and by finite differences the rate of each coordinate along a
/// leg is within `velocity`, its change from leg to leg within `acceleration` times the time from
/// the middle of one to that of the next. It begins and ends at rest: half the first and last leg
/// are there to get to their rate. No row is moved; where the legs turn, it goes slower.
std::vector<double> row_times(const JointMatrix& rows, std::span<const double> velocity,
                              std::span<const double> acceleration,
                              std::span<const double> least_duration);

}  // namespace bathyal::workspace
