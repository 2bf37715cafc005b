// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/navigation/dead_reckoning.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace bathyal {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A straight run along x, reckoned with a yaw error of bias + drift · time and a scale error.
double end_error(double length, double speed, double bias, double drift, double scale) {
  const int rows = 3601;
  const double step = length / speed / (rows - 1);
  std::vector<double> time;
  PointMatrix attitude = PointMatrix::Zero(rows, 3), velocity = PointMatrix::Zero(rows, 3);
  for (int i = 0; i < rows; ++i) {
    time.push_back(step * i);
    attitude(i, 2) = bias + drift * time.back();
    velocity(i, 0) = speed * (1.0 + scale);
  }
  const PointMatrix position = dead_reckon(time, attitude, velocity);
  return (position.row(rows - 1) - Eigen::RowVector3d(length, 0.0, 0.0)).norm();
}

TEST(DeadReckoning, ErrsAsTheFormulasSay) {
  EXPECT_NEAR(end_error(1000.0, 1.5, 1.0 * kDegree, 0.0, 0.0), 17.45, 0.01);
  EXPECT_NEAR(end_error(1000.0, 1.5, 0.0, 0.0, 0.002), 2.0, 1e-9);
  EXPECT_NEAR(end_error(5400.0, 1.5, 0.0, 1.0 * kDegree / 3600.0, 0.0), 47.1, 0.05);
}

TEST(DeadReckoning, AttitudeTurnsTheVelocity) {
  PointMatrix attitude(2, 3), velocity(2, 3);
  attitude << 0.0, kDegree * 90.0, 0.0, 0.0, kDegree * 90.0, 0.0;  // bow down
  velocity << 1.0, 0.0, 0.0, 1.0, 0.0, 0.0;
  const PointMatrix position = dead_reckon({0.0, 2.0}, attitude, velocity);
  EXPECT_LT((position.row(1) - Eigen::RowVector3d(0.0, 0.0, -2.0)).norm(), 1e-12);
}

TEST(DeadReckoning, RefusesBadInput) {
  const PointMatrix rows = PointMatrix::Zero(2, 3);
  PointMatrix broken = rows;
  broken(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(dead_reckon({}, rows, rows), std::invalid_argument);
  EXPECT_THROW(dead_reckon({1.0, 1.0}, rows, rows), std::invalid_argument);
  EXPECT_THROW(dead_reckon({0.0, 1.0, 2.0}, rows, rows), std::invalid_argument);
  EXPECT_THROW(dead_reckon({0.0, 1.0}, broken, rows), std::invalid_argument);
  EXPECT_THROW(dead_reckon({0.0, 1.0}, rows, broken), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
