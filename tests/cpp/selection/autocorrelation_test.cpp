// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/autocorrelation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bathyal/base/random.hpp"
#include "bathyal/estimation/orthogonal.hpp"
#include "linear_model.hpp"

namespace bathyal::selection {
namespace {

/// Values that are spread over -1 … 1, in no order.
Eigen::VectorXd scattered(std::uint64_t seed) {
  RandomStream random(seed);
  Eigen::VectorXd out(kRows);
  for (double& value : out) value = random.uniform(-1.0, 1.0);
  return out;
}

/// 1, u, u² and u³: what takes much of what is smooth in u.
Eigen::MatrixXd cubic_basis(const Eigen::VectorXd& u) {
  Eigen::MatrixXd out(u.size(), 4);
  out << Eigen::VectorXd::Ones(u.size()), u, u.cwiseAbs2(), u.array().cube().matrix();
  return orthonormal(out);
}

Autocorrelation tested(const Eigen::VectorXd& u, const Eigen::VectorXd& residual,
                       const Eigen::MatrixXd& basis) {
  LinearModel model;
  model.data() = residual;
  model.add_context(u);
  model.add_direction(Eigen::VectorXd::Ones(kRows));
  return test_autocorrelation(model, basis, static_cast<double>(kRows - basis.cols()),
                              Eigen::VectorXd::Ones(kRows), 1)
      .front();
}

/// p-values up to one in a hundred are those of the whole spectrum.
TEST(Autocorrelation, OfNoiseHasUniformPValuesWhateverWasFitted) {
  constexpr int kSeeds = 3000;
  int below_tenth = 0, below_hundredth = 0, below_thousandth = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const Eigen::VectorXd u = scattered(static_cast<std::uint64_t>(seed));
    const double p =
        tested(u, swing(10000 + static_cast<std::uint64_t>(seed), 1.0), cubic_basis(u)).p;
    below_tenth += p < 0.1;
    below_hundredth += p < 0.01;
    below_thousandth += p < 0.001;
  }
  // Within three standard deviations.
  EXPECT_NEAR(below_tenth, 300, 50);
  EXPECT_NEAR(below_hundredth, 30, 17);
  EXPECT_LE(below_thousandth, 8);
}

TEST(Autocorrelation, FindsWhatIsSmoothAndHowMuchOfIt) {
  const Eigen::VectorXd u = scattered(3);
  const Eigen::MatrixXd basis = cubic_basis(u);
  const Eigen::VectorXd wave = (6.0 * u.array()).sin().matrix();
  const double beside_basis = (wave - basis * (basis.transpose() * wave)).squaredNorm();
  constexpr int kSeeds = 20;
  double mean = 0.0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Autocorrelation found = tested(u, swing(seed, 1.0) + wave, basis);
    EXPECT_LT(found.p, 1e-4) << seed;
    mean += found.explained / kSeeds;
  }
  // Near observations differ a little.
  EXPECT_LT(mean, 1.1 * beside_basis);
  EXPECT_GT(mean, 0.7 * beside_basis);
}

TEST(Autocorrelation, OfAnotherCoordinateShowsNothing) {
  const Eigen::VectorXd u = scattered(5);
  const Eigen::VectorXd wave = (6.0 * scattered(6).array()).sin().matrix();
  EXPECT_GT(tested(u, swing(7, 1.0) + wave, cubic_basis(u)).p, 0.01);
}

TEST(Autocorrelation, LeavesOutExcludedObservations) {
  const Eigen::VectorXd u = scattered(8);
  LinearModel model;
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(kRows);
  model.data() = swing(9, 1.0);
  for (Index i = 0; i < kRows; ++i) {
    if (u[i] < 0.8) continue;
    weights[i] = 0.0;
    model.data()[i] = 0.0;
  }
  model.add_context(u);
  model.add_direction(Eigen::VectorXd::Ones(kRows));
  EXPECT_GT(test_autocorrelation(model, cubic_basis(u), weights.sum() - 4.0, weights, 1).front().p,
            0.01);
}

TEST(Autocorrelation, WithoutContextsTestsNothing) {
  LinearModel model;
  EXPECT_TRUE(test_autocorrelation(model, cubic_basis(scattered(1)), kRows - 4.0,
                                   Eigen::VectorXd::Ones(kRows), 1)
                  .empty());
}

}  // namespace
}  // namespace bathyal::selection
