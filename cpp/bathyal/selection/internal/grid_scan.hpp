// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/selection/model.hpp"

namespace bathyal::selection {

/// A term and its gain: the log evidence of CandidateSet::evaluate, without ln(multiplicity).
struct ScannedTerm {
  int term = 0;
  double gain = 0.0;       ///< in log evidence
  double explained = 0.0;  ///< sum of squares
  double width = 0.0;      ///< columns
};

/// The gain of each of `terms`, in their order, given a model with the orthonormal `basis`. Columns
/// are made a few at a time: memory does not grow with the number of terms.
std::vector<ScannedTerm> scan(const Model& model, const std::vector<int>& terms,
                              const Eigen::MatrixXd& basis, const Eigen::VectorXd& residual,
                              double dof, int num_threads);

/// The best `count` local maxima of a family of terms ordered by one setting: the neighbours of a
/// maximum describe the same.
std::vector<int> peaks(const std::vector<ScannedTerm>& family, int count);

}  // namespace bathyal::selection
