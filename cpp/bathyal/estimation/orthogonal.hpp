// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <vector>

// Orthonormal columns. For use inside the room.

namespace bathyal {

using Eigen::Index;

/// Of a column's length, the part beside other columns that counts as rounding or as nothing worth
/// telling: the columns before it can do the same.
inline constexpr double kSwallowed = 1e-4;

/// Puts `more` behind `columns`.
void append(Eigen::MatrixXd& columns, const Eigen::MatrixXd& more);

/// All columns in one.
Eigen::MatrixXd side_by_side(const std::vector<Eigen::MatrixXd>& columns);

/// Columns of 0 stay.
void scale_to_length_1(Eigen::MatrixXd& columns);

/// Orthonormal columns that span `columns` as far as they are independent: of each scaled to length
/// 1, what is shorter than `tolerance` beside the others is left out.
/// \pre no entry is NaN
Eigen::MatrixXd orthonormal(Eigen::MatrixXd columns, double tolerance = 1e-10);

/// Orthonormal columns beside a basis, and what they are of the columns that they were made from.
struct Beside {
  Eigen::MatrixXd columns;  ///< (M, k); may have none
  /// (k,) length of each before it was made 1. Values of the columns that were given, each of
  /// variance 1, are values along these of variance length², independent of one another.
  Eigen::VectorXd length;
};

/// The length from which a direction of `columns` (each per largest plausible size) counts: shorter
/// ones could not be seen, or are rounding beside the longest column.
double least_length(const Eigen::Ref<const Eigen::MatrixXd>& columns);

/// The part of each group of columns that is orthogonal to `basis`, without directions shorter than
/// least_length(group).
std::vector<Beside> orthonormal_beside(const Eigen::MatrixXd& basis,
                                       std::vector<Eigen::MatrixXd> groups, int num_threads);

}  // namespace bathyal
