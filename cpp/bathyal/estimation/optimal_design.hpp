// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <vector>

// Which of many touches to choose: a problem of optimal design, without an arm in it. For use
// inside the room.

namespace bathyal {

/// Touches that may be chosen, to first order. Unknowns are the arm's columns, then three
/// coordinates of each touched point: with them each touch adds to the information by itself, and
/// what the columns gain is what deviations from a centroid would tell.
struct TouchDesign {
  /// (columns, 3 N) derivative of each touch's tip, three columns a touch, in units of the noise.
  Eigen::MatrixXd touches;
  std::vector<int> point;  ///< (N,) 0 … points - 1
  int points = 0;
  double point_weight = 1.0;  ///< derivative of a point's coordinate in units of the noise
  Eigen::MatrixXd prior;      ///< (columns + 3 points, same) information before any touch
  /// (columns, 3 S) derivative of the tip over the workspace. Empty: the determinant is to grow.
  Eigen::MatrixXd tips;
};

/// Rows of the `count` touches that serve best, no row twice: the worst variance of the tip over
/// the workspace is to fall (by way of the mean of a high power, which is smooth), or the
/// determinant of the columns' information to grow.
///
/// Touches are added one by one, to each point in turn, then exchanged one by one for the best of
/// all others as long as that helps, at most `passes` times round (Fedorov 1972; Cook and
/// Nachtsheim 1980). A point is touched twice or more, or not at all: the last ones are left out
/// when `count` does not suffice. Ties fall to the lowest row, so that the result is the same for
/// any number of threads. Fewer than `count` where there are no more.
std::vector<int> select_touches(const TouchDesign& design, int count, int passes, int num_threads);

}  // namespace bathyal
