// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/identify/fit/arm_fit.hpp"

// Rows that the others contradict. For use inside the room.

namespace bathyal {

/// How far a row's numbers may lie from the drawing before the search has strayed: wide of what
/// makers and assemblers do.
inline constexpr double kFarLength = 10e-3;  ///< [m]
inline constexpr double kFarAngle = 0.05;    ///< [rad]

/// What is left of a fit [m, rms], as a share of the chain's length, from which it cannot be this
/// arm.
inline constexpr double kForeignShare = 0.01;

struct OutlierSearch {
  std::vector<Outlier> outliers;  ///< by row
  bool looked_twice = false;      ///< there was reason to find the arm again
  /// Nothing near the drawing agrees with most rows: none is named.
  bool hopeless = false;
  Eigen::VectorXd x;          ///< of all columns, without the outliers
  std::vector<double> trust;  ///< (N,) 1, or next to nothing for an outlier
  /// (3, n) touched points by the touches alone, without what was told of them, when looked twice.
  Eigen::Matrix3Xd points;
};

/// Looks for touches, or measured positions, that lie far from where the others want them.
///
/// A row is named when its residual, over the standard deviation that it would have among rows
/// without it (its leverage counted: a fit bends towards rows that stand alone), is beyond what
/// chance gives to one fit in a hundred, and above 6. Least squares hides gross errors: it bends to
/// them and blames the good rows, or it folds the arm until the tip hardly moves, which agrees with
/// everything. So where residuals look anything but normal, or the arm strayed from its drawing, it
/// is found again from the drawing, held to it loosely, without what was told of the points: first
/// with every row's pull bounded (Huber, then Tukey's biweight: Huber, Ronchetti 2009), then by
/// least squares of the rows that stand the test, until these stay the same.
OutlierSearch find_outliers(const ArmSystem& fitted, const Eigen::VectorXd& x);

}  // namespace bathyal
