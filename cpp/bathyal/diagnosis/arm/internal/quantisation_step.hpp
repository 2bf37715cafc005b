// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/arm/arm.hpp"
#include "bathyal/effects/measurements.hpp"

namespace bathyal::diagnosis {

/// The step [rad] of which every logged value of every turning joint is a whole multiple; 0 when
/// there is none. The longest one: what divides it divides them too.
double quantisation_step(const RowMatrix& q, const Arm& arm);

}  // namespace bathyal::diagnosis
