// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "bathyal/selection/model.hpp"

namespace bathyal::selection {

/// Which observations are held out together: (observations,) fold numbers 0 … count - 1.
struct Folds {
  std::vector<int> fold_of;
  int count = 0;
  std::string description;  ///< a sentence
};

/// Numbers that replicates share: rows of `q` within `near` of one another in every column, by
/// single linkage.
std::vector<int> find_replicates(const Eigen::Ref<const Eigen::MatrixXd>& q, double near);

/// `wanted` folds: blocks of observations consecutive in time, or short runs spread over a list
/// without times, cut in each session alike. Replicates share a fold. Folds are whole groups where
/// observations have groups and there are enough. Sessions of fewer observations than folds are
/// dealt out over the folds. Fewer folds where there are few observations; a single one, which
/// cannot be held out, where replicates link everything.
Folds make_folds(const Observations& observations, int wanted = 10);

/// More given groups are joined to so many folds.
inline constexpr int kMostGroupFolds = 50;

/// Each given group is a fold, whatever else its observations share; of more than kMostGroupFolds
/// groups several make one. `group_of` (observations,) are numbers 0 … groups - 1.
Folds folds_of_groups(const std::vector<int>& group_of);

}  // namespace bathyal::selection
