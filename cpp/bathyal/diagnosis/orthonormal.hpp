// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>

// Orthonormal columns. For use inside the room.

namespace bathyal {

using Eigen::Index;

/// Of a column's length, the part beside other columns that counts as rounding or as nothing worth
/// telling: the columns before it can do the same.
inline constexpr double kSwallowed = 1e-4;

/// Orthonormal columns that span `columns` as far as they are independent: of each scaled to length
/// 1, what is shorter than `tolerance` beside the others is left out.
/// \pre no entry is NaN
Eigen::MatrixXd orthonormal(Eigen::MatrixXd columns, double tolerance = 1e-10);

/// The part of `columns` that is orthogonal to `basis`, orthonormalised; a direction of it is left
/// out where that part is less than kSwallowed of the whole. May have no columns.
Eigen::MatrixXd orthonormal_beside(const Eigen::MatrixXd& basis, Eigen::MatrixXd columns);

}  // namespace bathyal
