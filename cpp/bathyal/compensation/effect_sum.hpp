// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/arm/kinematics.hpp"
#include "bathyal/effects/effect.hpp"

// The sum of the effects at each pose, and the kinematic chain perturbed by it.

namespace bathyal {

/// The sum of the perturbations of all effects.
struct EffectSum {
  JointMatrix q;  ///< (N, n) added to the coordinates
  /// (N, 6) of each frame, joints + 2 of them: shift and turn; empty without perturbations.
  std::vector<RowMatrix> frames;
  Eigen::VectorXd lengths;    ///< (N,) share of all a and d; empty without perturbations
  std::vector<char> chained;  ///< (N,) whether frames or lengths are perturbed in that row

  EffectSum(const Arm& arm, Index rows);
  /// Adds the perturbations of one effect, [p] those of parameter p, times their values.
  void add(const std::vector<std::vector<Perturbation>>& perturbations,
           const Eigen::VectorXd& values);

 private:
  void add(const Perturbation& perturbation, double value);
};

/// Every frame of a corrected arm at one pose, in the world.
struct CorrectedFrames {
  /// joints + 2 of them, as Perturbation::index counts: [0] the base, [k] behind row k - 1, the
  /// last the flange; before and behind the perturbation of that frame.
  std::vector<Pose> before;
  std::vector<Pose> behind;
  Pose world_from_tool = Pose::Identity();

  /// The frame that row k starts from.
  Pose start_of_row(const Arm& arm, std::size_t k) const {
    return k == 0 ? behind[0] * arm.root() : behind[k];
  }
};

/// base · F0 · root · row 1 · F1 · … · row m · Fm · flange · F(m+1) · tool with
/// F = translation(shift) · rotation(exp(turn)), rows at q + sum, their lengths times
/// 1 + share.
void compute_corrected_frames(const Arm& arm, const double* q, const EffectSum& sum, Index row,
                              CorrectedFrames& frames);

/// d tip / d q, (6, n) in the world, of the pose `frames`; `by_joint` [j] is how the sum
/// changes with coordinate j.
Eigen::MatrixXd corrected_jacobian(const Arm& arm, const CorrectedFrames& frames,
                                   const EffectSum& sum, const std::vector<EffectSum>& by_joint,
                                   Index row);

}  // namespace bathyal
