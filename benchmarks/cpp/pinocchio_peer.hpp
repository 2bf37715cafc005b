// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "bathyal/arm/kinematics.hpp"

namespace bathyal {

/// An arm as a model of Pinocchio. Its headers stay behind this class: they are compiled once, with
/// the flags that serve them best.
class PinocchioPeer {
 public:
  explicit PinocchioPeer(const Arm& arm);
  ~PinocchioPeer();

  /// (N, 4, 4) world_from_tool and (N, 6, n) Jacobians along the world's axes, row-major.
  void forward_and_jacobian(JointView q, double* poses, double* jacobians);

  static const char* version();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bathyal
