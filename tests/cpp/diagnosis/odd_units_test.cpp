// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/odd_units.hpp"

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

}  // namespace
}  // namespace bathyal
