// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/outlier_test.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "bathyal/base/random.hpp"

namespace bathyal::selection {
namespace {

constexpr Index kObservations = 100, kOutlier = 40;

/// One row an observation, noise of 1; the residual of `kOutlier` is given.
Linearization with_outlier(double size) {
  Linearization at;
  at.residual.resize(kObservations);
  RandomStream random(5);
  for (double& value : at.residual) value = random.normal();
  at.residual[kOutlier] = size;
  at.jacobian.resize(kObservations, 0);
  at.observation.resize(kObservations);
  std::iota(at.observation.begin(), at.observation.end(), 0);
  at.noise_rows = kObservations;
  return at;
}

/// The residual of the outlier at a given p-value.
double residual_at(double p) {
  const Eigen::MatrixXd no_basis(kObservations, 0);
  const Eigen::VectorXd all = Eigen::VectorXd::Ones(kObservations);
  double low = 0.0, high = 100.0;
  while (high - low > 1e-6) {
    const double middle = 0.5 * (low + high);
    (test_observations(with_outlier(middle), no_basis, all, kObservations)[kOutlier].p > p ? low
                                                                                           : high) =
        middle;
  }
  return high;
}

TEST(Outliers, AreExcludedAtOneInAThousand) {
  const Eigen::MatrixXd no_basis(kObservations, 0);
  const Eigen::VectorXd all = Eigen::VectorXd::Ones(kObservations);
  const double least = residual_at(1e-3 / kObservations);  // corrected for all of them
  Eigen::VectorXd without = all;
  without[kOutlier] = 0.0;
  EXPECT_EQ(exclude_outliers(with_outlier(1.02 * least), no_basis, all, kObservations), without);
  EXPECT_EQ(exclude_outliers(with_outlier(0.98 * least), no_basis, all, kObservations), all);
  EXPECT_GT(least, 4.0);
  EXPECT_LT(least, 6.0);
}

TEST(Outliers, HaveTheErrorThatTheOthersPredictForThem) {
  const Eigen::VectorXd all = Eigen::VectorXd::Ones(kObservations);
  const Linearization at = with_outlier(30.0);
  const Eigen::MatrixXd mean = all / std::sqrt(static_cast<double>(kObservations));
  Linearization fitted = at;
  fitted.residual -= mean * (mean.transpose() * at.residual);
  const ObservationTest test = test_observations(fitted, mean, all, kObservations - 1)[kOutlier];
  const double others = (at.residual.sum() - 30.0) / (kObservations - 1.0);
  EXPECT_NEAR(test.error, 30.0 - others, 1e-9);
  EXPECT_NEAR(test.square, std::pow(test.error, 2) * (1.0 - 1.0 / kObservations), 1e-8);
}

TEST(Outliers, AreTakenBackWhenTheyAreNoneAnyMore) {
  const Eigen::MatrixXd no_basis(kObservations, 0);
  const Eigen::VectorXd all = Eigen::VectorXd::Ones(kObservations);
  Eigen::VectorXd without = all;
  without[kOutlier] = 0.0;
  const double faint = std::sqrt(kExcludedWeight);  // the weight of excluded rows
  EXPECT_EQ(exclude_outliers(with_outlier(1.0 * faint), no_basis, without, kObservations - 1), all);
  EXPECT_EQ(exclude_outliers(with_outlier(9.0 * faint), no_basis, without, kObservations - 1),
            without);
}

}  // namespace
}  // namespace bathyal::selection
