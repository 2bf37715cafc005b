// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/identify/model/chain_derivatives.hpp"

namespace bathyal {

/// The joint values nearest to `q` at which `miss(tip)`, a shift in the world, is zero: by least
/// joint motion, as in the manual correction of a touch. `q` itself where a joint would have to
/// move too far. `row` is the row of perturbations. `frames` is scratch.
template <class Miss>
Eigen::VectorXd nearest_pose(const ChainDerivatives& chain, const Eigen::VectorXd& q, Index row,
                             int tool, int station, ChainFrames& frames, const Miss& miss) {
  constexpr int kMaxSteps = 10;
  constexpr double kFarTurn = 0.5;    // [rad], [m]
  constexpr double kOnPoint = 1e-12;  // [m]
  Eigen::VectorXd joints = q;
  for (int step = 0; step < kMaxSteps; ++step) {
    Vec3 tip;
    const Eigen::Matrix3Xd jacobian =
        chain.joint_jacobian(joints.data(), row, tool, station, frames, tip);
    const Vec3 shift = miss(tip);
    if (shift.norm() < kOnPoint) break;
    Eigen::Matrix3d square = jacobian * jacobian.transpose();
    square.diagonal().array() += 1e-12 * square.trace();
    joints += jacobian.transpose() * square.ldlt().solve(shift);
  }
  return (joints - q).cwiseAbs().maxCoeff() < kFarTurn ? joints : q;
}

}  // namespace bathyal
