// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bathyal/arm/forward_program.hpp"
#include "bathyal/arm/inverse.hpp"
#include "bathyal/arm/tip_state.hpp"

namespace bathyal::arm {

/// An arm and a task as the solvers take them: what all targets of a call share.
struct InverseProblem {
  InverseProblem(const Arm& arm, const InverseOptions& options);

  Program program;
  std::vector<double> lower;
  std::vector<double> upper;
  std::vector<std::uint8_t> turns;  ///< a whole turn of the coordinate changes nothing
  std::vector<std::uint8_t> wraps;  ///< and it fits between the limits
  std::vector<double> middle;       ///< of the limits; 0 where there is none
  double reach;                     ///< from the first frame's origin no target is further [m]
  TipTask task;
  double position_tolerance;
  double angle_tolerance;
  int max_iterations;

  std::size_t size() const { return lower.size(); }

  /// The target relative to the first frame's origin.
  PlainPose relative(PlainPose target) const;

  /// Brings turning coordinates by whole turns as near to `reference` as the limits allow.
  void unwind(std::span<const double> reference, double* q) const;

  bool within_limits(const double* q) const;
};

}  // namespace bathyal::arm
