// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/identify/model/arm_residuals.hpp"
#include "bathyal/selection/model.hpp"

namespace bathyal {

/// The rows of an arm as tests of `selection` read them: `residual` (M,) and `jacobian` (M, k) by
/// the arm's parameters, to which three columns are added for each touched point, whose position is
/// free, in place of the centroids.
selection::Linearization to_linearization(const ArmResiduals& system, Eigen::VectorXd residual,
                                          const Eigen::Ref<const Eigen::MatrixXd>& jacobian);

}  // namespace bathyal
