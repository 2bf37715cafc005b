// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/identify/model/arm_residuals.hpp"

namespace bathyal {

/// The estimate of touches without the bias of their scale, from the least-squares solution
/// `minimum` (all parameters).
///
/// Scatter is recorded in joint values, and a smaller arm maps it to a smaller one: least squares
/// underestimates the scale by (degrees of freedom) · (relative std of the scale)², many std where
/// hundreds of touches rely on a short known distance. The derivatives at consistent joint values
/// do not depend on the scatter, so that steps along them converge to the observed scale. For data
/// that no arm fits the steps may grow: the least-squares solution is then kept. `options` as of
/// the fit.
Eigen::VectorXd remove_scale_bias(const ArmResiduals& system, const Eigen::VectorXd& minimum,
                                  const LeastSquaresOptions& options = {});

}  // namespace bathyal
