// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/diagnosis/arm/internal/model.hpp"
#include "bathyal/diagnosis/diagnose.hpp"
#include "bathyal/selection/selection.hpp"

namespace bathyal::diagnosis {

/// What an examination found, in metres, names and words, with its verdict: all of a Diagnosis but
/// the warnings of the record and the next poses. For use inside the room.
Diagnosis report(const ArmModel& arm_model, const Measurement& measurement, const Arm& nominal,
                 const selection::SelectionResult& found, const DiagnoseOptions& options);

}  // namespace bathyal::diagnosis
