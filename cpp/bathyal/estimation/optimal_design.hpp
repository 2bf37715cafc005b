// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <vector>

// Which of many candidate experiments (touches) to choose: optimal experimental design, independent
// of any arm.

namespace bathyal {

/// Candidate touches, linearised. The unknowns are the model parameters, then three coordinates of
/// each touched point: with them the information of the touches is additive, and what the
/// parameters gain equals what deviations from a centroid would give.
struct OptimalDesign {
  /// (columns, 3 N) derivative of each touch's tip, three columns a touch, in units of the noise.
  Eigen::MatrixXd touches;
  std::vector<int> point;  ///< (N,) 0 … points - 1
  int points = 0;
  double point_weight = 1.0;  ///< derivative of a point's coordinate, in units of the noise
  Eigen::MatrixXd prior;      ///< (columns + 3 points, same) information before any touch
  /// (columns, 3 S) derivative of the tip over the workspace. Empty: D-optimality.
  Eigen::MatrixXd tips;
};

/// Rows of the best `count` touches, without repetition. Criterion: the worst variance of the tip
/// over the workspace (approximated by the mean of a high power, which is smooth), or the
/// determinant of the information on the parameters.
///
/// Touches are added one at a time, to each point in turn, then exchanged one at a time for the
/// best of all others as long as that improves the criterion, at most `passes` rounds (Fedorov
/// 1972; Cook and Nachtsheim 1980). A point is touched twice or more, or not at all: the last
/// points are dropped when `count` does not suffice. Ties are resolved in favour of the lowest row,
/// so that the result is the same for any number of threads. Fewer than `count` rows where there
/// are not enough candidates.
std::vector<int> exchange_select(const OptimalDesign& design, int count, int passes,
                                 int num_threads);

}  // namespace bathyal
