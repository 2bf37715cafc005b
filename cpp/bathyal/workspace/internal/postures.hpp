// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/arm/inverse.hpp"
#include "bathyal/base/random.hpp"

namespace bathyal::workspace {

/// Coordinates of one posture.
using JointRow = Eigen::RowVectorXd;

/// A posture drawn within the limits; where a coordinate has none on a side, to half a turn beyond
/// `middle` and the other limit (of sliding joints: the arm's length, at least 1 m).
JointRow drawn_posture(const Arm& arm, const JointRow& middle, RandomStream& random);

/// The same around zero.
JointRow drawn_posture(const Arm& arm, RandomStream& random);

/// What inverse kinematics reaches.
struct ReachedPostures {
  JointMatrix q;         ///< those reached, in the order of their starts
  InverseStatus status;  ///< kReached, or where none was, that of the first start
};

/// A tool pose, in the frame of the arm's base, from each of the starts, (S, n).
ReachedPostures reached_postures(const Arm& arm, const Pose& target, const JointMatrix& starts,
                                 const InverseOptions& options);

}  // namespace bathyal::workspace
