// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/pure_error.hpp"

#include <gtest/gtest.h>

#include "linear_model.hpp"

namespace bathyal::selection {
namespace {

constexpr int kReplicates = 4;

/// Every four observations are replicates of one.
PureErrorTest tested(const Eigen::VectorXd& residual, double weight_of_last = 1.0) {
  LinearModel model;
  model.data() = residual;
  for (int i = 0; i < kRows; ++i) model.replicates()[static_cast<std::size_t>(i)] = i / kReplicates;
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(kRows);
  weights[kRows - 1] = weight_of_last;
  return test_pure_error(model, Eigen::MatrixXd::Zero(kRows, 1), static_cast<double>(kRows) - 1.0,
                         weights);
}

TEST(PureError, OfNoiseAloneIsTheResidualVariance) {
  const PureErrorTest test = tested(swing(1, 1.0));
  EXPECT_EQ(test.dof, kRows - kRows / kReplicates);
  EXPECT_NEAR(test.variance, 1.0, 0.3);
  EXPECT_GT(test.p, 0.01);
}

TEST(PureError, ShowsLackOfFitOfAnyForm) {
  Eigen::VectorXd residual = swing(1, 1.0);
  const Eigen::VectorXd of_pose = swing(2, 1.0);
  for (Index i = 0; i < kRows; ++i) residual[i] += of_pose[i / kReplicates];
  const PureErrorTest test = tested(residual);
  EXPECT_LT(test.p, 1e-6);
  EXPECT_NEAR(test.explained, kRows, 0.5 * kRows);
}

TEST(PureError, LeavesOutExcludedObservations) {
  Eigen::VectorXd residual = swing(1, 1.0);
  residual[kRows - 1] = 0.0;
  EXPECT_EQ(tested(residual, 0.0).dof, kRows - kRows / kReplicates - 1.0);
}

TEST(PureError, IsTheSpreadAboutTheMeanOfEachSet) {
  const auto row = [](double value) { return Eigen::VectorXd::Constant(1, value); };
  const PureError pure = pure_error({row(1.0), row(3.0), row(7.0), {}, row(5.0)}, {0, 0, 1, 1, 0});
  EXPECT_DOUBLE_EQ(pure.squares, 8.0);
  EXPECT_EQ(pure.dof, 2.0);
  EXPECT_EQ(pure.sets, 1);
  EXPECT_FALSE(pure.is_measured());
}

TEST(PureError, WithoutReplicatesIsNoTest) {
  LinearModel model;
  const PureErrorTest test =
      test_pure_error(model, Eigen::MatrixXd::Zero(kRows, 1), static_cast<double>(kRows) - 1.0,
                      Eigen::VectorXd::Ones(kRows));
  EXPECT_EQ(test.dof, 0.0);
  EXPECT_EQ(test.p, 1.0);
}

}  // namespace
}  // namespace bathyal::selection
