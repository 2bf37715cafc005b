// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/registration.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <stdexcept>

#include "bathyal/base/error.hpp"
#include "bathyal/base/random.hpp"

namespace bathyal {
namespace {

PointView view(const PointMatrix& points) { return {points.data(), points.rows(), 3}; }

PointMatrix lattice() {
  RandomStream random(1);
  PointMatrix points(27, 3);
  for (int i = 0; i < 27; ++i) {
    const Eigen::RowVector3d node(i % 3, i / 3 % 3, i / 9);
    for (int k = 0; k < 3; ++k) points(i, k) = node[k] + random.uniform(-0.2, 0.2);
  }
  return points;
}

TEST(PairByIcp, FindsTheRowsAfterAMotionAndAShuffle) {
  const PointMatrix points = lattice();
  const Eigen::AngleAxisd turn(0.08, Vec3(1, 1, -1).normalized());
  PointMatrix measured(27, 3);
  std::vector<Index> expected(27);
  for (Index i = 0; i < 27; ++i) {
    const Index row = (i * 10) % 27;  // 10 and 27 have no factor in common
    expected[static_cast<std::size_t>(i)] = row;
    measured.row(row) = (turn * points.row(i).transpose() + Vec3(4e5, 6e6, -30)).transpose();
  }
  EXPECT_EQ(pair_by_icp(view(points), view(measured)), expected);
}

TEST(PairByIcp, RefusesWhatItCannotPair) {
  PointMatrix points = lattice();
  const PointMatrix two = points.topRows(2);
  EXPECT_THROW(pair_by_icp(view(two), view(points)), std::invalid_argument);
  points(4, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(pair_by_icp(view(points), view(points)), std::invalid_argument);
  EXPECT_THROW(pair_by_icp(view(two), view(two), {.max_iterations = 0}), std::invalid_argument);
}

TEST(PairByIcp, LeavesOverWhatNobodyPredicted) {
  const PointMatrix points = lattice();
  PointMatrix measured(28, 3);
  measured << points, Eigen::RowVector3d(1.5, 1.5, 1.5);
  std::vector<Index> expected(27);
  std::iota(expected.begin(), expected.end(), Index{0});
  EXPECT_EQ(pair_by_icp(view(points), view(measured)), expected);
  EXPECT_THROW(pair_by_icp(view(measured), view(points)), std::invalid_argument);
}

TEST(PairByIcp, NeverGivesOnePositionTwice) {
  const PointMatrix points = lattice();
  PointMatrix measured = points;
  measured.row(13) += Eigen::RowVector3d(3.0, 3.0, 3.0);  // far from its prediction
  EXPECT_THROW(pair_by_icp(view(points), view(measured)), Error);
}

}  // namespace
}  // namespace bathyal
