// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/identify/fit/arm_fit.hpp"

namespace bathyal {

/// Looks at a fit as a doubting reader would, and writes what is wrong with it into its `outliers`,
/// `structure_p` and `warnings`. For use inside the room.
/// \return those of the warnings that stand whatever else than geometry may be wrong
std::vector<std::string> examine(const Measurement& measurement, const ArmSystem& system,
                                 const Arm& nominal, ArmFit& fit);

}  // namespace bathyal
