// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/arm/arm.hpp"
#include "bathyal/effects/measurements.hpp"

namespace bathyal::diagnosis {

/// The longest step [rad] of which every logged value of every revolute joint is a whole multiple;
/// 0 when there is none.
double quantisation_step(const RowMatrix& q, const Arm& arm);

}  // namespace bathyal::diagnosis
