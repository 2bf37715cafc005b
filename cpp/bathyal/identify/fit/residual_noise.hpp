// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/identify/identify_options.hpp"
#include "bathyal/identify/model/arm_residuals.hpp"

namespace bathyal {

/// Noise of positions and rotations, each by its own residuals: σ² = Σ r² / (free rows - `taken`).
/// `squares`: sums of squares in units of the present noise; `taken`: degrees of freedom that the
/// parameters use up. What `options` give stays, and what has no degree of freedom.
Noise residual_noise(const ArmResiduals& system, const Eigen::Array2d& squares,
                     const Eigen::Array2d& taken, const IdentifyOptions& options);

/// The larger of the two.
double relative_change(const Noise& noise, const Noise& old);

}  // namespace bathyal
