// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "bathyal/arm/forward_kernel.hpp"
#include "bathyal/arm/inverse.hpp"

namespace bathyal::arm {

struct TipTask {
  InverseTask kind = InverseTask::kPose;
  double axis[3] = {0.0, 0.0, 1.0};  ///< of kPositionAxis: unit, in the tool's frame
  double length = 1.0;  ///< a residual of 1 rad weighs as much as one of so many metres
};

/// Where the tool is at one q, how that differs from a target, and the Jacobian of it. Targets
/// are given relative to the origin of the arm's first frame, along the axes of the world.
class TipState {
 public:
  TipState(const ForwardProgram& program, const TipTask& task);

  void evaluate(const PlainPose& target, const double* q);

  double position_error() const { return position_error_; }  ///< [m]
  double angle_error() const { return angle_error_; }        ///< [rad]
  double error() const { return std::sqrt(2.0 * cost()); }   ///< norm of the residual [m]
  /// Half the squared residual [m²].
  double cost() const {
    const double angle = task_.length * angle_error_;
    return 0.5 * (position_error_ * position_error_ + angle * angle);
  }
  /// Six numbers: what is missing of the position, and of the rotation times the length [m].
  const double* residual() const { return residual_; }
  /// 6 × size, row by row: the Jacobian of the place, and of the rotation times the length.
  const double* jacobian() const { return jacobian_.data(); }
  /// Trace of JᵀJ [m²].
  double scale() const { return scale_; }

 private:
  void follow_chain(const double* q);
  void set_residual(const PlainPose& target);
  void set_jacobian();

  const ForwardProgram& program_;
  TipTask task_;
  std::vector<double> sines_, cosines_;  ///< of every step's joint
  std::vector<double> axes_;             ///< direction and origin of every step's joint
  std::vector<double> jacobian_;
  double rotation_[9];
  double tip_[3];
  double residual_[6];
  double position_error_ = 0.0;
  double angle_error_ = 0.0;
  double scale_ = 0.0;
};

}  // namespace bathyal::arm
