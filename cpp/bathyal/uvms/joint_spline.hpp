// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/arm/kinematics.hpp"

namespace bathyal {

/// Coordinates of an arm over time: a cubic spline through rows, twice continuously differentiable,
/// at rest at its ends and beyond them.
class JointSpline {
 public:
  /// Held at one posture.
  explicit JointSpline(std::vector<double> q);

  /// \param time (K,) rising [s]. \param rows (K, n) [rad, m]
  /// \throw std::invalid_argument for no row, another count of times, times that do not rise, or
  ///        numbers that are not finite
  JointSpline(std::vector<double> time, JointView rows);

  std::size_t size() const { return size_; }
  const std::vector<double>& time() const { return time_; }

  /// Of a moment, (n,) each. Allocates nothing where they have been used before.
  void at(double time, std::vector<double>& q, std::vector<double>& rate,
          std::vector<double>& acceleration) const;

 private:
  std::size_t size_;
  std::vector<double> time_, rows_;  // (K, n)
  std::vector<double> slope_;        // (K, n) rates at the rows
};

}  // namespace bathyal
