// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/internal/fold_least_squares.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "bathyal/base/random.hpp"

namespace bathyal {
namespace {

Units units_of(int count) {
  Units units;
  units.order.resize(static_cast<std::size_t>(count));
  std::iota(units.order.begin(), units.order.end(), 0);
  units.twin = units.order;
  units.session.assign(units.order.size(), 0);
  units.point.assign(units.order.size(), -1);
  return units;
}

Eigen::MatrixXd normal(std::uint64_t seed, Index rows, Index columns) {
  Eigen::MatrixXd out(rows, columns);
  RandomStream random(seed);
  for (double& value : out.reshaped()) value = random.normal();
  return out;
}

TEST(HoldOut, ForetellsAsAFitToTheOthersDoes) {
  constexpr Index kRows = 60;
  Eigen::MatrixXd columns = normal(1, kRows, 4);
  columns.colwise().normalize();
  const Eigen::VectorXd misfit = normal(2, kRows, 1);
  std::vector<int> unit(kRows);
  for (Index r = 0; r < kRows; ++r) unit[r] = r < 3 ? -1 : static_cast<int>(r / 3);
  Blocks blocks;
  blocks.count = 4;
  for (int u = 0; u < 20; ++u) blocks.of.push_back(u % 4);
  const HoldOut held(misfit, columns, Eigen::VectorXd::Zero(columns.cols()), unit, blocks, 2);
  const HeldOutErrors found = held.errors({0, 1, 3});
  EXPECT_EQ(held.rows(), kRows - 3.0);
  EXPECT_TRUE(found.error.head(3).isZero());
  EXPECT_TRUE(held.squares({0, 1, 3}).isApprox(found.of_block, 1e-9));
  double density = 0.0;
  for (int b = 0; b < 4; ++b) {
    std::vector<Index> own, others;
    for (Index r = 0; r < kRows; ++r) {
      (unit[r] >= 0 && blocks.of[unit[r]] == b ? own : others).push_back(r);
    }
    const std::vector<Index> which{0, 1, 3};
    const Eigen::VectorXd values =
        Eigen::MatrixXd(columns(others, which)).colPivHouseholderQr().solve(misfit(others));
    const Eigen::VectorXd error = misfit(own) - columns(own, which) * values;
    EXPECT_TRUE(error.isApprox(found.error(own), 1e-6)) << b;
    const Eigen::MatrixXd used = columns(others, which), asked = columns(own, which);
    const Eigen::MatrixXd covariance =
        Eigen::MatrixXd::Identity(error.size(), error.size()) +
        asked * (used.transpose() * used).inverse() * asked.transpose();
    density -=
        0.5 * error.dot(covariance.inverse() * error) + 0.5 * std::log(covariance.determinant());
  }
  EXPECT_NEAR(held.density({0, 1, 3}), density, 1e-5);
}

TEST(Blocks, PointsThatEverySessionTouchesAreHeldOutEachByItself) {
  Units units = units_of(180);
  for (int u = 0; u < 180; ++u) {
    units.point[static_cast<std::size_t>(u)] = u % 6;
    units.session[static_cast<std::size_t>(u)] = u / 60;
  }
  const Blocks blocks = make_blocks(units, 10);
  ASSERT_EQ(blocks.count, 6);
  for (int u = 0; u < 180; ++u) EXPECT_EQ(blocks.of[u], blocks.of[u % 6]);
}

TEST(Blocks, PosesThatEverySessionRepeatsAreDealtOutEvenly) {
  Units units = units_of(180);
  for (int u = 0; u < 180; ++u) {
    units.twin[static_cast<std::size_t>(u)] = u % 60;
    units.session[static_cast<std::size_t>(u)] = u / 60;
  }
  const Blocks blocks = make_blocks(units, 10);
  ASSERT_EQ(blocks.count, 10);
  for (int b = 0; b < 10; ++b) EXPECT_EQ(std::count(blocks.of.begin(), blocks.of.end(), b), 18);
}

TEST(Blocks, SessionsOfFewRowsShareThem) {
  Units units = units_of(90);
  for (const int rows : {1, 2, 3}) {
    for (int u = 0; u < 90; ++u) units.session[static_cast<std::size_t>(u)] = u / rows;
    const Blocks blocks = make_blocks(units, 10);
    ASSERT_EQ(blocks.count, 10) << rows;
    for (int b = 0; b < 10; ++b) EXPECT_EQ(std::count(blocks.of.begin(), blocks.of.end(), b), 9);
  }
}

TEST(HoldOut, AColumnThatOneBlockAloneTellsStaysAtZero) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(9, 1);
  columns.topRows(3).setConstant(1.0 / std::sqrt(3.0));
  const Eigen::VectorXd misfit = Eigen::VectorXd::Constant(9, 2.0);
  const std::vector<int> unit{0, 0, 0, 1, 1, 1, 2, 2, 2};
  const Blocks blocks{{0, 1, 2}, 3, ""};
  const HoldOut held(misfit, columns, Eigen::VectorXd::Zero(columns.cols()), unit, blocks, 1);
  EXPECT_NEAR(held.errors({0}).error[0], 2.0, 1e-9);
}

TEST(Blocks, CutTimeIntoPiecesOfOneSize) {
  const Blocks blocks = make_blocks(units_of(95));
  EXPECT_EQ(blocks.count, 10);
  std::vector<int> size(10, 0);
  for (const int b : blocks.of) ++size[b];
  for (const int s : size) EXPECT_NEAR(s, 9.5, 0.6);
  for (std::size_t i = 1; i < blocks.of.size(); ++i) EXPECT_GE(blocks.of[i], blocks.of[i - 1]);
}

TEST(Blocks, OfAListWithoutTimesAreShortRunsFromAllOverIt) {
  Units units = units_of(240);
  units.timed = false;
  const Blocks blocks = make_blocks(units);
  EXPECT_EQ(blocks.count, 10);
  for (int b = 0; b < blocks.count; ++b) {
    int runs = 0;
    for (std::size_t i = 0; i < blocks.of.size(); ++i) {
      if (blocks.of[i] == b && (i == 0 || blocks.of[i - 1] != b)) ++runs;
    }
    EXPECT_EQ(runs, 8);
  }
}

TEST(Blocks, KeepTwinsTogetherAndGiveEverySessionItsShare) {
  Units units = units_of(200);
  for (int i = 0; i < 200; ++i) {
    units.session[i] = i / 100;
    units.twin[i] = i % 50;
  }
  const Blocks blocks = make_blocks(units);
  for (int i = 0; i < 200; ++i) EXPECT_EQ(blocks.of[i], blocks.of[i % 50]);
  for (int b = 0; b < blocks.count; ++b) {
    std::set<int> sessions;
    for (int i = 0; i < 200; ++i) {
      if (blocks.of[i] == b) sessions.insert(units.session[i]);
    }
    EXPECT_EQ(sessions.size(), 2u);
  }
}

TEST(Blocks, TakeWholePointsThoughTheirTouchesAlternate) {
  Units units = units_of(120);
  for (int i = 0; i < 120; ++i) units.point[i] = i % 12;
  const Blocks blocks = make_blocks(units);
  EXPECT_GE(blocks.count, 6);
  for (int i = 0; i < 120; ++i) EXPECT_EQ(blocks.of[i], blocks.of[i % 12]);
}

TEST(Blocks, OneChainOfTwinsCannotBeHeldOut) {
  Units units = units_of(30);
  units.twin.assign(30, 0);
  EXPECT_EQ(make_blocks(units).count, 1);
}

TEST(Twins, AreFoundAlongChains) {
  Eigen::MatrixXd q(5, 2);
  q << 0.0, 0.0, 0.0009, 0.0, 0.0018, 0.0, 0.0018, 1.0, 3.0, 0.0;
  EXPECT_EQ(find_twins(q, 1e-3), (std::vector<int>{0, 0, 0, 1, 2}));
}

TEST(SignFlips, AllGainsAreLuckOnceInTwoToTheBlocks) {
  EXPECT_DOUBLE_EQ(sign_flip_p(Eigen::VectorXd::Ones(10)), 1.0 / 1024.0);
  EXPECT_GT(sign_flip_p(Eigen::VectorXd::Zero(5)), 0.99);
  Eigen::VectorXd gains(4);
  gains << 3.0, -1.0, 2.0, -4.0;
  EXPECT_DOUBLE_EQ(sign_flip_p(gains), 9.0 / 16.0);
}

}  // namespace
}  // namespace bathyal
