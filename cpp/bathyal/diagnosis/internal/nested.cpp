// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/internal/nested.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bathyal::diagnosis {

void cross_validate_whole(const selection::Folds& folds, const std::vector<int>& outliers,
                          const DiagnoseRows& diagnose_rows, Diagnosis& report) {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  HeldOut::Nested& out = report.held_out.nested;
  const auto rows = static_cast<int>(folds.fold_of.size());
  out.folds = folds.count;
  out.after = Eigen::VectorXd::Constant(rows, kNothing);
  for (int fold = 0; fold < folds.count; ++fold) {
    std::vector<int> own, others;
    for (int i = 0; i < rows; ++i) (folds.fold_of[i] == fold ? own : others).push_back(i);
    const Prediction prediction = diagnose_rows(others, fold);
    out.after(own) = prediction.errors(own);
    out.verdicts.push_back(prediction.verdict);
    for (NamedEffect& effect : report.effects) {
      const std::pair same(effect.name, effect.joint);
      const auto& found = prediction.found;
      effect.nested_folds += std::find(found.begin(), found.end(), same) == found.end() ? 0 : 1;
    }
  }
  for (const int row : outliers) out.after[row] = kNothing;
  double squares = 0.0, count = 0.0;
  for (const double error : out.after) {
    if (std::isnan(error)) continue;
    squares += error * error;
    count += 1.0;
  }
  out.rms = count > 0.0 ? std::sqrt(squares / count) : kNothing;
}

}  // namespace bathyal::diagnosis
