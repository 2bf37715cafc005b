// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "bathyal/estimation/parameter.hpp"

// What data can tell of columns, from the Jacobian alone: by QR and singular values of the Jacobian
// with its columns scaled, never from normal equations.

namespace bathyal {

/// A singular value below this share of the largest one is none. Jacobians are analytic, so that
/// columns that truly depend leave about 1e-15.
constexpr double kRankTolerance = 1e-7;

/// Singular values of a Jacobian and its directions, all columns in units of their scale.
struct RankReport {
  int rank = 0;
  Eigen::VectorXd singular_values;  ///< falling; as many as columns
  Eigen::MatrixXd directions;       ///< (columns, columns) right singular vectors, in that order

  /// (columns, columns - rank) orthonormal: changes that nothing measured can see.
  Eigen::MatrixXd unseen() const { return directions.rightCols(directions.cols() - rank); }
};

/// R of the QR decomposition, (columns, columns): it has the singular values, the right singular
/// vectors and the square of all the rows. Many rows are taken in fixed blocks whose triangles are
/// decomposed again: the same bytes for any number of threads.
Eigen::MatrixXd triangle_of(const Eigen::MatrixXd& rows, int num_threads = 1);

/// \pre no entry is NaN
RankReport reveal_rank(const Eigen::MatrixXd& jacobian, double tolerance = kRankTolerance);

/// The same as reveal_rank(jacobian).unseen(), for less where all is plainly seen.
/// \pre no entry is NaN
Eigen::MatrixXd unseen_of(const Eigen::MatrixXd& jacobian);

/// (JᵀJ)⁻¹ from the triangle of J: the covariance of columns when residuals have unit noise.
/// \pre the columns are independent
Eigen::MatrixXd inverse_square(const Eigen::MatrixXd& jacobian);

/// The same space, each direction with a leading column that no other one has, so that each reads
/// as one sentence; leading entries are 1.
std::vector<Eigen::VectorXd> readable_directions(const Eigen::MatrixXd& unseen);

/// A column's share in an unseen direction from which it counts as part of it.
constexpr double kUnseenShare = 1e-4;

/// Whether `column` takes part in any of `directions` (columns, k), k 0 or more.
bool takes_part(Eigen::Index column, const Eigen::MatrixXd& directions);

/// A column that takes part in a change that nothing sees.
struct Trade {
  std::string name;
  std::string words;
  double factor = 0.0;  ///< how far it goes per unit of the first one, each in its own unit
};

/// Others that move along with `column` in the unseen change that moves it most, the largest first
/// (in units of their scale). Empty when `column` is seen.
std::vector<Trade> trades_of(int column, const Eigen::MatrixXd& unseen,
                             const std::vector<Column>& columns);

/// "theta of row 1 +1, d of row 2 -0.5": the columns of a direction, the largest first.
std::string in_words(const Eigen::VectorXd& direction, const std::vector<Column>& columns);

/// Columns taken in the order given as long as each brings something new: a share of it, above the
/// tolerance, that those kept before cannot do. Of several tolerances the first counts for all
/// columns before the next one is asked of those that are left.
struct Selection {
  std::vector<int> kept;
  std::vector<int> dependent;  ///< those that the columns kept before them can do as well
};
Selection select_independent(const Eigen::MatrixXd& jacobian, const std::vector<int>& order,
                             const std::vector<double>& tolerances = {kRankTolerance});

/// The same by an absolute measure: a column brings something new where those kept before it leave
/// more than `least` of its length.
Selection select_longer(const Eigen::MatrixXd& jacobian, const std::vector<int>& order,
                        double least);

}  // namespace bathyal
