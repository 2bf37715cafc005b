// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/workspace/motion/internal/speed_profile.hpp"
#include "bathyal/workspace/motion/motion_timing.hpp"

namespace bathyal::workspace {

/// Straight legs and rounded corners. The way s is measured so that a unit of it on a leg changes
/// the coordinates by a unit vector, each coordinate in units of its speed limit.
class RoundedPath {
 public:
  /// Rows that equal the one before are dropped, and those on a straight line within half of their
  /// tolerance; corners take the other half.
  RoundedPath(JointView rows, const MotionLimits& limits, const std::vector<double>& tolerance);

  /// Legs and corners by turns, beginning and ending with a leg; none for a path of one point.
  const std::vector<Piece>& pieces() const { return pieces_; }

  /// The point `way` after the start of a piece, and where that is on the rows given.
  double at(std::size_t piece, double way, Eigen::Ref<Eigen::RowVectorXd> q) const;

 private:
  std::vector<Piece> pieces_with(const std::vector<double>& half, const MotionLimits& limits) const;
  /// A narrow corner may take longer than a stop.
  void stop_where_faster(const MotionLimits& limits);

  std::vector<std::size_t> kept_;  ///< rows of the path given
  JointMatrix points_;             ///< (P, n) those rows
  JointMatrix directions_;         ///< (P − 1, n) of the legs
  std::vector<double> lengths_;    ///< of the legs
  std::vector<double> half_;       ///< (P,) of the way through each corner, 0 at a stop
  std::vector<Piece> pieces_;
};

}  // namespace bathyal::workspace
