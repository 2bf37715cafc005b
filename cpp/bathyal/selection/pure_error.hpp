// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "bathyal/selection/decisions.hpp"
#include "bathyal/selection/model.hpp"

namespace bathyal::selection {

/// What replicates of an observation differ by, without any model.
struct PureError {
  double squares = 0.0;  ///< about the mean of each set of replicates
  double dof = 0.0;
  int sets = 0;
  bool is_measured() const { return dof >= Decisions::kMinPureErrorDof && squares > 0.0; }
};

/// `values`: the rows of each observation, none of an excluded one; `replicate`: its number.
PureError pure_error(const std::vector<Eigen::VectorXd>& values, const std::vector<int>& replicate);

/// Residual variance against that between replicates of an observation (pure error).
struct PureErrorTest {
  double dof = 0.0;        ///< of the pure error
  double variance = 0.0;   ///< pure error, per row
  double p = 1.0;          ///< of the lack of fit, by Fisher's F; 1 with too few replicates
  double explained = 0.0;  ///< sum of squares by the lack of fit, less pure error
};

/// The lack-of-fit F test (Fisher 1922; Draper and Smith 1998, section 2.1): lack of fit of any
/// form makes the residuals larger than replicates differ. `basis`: (M, b) orthonormal columns of
/// all that was fitted, `dof` its residual degrees of freedom; `weights`: (N,), 0 of excluded
/// observations.
PureErrorTest test_pure_error(const Model& model, const Eigen::MatrixXd& basis, double dof,
                              const Eigen::VectorXd& weights);

}  // namespace bathyal::selection
