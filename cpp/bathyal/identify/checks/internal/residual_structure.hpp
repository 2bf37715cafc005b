// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/identify/model/arm_residuals.hpp"

// Whether what is left follows the joints. For use inside the room.

namespace bathyal {

/// How much of the residuals low harmonics of the joints explain.
struct JointStructure {
  double p = 1.0;       ///< probability that noise alone follows the joints as well; 1: not asked
  double share = 0.0;   ///< of the residuals' variance, less what chance would explain; 0 … 1
  int coordinate = -1;  ///< the joint that explains most by itself
  double joint_share = 0.0;  ///< its share
};

/// Fisher's F test of the position residuals at `x`, rows weighed by `trust`, against errors that
/// follow one joint each: cos q and sin q of a turning joint, the first two Legendre polynomials
/// along a sliding one, each along the three axes of the base. (Gravity on elastic links and gears
/// and eccentric encoders have such parts; harmonics about the joints' own axes alone explain less
/// of real arms.) What the arm's parameters can do to first order is taken out of both before, so
/// that under normal noise `p` is uniform.
///
/// Every pose counts as an independent one. Of more than 2000, every k-th is asked.
JointStructure find_structure(const ArmSystem& system, const Eigen::VectorXd& x,
                              const std::vector<double>& trust);

}  // namespace bathyal
