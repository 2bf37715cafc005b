// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/identify/fit/arm_fit.hpp"

namespace bathyal {

/// Checks a fit and writes the result into its `outliers`, `structure_p` and `warnings`.
/// \return those of the warnings that apply whatever effects are considered
std::vector<std::string> run_checks(const Measurement& measurement, const ArmResiduals& system,
                                    const Arm& nominal, ArmFit& fit);

}  // namespace bathyal
