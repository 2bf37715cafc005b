// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/least_squares.hpp"

#include <ceres/tiny_solver.h>

#include <cmath>

#include "bathyal/base/check.hpp"

namespace bathyal {
namespace {

/// A model as TinySolver wants it. The solver asks for derivatives at the start and at each point
/// that it accepts, and nowhere else: that is where the history is written.
struct TinyFunction {
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = Eigen::Dynamic };

  const ResidualModel& model;
  std::vector<double>& history;

  int NumResiduals() const { return static_cast<int>(model.rows()); }
  int NumParameters() const { return static_cast<int>(model.columns()); }

  bool operator()(const double* y, double* residuals, double* jacobian) const {
    model.evaluate(y, residuals, jacobian);
    if (jacobian != nullptr) {
      history.push_back(Eigen::Map<const Eigen::VectorXd>(residuals, model.rows()).squaredNorm());
    }
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
  solver.options.function_tolerance = options.cost_change;
  solver.options.cost_threshold = 0.0;
  solver.options.initial_trust_region_radius = 1.0 / options.damping;
  solver.Solve(TinyFunction{model, result.history}, &result.y);
  const double last = 2.0 * solver.summary.final_cost;
  if (last != result.history.back()) result.history.push_back(last);
  result.converged = solver.summary.status != Tiny::HIT_MAX_ITERATIONS;
  return result;
}

LeastSquaresResult solve_paper(const ResidualModel& model, const Eigen::VectorXd& start,
                               const LeastSquaresOptions& options) {
  LeastSquaresResult result{start, {}, false};
  Eigen::VectorXd residuals(model.rows());
  Eigen::VectorXd tried(model.rows());
  Eigen::MatrixXd jacobian(model.rows(), model.columns());
  double damping = options.damping;

  model.evaluate(result.y.data(), residuals.data(), jacobian.data());
  result.history.push_back(residuals.squaredNorm());
  for (int i = 0; i < options.max_iterations; ++i) {
    Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    normal.diagonal().array() += damping;
    const Eigen::VectorXd step = normal.ldlt().solve(-(jacobian.transpose() * residuals));  // eq 17
    const Eigen::VectorXd next = result.y + step;
    model.evaluate(next.data(), tried.data(), nullptr);
    const double change = tried.squaredNorm() - result.history.back();
    if (change < 0.0) {
      result.y = next;
      result.history.push_back(tried.squaredNorm());
      model.evaluate(result.y.data(), residuals.data(), jacobian.data());
      damping *= options.factor;
    } else {
      damping /= options.factor;
    }
    if (std::abs(change) <= options.cost_change) {
      result.converged = true;
      break;
    }
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

LeastSquaresResult solve_least_squares(const ResidualModel& model, const Eigen::VectorXd& start,
                                       const LeastSquaresOptions& options) {
  options.check();
  if (model.columns() == 0) {
    LeastSquaresResult result{start, {}, true};
    Eigen::VectorXd residuals(model.rows());
    model.evaluate(start.data(), residuals.data(), nullptr);
    result.history.push_back(residuals.squaredNorm());
    return result;
  }
  return options.solver == Solver::kPaper ? solve_paper(model, start, options)
                                          : solve_tiny(model, start, options);
}

}  // namespace bathyal
