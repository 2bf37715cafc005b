// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "bathyal/estimation/parameter.hpp"

// Observability of parameters from the Jacobian alone: by QR and singular values of the Jacobian
// with scaled columns, never from normal equations.

namespace bathyal {

/// Singular values below this share of the largest one count as zero. Jacobians are analytic, so
/// that truly dependent columns leave about 1e-15.
constexpr double kRankTolerance = 1e-7;

/// Singular values and right singular vectors of a Jacobian whose columns are in units of scale.
struct RankReport {
  int rank = 0;
  Eigen::VectorXd singular_values;  ///< descending; as many as columns
  Eigen::MatrixXd directions;       ///< (columns, columns) right singular vectors, in that order

  /// (columns, columns - rank) orthonormal: changes without effect on any measurement.
  Eigen::MatrixXd null_space() const { return directions.rightCols(directions.cols() - rank); }
};

/// R of the QR decomposition, (columns, columns): it has the singular values, right singular
/// vectors and Gram matrix of all the rows. Many rows are decomposed in fixed blocks whose R
/// factors are stacked and decomposed again: the same bytes for any number of threads.
Eigen::MatrixXd qr_factor(const Eigen::MatrixXd& rows, int num_threads = 1);

/// (rows, rank) a basis of the column space as `orthonormal` gives it, from the R factor: cheaper,
/// and orthonormal to about 1e-16 / `tolerance`.
Eigen::MatrixXd column_space(const Eigen::MatrixXd& jacobian, double tolerance,
                             int num_threads = 1);

/// \pre no entry is NaN
RankReport numerical_rank(const Eigen::MatrixXd& jacobian, double tolerance = kRankTolerance);

/// The same as numerical_rank(jacobian).null_space(), cheaper where the rank is clearly full.
/// \pre no entry is NaN
Eigen::MatrixXd null_space_of(const Eigen::MatrixXd& jacobian);

/// (JᵀJ)⁻¹ from the R factor of J: the covariance of the parameters for residuals of unit noise.
/// \pre the columns are independent
Eigen::MatrixXd covariance_from_qr(const Eigen::MatrixXd& jacobian);

/// A basis of the same space in which each direction has a leading parameter that takes part in no
/// other one, so that it can be described in one sentence; leading entries are 1.
std::vector<Eigen::VectorXd> readable_directions(const Eigen::MatrixXd& null_space);

/// A parameter's share in a null-space direction from which it counts as part of it.
constexpr double kNullSpaceShare = 1e-4;

/// Whether parameter `column` takes part in any of `directions` (columns, k), k 0 or more.
bool takes_part(Eigen::Index column, const Eigen::MatrixXd& directions);

/// A parameter that takes part in an unobservable change of another one.
struct NullSpacePartner {
  std::string name;
  std::string description;
  double factor = 0.0;  ///< its change per unit of the first one, each in its own unit
};

/// The other parameters of the unobservable change that moves `column` most, by descending size (in
/// units of their scale). Empty when `column` is observable.
std::vector<NullSpacePartner> null_space_partners(int column, const Eigen::MatrixXd& null_space,
                                                  const std::vector<Parameter>& parameters);

/// "theta of row 1 +1, d of row 2 -0.5": the parameters of a direction by descending size.
std::string describe_direction(const Eigen::VectorXd& direction,
                               const std::vector<Parameter>& parameters);

/// Columns selected in the order given, each as long as a share of it above the tolerance is
/// independent of those kept before. Of several tolerances the first is applied to all columns
/// before the next one is applied to the columns that it rejected.
struct IndependentColumns {
  std::vector<int> kept;
  std::vector<int> dependent;  ///< linear combinations of the columns kept before them
};
IndependentColumns select_independent(const Eigen::MatrixXd& jacobian,
                                      const std::vector<int>& order,
                                      const std::vector<double>& tolerances = {kRankTolerance});

/// The same with an absolute tolerance: a column is selected where its component orthogonal to
/// those kept before is longer than `least`.
IndependentColumns select_longer(const Eigen::MatrixXd& jacobian, const std::vector<int>& order,
                                 double least);

}  // namespace bathyal
