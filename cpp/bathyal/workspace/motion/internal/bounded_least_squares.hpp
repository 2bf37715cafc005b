// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

// Small dense least-squares problems with inequalities, and several of them by strict priority: one
// step of an arm's joints.

namespace bathyal::workspace {

/// lower ≤ x ≤ upper, and rows · x ≥ least. Bounds may be infinite.
struct LinearBounds {
  Eigen::VectorXd lower, upper;
  Eigen::MatrixXd rows;  ///< (m, n); m may be 0
  Eigen::VectorXd least;
};

/// Of minimize(): x, and the constraints that hold with equality there. Constraint i < n is the
/// lower bound of x_i, then the n upper ones, then the rows.
struct BoundedAnswer {
  bool feasible = false;
  Eigen::VectorXd x;
  std::vector<int> active;
};

/// The x that minimises |a x − b|² + damping |x|², within the bounds. The dual active-set method
/// (Goldfarb, Idnani 1983): from the free minimum, violated constraints are taken in one by one,
/// the most violated first, and left again where their multiplier falls to zero. `damping` above 0.
BoundedAnswer minimize(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, double damping,
                       const LinearBounds& bounds);

/// A task: jacobian · x should be wanted.
struct Task {
  Eigen::MatrixXd jacobian;
  Eigen::VectorXd wanted;
  double damping = 1e-9;
};

/// x within the bounds that does the tasks by strict priority, the first first: each is minimised
/// over what leaves those before it as they are. Bounds that no x fulfils are loosened: rows to
/// at most 0, so that 0 must lie within `lower` and `upper`. `active` is that of the first task.
BoundedAnswer prioritized(std::span<const Task> tasks, LinearBounds bounds);

}  // namespace bathyal::workspace
