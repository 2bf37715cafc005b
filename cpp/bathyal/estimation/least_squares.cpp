// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/estimation/least_squares.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/base/check.hpp"
#include "bathyal/estimation/gram.hpp"

namespace bathyal {

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
  const Index last = normal.cols() - 1;
  const Eigen::MatrixXd& subspace = options.subspace;
  Eigen::MatrixXd square = normal.topLeftCorner(last, last);
  Eigen::VectorXd gradient = normal.col(last).head(last);
  if (subspace.size() > 0) {
    square = inner_products(subspace, product(square, subspace, 1), 1);
    gradient = subspace.transpose() * gradient;
  }
  const bool relative = options.solver == Solver::kLevenbergMarquardt;
  if (!relative) square.diagonal().array() += damping;
  const Eigen::VectorXd scale = square.diagonal().unaryExpr(
      [](double value) { return value > 0.0 ? 1.0 / std::sqrt(value) : 0.0; });
  square = scale.asDiagonal() * square * scale.asDiagonal();
  square.diagonal().array() += relative ? std::max(damping, options.ridge) : options.ridge;
  Eigen::VectorXd step = square.ldlt().solve(-(scale.asDiagonal() * gradient));  // eq 17
  step = scale.asDiagonal() * step;
  return subspace.size() > 0 ? Eigen::VectorXd(subspace * step) : step;
}

LeastSquaresResult solve_least_squares(const ResidualModel& model, const Eigen::VectorXd& start,
                                       const LeastSquaresOptions& options) {
  options.check();
  if (model.columns() == 0) return {start, {model.cost(start.data())}, true};
  LeastSquaresResult result{start, {}, false};
  double damping = options.damping, growth = 2.0;
  Eigen::MatrixXd normal = model.normal_equations(start.data());
  result.history.push_back(normal(normal.rows() - 1, normal.cols() - 1));
  bool moved = false;
  for (int i = 0; i < options.max_iterations && !result.converged; ++i) {
    if (moved) normal = model.normal_equations(result.y.data());
    const double before = result.history.back();
    const Eigen::VectorXd step = damped_step(normal, damping, options);
    const Eigen::VectorXd next = result.y + step;
    const double cost = model.cost(next.data());
    moved = cost < before;
    if (moved) {
      result.y = next;
      result.history.push_back(cost);
    }
    if (options.solver == Solver::kLevenberg) {
      damping *= moved ? options.factor : 1.0 / options.factor;
    } else if (moved) {  // by the gain ratio (Nielsen 1999)
      const Index last = normal.cols() - 1;
      const Eigen::VectorXd slope = normal.topLeftCorner(last, last) * step;
      const double predicted = -step.dot(2.0 * normal.col(last).head(last) + slope);
      damping *= std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * (before - cost) / predicted - 1.0, 3));
      growth = 2.0;
    } else {
      damping *= growth;
      growth *= 2.0;
    }
    result.converged =
        std::abs(cost - before) <= std::max(options.cost_change * static_cast<double>(model.rows()),
                                            options.relative_cost_change * before);
  }
  return result;
}

}  // namespace bathyal
