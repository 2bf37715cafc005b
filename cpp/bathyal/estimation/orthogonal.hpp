// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <vector>

// Orthonormal bases and projections.

namespace bathyal {

using Eigen::Index;

/// Collinearity tolerance: a column of which a smaller share is orthogonal to the others carries
/// rounding errors or nothing worth reporting.
inline constexpr double kCollinearityTolerance = 1e-4;

/// Appends `more` to `columns`.
void append(Eigen::MatrixXd& columns, const Eigen::MatrixXd& more);

/// All columns in one matrix, in order.
Eigen::MatrixXd concatenate_columns(const std::vector<Eigen::MatrixXd>& columns);

/// To length 1; columns of zeros remain.
void normalize_columns(Eigen::MatrixXd& columns);

/// An orthonormal basis of the span of `columns`: of each, scaled to length 1, what is shorter than
/// `tolerance` after projecting out the others is dropped.
/// \pre no entry is NaN
Eigen::MatrixXd orthonormal(Eigen::MatrixXd columns, double tolerance = 1e-10);

/// Orthonormal columns in the orthogonal complement of a basis, and how they scale the columns that
/// they were made from.
struct ProjectedColumns {
  Eigen::MatrixXd columns;  ///< (M, k); may have none
  /// (k,) length of each before normalisation. Coefficients of the given columns with variance 1
  /// each correspond to independent coefficients of these columns with variance length².
  Eigen::VectorXd length;
};

/// The length from which a direction of `columns` (each per largest plausible size) counts: shorter
/// ones could not be observed, or are rounding errors relative to the longest column.
double least_length(const Eigen::Ref<const Eigen::MatrixXd>& columns);

/// The part of each group of columns that is orthogonal to `basis`, without directions shorter than
/// least_length(group).
std::vector<ProjectedColumns> projected_columns(const Eigen::MatrixXd& basis,
                                                std::vector<Eigen::MatrixXd> groups,
                                                int num_threads);

}  // namespace bathyal
