// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/selection/model.hpp"

// Outliers among the observations.

namespace bathyal::selection {

/// An observation against its prediction from the others.
struct ObservationTest {
  double distance = 0.0;  ///< squared deleted residual over its variance, per row
  double p = 1.0;         ///< by Fisher's F, of this observation alone
  double rows = 0.0;      ///< of it that the others predict
  double square = 0.0;    ///< squared deleted residual in units of its spread, without noise
  double error = 0.0;     ///< length of the deleted residual [noise], at weight 1
};

/// Each observation's rows against a fit to all others (externally studentized residuals).
/// `weights` is 0 for those that the fit excludes already.
std::vector<ObservationTest> test_observations(const Linearization& at,
                                               const Eigen::MatrixXd& basis,
                                               const Eigen::VectorXd& weights, double dof);

/// `weights` with 0 for outliers, and 1 for excluded observations that are none any more.
Eigen::VectorXd exclude_outliers(const Linearization& at, const Eigen::MatrixXd& basis,
                                 const Eigen::VectorXd& weights, double dof);

}  // namespace bathyal::selection
