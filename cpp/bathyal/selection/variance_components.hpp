// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "bathyal/selection/folds.hpp"
#include "bathyal/selection/model.hpp"

// Heteroscedastic noise.

namespace bathyal::selection {

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

/// `basis` is orthonormal, of all that was fitted; `noise` of a position row [m]. `weights` are 0
/// or 1. Without folds nothing is held out.
VarianceComponentFit fit_variance_component(const VarianceComponent& term, const Linearization& at,
                                            const Eigen::MatrixXd& basis,
                                            const Eigen::VectorXd& weights, double noise,
                                            const Folds& folds = {});

}  // namespace bathyal::selection
