// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/motion/internal/bounded_least_squares.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bathyal/base/random.hpp"

namespace bathyal::workspace {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd random_matrix(RandomStream& random, Eigen::Index rows, Eigen::Index cols) {
  MatrixXd matrix(rows, cols);
  for (double& value : matrix.reshaped()) value = random.uniform(-1.0, 1.0);
  return matrix;
}

LinearBounds box(Eigen::Index n, double half) {
  return {VectorXd::Constant(n, -half), VectorXd::Constant(n, half), MatrixXd(0, n), VectorXd(0)};
}

TEST(BoundedLeastSquares, WithoutActiveBoundsItIsTheNormalEquations) {
  RandomStream random(1);
  const MatrixXd a = random_matrix(random, 6, 4);
  const VectorXd b = random_matrix(random, 6, 1);
  const BoundedAnswer answer = minimize(a, b, 1e-3, box(4, 100.0));
  const VectorXd expected =
      (a.transpose() * a + 1e-3 * MatrixXd::Identity(4, 4)).ldlt().solve(a.transpose() * b);
  EXPECT_TRUE(answer.feasible);
  EXPECT_TRUE(answer.active.empty());
  EXPECT_LT((answer.x - expected).norm(), 1e-12);
}

TEST(BoundedLeastSquares, OfTheIdentityEachNumberIsClamped) {
  const VectorXd b = (VectorXd(3) << 2.0, -0.2, -3.0).finished();
  const BoundedAnswer answer = minimize(MatrixXd::Identity(3, 3), b, 1e-12, box(3, 0.5));
  EXPECT_LT((answer.x - VectorXd((VectorXd(3) << 0.5, -0.2, -0.5).finished())).norm(), 1e-10);
}

/// Karush-Kuhn-Tucker: the gradient is a sum of the active normals with weights of 0 or more.
TEST(BoundedLeastSquares, RandomProblemsMeetTheConditionsOfAMinimum) {
  RandomStream random(2);
  int with_active = 0, infeasible = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Eigen::Index n = 2 + trial % 7, m = trial % 6;
    const MatrixXd a = random_matrix(random, 3, n);
    const VectorXd b = 2.0 * random_matrix(random, 3, 1);
    LinearBounds bounds = box(n, 0.4);
    bounds.rows = random_matrix(random, m, n);
    bounds.least = 0.3 * random_matrix(random, m, 1);
    const double damping = 1e-4;
    const BoundedAnswer answer = minimize(a, b, damping, bounds);
    if (!answer.feasible) {
      ++infeasible;
      continue;
    }
    ASSERT_LE(answer.x.cwiseAbs().maxCoeff(), 0.4 + 1e-9);
    if (m > 0) {
      ASSERT_GE((bounds.rows * answer.x - bounds.least).minCoeff(), -1e-9);
    }
    const VectorXd gradient = a.transpose() * (a * answer.x - b) + damping * answer.x;
    MatrixXd normals(n, std::ssize(answer.active));
    for (Eigen::Index k = 0; k < normals.cols(); ++k) {
      const int i = answer.active[static_cast<std::size_t>(k)];
      normals.col(k) = i < n       ? VectorXd(VectorXd::Unit(n, i))
                       : i < 2 * n ? VectorXd(-VectorXd::Unit(n, i - n))
                                   : VectorXd(bounds.rows.row(i - 2 * n).transpose());
    }
    if (normals.cols() == 0) {
      EXPECT_LT(gradient.norm(), 1e-9);
      continue;
    }
    ++with_active;
    const VectorXd weights = normals.colPivHouseholderQr().solve(gradient);
    EXPECT_LT((normals * weights - gradient).norm(), 1e-7) << trial;
    EXPECT_GT(weights.minCoeff(), -1e-7) << trial;
  }
  EXPECT_GT(with_active, 1000);
  EXPECT_LT(infeasible, 200);
}

TEST(BoundedLeastSquares, SaysWhenNothingFulfilsTheBounds) {
  LinearBounds bounds = box(2, 1.0);
  bounds.rows = MatrixXd::Ones(1, 2);
  bounds.least = VectorXd::Constant(1, 3.0);
  EXPECT_FALSE(minimize(MatrixXd::Identity(2, 2), VectorXd::Zero(2), 1e-9, bounds).feasible);
}

TEST(Prioritized, ALaterTaskTakesNothingFromAnEarlierOne) {
  RandomStream random(3);
  for (int trial = 0; trial < 300; ++trial) {
    const Eigen::Index n = 7;
    std::vector<Task> tasks;
    tasks.push_back({random_matrix(random, 3, n), 0.3 * random_matrix(random, 3, 1), 1e-10});
    tasks.push_back({random_matrix(random, 3, n), 0.3 * random_matrix(random, 3, 1), 1e-10});
    tasks.push_back({MatrixXd::Identity(n, n), random_matrix(random, n, 1), 1e-10});
    LinearBounds bounds = box(n, 0.2);
    bounds.rows = random_matrix(random, 2, n);
    bounds.least = -0.1 * random_matrix(random, 2, 1).cwiseAbs();
    const BoundedAnswer first = prioritized(std::span(tasks).first(1), bounds);
    const BoundedAnswer two = prioritized(std::span(tasks).first(2), bounds);
    const BoundedAnswer all = prioritized(tasks, bounds);
    EXPECT_LT((tasks[0].jacobian * (all.x - first.x)).norm(), 1e-8);
    EXPECT_LT((tasks[1].jacobian * (all.x - two.x)).norm(), 1e-8);
    EXPECT_LE(all.x.cwiseAbs().maxCoeff(), 0.2 + 1e-9);
    EXPECT_GE((bounds.rows * all.x - bounds.least).minCoeff(), -1e-9);
    // The last one is nearer to what it wants than what the others alone make.
    EXPECT_LE((all.x - tasks[2].wanted).norm(), (two.x - tasks[2].wanted).norm() + 1e-9);
  }
}

TEST(Prioritized, BoundsThatCannotBeMetAreLoosenedToRest) {
  LinearBounds bounds = box(2, 0.1);
  bounds.rows = MatrixXd::Identity(1, 2);
  bounds.least = VectorXd::Constant(1, 1.0);
  const std::vector<Task> tasks{{MatrixXd::Identity(2, 2), VectorXd::Constant(2, -1.0), 1e-10}};
  const BoundedAnswer answer = prioritized(tasks, bounds);
  EXPECT_FALSE(answer.feasible);
  EXPECT_NEAR(answer.x[0], 0.0, 1e-9);
  EXPECT_NEAR(answer.x[1], -0.1, 1e-9);
}

}  // namespace
}  // namespace bathyal::workspace
