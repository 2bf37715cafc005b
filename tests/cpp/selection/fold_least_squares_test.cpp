// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/internal/fold_least_squares.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bathyal/base/random.hpp"

namespace bathyal::selection {
namespace {

Eigen::MatrixXd normal(std::uint64_t seed, Index rows, Index columns) {
  Eigen::MatrixXd out(rows, columns);
  RandomStream random(seed);
  for (double& value : out.reshaped()) value = random.normal();
  return out;
}

TEST(FoldLeastSquares, PredictsAsAFitToTheOtherFolds) {
  constexpr Index kRows = 60;
  Eigen::MatrixXd columns = normal(1, kRows, 4);
  columns.colwise().normalize();
  const Eigen::VectorXd residual = normal(2, kRows, 1);
  std::vector<int> observation(kRows);
  for (Index r = 0; r < kRows; ++r) observation[r] = r < 3 ? -1 : static_cast<int>(r / 3);
  Folds folds;
  folds.count = 4;
  for (int u = 0; u < 20; ++u) folds.fold_of.push_back(u % 4);
  const FoldLeastSquares held(residual, columns, Eigen::VectorXd::Zero(columns.cols()), observation,
                              folds, 2);
  const HeldOutErrors found = held.errors({0, 1, 3});
  EXPECT_EQ(held.rows(), kRows - 3.0);
  EXPECT_TRUE(found.error.head(3).isZero());
  EXPECT_TRUE(held.press({0, 1, 3}).isApprox(found.by_fold, 1e-9));
  double density = 0.0;
  for (int b = 0; b < 4; ++b) {
    std::vector<Index> own, others;
    for (Index r = 0; r < kRows; ++r) {
      (observation[r] >= 0 && folds.fold_of[observation[r]] == b ? own : others).push_back(r);
    }
    const std::vector<Index> which{0, 1, 3};
    const Eigen::VectorXd values =
        Eigen::MatrixXd(columns(others, which)).colPivHouseholderQr().solve(residual(others));
    const Eigen::VectorXd error = residual(own) - columns(own, which) * values;
    EXPECT_TRUE(error.isApprox(found.error(own), 1e-6)) << b;
    const Eigen::MatrixXd used = columns(others, which), asked = columns(own, which);
    const Eigen::MatrixXd covariance =
        Eigen::MatrixXd::Identity(error.size(), error.size()) +
        asked * (used.transpose() * used).inverse() * asked.transpose();
    density -=
        0.5 * error.dot(covariance.inverse() * error) + 0.5 * std::log(covariance.determinant());
  }
  EXPECT_NEAR(held.log_predictive_density({0, 1, 3}), density, 1e-5);
}

TEST(FoldLeastSquares, AColumnOfOneFoldAloneIsZeroWithoutIt) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(9, 1);
  columns.topRows(3).setConstant(1.0 / std::sqrt(3.0));
  const Eigen::VectorXd residual = Eigen::VectorXd::Constant(9, 2.0);
  const std::vector<int> observation{0, 0, 0, 1, 1, 1, 2, 2, 2};
  const Folds folds{{0, 1, 2}, 3, ""};
  const FoldLeastSquares held(residual, columns, Eigen::VectorXd::Zero(columns.cols()), observation,
                              folds, 1);
  EXPECT_NEAR(held.errors({0}).error[0], 2.0, 1e-9);
}

TEST(SignFlips, AllGainsHaveOneChanceInTwoToTheFolds) {
  EXPECT_DOUBLE_EQ(sign_flip_p(Eigen::VectorXd::Ones(10)), 1.0 / 1024.0);
  EXPECT_GT(sign_flip_p(Eigen::VectorXd::Zero(5)), 0.99);
  Eigen::VectorXd gains(4);
  gains << 3.0, -1.0, 2.0, -4.0;
  EXPECT_DOUBLE_EQ(sign_flip_p(gains), 9.0 / 16.0);
}

}  // namespace
}  // namespace bathyal::selection
