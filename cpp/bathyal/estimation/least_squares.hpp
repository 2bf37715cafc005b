// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <vector>

namespace bathyal {

/// Residuals and their derivatives. Parameters are in units of their own scale and residuals in
/// units of their noise, so that 1 means the same everywhere.
class ResidualModel {
 public:
  virtual ~ResidualModel() = default;
  virtual Eigen::Index rows() const = 0;
  virtual Eigen::Index columns() const = 0;

  /// Fills `residuals` (rows) and, unless it is null, `jacobian` (rows × columns, column by
  /// column).
  virtual void evaluate(const double* y, double* residuals, double* jacobian) const = 0;

  /// [J r]ᵀ[J r], (columns + 1, columns + 1): the normal equations, enough for a step but not for a
  /// rank. By default computed from `evaluate`; a model of many rows need not hold them all in
  /// memory at once.
  virtual Eigen::MatrixXd normal_equations(const double* y) const;

  /// Sum of squared residuals.
  virtual double cost(const double* y) const;
};

enum class Solver {
  kLevenbergMarquardt,  ///< Ceres' TinySolver (Madsen, Nielsen, Tingleff 2004)
  kPaper,  ///< Yukhimets, Gubankov 2023, eq 17: one damping for all parameters, in their units
};

struct LeastSquaresOptions {
  Solver solver = Solver::kLevenbergMarquardt;
  int max_iterations = 100;           ///< 1 or more, failed ones included
  double damping = 1e-8;              ///< initial, relative (paper: absolute), above 0
  double factor = 0.1;                ///< eta of eq 17, in (0, 1)
  double cost_change = 1e-12;         ///< convergence: the mean square changes by less, 0 or more
  double relative_cost_change = 0.0;  ///< or by less than this share of itself (paper)
  double ridge = 1e-13;               ///< least damping relative to the curvature (paper)
  Eigen::MatrixXd subspace = {};      ///< (columns, k) orthonormal: admissible changes; empty: all

  void check() const;
};

struct LeastSquaresResult {
  Eigen::VectorXd y;
  std::vector<double> history;  ///< sum of squares at the start and after each accepted step
  bool converged = false;       ///< false: max_iterations were not enough
};

/// The nearest minimum of the sum of squared residuals, from `start`.
///
/// Steps are computed from JᵀJ, as TinySolver and the paper do; the rows of the model enter only
/// through `normal_equations` and `cost`. Directions to which no residual is sensitive do no harm:
/// both solvers are damped and do not move along them. The printed rule of eq 17 is corrected: the
/// damping falls after success and grows after failure, and the stop test takes the absolute value
/// of the change.
LeastSquaresResult solve_least_squares(const ResidualModel& model, const Eigen::VectorXd& start,
                                       const LeastSquaresOptions& options = {});

/// The step of eq 17 from the `normal` equations [J r]ᵀ[J r]; without damping Gauss–Newton's.
Eigen::VectorXd damped_step(const Eigen::MatrixXd& normal, double damping,
                            const LeastSquaresOptions& options = {});

}  // namespace bathyal
