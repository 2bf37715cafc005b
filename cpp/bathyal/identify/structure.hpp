// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/identify/arm_system.hpp"

// Whether what is left follows the joints. For use inside the room.

namespace bathyal {

/// How much of the residuals low harmonics of the joints explain.
struct Structure {
  double p = 1.0;       ///< probability that noise alone follows the joints as well; 1: not asked
  double share = 0.0;   ///< of the residuals' variance, less what chance would explain; 0 … 1
  int coordinate = -1;  ///< the joint that explains most by itself
  double joint_share = 0.0;  ///< its share
};

/// Fisher's F test of the position residuals at `x`, rows weighed by `trust`, against errors of
/// each joint that repeat with it: cos q, sin q, cos 2q, sin 2q of a turning joint (eccentric
/// encoders, gears, gravity on an elastic joint), Legendre polynomials up to the fourth along a
/// sliding one. What the arm's parameters themselves can do to first order is taken out of both
/// before, so that the probability is exact for normal noise: under it `p` is uniform.
///
/// Every pose counts as an independent one. Of more than 2000, every k-th is asked.
Structure find_structure(const ArmSystem& system, const Eigen::VectorXd& x,
                         const std::vector<double>& trust);

}  // namespace bathyal
