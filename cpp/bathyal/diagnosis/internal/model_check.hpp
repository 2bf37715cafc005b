// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/diagnosis/arm/internal/model.hpp"
#include "bathyal/diagnosis/diagnose.hpp"

namespace bathyal::diagnosis {

/// Whether the corrected arm that a diagnosis hands out does what its report says: evaluated at the
/// joint values that taught it, it must leave the residuals that are reported. Rows that lack a
/// covariate of the caller's own (NaN) are not compared: there the model leaves out what looks at
/// it.
/// \throw Error where it does not
void check_model(const Diagnosis& found, const ArmModel& arm_model, const Measurement& measurement,
                 int num_threads);

}  // namespace bathyal::diagnosis
