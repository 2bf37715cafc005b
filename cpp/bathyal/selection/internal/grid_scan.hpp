// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/selection/model.hpp"

namespace bathyal {

/// A form and what it would add: the log evidence of Pool::judge, without ln(trials).
struct ScannedForm {
  int form = 0;
  double gain = 0.0;       ///< in log evidence
  double explained = 0.0;  ///< sum of squares
  double width = 0.0;      ///< columns
};

/// What each of `forms` adds to a model that `basis` (orthonormal) spans, in their order. Columns
/// are made a few at a time: memory does not grow with the number of forms.
std::vector<ScannedForm> scan(const Subject& subject, const std::vector<int>& forms,
                              const Eigen::MatrixXd& basis, const Eigen::VectorXd& misfit,
                              double freedom, int num_threads);

/// The best `count` of a family whose forms stand in the order of one number: only peaks, since the
/// neighbours of a peak say the same.
std::vector<int> peaks(const std::vector<ScannedForm>& family, int count);

}  // namespace bathyal
