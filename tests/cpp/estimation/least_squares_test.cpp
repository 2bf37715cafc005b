// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/estimation/least_squares.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>

namespace bathyal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Residuals of a function and derivatives by hand.
class Written final : public ResidualModel {
 public:
  using Function = std::function<void(const VectorXd&, VectorXd&, MatrixXd&)>;
  Written(Eigen::Index rows, Eigen::Index columns, Function function)
      : rows_(rows), columns_(columns), function_(std::move(function)) {}

  Eigen::Index rows() const override { return rows_; }
  Eigen::Index columns() const override { return columns_; }
  void evaluate(const double* y, double* residuals, double* jacobian) const override {
    VectorXd r(rows_);
    MatrixXd j(rows_, columns_);
    function_(Eigen::Map<const VectorXd>(y, columns_), r, j);
    Eigen::Map<VectorXd>(residuals, rows_) = r;
    if (jacobian != nullptr) Eigen::Map<MatrixXd>(jacobian, rows_, columns_) = j;
  }

 private:
  Eigen::Index rows_, columns_;
  Function function_;
};

Written rosenbrock() {
  return {2, 2, [](const VectorXd& y, VectorXd& r, MatrixXd& j) {
            r << 10.0 * (y[1] - y[0] * y[0]), 1.0 - y[0];
            j << -20.0 * y[0], 10.0, -1.0, 0.0;
          }};
}

/// An exponential's decay with noise: the minimum is not zero.
Written decay() {
  return {6, 2, [](const VectorXd& y, VectorXd& r, MatrixXd& j) {
            const double seen[] = {2.03, 1.48, 1.13, 0.79, 0.64, 0.42};
            for (int i = 0; i < 6; ++i) {
              const double e = std::exp(-y[1] * i);
              r[i] = y[0] * e - seen[i];
              j(i, 0) = e;
              j(i, 1) = -y[0] * i * e;
            }
          }};
}

class BothSolvers : public testing::TestWithParam<Solver> {};

TEST_P(BothSolvers, GoesDownTheBananaValley) {
  const VectorXd start = Eigen::Vector2d(-1.2, 1.0);
  const LeastSquaresResult found = solve_least_squares(
      rosenbrock(), start, {.solver = GetParam(), .max_iterations = 1000, .damping = 1e-3});
  EXPECT_TRUE(found.converged);
  EXPECT_LT((found.y - Eigen::Vector2d(1.0, 1.0)).norm(), 1e-6);
  EXPECT_NEAR(found.history.front(), 24.2, 1e-12);
  for (std::size_t i = 1; i < found.history.size(); ++i) {
    EXPECT_LT(found.history[i], found.history[i - 1]);
  }
}

TEST_P(BothSolvers, StandsWhereTheGradientIsZero) {
  const VectorXd start = Eigen::Vector2d(1.0, 1.0);
  const LeastSquaresResult found = solve_least_squares(decay(), start, {.solver = GetParam()});
  VectorXd r(6);
  MatrixXd j(6, 2);
  decay().evaluate(found.y.data(), r.data(), j.data());
  EXPECT_LT((j.transpose() * r).norm(), 1e-7);
  EXPECT_NEAR(found.history.back(), r.squaredNorm(), 1e-14);
  EXPECT_GT(found.history.back(), 1e-4);
}

TEST_P(BothSolvers, StaysPutAlongWhatNothingFeels) {
  const Written sum{3, 2, [](const VectorXd& y, VectorXd& r, MatrixXd& j) {
                      for (int i = 0; i < 3; ++i) r[i] = y[0] + y[1] - i;
                      j.setOnes();
                    }};
  const VectorXd start = Eigen::Vector2d(0.5, -0.5);
  const LeastSquaresResult found = solve_least_squares(sum, start, {.solver = GetParam()});
  EXPECT_NEAR(found.y.sum(), 1.0, 1e-7);
  EXPECT_NEAR(found.y[0] - found.y[1], 1.0, 1e-7);
}

TEST_P(BothSolvers, SaysWhenItRanOutOfSteps) {
  const VectorXd start = Eigen::Vector2d(-1.2, 1.0);
  const LeastSquaresResult found =
      solve_least_squares(rosenbrock(), start, {.solver = GetParam(), .max_iterations = 2});
  EXPECT_FALSE(found.converged);
  EXPECT_LE(found.history.size(), 3u);
}

TEST_P(BothSolvers, NothingUnknownIsNothingToDo) {
  const Written constant{2, 0, [](const VectorXd&, VectorXd& r, MatrixXd&) { r << 3.0, 4.0; }};
  const LeastSquaresResult found =
      solve_least_squares(constant, VectorXd(0), {.solver = GetParam()});
  EXPECT_TRUE(found.converged);
  EXPECT_EQ(found.history, std::vector<double>{25.0});
}

INSTANTIATE_TEST_SUITE_P(Solvers, BothSolvers,
                         testing::Values(Solver::kLevenbergMarquardt, Solver::kPaper));

TEST(LeastSquares, MovesInTheSubspaceAlone) {
  const MatrixXd along = Eigen::Vector2d(0.6, 0.8);
  const VectorXd start = Eigen::Vector2d(-1.2, 1.0);
  for (const Solver solver : {Solver::kLevenbergMarquardt, Solver::kPaper}) {
    const LeastSquaresResult found =
        solve_least_squares(rosenbrock(), start, {.solver = solver, .subspace = along});
    EXPECT_TRUE(found.converged);
    const VectorXd moved = found.y - start;
    EXPECT_GT(moved.norm(), 1e-3);
    EXPECT_LT((moved - along * (along.transpose() * moved)).norm(), 1e-14);
    VectorXd r(2);
    MatrixXd j(2, 2);
    rosenbrock().evaluate(found.y.data(), r.data(), j.data());
    EXPECT_LT((along.transpose() * j.transpose() * r).norm(), 1e-4);
  }
}

TEST(LeastSquares, DampsAllParametersAlike) {
  MatrixXd normal(3, 3);
  normal << 4.0, 0.0, 4.0, 0.0, 1.0, 1.0, 4.0, 1.0, 9.0;
  const auto step = [&](double damping) { return damped_step(normal, damping, {.ridge = 0.0}); };
  EXPECT_LT((step(0.0) - Eigen::Vector2d(-1, -1)).norm(), 1e-14);
  EXPECT_LT((step(1.0) - Eigen::Vector2d(-0.8, -0.5)).norm(), 1e-14);
}

TEST(LeastSquaresOptions, AreChecked) {
  EXPECT_THROW((LeastSquaresOptions{.max_iterations = 0}.check()), std::invalid_argument);
  EXPECT_THROW((LeastSquaresOptions{.damping = 0.0}.check()), std::invalid_argument);
  EXPECT_THROW((LeastSquaresOptions{.factor = 1.0}.check()), std::invalid_argument);
  EXPECT_THROW((LeastSquaresOptions{.cost_change = -1.0}.check()), std::invalid_argument);
  EXPECT_THROW((LeastSquaresOptions{.relative_cost_change = -1.0}.check()), std::invalid_argument);
  EXPECT_THROW((LeastSquaresOptions{.ridge = -1.0}.check()), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
