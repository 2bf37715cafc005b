// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/diagnosis/arm/internal/model.hpp"
#include "bathyal/diagnosis/diagnose.hpp"
#include "bathyal/selection/selection.hpp"

namespace bathyal::diagnosis {

/// The result of a selection in metres and names, with its verdict: all of a Diagnosis but the
/// warnings of the record and the next poses.
Diagnosis report(const ArmModel& arm_model, const Measurement& measurement, const Arm& nominal,
                 const selection::SelectionResult& found, const DiagnoseOptions& options);

}  // namespace bathyal::diagnosis
