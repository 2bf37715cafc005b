// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "bathyal/workspace/motion/internal/tip_step.hpp"
#include "bathyal/workspace/motion/stepping.hpp"

namespace bathyal::workspace {

/// Rows that bring the tip towards a target, and how they end.
struct TipMotion {
  enum class End {
    kReached,
    kHalted,      ///< no step brings the tip nearer
    kContact,     ///< the next row touches something, or the start does
    kBeyondLimit  ///< the next row lies outside the limits, or the start does
  };
  End end = End::kReached;
  JointMatrix rows;
  int link = -1, obstacle = -1, other_link = -1;  ///< as in Move
  int coordinate = -1;
};

/// MoveMethod::kDamped. Steps are as long as rates and speeds allow within a period.
TipMotion damped_motion(const Workspace& ws, std::span<const double> q_start,
                        const TipTarget& target, const MoveOptions& options);

/// MoveMethod::kPseudoInverse, by the same steps as InverseMethod::kPseudoInverse.
TipMotion pseudo_inverse_motion(const Workspace& ws, std::span<const double> q_start,
                                const TipTarget& target, const MoveOptions& options);

/// How long each leg takes the tip at least [s].
std::vector<double> tip_durations(const Arm& arm, const JointMatrix& rows, double speed,
                                  double angular_rate);

}  // namespace bathyal::workspace
