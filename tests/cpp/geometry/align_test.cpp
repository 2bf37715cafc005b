// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/geometry/align.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "bathyal/base/random.hpp"

namespace bathyal {
namespace {

PointMatrix random_points(Index count, std::uint64_t seed) {
  RandomStream random(seed);
  PointMatrix points(count, 3);
  for (Index i = 0; i < points.size(); ++i) points.data()[i] = random.uniform(-1.0, 1.0);
  return points;
}

PointView view(const PointMatrix& points) { return {points.data(), points.rows(), 3}; }

PointMatrix moved(const PointMatrix& points, const Pose& pose) {
  return (points * pose.linear().transpose()).rowwise() + pose.translation().transpose();
}

Pose some_pose() {
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(2.9, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  pose.translation() = Vec3(431212.0, 6172657.0, -33.0);
  return pose;
}

TEST(Align, FindsTheMotionAlsoAtSurveyCoordinates) {
  const PointMatrix points = random_points(20, 1);
  const PointMatrix target = moved(points, some_pose());
  const Pose found = align(view(points), view(target));
  EXPECT_LT((moved(points, found) - target).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LT((found.linear() - some_pose().linear()).norm(), 1e-8);
}

TEST(Align, NeverMirrors) {
  const PointMatrix points = random_points(12, 2);
  PointMatrix mirrored = points;
  mirrored.col(0) *= -1.0;
  EXPECT_GT(align(view(points), view(mirrored)).linear().determinant(), 0.0);
  PointMatrix flat = points;  // points of one plane leave the third direction to the sign
  flat.col(2).setZero();
  const PointMatrix target = moved(flat, some_pose());
  EXPECT_LT((moved(flat, align(view(flat), view(target))) - target).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(Align, NoMotionNearTheBestOneIsBetter) {
  const PointMatrix from = random_points(15, 3), onto = random_points(15, 4);
  const Pose best = align(view(from), view(onto));
  const double least = (moved(from, best) - onto).squaredNorm();
  RandomStream random(5);
  for (int trial = 0; trial < 100; ++trial) {
    const Vec3 turn(random.normal(), random.normal(), random.normal());
    Pose other = best;
    other.linear() = Eigen::AngleAxisd(1e-3, turn.normalized()) * best.linear();
    other.translation() += 1e-3 * Vec3(random.normal(), random.normal(), random.normal());
    EXPECT_GT((moved(from, other) - onto).squaredNorm(), least);
  }
}

TEST(Align, RefusesWhatDeterminesNoMotion) {
  const PointMatrix points = random_points(5, 6);
  PointMatrix line(5, 3);
  for (Index i = 0; i < 5; ++i) line.row(i) = static_cast<double>(i) * Eigen::RowVector3d(1, 2, 3);
  EXPECT_THROW(align(view(points), view(line)), std::invalid_argument);
  EXPECT_THROW(align(view(line), view(points)), std::invalid_argument);
  const PointMatrix two = points.topRows(2);
  EXPECT_THROW(align(view(two), view(two)), std::invalid_argument);
  EXPECT_THROW(align(view(points), view(two)), std::invalid_argument);
  PointMatrix broken = points;
  broken(3, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(align(view(points), view(broken)), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
