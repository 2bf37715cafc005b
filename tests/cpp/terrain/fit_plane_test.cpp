// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/terrain/fit_plane.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <string>

#include "bathyal/base/random.hpp"

namespace bathyal {
namespace {

const Vec3 kUtm(620152.5, 7246504.25, -52.75);

/// A 20 m square of soundings about `centre` on the plane z = a x + b y, with noise and a share of
/// gross errors from −5 to 10 m.
PointMatrix soundings(std::uint64_t seed, Index count, double a, double b, double noise,
                      double outliers, const Vec3& centre) {
  PointMatrix points(count, 3);
  RandomStream draw(seed);
  for (Index i = 0; i < count; ++i) {
    const double x = draw.uniform(-10, 10), y = draw.uniform(-10, 10);
    const double wrong = draw.uniform() < outliers ? draw.uniform(-5, 10) : 0.0;
    points.row(i) = Vec3(x, y, a * x + b * y + noise * draw.normal() + wrong) + centre;
  }
  return points;
}

PlaneFit fit(const PointMatrix& points, const FitPlaneOptions& options = {}) {
  return fit_plane(Points(points).view(), options);
}

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

std::string refusal(const PointMatrix& points) {
  try {
    fit(points);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(FitPlane, IsExactOnAnExactPlane) {
  const Vec3 up = Vec3(-0.1, 0.25, 1.0).normalized();
  for (const Vec3& centre : {Vec3(0, 0, 0), kUtm, Vec3(1e7, -1e7, 5e3)}) {
    const PlaneFit result = fit(soundings(1, 500, 0.1, -0.25, 0.0, 0.0, centre));
    EXPECT_LT(angle_between(result.plane.normal(), up), 1e-8);
    EXPECT_NEAR(result.plane.distance(centre), 0.0, 1e-8);
    EXPECT_LT(result.rms, 1e-8);
    EXPECT_EQ(result.inlier_count, 500);
    EXPECT_TRUE(result.flat);
  }
}

TEST(FitPlane, ThreePointsAreEnough) {
  PointMatrix points(3, 3);
  points << 0, 0, 1, 4, 0, 1, 0, 3, 1;
  const PlaneFit result = fit(points);
  EXPECT_LT((result.plane.normal() - Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_NEAR(result.plane.offset(), 1.0, 1e-12);
}

// Without outliers the tilt's standard deviation is noise / (√n × spread); five of it is allowed,
// and half as much again for the third of the points that is lost.
TEST(FitPlane, IsNotDisturbedByThirtyOrFortyPercentOfGrossErrors) {
  const Vec3 up = Vec3(-0.05, 0.1, 1.0).normalized();
  for (const double outliers : {0.0, 0.3, 0.4}) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      const PlaneFit result = fit(soundings(seed, 1000, 0.05, -0.1, 0.02, outliers, kUtm));
      EXPECT_LT(angle_between(result.plane.normal(), up), 7.5 * 0.02 / (std::sqrt(1000.0) * 5.77))
          << seed;
      EXPECT_NEAR(result.plane.distance(kUtm), 0.0, 7.5 * 0.02 / std::sqrt(1000.0)) << seed;
      EXPECT_NEAR(result.rms, 0.02, 0.003) << seed;
      EXPECT_NEAR(static_cast<double>(result.inlier_count) / 1000.0, 1.0 - outliers, 0.06) << seed;
    }
  }
}

// 450 of 1000, to the point: spread to both sides, all to one side, a second bottom 3 m above the
// first (a school of fish, a sound speed that is off), and a heap.
TEST(FitPlane, IsNotDisturbedByFortyFivePercentOfGrossErrorsOfAnyKind) {
  const Vec3 up = Vec3(-0.05, 0.1, 1.0).normalized();
  const std::vector<std::function<Vec3(RandomStream&)>> kinds{
      [](RandomStream& draw) { return Vec3(0, 0, draw.uniform(-10, 10)); },
      [](RandomStream& draw) { return Vec3(0, 0, draw.uniform(0.2, 10)); },
      [](RandomStream&) { return Vec3(0, 0, 3); },
      [](RandomStream& draw) { return Vec3(draw.uniform(4, 6), 5, draw.uniform(4, 6)); },
  };
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    for (std::uint64_t seed = 0; seed < 25; ++seed) {
      PointMatrix points = soundings(seed, 1000, 0.05, -0.1, 0.02, 0.0, Vec3::Zero());
      RandomStream draw(1000 + seed);
      for (Index i = 0; i < 450; ++i) {
        const Vec3 wrong = kinds[kind](draw);
        const bool heap = wrong.x() != 0.0;
        points.row(i) = heap ? wrong : Vec3(points.row(i).transpose() + wrong);
      }
      points.rowwise() += kUtm.transpose();
      const PlaneFit result = fit(points);
      EXPECT_LT(angle_between(result.plane.normal(), up), 7.5 * 0.02 / (std::sqrt(1000.0) * 5.77))
          << kind << ", " << seed;
      EXPECT_NEAR(result.plane.distance(kUtm), 0.0, 7.5 * 0.02 / std::sqrt(1000.0))
          << kind << ", " << seed;
      EXPECT_NEAR(result.rms, 0.02, 0.004) << kind << ", " << seed;
    }
  }
}

TEST(FitPlane, IsNotDrawnByAClusterOfErrorsOnOneSide) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    PointMatrix points = soundings(seed, 1000, 0.0, 0.0, 0.02, 0.0, Vec3::Zero());
    for (int i = 0; i < 300; ++i) {
      points.row(i) = Vec3(8.0 + 0.001 * i, 8.0, 6.0 + 0.002 * i);
    }
    EXPECT_LT(angle_between(fit(points).plane.normal(), Vec3::UnitZ()), 1e-3) << seed;
  }
}

TEST(FitPlane, TiltStandardDeviationIsWhatTheTiltScattersBy) {
  double squares = 0.0, predicted = 0.0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const PlaneFit result = fit(soundings(seed, 200, 0.0, 0.0, 0.05, 0.0, Vec3::Zero()));
    squares += result.plane.normal().x() * result.plane.normal().x() / 200.0;
    predicted += result.tilt_std / 200.0;
  }
  EXPECT_NEAR(std::sqrt(squares) / predicted, 1.0, 0.15);
}

TEST(FitPlane, NormalPointsUpAndAVerticalPlaneKeepsTheStatedSide) {
  const PointMatrix level = soundings(3, 100, 0.0, 0.0, 0.0, 0.0, Vec3::Zero());
  for (const double angle : {0.3, 1.2, 1.5, 1.7, 3.0, 4.5, 6.0}) {
    const Eigen::AngleAxisd turn(angle, Vec3::UnitX());
    const PointMatrix turned = level * turn.toRotationMatrix().transpose();
    EXPECT_GT(fit(turned).plane.normal().z(), 0.0) << angle;
  }
  PointMatrix wall = level;
  wall.col(0) = level.col(2);
  wall.col(2) = level.col(0);
  EXPECT_LT((fit(wall).plane.normal() - Vec3::UnitX()).norm(), 1e-9);
}

TEST(FitPlane, MovesWithARigidMotion) {
  const PointMatrix points = soundings(4, 2000, 0.1, 0.2, 0.03, 0.3, Vec3::Zero());
  const PlaneFit before = fit(points);
  const Eigen::Isometry3d motion =
      Eigen::Translation3d(1e5, -3e5, 40.0) * Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized());
  PointMatrix moved(points.rows(), 3);
  for (Index i = 0; i < points.rows(); ++i) {
    moved.row(i) = (motion * Vec3(points.row(i).transpose())).transpose();
  }
  const PlaneFit after = fit(moved);
  EXPECT_LT(angle_between(motion.linear() * before.plane.normal(), after.plane.normal()), 1e-8);
  EXPECT_NEAR(after.rms, before.rms, 1e-9);
  EXPECT_EQ(after.inliers, before.inliers);
}

TEST(FitPlane, DoesNotDependOnTheOrderOfThePointsNorOnThreads) {
  const PointMatrix points = soundings(5, 100000, 0.1, 0.2, 0.03, 0.3, kUtm);
  const PlaneFit forward = fit(points);
  const PlaneFit backward = fit(points.colwise().reverse());
  EXPECT_LT(angle_between(forward.plane.normal(), backward.plane.normal()), 1e-9);
  EXPECT_EQ(forward.inlier_count, backward.inlier_count);
  for (const int threads : {1, 8}) {
    const PlaneFit again = fit(points, {.num_threads = threads});
    EXPECT_EQ(again.plane.normal(), forward.plane.normal());
    EXPECT_EQ(again.plane.offset(), forward.plane.offset());
    EXPECT_EQ(again.inliers, forward.inliers);
  }
}

TEST(FitPlane, CallsFlatWhatTheToolWouldFindFlat) {
  EXPECT_TRUE(fit(soundings(6, 20000, 0.1, 0.0, 0.05, 0.0, kUtm)).flat);  // noise is no relief
  EXPECT_TRUE(fit(soundings(6, 20000, 0.1, 0.0, 0.02, 0.2, kUtm)).flat);  // nor are spikes
  PointMatrix waves = soundings(6, 20000, 0.1, 0.0, 0.01, 0.0, Vec3::Zero());
  for (Index i = 0; i < waves.rows(); ++i) waves(i, 2) += 0.2 * std::sin(waves(i, 0));
  const PlaneFit wavy = fit(waves);
  EXPECT_FALSE(wavy.flat);
  EXPECT_NEAR(wavy.relief, 0.2, 0.03);
  EXPECT_TRUE(fit(waves, {.tolerance = 0.25}).flat);
  PointMatrix boulder = soundings(6, 20000, 0.1, 0.0, 0.01, 0.0, Vec3::Zero());
  for (Index i = 0; i < boulder.rows(); ++i) {
    if (boulder.row(i).head<2>().norm() < 1.5) boulder(i, 2) += 0.8;
  }
  const PlaneFit bouldery = fit(boulder);
  EXPECT_FALSE(bouldery.flat);
  EXPECT_NEAR(bouldery.relief, 0.8, 0.05);
  EXPECT_NEAR(bouldery.rms, 0.01, 0.001);
}

TEST(FitPlane, RefusesWhatHasNoPlane) {
  PointMatrix points(0, 3);
  EXPECT_EQ(refusal(points), "`points`: expected three points or more, got 0");
  points = PointMatrix::Constant(5, 3, 7e6);
  EXPECT_NE(refusal(points).find("one line or in one place"), std::string::npos);
  points.resize(100, 3);
  for (int i = 0; i < 100; ++i) points.row(i) = kUtm + 0.37 * i * Vec3(1, 2, 0.1);
  EXPECT_NE(refusal(points).find("one line or in one place"), std::string::npos);
  for (int i = 0; i < 30; ++i)
    points.row(i) += Vec3(0.1 * (i % 7), -0.2 * (i % 5), 1.0 + i).transpose();
  EXPECT_NE(refusal(points).find("over 90 % of the"), std::string::npos);
  points(3, 1) = -1e80;
  EXPECT_NE(refusal(points).find("1e75"), std::string::npos);
  points(3, 1) = NAN;
  EXPECT_NE(refusal(points).find("row 3"), std::string::npos);
}

TEST(FitPlane, ChecksItsOptions) {
  const PointMatrix points = soundings(7, 100, 0.0, 0.0, 0.0, 0.0, Vec3::Zero());
  EXPECT_THROW(fit(points, {.tolerance = 0.0}), std::invalid_argument);
  EXPECT_THROW(fit(points, {.patch_points = 4}), std::invalid_argument);
  EXPECT_THROW(fit(points, {.flat_share = 1.1}), std::invalid_argument);
  EXPECT_THROW(fit(points, {.trials = 0}), std::invalid_argument);
  EXPECT_THROW(fit(points, {.num_threads = -1}), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
