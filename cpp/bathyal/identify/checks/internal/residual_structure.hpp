// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/identify/model/arm_residuals.hpp"

// Whether residuals depend on the joints.

namespace bathyal::identify {

/// Share of the residuals that low harmonics of the joints explain.
struct ResidualStructure {
  double p = 1.0;            ///< probability of as much structure by noise alone; 1: not tested
  double share = 0.0;        ///< of the variance of the residuals, adjusted for chance; 0 … 1
  int coordinate = -1;       ///< the joint that explains most by itself
  double joint_share = 0.0;  ///< its share
};

/// Fisher's F test of the position residuals at `x`, with rows weighted by `weights`, against
/// errors that depend on one joint each: cos q and sin q of a revolute joint, the first two
/// Legendre polynomials along a prismatic one, each along the three axes of the base. (Gravity on
/// elastic links and gears and eccentric encoders have such components; harmonics about the axes of
/// the joints alone explain less of real arms.) The column space of the Jacobian is projected out
/// of both before, so that under normal noise `p` is uniform.
///
/// Every pose counts as an independent one. Of more than 2000, every k-th is used.
ResidualStructure test_residual_structure(const ArmResiduals& system, const Eigen::VectorXd& x,
                                          const std::vector<double>& weights);

}  // namespace bathyal::identify
