// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/navigation/navigation_smoother.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bathyal/navigation/internal/filter_steps.hpp"
#include "bathyal/navigation/smooth_reckoning.hpp"
#include "navigation/simulated_run.hpp"

namespace bathyal {
namespace {

/// A run of 20 s by all sensors, and its smoothed estimates, one a sample of the imu.
struct Smoothed {
  std::vector<NavigationEstimate> rows;
  NavigationEstimate last, middle;
  Vec6 bias;  ///< in the middle
};

Smoothed smoothed_run(std::uint64_t seed, double lag = 0.0, double late = 0.0) {
  NavigationOptions options = test::usual_options();
  options.lag = lag;
  options.devices[4].latency = late;
  NavigationRecord record(options);
  NavigationState state = test::wrong_start(record.filter(), seed);
  Smoothed got;
  test::run(
      record.filter(), state, seed, 20.0,
      [&](const SensorTruth& truth, const NavigationState& s,
          const std::vector<SensorState>& sensors) {
        if (std::abs(truth.time - 10.0) > 0.1) return;
        got.middle = s.now;
        got.bias = test::imu_bias(options.devices[0], sensors[0], seed);
      },
      &record.steps());
  got.rows = record.smoothed();
  got.last = state.now;
  return got;
}

TEST(NavigationSmoother, ItsErrorsAreAsLargeAsItSaysAndSmallerThanTheFilters) {
  const int seeds = 20;
  double sum = 0.0, filtered = 0.0, smoothed = 0.0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const Smoothed run = smoothed_run(seed);
    ASSERT_EQ(run.rows.size(), 1001U);
    const SensorTruth truth = test::truth_at(10.0);
    const Vec3 gyro = run.bias.head<3>(), accel = run.bias.tail<3>();
    const NavigationVector error = test::error_of(run.rows[500], truth, gyro, accel);
    EXPECT_NEAR(run.rows[500].time, 10.0, 1e-9);
    sum += test::nees(run.rows[500], error);
    smoothed += error.head<3>().squaredNorm();
    filtered += test::error_of(run.middle, truth, gyro, accel).head<3>().squaredNorm();
  }
  EXPECT_NEAR(sum / seeds, 15.0, 1.96 * std::sqrt(2.0 * 15.0 / seeds));
  EXPECT_LT(smoothed, 0.8 * filtered);
}

TEST(NavigationSmoother, ItEndsWithTheFilter) {
  const Smoothed run = smoothed_run(3);
  // The last row is of before the readings at its time, which the smoother brings in.
  EXPECT_LT((run.rows.back().position - run.last.position).norm(), 1e-6);
}

TEST(NavigationSmoother, LateReadingsAreInTheRecordAtTheirOwnTime) {
  const Smoothed at_once = smoothed_run(3, 2.0), late = smoothed_run(3, 2.0, 1.3);
  ASSERT_EQ(at_once.rows.size(), late.rows.size());
  for (const std::size_t row : {std::size_t{0}, std::size_t{300}, std::size_t{700}}) {
    // The last fix, of 20 s, is only in the first.
    EXPECT_LT((at_once.rows[row].position - late.rows[row].position).norm(), 0.2);
  }
}

/// A track of 300 s with turns, a log that reads 3 % too much, a yaw 2° off, and no fix for 150 s.
TEST(SmoothReckoning, FindsScaleAndHeading) {
  const int rows = 1501;
  ReckonedTrack track;
  track.attitude = track.velocity = PointMatrix::Zero(rows, 3);
  PointMatrix truth(rows, 3);
  PointMatrix attitude = PointMatrix::Zero(rows, 3);
  for (int i = 0; i < rows; ++i) {
    const double t = 0.2 * i;
    track.time.push_back(t);
    attitude(i, 2) = 1.5 * std::sin(0.05 * t);
    truth.row(i) << 1.2, 0.0, 0.0;
  }
  track.velocity = 1.03 * truth;
  track.attitude = attitude;
  track.attitude.col(2).array() += 2.0 * std::numbers::pi / 180.0;
  const PointMatrix position = dead_reckon(track.time, attitude, truth);
  PositionFixes fixes;
  fixes.noise.setConstant(0.02);
  fixes.position.resize(3, 3);
  for (const int row : {0, 750, 1500}) {
    fixes.position.row(static_cast<Eigen::Index>(fixes.time.size())) = position.row(row);
    fixes.time.push_back(track.time[static_cast<std::size_t>(row)]);
  }
  NavigationOptions options = reckoning_options();
  options.current = options.fix_lever = 0.0;
  options.log_walk = 0.01;
  options.log_scale = 0.05;
  const SmoothedTrack got = smooth_reckoning(track, fixes, options);
  ASSERT_EQ(got.estimate.size(), static_cast<std::size_t>(rows));
  ASSERT_EQ(got.fixes.size(), 3U);
  EXPECT_NEAR(got.estimate.back().log_scale, 0.03, 0.002);
  double worst = 0.0;
  for (int i = 0; i < rows; ++i) {
    const Vec3 off =
        got.estimate[static_cast<std::size_t>(i)].position - position.row(i).transpose();
    worst = std::max(worst, off.norm());
  }
  EXPECT_LT(worst, 0.15);  // reckoned alone: 6 m
  fixes.time[1] += 0.05;   // between two rows, and so much farther on
  fixes.position.row(1) += 0.25 * (position.row(751) - position.row(750));
  const SmoothedTrack between = smooth_reckoning(track, fixes, options);
  ASSERT_EQ(between.estimate.size(), static_cast<std::size_t>(rows));
  EXPECT_TRUE(between.fixes[1].accepted);
  EXPECT_LT((between.estimate[400].position - got.estimate[400].position).norm(), 0.02);
}

TEST(SmoothReckoning, RefusesBadInput) {
  ReckonedTrack track{{0.0, 1.0}, PointMatrix::Zero(2, 3), PointMatrix::Zero(2, 3)};
  PositionFixes fixes{{0.5}, PointMatrix::Zero(1, 3), Vec3(1.0, 1.0, 1.0)};
  const NavigationOptions options = reckoning_options();
  EXPECT_EQ(smooth_reckoning(track, fixes, options).estimate.size(), 2U);
  const auto refused = [&](const ReckonedTrack& t, const PositionFixes& f) {
    EXPECT_THROW(smooth_reckoning(t, f, options), std::invalid_argument);
  };
  ReckonedTrack bad = track;
  bad.time = {1.0, 1.0};
  refused(bad, fixes);
  bad = track;
  bad.velocity(1, 0) = std::nan("");
  refused(bad, fixes);
  bad.velocity = PointMatrix::Zero(3, 3);
  refused(bad, fixes);
  PositionFixes wrong = fixes;
  wrong.time = {1.5};
  refused(track, wrong);
  wrong = fixes;
  wrong.time.clear();
  refused(track, wrong);
  wrong = fixes;
  wrong.noise.y() = 0.0;
  refused(track, wrong);
}

TEST(SmoothReckoning, HeldValuesAreFound) {
  PointMatrix rows(4, 3);
  rows << 1, 0, 0, 1, 0, 0, 1, 0, 1e-9, 1, 0, 1e-9;
  EXPECT_EQ(fresh_rows(rows), (std::vector<bool>{true, false, true, false}));
}

}  // namespace
}  // namespace bathyal
