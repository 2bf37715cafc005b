// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "bathyal/selection/folds.hpp"
#include "bathyal/selection/model.hpp"

// Outliers among the observations, and heteroscedastic noise.

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

/// A variance component, fitted by maximum likelihood.
struct VarianceComponentFit {
  int term = 0;
  double parameter = 0.0;      ///< in its unit
  double std = 0.0;            ///< of it
  double gain = 0.0;           ///< log likelihood over that of homoscedastic noise
  double held_out_gain = 0.0;  ///< the same on held-out folds
  double share = 0.0;          ///< of the noise's variance
  double ratio = 0.0;          ///< Model::set_variance_ratios
  double multiplicity = 1.0;   ///< of tests, for which `p` is corrected
  /// Of so large a gain in homoscedastic noise, of a variance that cannot be negative (Self and
  /// Liang 1987).
  double p() const {
    return std::min(1.0, 0.5 * multiplicity * std::erfc(std::sqrt(std::max(gain, 0.0))));
  }
};

/// `basis` as above; `noise` of a position row [m]. `weights` are 0 or 1. Without folds nothing is
/// held out.
VarianceComponentFit fit_noise(const VarianceComponent& term, const Linearization& at,
                               const Eigen::MatrixXd& basis, const Eigen::VectorXd& weights,
                               double noise, const Folds& folds = {});

}  // namespace bathyal::selection
