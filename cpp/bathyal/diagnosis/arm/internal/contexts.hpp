// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "bathyal/diagnosis/diagnosis.hpp"
#include "bathyal/effects/effect.hpp"

// What an arm's residuals may depend on in any way, and along which directions.

namespace bathyal::diagnosis {

/// Coordinates in which like poses should have unlike residuals.
struct Contexts {
  std::vector<Dependence> dependence;
  std::vector<Eigen::MatrixXd> coordinates;  ///< (N, d) of each, columns of standard deviation 1
};

/// All joints together, each, and each two; the tip's `position` (3, N) in the base frame, and its
/// `range` (N,) from the instrument, where they have columns; the order of the rows, the last move
/// of each joint; each covariate.
Contexts make_contexts(const EffectData& data, const Eigen::Matrix3Xd& position,
                       const Eigen::VectorXd& range);

/// Directions: the base's axes, the tool's axes, the line from the instrument, each joint.
inline constexpr int kBaseAxes = 0, kToolAxes = 1, kSight = 2, kFirstJoint = 3;

/// "what moves joint 3 with joints 1 and 2": the dependence of a direction on a context.
std::string describe(int direction, const Dependence& context);

}  // namespace bathyal::diagnosis
