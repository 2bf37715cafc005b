// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/estimation/least_squares.hpp"

#include <ceres/tiny_solver.h>

#include <cmath>

#include "bathyal/base/check.hpp"

namespace bathyal {

using Eigen::Index;

namespace {

/// A matrix F with FᵀF = `square`, which need not be definite.
Eigen::MatrixXd root_of(const Eigen::MatrixXd& square) {
  const Eigen::LDLT<Eigen::MatrixXd> factors(square);
  const Eigen::VectorXd diagonal = factors.vectorD().cwiseMax(0.0).cwiseSqrt();
  Eigen::MatrixXd root = Eigen::MatrixXd::Identity(square.rows(), square.cols());
  root = factors.transpositionsP() * root;
  root = factors.matrixU() * root;
  return diagonal.asDiagonal() * root;
}

/// A model as TinySolver expects it: columns + 1 rows with the JᵀJ, Jᵀr and rᵀr of all the rows of
/// the model. The solver evaluates derivatives at the start and at each accepted point, and nowhere
/// else: that is where the history is written.
struct TinyFunction {
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = Eigen::Dynamic };

  const ResidualModel& model;
  std::vector<double>& history;
  Eigen::VectorXd& derived_at;  ///< where derivatives were last evaluated

  int NumResiduals() const { return NumParameters() + 1; }
  int NumParameters() const { return static_cast<int>(model.columns()); }

  bool operator()(const double* y, double* residuals, double* jacobian) const {
    const Index columns = model.columns();
    Eigen::Map<Eigen::VectorXd> r(residuals, columns + 1);
    if (jacobian == nullptr) {
      r.setZero();
      r[0] = std::sqrt(model.cost(y));
      return true;
    }
    const Eigen::MatrixXd normal = model.normal_equations(y);
    const Eigen::MatrixXd root = root_of(normal);
    r = root.col(columns);
    Eigen::Map<Eigen::MatrixXd>(jacobian, columns + 1, columns) = root.leftCols(columns);
    history.push_back(normal(columns, columns));
    derived_at = Eigen::Map<const Eigen::VectorXd>(y, columns);
    return true;
  }
};

LeastSquaresResult solve_tiny(const ResidualModel& model, const Eigen::VectorXd& start,
                              const LeastSquaresOptions& options) {
  LeastSquaresResult result{start, {}, false};
  using Tiny = ceres::TinySolver<TinyFunction>;
  Tiny solver;
  solver.options.max_num_iterations = options.max_iterations + 1;  // it counts from 1
  solver.options.gradient_tolerance = 0.0;
  solver.options.parameter_tolerance = 1e-12;
  solver.options.function_tolerance = options.cost_change * static_cast<double>(model.rows());
  solver.options.cost_threshold = 0.0;
  solver.options.initial_trust_region_radius = 1.0 / options.damping;
  Eigen::VectorXd derived_at;
  solver.Solve(TinyFunction{model, result.history, derived_at}, &result.y);
  // The last step is taken without derivatives when it changes next to nothing.
  if (result.y != derived_at) result.history.push_back(2.0 * solver.summary.final_cost);
  result.converged = solver.summary.status != Tiny::HIT_MAX_ITERATIONS;
  return result;
}

LeastSquaresResult solve_paper(const ResidualModel& model, const Eigen::VectorXd& start,
                               const LeastSquaresOptions& options) {
  LeastSquaresResult result{start, {}, false};
  const Index columns = model.columns();
  const double convergence = options.cost_change * static_cast<double>(model.rows());
  double damping = options.damping;
  Eigen::MatrixXd square = model.normal_equations(start.data());
  result.history.push_back(square(columns, columns));
  for (int i = 0; i < options.max_iterations; ++i) {
    Eigen::MatrixXd normal = square.topLeftCorner(columns, columns);
    normal.diagonal().array() += damping;
    const Eigen::VectorXd step = normal.ldlt().solve(-square.col(columns).head(columns));  // eq 17
    const Eigen::VectorXd next = result.y + step;
    const double cost = model.cost(next.data());
    const double change = cost - result.history.back();
    if (change < 0.0) {
      result.y = next;
      result.history.push_back(cost);
      damping *= options.factor;
    } else {
      damping /= options.factor;
    }
    if (std::abs(change) <= convergence) {
      result.converged = true;
      break;
    }
    if (change < 0.0) square = model.normal_equations(result.y.data());
  }
  return result;
}

}  // namespace

void LeastSquaresOptions::check() const {
  if (max_iterations < 1) {
    throw_argument("max_iterations", "1 or more", std::to_string(max_iterations));
  }
  check_positive("damping", damping);
  if (!(factor > 0.0 && factor < 1.0)) {
    throw_argument("factor", "a number between 0 and 1", to_text(factor));
  }
  check_not_negative("cost_change", cost_change);
}

Eigen::MatrixXd ResidualModel::normal_equations(const double* y) const {
  Eigen::MatrixXd both(rows(), columns() + 1);
  evaluate(y, both.col(columns()).data(), both.data());
  Eigen::MatrixXd square = Eigen::MatrixXd::Zero(both.cols(), both.cols());
  square.selfadjointView<Eigen::Lower>().rankUpdate(both.transpose());
  return square.selfadjointView<Eigen::Lower>();
}

double ResidualModel::cost(const double* y) const {
  Eigen::VectorXd residuals(rows());
  evaluate(y, residuals.data(), nullptr);
  return residuals.squaredNorm();
}

LeastSquaresResult solve_least_squares(const ResidualModel& model, const Eigen::VectorXd& start,
                                       const LeastSquaresOptions& options) {
  options.check();
  if (model.columns() == 0) return {start, {model.cost(start.data())}, true};
  return options.solver == Solver::kPaper ? solve_paper(model, start, options)
                                          : solve_tiny(model, start, options);
}

}  // namespace bathyal
