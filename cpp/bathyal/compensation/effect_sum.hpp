// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/arm/kinematics.hpp"
#include "bathyal/effects/effect.hpp"

// What found effects add up to at each pose, and the chain that carries it. For use inside the
// room.

namespace bathyal {

/// The sum of what effects move.
struct Correction {
  JointMatrix q;  ///< (N, n) added to the coordinates
  /// (N, 6) of each frame, joints + 2 of them: shift and turn; empty where nothing acts.
  std::vector<RowMatrix> frames;
  Eigen::VectorXd lengths;    ///< (N,) share of all a and d; empty where nothing acts
  std::vector<char> chained;  ///< (N,) whether frames or lengths move in that row

  Correction(const Arm& arm, Index rows);
  /// The actions of one effect, [p] those of parameter p, by their values.
  void add(const std::vector<std::vector<Action>>& actions, const Eigen::VectorXd& values);

 private:
  void add(const Action& action, double value);
};

/// Every frame of a corrected arm at one pose, in the world.
struct CorrectedFrames {
  /// joints + 2 of them, as Action::index counts: [0] the base, [k] behind row k - 1, the last the
  /// flange; before what effects put in there, and behind it.
  std::vector<Pose> before;
  std::vector<Pose> behind;
  Pose world_from_tool = Pose::Identity();

  /// The frame that row k starts from.
  Pose start_of_row(const Arm& arm, std::size_t k) const {
    return k == 0 ? behind[0] * arm.root() : behind[k];
  }
};

/// base · F0 · root · row 1 · F1 · … · row m · Fm · flange · F(m+1) · tool with
/// F = translation(shift) · rotation(exp(turn)), rows at q + correction, their lengths times
/// 1 + share.
void compute_corrected_frames(const Arm& arm, const double* q, const Correction& correction,
                              Index row, CorrectedFrames& frames);

/// d tip / d q, (6, n) in the world, of the pose `frames`; `by_joint` [j] is how the correction
/// changes with coordinate j.
Eigen::MatrixXd corrected_jacobian(const Arm& arm, const CorrectedFrames& frames,
                                   const Correction& correction,
                                   const std::vector<Correction>& by_joint, Index row);

}  // namespace bathyal
