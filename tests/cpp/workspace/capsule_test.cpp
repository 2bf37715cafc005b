// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/capsule.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace bathyal {
namespace {

Vec3 random_point(std::mt19937_64& random, double size = 1.0) {
  std::uniform_real_distribution<double> uniform(-size, size);
  return {uniform(random), uniform(random), uniform(random)};
}

/// The distance from a segment is convex along another: thirds of an interval find its least.
double least_by_thirds(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1) {
  const auto at = [&](double s) {
    const Vec3 point = a0 + s * (a1 - a0), span = b1 - b0;
    const double t = std::clamp(span.dot(point - b0) / span.squaredNorm(), 0.0, 1.0);
    return (point - b0 - t * span).norm();
  };
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 200; ++i) {
    const double left = low + (high - low) / 3.0, right = high - (high - low) / 3.0;
    (at(left) <= at(right) ? high : low) = at(left) <= at(right) ? right : left;
  }
  return std::min({at(0.0), at(1.0), at(low)});
}

TEST(Capsule, SegmentsThatCrossTouchOrRunInParallel) {
  const Vec3 o = Vec3::Zero(), x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  const SegmentPair crossing = nearest_of_segments(-x, x, z - y, z + y);
  EXPECT_DOUBLE_EQ(crossing.distance, 1.0);
  EXPECT_DOUBLE_EQ(crossing.first, 0.5);
  EXPECT_DOUBLE_EQ(crossing.second, 0.5);
  EXPECT_DOUBLE_EQ(nearest_of_segments(o, x, x, x + y).distance, 0.0);
  EXPECT_DOUBLE_EQ(nearest_of_segments(o, x, y, x + y).distance, 1.0);
  EXPECT_DOUBLE_EQ(nearest_of_segments(o, x, 3.0 * x, 2.0 * x).distance, 1.0);
  EXPECT_DOUBLE_EQ(nearest_of_segments(o, o, y, y).distance, 1.0);
  EXPECT_DOUBLE_EQ(nearest_of_segments(o, x, 0.25 * x + y, 0.25 * x + y).first, 0.25);
}

TEST(Capsule, RandomSegmentsAgreeWithConvexSearch) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 300; ++i) {
    const Vec3 a0 = random_point(random), b0 = random_point(random);
    const double length = i % 3 == 0 ? 1e-9 : 1.0;
    const Vec3 a1 = a0 + length * random_point(random);
    const Vec3 along = i % 5 == 0 ? Vec3(0.7 * (a1 - a0)) : random_point(random), b1 = b0 + along;
    const double found = nearest_of_segments(a0, a1, b0, b1).distance;
    EXPECT_NEAR(found, least_by_thirds(a0, a1, b0, b1), 1e-9) << i;
    const SegmentPair pair = nearest_of_segments(a0, a1, b0, b1);
    const Vec3 gap = a0 + pair.first * (a1 - a0) - b0 - pair.second * (b1 - b0);
    EXPECT_NEAR(gap.norm(), pair.distance, 1e-15) << i;
  }
}

TEST(Capsule, OverlapIsNegative) {
  const Capsule one{Vec3::Zero(), Vec3::UnitX(), 0.3};
  const Capsule other{{0.5, -1.0, 0.4}, {0.5, 1.0, 0.4}, 0.2};
  EXPECT_NEAR(distance(one, other), -0.1, 1e-15);
}

TEST(Capsule, FitContainsAllPointsAndIsTight) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 20; ++i) {
    // Points of a known capsule, anywhere in space; the fit may be larger by a few per cent.
    const Vec3 start = 100.0 * random_point(random), end = start + random_point(random);
    const double radius = 0.2;
    Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> points(2000, 3);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (Index k = 0; k < points.rows(); ++k) {
      points.row(k) =
          (start + uniform(random) * (end - start) + radius * random_point(random).normalized())
              .transpose();
    }
    const Capsule fit = fit_capsule({points.data(), points.rows(), 3});
    for (Index k = 0; k < points.rows(); ++k) {
      const Vec3 point = points.row(k).transpose();
      EXPECT_LE(nearest_of_segments(fit.start, fit.end, point, point).distance, fit.radius + 1e-9);
    }
    const double length = (fit.end - fit.start).norm();
    EXPECT_LT(fit.radius, 1.1 * radius);
    EXPECT_LT(length + 2.0 * fit.radius, (end - start).norm() + 2.2 * radius);
  }
}

TEST(Capsule, FitOfOnePointOrOfALine) {
  const Eigen::Matrix<double, 1, 3, Eigen::RowMajor> one{{1.0, 2.0, 3.0}};
  const Capsule ball = fit_capsule({one.data(), 1, 3});
  EXPECT_EQ(ball.radius, 0.0);
  EXPECT_TRUE(ball.start.isApprox(Vec3(1.0, 2.0, 3.0)));
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> line{
      {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {2.0, 2.0, 2.0}};
  const Capsule thin = fit_capsule({line.data(), 3, 3});
  EXPECT_LT(thin.radius, 1e-12);
  EXPECT_NEAR((thin.end - thin.start).norm(), std::sqrt(12.0), 1e-9);
}

TEST(Capsule, Refusals) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((Capsule{Vec3::Zero(), Vec3::Zero(), -1.0}.check()), std::invalid_argument);
  EXPECT_THROW((Capsule{Vec3::Zero(), Vec3::Zero(), nan}.check()), std::invalid_argument);
  EXPECT_THROW((Capsule{Vec3(nan, 0, 0), Vec3::Zero(), 1.0}.check()), std::invalid_argument);
  const Eigen::Matrix<double, 1, 3, Eigen::RowMajor> bad{{nan, 0.0, 0.0}};
  EXPECT_THROW(fit_capsule({bad.data(), 1, 3}), std::invalid_argument);
  EXPECT_THROW(fit_capsule({nullptr, 0, 3}), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
