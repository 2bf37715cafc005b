// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/geometry/pose.hpp"

namespace bathyal {

/// A pose over time. Between two times the origin moves on a straight line and the frame turns at a
/// constant rate about one axis; before the first and after the last time it rests.
class Trajectory {
 public:
  /// At rest, in the identity unless given. Implicit: wherever a motion is asked for, a pose will
  /// do.
  Trajectory(const Pose& pose = Pose::Identity());  // NOLINT(google-explicit-constructor)

  /// \throw std::invalid_argument for no pose, times that are not finite or do not rise, another
  ///        count of poses, or one that is not rigid (the row is named).
  Trajectory(std::vector<double> time, std::vector<Pose> pose);

  const std::vector<double>& time() const { return time_; }  ///< [s], rising
  const std::vector<Pose>& pose() const { return pose_; }
  bool moves() const { return pose_.size() > 1; }

  Pose at(double time) const;

  /// The greatest speeds within an interval.
  struct Rates {
    double linear = 0.0;   ///< of the origin [m/s]
    double angular = 0.0;  ///< [rad/s]
  };
  Rates max_rates(double from, double to) const;

 private:
  std::vector<double> time_;
  std::vector<Pose> pose_;
  std::vector<Rates> rates_;  ///< of each stretch
};

}  // namespace bathyal
