// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/identify/arm_fit.hpp"

// Rows that the others contradict. For use inside the room.

namespace bathyal {

struct OutlierSearch {
  std::vector<Outlier> outliers;  ///< by row
  /// Too many rows contradict each other to tell which ones are wrong: none is named.
  bool hopeless = false;
  Eigen::VectorXd x;          ///< of all columns, without the outliers
  std::vector<double> trust;  ///< (N,) 1, or next to nothing for an outlier
};

/// Looks for touches, or measured positions, that lie far from where the others want them.
///
/// A row is named when its residual, over the standard deviation that it would have among rows
/// without it (its leverage counted: a fit bends towards rows that stand alone), is beyond what
/// chance gives to one fit in a hundred, and above 6. Least squares hides gross errors: it bends to
/// them and blames the good rows. So where residuals look anything but normal the arm is found
/// again, with every row's pull bounded (Huber, then Tukey's biweight: Huber, Ronchetti 2009), then
/// by least squares of the rows that stand the test, until these stay the same.
OutlierSearch find_outliers(const ArmSystem& system, const Eigen::VectorXd& x);

}  // namespace bathyal
