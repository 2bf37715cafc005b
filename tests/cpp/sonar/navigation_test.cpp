// SPDX-License-Identifier: BSD-3-Clause
// What a vehicle reports against where it is.
#include "bathyal/sonar/navigation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace bathyal {
namespace {

constexpr double kPi = std::numbers::pi;

Pose pose_of(const Vec3& place, double yaw) {
  Pose pose = Pose(Eigen::Translation3d(place));
  pose.rotate(Eigen::AngleAxisd(yaw, Vec3::UnitZ()));
  return pose;
}

/// East at 2 m/s, 10 m below z = 0.
Trajectory eastward(double duration) {
  return {{0.0, duration},
          {pose_of(Vec3(0, 0, -10), 0.0), pose_of(Vec3(2.0 * duration, 0, -10), 0.0)}};
}

std::vector<double> times_to(double end, double step) {
  std::vector<double> times;
  for (int k = 0; k * step <= end + 1e-9; ++k) times.push_back(k * step);
  return times;
}

double spread(const std::vector<double>& values) {
  double sum = 0.0, square = 0.0;
  for (const double value : values) sum += value, square += value * value;
  const auto count = static_cast<double>(values.size());
  return std::sqrt(square / count - sum * sum / (count * count));
}

TEST(Navigation, WithoutErrorsItIsTheTruth) {
  std::vector<Pose> poses;
  std::vector<double> knots;
  for (int i = 0; i <= 20; ++i) {
    Pose pose = pose_of(Vec3(std::sin(0.3 * i), 3.0 * i, -20.0 + 0.1 * i), 0.2 * i - 3.0);
    pose.rotate(Eigen::AngleAxisd(0.02 * i, Vec3::UnitY()));
    pose.rotate(Eigen::AngleAxisd(-0.03 * i, Vec3::UnitX()));
    poses.push_back(pose);
    knots.push_back(i);
  }
  const Trajectory trajectory(knots, poses);
  const std::vector<double> times = times_to(20.0, 0.25);
  const ReportedNavigation got = report_navigation({}, trajectory, times, 1.5, 7);
  for (std::size_t k = 0; k < times.size(); ++k) {
    const Pose pose = trajectory.at(times[k]);
    EXPECT_EQ(Vec3(got.position.row(static_cast<Index>(k))), pose.translation());
    EXPECT_DOUBLE_EQ(got.depth[k], 1.5 - pose.translation().z());
    // A frame built from the angles: about z by π/2 − heading, −pitch about y, roll about x.
    const Eigen::Matrix3d turn = (Eigen::AngleAxisd(0.5 * kPi - got.heading[k], Vec3::UnitZ()) *
                                  Eigen::AngleAxisd(-got.pitch[k], Vec3::UnitY()) *
                                  Eigen::AngleAxisd(got.roll[k], Vec3::UnitX()))
                                     .toRotationMatrix();
    EXPECT_TRUE(turn.isApprox(pose.linear(), 1e-12)) << k;
    EXPECT_GE(got.heading[k], 0.0);
    EXPECT_LT(got.heading[k], 2.0 * kPi);
  }
  EXPECT_NEAR(report_navigation({}, eastward(10.0), {5.0}).speed[0], 2.0, 1e-12);
  EXPECT_TRUE(std::isnan(report_navigation({}, eastward(10.0), {5.0}).depth[0]));
  EXPECT_EQ(report_navigation({}, eastward(10.0), {}).position.rows(), 0);
}

/// A log that is 1 % long by 10 m after 1 000 m; a heading of +δ sends the track to starboard.
TEST(Navigation, ReckoningDriftsWithTheWay) {
  const std::vector<double> times = times_to(500.0, 1.0);
  NavigationErrors errors;
  errors.speed_scale = 0.01;
  const ReportedNavigation fast = report_navigation(errors, eastward(500.0), times);
  EXPECT_NEAR(fast.position(500, 0), 1010.0, 1e-6);
  EXPECT_NEAR(fast.position(250, 0), 505.0, 1e-6);
  EXPECT_NEAR(fast.speed[100], 2.02, 1e-9);
  errors = {};
  errors.heading_bias = 0.02;
  const ReportedNavigation turned = report_navigation(errors, eastward(500.0), times);
  EXPECT_NEAR(turned.position(500, 0), 1000.0 * std::cos(0.02), 1e-6);
  EXPECT_NEAR(turned.position(500, 1), -1000.0 * std::sin(0.02), 1e-6);
  EXPECT_NEAR(turned.heading[7], 0.5 * kPi + 0.02, 1e-12);
}

TEST(Navigation, WalksGrowWithTheRootOfTime) {
  NavigationErrors errors;
  errors.position_walk = 0.1;
  errors.heading_walk = 0.001;
  std::vector<double> early, late, gyro;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const ReportedNavigation got =
        report_navigation(errors, Trajectory(), times_to(100.0, 4.0), {}, seed);
    early.push_back(got.position(1, 0));
    late.push_back(got.position(25, 1));
    gyro.push_back(std::remainder(got.heading[25] - 0.5 * kPi, 2.0 * kPi));
  }
  EXPECT_NEAR(spread(early), 0.1 * 2.0, 0.02);
  EXPECT_NEAR(spread(late), 0.1 * 10.0, 0.1);
  EXPECT_NEAR(spread(gyro), 0.001 * 10.0, 0.001);
}

TEST(Navigation, FixesEndTheDrift) {
  NavigationErrors errors;
  errors.speed_scale = 0.05;
  errors.fix_interval = 10.0;
  errors.fix_noise = 0.5;
  const std::vector<double> times = times_to(4000.0, 1.0);
  const ReportedNavigation got = report_navigation(errors, eastward(4000.0), times);
  std::vector<double> at_fix, across, gained;
  for (Index k = 0; k < static_cast<Index>(times.size()) - 10; k += 10) {
    const double east = 2.0 * times[static_cast<std::size_t>(k)];
    at_fix.push_back(got.position(k, 0) - east);
    across.push_back(got.position(k, 1));
    gained.push_back(got.position(k + 9, 0) - got.position(k, 0) - 18.0);
  }
  EXPECT_NEAR(spread(at_fix), 0.5, 0.06);
  EXPECT_NEAR(spread(across), 0.5, 0.06);
  for (const double one : gained) EXPECT_NEAR(one, 0.05 * 18.0, 1e-9);
}

TEST(Navigation, NoiseAndBiasAreAsGiven) {
  NavigationErrors errors;
  errors.heading_noise = 0.01;
  errors.pitch_bias = 0.1;
  errors.roll_bias = -0.2;
  errors.attitude_noise = 0.02;
  errors.depth_bias = 0.3;
  errors.depth_noise = 0.05;
  errors.altitude_bias = -1.0;
  errors.altitude_noise = 0.25;
  const std::vector<double> times = times_to(5000.0, 1.0);
  const ReportedNavigation got = report_navigation(errors, Trajectory(), times, 0.0);
  std::vector<double> heading, pitch, roll, depth, altitude;
  double means[4] = {};
  for (std::size_t k = 0; k < times.size(); ++k) {
    heading.push_back(got.heading[k]);
    pitch.push_back(got.pitch[k]);
    roll.push_back(got.roll[k]);
    depth.push_back(got.depth[k]);
    altitude.push_back(report_altitude(errors, 10.0, static_cast<std::int64_t>(k), 0));
    means[0] += got.pitch[k] / 5001.0;
    means[1] += got.roll[k] / 5001.0;
    means[2] += got.depth[k] / 5001.0;
    means[3] += altitude[k] / 5001.0;
    EXPECT_DOUBLE_EQ(got.position(static_cast<Index>(k), 2), -got.depth[k]);
  }
  EXPECT_NEAR(spread(heading), 0.01, 0.0005);
  EXPECT_NEAR(spread(pitch), 0.02, 0.001);
  EXPECT_NEAR(spread(roll), 0.02, 0.001);
  EXPECT_NEAR(spread(depth), 0.05, 0.0025);
  EXPECT_NEAR(spread(altitude), 0.25, 0.0125);
  EXPECT_NEAR(means[0], 0.1, 0.002);
  EXPECT_NEAR(means[1], -0.2, 0.002);
  EXPECT_NEAR(means[2], 0.3, 0.005);
  EXPECT_NEAR(means[3], 9.0, 0.02);
  EXPECT_TRUE(std::isnan(report_altitude(errors, std::nan(""), 1, 0)));
}

TEST(Navigation, ReportsAreLate) {
  const Trajectory turning({0.0, 10.0}, {pose_of(Vec3(0, 0, 0), 0.0), pose_of(Vec3(20, 0, 0), -1)});
  NavigationErrors errors;
  errors.latency = 0.5;
  const ReportedNavigation late = report_navigation(errors, turning, {1.0, 4.0});
  EXPECT_NEAR(late.position(1, 0), 7.0, 1e-12);
  EXPECT_NEAR(late.heading[1], 0.5 * kPi + 0.35, 1e-9);
  errors = {};
  errors.attitude_lag = 0.5;
  const ReportedNavigation lagging = report_navigation(errors, turning, {4.0});
  EXPECT_NEAR(lagging.position(0, 0), 8.0, 1e-12);
  EXPECT_NEAR(lagging.heading[0], 0.5 * kPi + 0.35, 1e-9);
}

TEST(Navigation, BetweenReadingsTheLastOneIsReported) {
  NavigationErrors errors;
  errors.rate = 1.0;
  errors.depth_noise = 0.1;
  const std::vector<double> times = times_to(10.0, 0.25);
  const ReportedNavigation got = report_navigation(errors, eastward(10.0), times);
  for (Index k = 0; k < 40; ++k) {
    EXPECT_DOUBLE_EQ(got.position(k, 0), 2.0 * static_cast<double>(k / 4));
    EXPECT_EQ(got.position(k, 2), got.position(k - k % 4, 2));
  }
}

/// What is reported at a time does not depend on what is asked for after it.
TEST(Navigation, PartsAgreeWithTheWhole) {
  const NavigationErrors errors = usbl_navigation();
  const std::vector<double> all = times_to(60.0, 0.3);
  const std::vector<double> part(all.begin(), all.begin() + 50);
  const ReportedNavigation whole = report_navigation(errors, eastward(60.0), all, 0.0, 3);
  const ReportedNavigation first = report_navigation(errors, eastward(60.0), part, 0.0, 3);
  EXPECT_EQ(whole.position.topRows(50), first.position);
  EXPECT_TRUE(std::equal(first.heading.begin(), first.heading.end(), whole.heading.begin()));
  const ReportedNavigation other = report_navigation(errors, eastward(60.0), all, 0.0, 4);
  EXPECT_NE(whole.position, other.position);
}

TEST(Navigation, ClassesDriftAsTheySay) {
  const auto off_after = [](const NavigationErrors& errors) {
    double square = 0.0;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      const ReportedNavigation got =
          report_navigation(errors, eastward(500.0), times_to(500.0, 1.0), {}, seed);
      const Vec3 end = got.position.bottomRows(1).transpose();
      square += (end - Vec3(1000, 0, -10)).head<2>().squaredNorm() / 8.0;
    }
    return std::sqrt(square) / 1000.0;
  };
  EXPECT_NEAR(off_after(inertial_navigation()), 0.001, 0.0005);
  EXPECT_NEAR(off_after(compass_navigation()), 0.02, 0.005);
  EXPECT_LT(off_after(usbl_navigation()), 0.003);
}

TEST(Navigation, NonsenseIsRefused) {
  const auto refused = [](const std::function<void(NavigationErrors&)>& change) {
    NavigationErrors errors;
    change(errors);
    EXPECT_THROW(report_navigation(errors, Trajectory(), {0.0}), std::invalid_argument);
  };
  refused([](NavigationErrors& e) { e.fix_interval = -1.0; });
  refused([](NavigationErrors& e) { e.fix_noise = std::nan(""); });
  refused([](NavigationErrors& e) { e.speed_scale = 1.0; });
  refused([](NavigationErrors& e) { e.heading_bias = 4.0; });
  refused([](NavigationErrors& e) { e.depth_bias = std::numeric_limits<double>::infinity(); });
  refused([](NavigationErrors& e) { e.latency = -0.1; });
  refused([](NavigationErrors& e) { e.rate = -1.0; });
  EXPECT_THROW(report_navigation({}, Trajectory(), {0.0, std::nan("")}), std::invalid_argument);
  EXPECT_THROW(report_navigation({}, Trajectory(), {1.0, 0.0}), std::invalid_argument);
  NavigationErrors fast;
  fast.rate = 1e6;
  EXPECT_THROW(report_navigation(fast, Trajectory(), {0.0, 1e6}), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
