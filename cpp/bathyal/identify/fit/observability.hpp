// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/estimation/rank.hpp"
#include "bathyal/identify/model/arm_residuals.hpp"

// What touches or tracked poses can tell of an arm's columns. For use inside the room.

namespace bathyal {

/// Directions are of all columns, in units of their scale.
struct Observability {
  RankReport rank;         ///< of all columns, by the data alone
  Eigen::MatrixXd unseen;  ///< (P, k) changes of the free columns that the data do not see
  Eigen::MatrixXd blind;   ///< (P, l) those of them that no prior holds either
};

/// Asked at `x` for exact touches.
Observability observe(const ArmSystem& system, const Eigen::VectorXd& x);

/// Rows that keep what is blind at nominal.
std::vector<LinearRow> rows_to_hold(const Eigen::MatrixXd& blind,
                                    const std::vector<Column>& columns);

/// Covariance of the free columns (free, free), in units of their scale, for exact touches; what is
/// `blind` counts nothing.
Eigen::MatrixXd free_covariance(const ArmSystem& system, const Eigen::VectorXd& x,
                                const Eigen::MatrixXd& blind);

/// The joint values nearest to those recorded at which every tip is where it should be: scatter of
/// touches would pass for information about the arm's size. Of tracked poses: those recorded.
RowMatrix exact_joints(const ArmSystem& system, const Eigen::VectorXd& x);

}  // namespace bathyal
