// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/identify/checks/internal/limits.hpp"
#include "bathyal/identify/fit/arm_fit.hpp"

// Rows that contradict the others.

namespace bathyal::identify {

struct OutlierSearch {
  std::vector<Outlier> outliers;  ///< by row
  bool refitted = false;          ///< the arm was estimated again, robustly
  /// No arm near nominal agrees with most rows: no outlier is reported.
  bool no_consensus = false;
  Eigen::VectorXd x;                        ///< of all parameters, without the outliers
  std::vector<double> observation_weights;  ///< (N,) 1, or almost 0 for an outlier
  /// (3, n) touched points by the touches alone, without known lengths or positions, if refitted.
  Eigen::Matrix3Xd points;
};

/// Finds touches, or measured positions, that contradict the others.
///
/// A row is an outlier when its deletion residual (the residual over the standard deviation that it
/// would have with the row excluded, leverage included) is beyond what chance gives to one fit in a
/// hundred, and above 6. Least squares masks gross errors: it bends towards them and spreads them
/// over good rows, or it folds the arm until the tip hardly moves, which agrees with everything. So
/// where residuals are far from normal, or the arm is far from nominal, it is estimated again from
/// nominal, with loose priors, without known lengths or positions: first with bounded influence of
/// every row (Huber, then Tukey's biweight: Huber, Ronchetti 2009), then by least squares of the
/// rows that pass the test, until these stay the same.
OutlierSearch find_outliers(const ArmResiduals& fitted, const Eigen::VectorXd& x);

}  // namespace bathyal::identify
