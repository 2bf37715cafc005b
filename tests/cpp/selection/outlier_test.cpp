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

/// Three rows an observation, noise of 1 in all directions and of `size` along one of each.
TEST(VarianceComponents, AreEstimatedAlongTheirDirections) {
  constexpr double kSize = 0.5, kNoise = 1e-3;
  Linearization at;
  VarianceComponent along{"", "", "size", "m", 1.0, Eigen::MatrixXd(3 * kObservations, 1)};
  at.residual.resize(3 * kObservations);
  RandomStream random(6);
  Folds folds{{}, 5, ""};
  for (Index u = 0; u < kObservations; ++u) {
    const Eigen::Vector3d load(random.normal(), 3.0 * random.normal(), 2.0 * random.normal());
    const double source = random.normal();
    along.loads.middleRows<3>(3 * u) = kNoise * load;
    for (Index k = 0; k < 3; ++k) {
      at.residual[3 * u + k] = random.normal() + kSize * source * load[k];
      at.observation.push_back(static_cast<int>(u));
    }
    folds.fold_of.push_back(static_cast<int>(u % 5));
  }
  at.noise_rows = 3 * kObservations;
  const Eigen::MatrixXd basis = Eigen::VectorXd::Ones(3 * kObservations).normalized();
  const Eigen::VectorXd all = Eigen::VectorXd::Ones(kObservations);
  const VarianceComponentFit found = fit_noise(along, at, basis, all, kNoise, folds);
  EXPECT_NEAR(found.parameter, kSize, 3.0 * found.std);
  EXPECT_LT(found.std, 0.2 * kSize);
  EXPECT_NEAR(std::sqrt(found.ratio) * kNoise, kSize, 0.15);
  EXPECT_GT(found.held_out_gain, 0.0);

  // An isotropic component of the same variance fits worse.
  VarianceComponent around = along;
  around.loads = Eigen::MatrixXd::Zero(3 * kObservations, 3);
  for (Index u = 0; u < kObservations; ++u) {
    around.loads.middleRows<3>(3 * u).diagonal().setConstant(
        along.loads.middleRows<3>(3 * u).norm() / std::sqrt(3.0));
  }
  const VarianceComponentFit other = fit_noise(around, at, basis, all, kNoise, folds);
  EXPECT_GT(found.gain, other.gain + 5.0);
  EXPECT_GT(found.held_out_gain, other.held_out_gain + 5.0);
}

}  // namespace
}  // namespace bathyal::selection
