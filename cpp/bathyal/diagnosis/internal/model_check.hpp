// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/diagnosis/arm/internal/model.hpp"
#include "bathyal/diagnosis/diagnose.hpp"

namespace bathyal::diagnosis {

/// (3, N) tips of the model that was found for rows of a record, each by the tool and the station
/// of its row. The measurement may have rows that the model was not fitted to.
Eigen::Matrix3Xd tips_of_model(const Diagnosis& found, const ArmModel& arm_model,
                               const Measurement& measurement, const Covariates& covariates,
                               int num_threads);

/// Checks that the corrected arm of a diagnosis, evaluated at the recorded joint values, has the
/// residuals that are reported. Rows that lack a covariate of the caller's own (NaN) are not
/// compared: there the model omits the effects that depend on it.
/// \throw Error where it does not
void check_model(const Diagnosis& found, const ArmModel& arm_model, const Measurement& measurement,
                 int num_threads);

}  // namespace bathyal::diagnosis
