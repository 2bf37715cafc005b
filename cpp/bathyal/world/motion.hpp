// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <utility>

#include "bathyal/geometry/trajectory.hpp"

namespace bathyal {

/// Where an object is: at rest, along a trajectory, or wherever a function of time says.
class Motion {
 public:
  /// Implicit: wherever a motion is asked for, a pose or a trajectory will do.
  Motion(const Pose& pose = Pose::Identity()) : trajectory_(pose) {}     // NOLINT
  Motion(Trajectory trajectory) : trajectory_(std::move(trajectory)) {}  // NOLINT

  /// The function may be called from any thread, one call at a time.
  explicit Motion(std::function<Pose(double)> function) : function_(std::move(function)) {}

  bool moves() const { return function_ || trajectory_.moves(); }

  /// world_from_object at a time [s].
  /// \throw std::invalid_argument for what a function returns, where that is no rigid motion.
  Pose at(double time) const;

  const Trajectory& trajectory() const { return trajectory_; }  ///< the identity for a function
  bool is_function() const { return static_cast<bool>(function_); }
  const std::function<Pose(double)>& function() const { return function_; }  ///< empty for others

 private:
  Trajectory trajectory_;
  std::function<Pose(double)> function_;
};

}  // namespace bathyal
