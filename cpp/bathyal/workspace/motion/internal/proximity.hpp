// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/workspace/internal/bodies.hpp"

namespace bathyal::workspace {

/// Two bodies that are near each other, and how their distance changes with the coordinates.
struct NearPair {
  double distance = 0.0;  ///< [m]
  int link = -1;
  int obstacle = -1;         ///< or -1, and
  int other_link = -1;       ///< of the arm's own
  Eigen::VectorXd gradient;  ///< of the distance [m/rad], [m/m]
};

/// 3 × n: the velocity of a point fixed to a link, for a unit speed of each coordinate.
Eigen::MatrixXd point_jacobian(const Arm& arm, const RowFrames& frames, int link,
                               const Vec3& point);

/// Every pair nearer than `within` in a posture. Of a capsule near an obstacle its two ends are
/// given, too: else one that lies along a surface rocks from end to end. Pairs whose axis and
/// surface touch have no direction, and no gradient is given: zeros.
std::vector<NearPair> near_pairs(const Bodies& bodies, const Posture& posture, double within,
                                 TipContact tip_contact);

}  // namespace bathyal::workspace
