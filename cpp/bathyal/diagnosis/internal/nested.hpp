// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bathyal/diagnosis/diagnose.hpp"
#include "bathyal/selection/folds.hpp"

namespace bathyal::diagnosis {

/// A diagnosis of some rows, and what its model predicts of all.
struct Prediction {
  Verdict verdict = Verdict::kNone;
  std::vector<std::pair<std::string, int>> found;  ///< effect and joint of each
  Eigen::VectorXd errors;  ///< (N,) 3-D [m]; NaN: the rows do not determine them
};

/// The diagnosis of the rows that a fold leaves, ascending.
using DiagnoseRows = std::function<Prediction(const std::vector<int>& rows, int fold)>;

/// Nested cross-validation (Stone 1974): everything, names and orders of waves too, is chosen anew
/// without each fold, which the result predicts. Fills `report.held_out.nested` and
/// `nested_folds` of the effects.
void cross_validate_whole(const selection::Folds& folds, const std::vector<int>& outliers,
                          const DiagnoseRows& diagnose_rows, Diagnosis& report);

}  // namespace bathyal::diagnosis
