// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/identify/model/chain_derivatives.hpp"

namespace bathyal {

/// The joint values nearest to `q` at which `miss(tip)`, a shift in the world, is nothing: by
/// least joint motion, as hands correct a touch. `q` itself where that asks too much of a joint.
/// `row` is that of
/// effects' actions. `frames` is scratch. For use inside the room.
template <class Miss>
Eigen::VectorXd nearest_pose(const TipWalk& walk, const Eigen::VectorXd& q, Index row, int tool,
                             int station, WalkFrames& frames, const Miss& miss) {
  constexpr int kMostSteps = 10;
  constexpr double kFarTurn = 0.5;    // [rad], [m]
  constexpr double kOnPoint = 1e-12;  // [m]
  Eigen::VectorXd joints = q;
  for (int step = 0; step < kMostSteps; ++step) {
    Vec3 tip;
    const Eigen::Matrix3Xd jacobian =
        walk.joint_jacobian(joints.data(), row, tool, station, frames, tip);
    const Vec3 shift = miss(tip);
    if (shift.norm() < kOnPoint) break;
    Eigen::Matrix3d square = jacobian * jacobian.transpose();
    square.diagonal().array() += 1e-12 * square.trace();
    joints += jacobian.transpose() * square.ldlt().solve(shift);
  }
  return (joints - q).cwiseAbs().maxCoeff() < kFarTurn ? joints : q;
}

}  // namespace bathyal
