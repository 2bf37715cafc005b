// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/estimation/rank.hpp"
#include "bathyal/identify/model/arm_residuals.hpp"

// Observability of the parameters of an arm by touches or tracked poses.

namespace bathyal {

/// Directions are of all parameters, in units of their scale.
struct Observability {
  RankReport rank;  ///< of all parameters, by the data alone
  Eigen::MatrixXd
      null_space;  ///< (P, k) changes of the free parameters that the data do not observe
  Eigen::MatrixXd undetermined;  ///< (P, l) those of them that no prior determines either
};

/// Evaluated at `x` for consistent touches.
Observability observe(const ArmResiduals& system, const Eigen::VectorXd& x);

/// Constraints that keep `undetermined` directions at nominal.
std::vector<LinearConstraint> undetermined_constraints(const Eigen::MatrixXd& undetermined,
                                                       const std::vector<Parameter>& parameters);

/// Covariance of the free parameters (free, free), in units of their scale, for consistent touches;
/// without `undetermined` directions.
Eigen::MatrixXd free_covariance(const ArmResiduals& system, const Eigen::VectorXd& x,
                                const Eigen::MatrixXd& undetermined);

/// The joint values nearest to those recorded at which every tip is where it should be, as in
/// errors-in-variables: scatter of touches would otherwise count as information on the scale. Of
/// tracked poses: those recorded.
RowMatrix consistent_joints(const ArmResiduals& system, const Eigen::VectorXd& x);

}  // namespace bathyal
