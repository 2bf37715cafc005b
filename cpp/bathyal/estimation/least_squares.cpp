// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/estimation/least_squares.hpp"

#include <ceres/tiny_solver.h>

#include <algorithm>
#include <cmath>

#include "bathyal/base/check.hpp"
#include "bathyal/estimation/gram.hpp"

namespace bathyal {
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

/// The normal equations of changes along the columns of `subspace`.
Eigen::MatrixXd along(const Eigen::MatrixXd& subspace, const Eigen::MatrixXd& normal) {
  if (subspace.size() == 0) return normal;
  const Index last = normal.cols() - 1, columns = subspace.cols();
  Eigen::MatrixXd out(columns + 1, columns + 1);
  out.topLeftCorner(columns, columns) =
      inner_products(subspace, product(normal.topLeftCorner(last, last), subspace, 1), 1);
  out.col(columns).head(columns) = subspace.transpose() * normal.col(last).head(last);
  out.row(columns) = out.col(columns).transpose();
  out(columns, columns) = normal(last, last);
  return out;
}

/// A model as TinySolver expects it, along the columns of `directions` from `start`: one row more
/// than columns, with the JᵀJ, Jᵀr and rᵀr of all the rows of the model. The solver evaluates
/// derivatives at the start and at each accepted point, and nowhere else: that is where the history
/// is written.
struct TinyFunction {
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = Eigen::Dynamic };

  const ResidualModel& model;
  const Eigen::VectorXd& start;
  const Eigen::MatrixXd& subspace;  ///< empty: all directions
  std::vector<double>& history;
  Eigen::VectorXd& derived_at;  ///< where derivatives were last evaluated

  int NumResiduals() const { return NumParameters() + 1; }
  int NumParameters() const {
    return static_cast<int>(subspace.size() > 0 ? subspace.cols() : model.columns());
  }
  Eigen::VectorXd place(const Eigen::VectorXd& moved) const {
    return subspace.size() > 0 ? Eigen::VectorXd(start + subspace * moved)
                               : Eigen::VectorXd(start + moved);
  }

  bool operator()(const double* moved, double* residuals, double* jacobian) const {
    const Index columns = NumParameters();
    const Eigen::VectorXd y = place(Eigen::Map<const Eigen::VectorXd>(moved, columns));
    Eigen::Map<Eigen::VectorXd> r(residuals, columns + 1);
    if (jacobian == nullptr) {
      r.setZero();
      r[0] = std::sqrt(model.cost(y.data()));
      return true;
    }
    const Eigen::MatrixXd normal = along(subspace, model.normal_equations(y.data()));
    const Eigen::MatrixXd root = root_of(normal);
    r = root.col(columns);
    Eigen::Map<Eigen::MatrixXd>(jacobian, columns + 1, columns) = root.leftCols(columns);
    history.push_back(normal(columns, columns));
    derived_at = y;
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
  const TinyFunction function{model, start, options.subspace, result.history, derived_at};
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(function.NumParameters());
  solver.Solve(function, &moved);
  result.y = function.place(moved);
  // The last step is taken without derivatives when it changes next to nothing.
  if (result.y != derived_at) result.history.push_back(2.0 * solver.summary.final_cost);
  result.converged = solver.summary.status != Tiny::HIT_MAX_ITERATIONS;
  return result;
}

/// Levenberg's method with the rule of eq 17 for the damping.
LeastSquaresResult solve_levenberg(const ResidualModel& model, const Eigen::VectorXd& start,
                                   const LeastSquaresOptions& options) {
  LeastSquaresResult result{start, {}, false};
  double damping = options.damping;
  Eigen::MatrixXd normal = model.normal_equations(start.data());
  result.history.push_back(normal(normal.rows() - 1, normal.cols() - 1));
  bool moved = false;
  for (int i = 0; i < options.max_iterations && !result.converged; ++i) {
    if (moved) normal = model.normal_equations(result.y.data());
    const double before = result.history.back();
    const Eigen::VectorXd next = result.y + damped_step(normal, damping, options);
    const double cost = model.cost(next.data());
    moved = cost < before;
    if (moved) {
      result.y = next;
      result.history.push_back(cost);
    }
    damping *= moved ? options.factor : 1.0 / options.factor;
    result.converged =
        std::abs(cost - before) <= std::max(options.cost_change * static_cast<double>(model.rows()),
                                            options.relative_cost_change * before);
  }
  return result;
}

}  // namespace

using Eigen::Index;

void LeastSquaresOptions::check() const {
  if (max_iterations < 1) {
    throw_argument("max_iterations", "1 or more", std::to_string(max_iterations));
  }
  check_positive("damping", damping);
  if (!(factor > 0.0 && factor < 1.0)) {
    throw_argument("factor", "a number between 0 and 1", to_text(factor));
  }
  check_not_negative("cost_change", cost_change);
  check_not_negative("relative_cost_change", relative_cost_change);
  check_not_negative("ridge", ridge);
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

Eigen::VectorXd damped_step(const Eigen::MatrixXd& normal, double damping,
                            const LeastSquaresOptions& options) {
  const Eigen::MatrixXd& subspace = options.subspace;
  const Eigen::MatrixXd own = along(subspace, normal);
  const Index last = own.cols() - 1;
  Eigen::MatrixXd square = own.topLeftCorner(last, last);
  square.diagonal().array() += damping;
  const Eigen::VectorXd scale = square.diagonal().unaryExpr(
      [](double value) { return value > 0.0 ? 1.0 / std::sqrt(value) : 0.0; });
  square = scale.asDiagonal() * square * scale.asDiagonal();
  square.diagonal().array() += options.ridge;
  const Eigen::VectorXd gradient = scale.asDiagonal() * own.col(last).head(last);
  const Eigen::VectorXd step = scale.asDiagonal() * square.ldlt().solve(-gradient);  // eq 17
  return subspace.size() > 0 ? Eigen::VectorXd(subspace * step) : step;
}

LeastSquaresResult solve_least_squares(const ResidualModel& model, const Eigen::VectorXd& start,
                                       const LeastSquaresOptions& options) {
  options.check();
  if (model.columns() == 0) return {start, {model.cost(start.data())}, true};
  return options.solver == Solver::kLevenbergMarquardt ? solve_tiny(model, start, options)
                                                       : solve_levenberg(model, start, options);
}

}  // namespace bathyal
