// SPDX-License-Identifier: BSD-3-Clause
// BlueROV2's eight thrusters: inverse of their matrix, limits, and every loss of one and of two.
#include "bathyal/control/allocation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "bathyal/base/random.hpp"
#include "bathyal/control/internal/bounded_least_squares.hpp"
#include "bathyal/vehicle/device_presets.hpp"

namespace bathyal {
namespace {

Allocation bluerov() { return Allocation(VehicleSystem(bluerov2_heavy_system()).thrusters()); }

Vec6 random_wrench(RandomStream& random, double force, double moment) {
  Vec6 wrench;
  for (int i = 0; i < 6; ++i) wrench[i] = random.uniform(-1.0, 1.0) * (i < 3 ? force : moment);
  return wrench;
}

TEST(Allocation, GivesWhatIsAskedFor) {
  const Allocation allocation = bluerov();
  RandomStream random(1);
  AllocationResult result;
  for (int k = 0; k < 200; ++k) {
    const Vec6 wrench = random_wrench(random, 20.0, 2.0);
    allocation.allocate(wrench, 15.0, {}, result);
    EXPECT_FALSE(result.saturated);
    EXPECT_LT((result.achieved - wrench).norm(), 1e-5);
    Vec6 given = Vec6::Zero();
    for (std::size_t i = 0; i < 8; ++i) {
      given += allocation.thrusters()[i].steady(result.command[i], 15.0).thrust *
               allocation.thrusters()[i].column();
    }
    EXPECT_LT((given - wrench).norm(), 1e-5);
  }
}

TEST(Allocation, KeepsAttitudeAndHeaveFirst) {
  const Allocation allocation = bluerov();
  AllocationResult result;
  Vec6 wrench;
  wrench << 400.0, 0.0, 60.0, 2.0, 6.0, 3.0;  // far more surge than there is
  allocation.allocate(wrench, 16.0, {}, result);
  EXPECT_TRUE(result.saturated);
  for (const int axis : {2, 3, 4}) {
    EXPECT_NEAR(result.achieved[axis], wrench[axis], 0.02 * std::abs(wrench[axis])) << axis;
  }
  EXPECT_GT(result.achieved[0], 100.0);
  EXPECT_LT(result.achieved[0], 200.0);
}

TEST(Allocation, GivesNineteenNewtonMetresInPitch) {
  const Allocation allocation = bluerov();
  AllocationResult result;
  Vec6 wrench = Vec6::Zero();
  wrench[4] = 18.5;  // 4 · 0.12 m · 38.97 N astern = 18.7
  allocation.allocate(wrench, 16.0, {}, result);
  EXPECT_FALSE(result.saturated);
  EXPECT_LT((result.achieved - wrench).norm(), 1e-4);
  wrench[4] = 19.5;
  allocation.allocate(wrench, 16.0, {}, result);
  EXPECT_TRUE(result.saturated);
  EXPECT_GT((result.achieved - wrench).norm(), 0.1);
}

TEST(Allocation, LosesThrustAsTheVoltageSags) {
  const Allocation allocation = bluerov();
  AllocationResult full, low;
  Vec6 wrench = Vec6::Zero();
  wrench[2] = 1000.0;
  allocation.allocate(wrench, 16.0, {}, full);
  allocation.allocate(wrench, 12.0, {}, low);
  EXPECT_LT(low.achieved[2], 0.8 * full.achieved[2]);
  wrench[2] = 40.0;
  allocation.allocate(wrench, 12.0, {}, low);
  EXPECT_NEAR(low.achieved[2], 40.0, 1e-5);
  EXPECT_GT(low.command[4], 0.0);
}

TEST(Allocation, KeepsItsRankAfterAnySingleLoss) {
  const Allocation allocation = bluerov();
  EXPECT_EQ(allocation.rank().rank, 6);
  for (int a = 0; a < 8; ++a) EXPECT_EQ(allocation.rank({a}).rank, 6) << a;
}

TEST(Allocation, NamesWhatADoubleLossTakesAndHoldsTheRest) {
  const Allocation allocation = bluerov();
  RandomStream random(2);
  AllocationResult result;
  int whole = 0, less = 0;
  for (int a = 0; a < 8; ++a) {
    for (int b = a + 1; b < 8; ++b) {
      const AllocationRank rank = allocation.rank({a, b});
      rank.rank == 6 ? ++whole : ++less;
      EXPECT_EQ(rank.lost.size(), static_cast<std::size_t>(6 - rank.rank));
      if (rank.rank == 6) continue;
      ASSERT_EQ(rank.rank, 5);
      const int lost = rank.lost[0];
      if (b < 4) {
        EXPECT_EQ(lost, b - a == 2 ? 0 : 1) << a << b;
      }  // level ones: surge, sway
      if (a >= 4 && a + b != 11) {
        EXPECT_EQ(lost, b - a == 1 ? 4 : 3) << a << b;
      }  // vertical ones
      for (int k = 0; k < 20; ++k) {
        const Vec6 wrench = random_wrench(random, 8.0, 0.8);
        allocation.allocate(wrench, 16.0, {a, b}, result);
        EXPECT_EQ(result.thrust[static_cast<std::size_t>(a)], 0.0);
        EXPECT_EQ(result.command[static_cast<std::size_t>(b)], 0.0);
        for (int axis = 0; axis < 6; ++axis) {
          if (axis != lost) {
            EXPECT_NEAR(result.achieved[axis], wrench[axis], 1e-4) << a << b << axis;
          }
        }
      }
    }
  }
  EXPECT_EQ(whole, 16);
  EXPECT_EQ(less, 12);
}

/// The best of all ways in which the unknowns may lie at their bounds or between.
double least_by_search(const control_internal::Columns& a, const control_internal::Rows& b,
                       const control_internal::Unknowns& low,
                       const control_internal::Unknowns& high) {
  const int count = static_cast<int>(a.cols());
  double least = std::numeric_limits<double>::infinity();
  for (int code = 0; code < static_cast<int>(std::pow(3, count)); ++code) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(count);
    Eigen::VectorXd rest = b;
    std::vector<int> open;
    for (int j = 0, c = code; j < count; ++j, c /= 3) {
      if (c % 3 == 0)
        open.push_back(j);
      else
        x[j] = c % 3 == 1 ? low[j] : high[j], rest -= a.col(j) * x[j];
    }
    if (!open.empty()) {
      Eigen::MatrixXd part(a.rows(), open.size());
      for (std::size_t k = 0; k < open.size(); ++k) part.col(k) = a.col(open[k]);
      const Eigen::VectorXd found = part.colPivHouseholderQr().solve(rest);
      for (std::size_t k = 0; k < open.size(); ++k) x[open[k]] = found[k];
    }
    if (((x - low).array() < -1e-12).any() || ((x - high).array() > 1e-12).any()) continue;
    least = std::min(least, (a * x - b).norm());
  }
  return least;
}

TEST(BoundedLeastSquares, IsTheBestOfAllActiveSets) {
  RandomStream random(3);
  for (int round = 0; round < 300; ++round) {
    control_internal::Columns a(7, 5);
    control_internal::Rows b(7);
    control_internal::Unknowns low(5), high(5);
    for (double& value : a.reshaped()) value = random.normal();
    for (double& value : b) value = 3.0 * random.normal();
    for (double& value : low) value = -random.uniform();
    for (double& value : high) value = random.uniform();
    const auto x = control_internal::bounded_least_squares(a, b, low, high);
    EXPECT_GE((x - low).minCoeff(), 0.0);
    EXPECT_GE((high - x).minCoeff(), 0.0);
    EXPECT_NEAR((a * x - b).norm(), least_by_search(a, b, low, high), 1e-9) << round;
  }
}

TEST(Allocation, BadInput) {
  const Allocation allocation = bluerov();
  AllocationResult result;
  EXPECT_THROW(Allocation({}), std::invalid_argument);
  AllocationOptions options;
  options.effort = 0.0;
  EXPECT_THROW(Allocation(allocation.thrusters(), options), std::invalid_argument);
  EXPECT_THROW(allocation.rank({8}), std::invalid_argument);
  EXPECT_THROW(allocation.allocate(Vec6::Constant(std::nan("")), 16.0, {}, result),
               std::invalid_argument);
  EXPECT_THROW(allocation.allocate(Vec6::Zero(), -1.0, {}, result), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
