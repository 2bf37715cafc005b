// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/outlier_test.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "bathyal/base/random.hpp"

namespace bathyal {
namespace {

constexpr Index kUnits = 100, kOdd = 40;

/// One row a unit, noise of 1; what the unit `kOdd` shows is chosen.
Linearization seen(double odd) {
  Linearization at;
  at.misfit.resize(kUnits);
  RandomStream random(5);
  for (double& value : at.misfit) value = random.normal();
  at.misfit[kOdd] = odd;
  at.base.resize(kUnits, 0);
  at.unit.resize(kUnits);
  std::iota(at.unit.begin(), at.unit.end(), 0);
  at.noise_rows = kUnits;
  return at;
}

/// What the odd unit must show for a given chance that it is one of the others.
double shown_at(double p) {
  const Eigen::MatrixXd no_basis(kUnits, 0);
  const Eigen::VectorXd all = Eigen::VectorXd::Ones(kUnits);
  double low = 0.0, high = 100.0;
  while (high - low > 1e-6) {
    const double middle = 0.5 * (low + high);
    (test_units(seen(middle), no_basis, all, kUnits)[kOdd].p > p ? low : high) = middle;
  }
  return high;
}

TEST(OddUnits, OneInAThousandChancesLeavesOneOut) {
  const Eigen::MatrixXd no_basis(kUnits, 0);
  const Eigen::VectorXd all = Eigen::VectorXd::Ones(kUnits);
  const double least = shown_at(1e-3 / kUnits);  // any of them might have been it
  Eigen::VectorXd without = all;
  without[kOdd] = 0.0;
  EXPECT_EQ(leave_out_odd(seen(1.02 * least), no_basis, all, kUnits), without);
  EXPECT_EQ(leave_out_odd(seen(0.98 * least), no_basis, all, kUnits), all);
  EXPECT_GT(least, 4.0);
  EXPECT_LT(least, 6.0);
}

TEST(OddUnits, OneThatBelongsIsTakenBack) {
  const Eigen::MatrixXd no_basis(kUnits, 0);
  const Eigen::VectorXd all = Eigen::VectorXd::Ones(kUnits);
  Eigen::VectorXd without = all;
  without[kOdd] = 0.0;
  const double faint = std::sqrt(kLeftOut);  // as rows that are left out are weighed
  EXPECT_EQ(leave_out_odd(seen(1.0 * faint), no_basis, without, kUnits - 1), all);
  EXPECT_EQ(leave_out_odd(seen(9.0 * faint), no_basis, without, kUnits - 1), without);
}

/// Three rows a unit, noise of 1 along all of them and of `size` along one direction of each.
TEST(FitNoise, FindsSourcesAlongTheirDirections) {
  constexpr double kSize = 0.5, kNoise = 1e-3;
  Linearization at;
  NoiseForm along{"", "", "size", "m", 1.0, Eigen::MatrixXd(3 * kUnits, 1)};
  at.misfit.resize(3 * kUnits);
  RandomStream random(6);
  Blocks blocks{{}, 5, ""};
  for (Index u = 0; u < kUnits; ++u) {
    const Eigen::Vector3d load(random.normal(), 3.0 * random.normal(), 2.0 * random.normal());
    const double source = random.normal();
    along.loads.middleRows<3>(3 * u) = kNoise * load;
    for (Index k = 0; k < 3; ++k) {
      at.misfit[3 * u + k] = random.normal() + kSize * source * load[k];
      at.unit.push_back(static_cast<int>(u));
    }
    blocks.of.push_back(static_cast<int>(u % 5));
  }
  at.noise_rows = 3 * kUnits;
  const Eigen::MatrixXd basis = Eigen::VectorXd::Ones(3 * kUnits).normalized();
  const Eigen::VectorXd all = Eigen::VectorXd::Ones(kUnits);
  const NoiseFit found = fit_noise(along, at, basis, all, kNoise, blocks);
  EXPECT_NEAR(found.parameter, kSize, 3.0 * found.std);
  EXPECT_LT(found.std, 0.2 * kSize);
  EXPECT_NEAR(std::sqrt(found.ratio) * kNoise, kSize, 0.15);
  EXPECT_GT(found.held_out_gain, 0.0);

  // As much in all directions is a worse account of it.
  NoiseForm around = along;
  around.loads = Eigen::MatrixXd::Zero(3 * kUnits, 3);
  for (Index u = 0; u < kUnits; ++u) {
    around.loads.middleRows<3>(3 * u).diagonal().setConstant(
        along.loads.middleRows<3>(3 * u).norm() / std::sqrt(3.0));
  }
  const NoiseFit other = fit_noise(around, at, basis, all, kNoise, blocks);
  EXPECT_GT(found.gain, other.gain + 5.0);
  EXPECT_GT(found.held_out_gain, other.held_out_gain + 5.0);
}

}  // namespace
}  // namespace bathyal
