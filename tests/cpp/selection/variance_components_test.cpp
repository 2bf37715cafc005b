// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/variance_components.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bathyal/base/random.hpp"

namespace bathyal::selection {
namespace {

constexpr Index kObservations = 100;

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
  const VarianceComponentFit found = fit_variance_component(along, at, basis, all, kNoise, folds);
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
  const VarianceComponentFit other = fit_variance_component(around, at, basis, all, kNoise, folds);
  EXPECT_GT(found.gain, other.gain + 5.0);
  EXPECT_GT(found.held_out_gain, other.held_out_gain + 5.0);
}

/// Four replicates share a source: as independent ones they would determine its size too well.
TEST(VarianceComponents, OfReplicatesThatShareTheirSourcesAreFewer) {
  constexpr double kSize = 0.8, kNoise = 1e-3;
  constexpr Index kReplicates = 4;
  Linearization at;
  VarianceComponent alike{"", "", "size", "m", 1.0, Eigen::MatrixXd(3 * kObservations, 1)};
  at.residual.resize(3 * kObservations);
  at.noise_rows = 3 * kObservations;
  RandomStream random(7);
  Eigen::Vector3d load;
  double source = 0.0;
  for (Index u = 0; u < kObservations; ++u) {
    if (u % kReplicates == 0) {
      load << random.normal(), 3.0 * random.normal(), 2.0 * random.normal();
      source = random.normal();
    }
    alike.source.push_back(static_cast<int>(u / kReplicates));
    alike.loads.middleRows<3>(3 * u) = kNoise * load;
    for (Index k = 0; k < 3; ++k) {
      at.residual[3 * u + k] = random.normal() + kSize * source * load[k];
      at.observation.push_back(static_cast<int>(u));
    }
  }
  const Eigen::MatrixXd no_basis(3 * kObservations, 0);
  const Eigen::VectorXd all = Eigen::VectorXd::Ones(kObservations);
  const auto fitted = [&](const VarianceComponent& component) {
    return fit_variance_component(component, at, no_basis, all, kNoise);
  };
  const VarianceComponentFit found = fitted(alike);
  EXPECT_NEAR(found.parameter, kSize, 3.0 * found.std);
  VarianceComponent apart = alike;
  apart.source.clear();
  EXPECT_GT(found.std, 1.4 * fitted(apart).std);
  EXPECT_GT(found.gain, fitted(apart).gain);
  EXPECT_EQ(found.held_out_gain, 0.0) << "nothing is held out without folds";
}

}  // namespace
}  // namespace bathyal::selection
