// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/geometry/pose.hpp"

namespace bathyal {

/// Horizontal current by depth and time, linear between rows and times, at the ends as there.
class Current {
 public:
  Current() = default;  ///< still water

  /// The same everywhere [m/s], x and y of the world.
  Current(double x, double y);  // NOLINT(bugprone-easily-swappable-parameters)

  /// \param depth rising [m], (K)
  /// \param velocity x and y [m/s], K rows a time, one time after the other
  /// \param time rising [s], (T); empty: it does not change
  /// \throw std::invalid_argument for depths or times that do not rise, another count of rows, or
  ///        numbers that are not finite.
  Current(std::vector<double> depth, std::vector<Eigen::Vector2d> velocity,
          std::vector<double> time = {});

  Eigen::Vector2d at(double depth, double time) const;  ///< [m/s]
  bool still() const { return velocity_.empty(); }

  const std::vector<double>& depth() const { return depth_; }
  const std::vector<Eigen::Vector2d>& velocity() const { return velocity_; }
  const std::vector<double>& time() const { return time_; }

 private:
  Eigen::Vector2d at_row(std::size_t first, double depth) const;

  std::vector<double> depth_;
  std::vector<Eigen::Vector2d> velocity_;
  std::vector<double> time_;
};

}  // namespace bathyal
