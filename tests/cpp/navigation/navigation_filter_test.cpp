// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/navigation/navigation_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bathyal/base/random.hpp"
#include "bathyal/navigation/navigation_state_bytes.hpp"
#include "bathyal/navigation/navigation_track.hpp"
#include "navigation/simulated_run.hpp"

namespace bathyal {
namespace {

using test::device;
using test::error_of;
using test::imu_bias;
using test::nees;
using test::truth_at;
using test::usual_options;
using test::wrong_start;

TEST(NavigationFilter, ItsErrorsAreAsLargeAsItSays) {
  const NavigationFilter filter(usual_options());
  const int seeds = 30;
  double sum = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    NavigationState state = wrong_start(filter, seed);
    test::run(filter, state, seed, 40.0,
              [&](const SensorTruth& truth, const NavigationState& s,
                  const std::vector<SensorState>& sensors) {
                if (truth.time < 39.5) return;
                const Vec6 bias = imu_bias(filter.options().devices[0], sensors[0], seed);
                sum += nees(s.now, error_of(s.now, truth, bias.head<3>(), bias.tail<3>()));
                ++count;
              });
  }
  ASSERT_EQ(count, seeds);
  EXPECT_NEAR(sum / seeds, 15.0, 1.96 * std::sqrt(2.0 * 15.0 / seeds));
}

// A depth between two velocities is reached by holding the last turn; noise of the attitude must
// not make what is held swing farther and farther.
TEST(NavigationFilter, HoldsTheTurnBetweenNoisyAttitudes) {
  NavigationOptions options;
  options.initial_position = Vec3(0.5, 0.5, 0.1);
  options.log_noise = 0.02;
  options.log_walk = 0.05;
  options.devices = {device("depth", SensorKind::depth, 10.0, {0.01})};
  const NavigationFilter filter(options);
  NavigationState state = filter.start(0.0, Pose::Identity());
  RandomStream draw(1);
  double worst = 0.0;
  for (int k = 0; k < 5 * 600; ++k) {
    const Vec3 angles(0.003 * draw.normal(), 0.003 * draw.normal(), 0.003 * draw.normal());
    filter.predict_motion(state, 0.2 * (k + 1), Eigen::Quaterniond(rotation_of(angles)),
                          Vec3(1.5, 0.0, 0.0));
    SensorReading depth;
    depth.count = 1;
    depth.time = depth.arrival = 0.2 * (k + 1) + 0.1;
    filter.update(state, 0, depth);
    worst = std::max(worst, state.now.velocity.tail<2>().norm());
  }
  EXPECT_LT(worst, 0.1);
  EXPECT_NEAR(state.now.position.x(), 1.5 * 599.9, 1.5);
}

TEST(NavigationFilter, FindsWhatTheLogAndTheCurrentAreOffBy) {
  NavigationOptions options = usual_options();
  options.log_scale = 0.02;
  options.log_mount = 0.03;
  options.current = 0.3;
  options.devices.push_back(device("adcp", SensorKind::current, 1.0, {0.02, 0.02, 0.02}));
  options.devices[2].rate = options.devices[4].rate = 1.0;
  options.devices[4].channels[0].noise = options.devices[4].channels[1].noise = 0.05;
  options.devices[4].channels[2].noise = 0.05;
  const NavigationFilter filter(options);
  NavigationState state = wrong_start(filter, 4);
  std::vector<SensorState> sensors(options.devices.size());
  const Eigen::Matrix3d mount = rotation_of(Vec3(0.01, -0.02, 0.03)).transpose();
  for (int k = 0; k <= 50 * 200; ++k) {
    const SensorTruth truth = truth_at(k / 50.0);
    for (std::size_t d = 0; d < options.devices.size(); ++d) {
      auto reading = sample(options.devices[d], sensors[d], truth, 4);
      if (!reading) continue;
      if (reading->kind == SensorKind::dvl) {
        Eigen::Map<Vec3> value(reading->values.data());
        value = 1.015 * (mount * value).eval();
      }
      filter.update(state, static_cast<int>(d), *reading);
    }
  }
  EXPECT_NEAR(state.now.log_scale, 0.015, 0.002);
  EXPECT_LT((state.now.log_mount - Vec3(0.01, -0.02, 0.03)).norm(), 0.006);
  EXPECT_LT((state.now.current - Eigen::Vector2d(0.2, -0.1)).norm(), 0.02);
}

/// What an imu feels off the origin is brought there: without it this one would push by ω² r.
TEST(NavigationFilter, AnImuMayBeMountedAnywhere) {
  NavigationOptions options = usual_options();
  options.devices.resize(1);
  for (SensorChannel& c : options.devices[0].channels) c = {};
  const auto drift_by_end = [&](const Vec3& arm) {
    options.devices[0].vehicle_from_sensor.translation() = arm;
    options.devices[0].vehicle_from_sensor.linear() = rotation_of(Vec3(0.0, 0.0, 1.0));
    const NavigationFilter filter(options);
    const SensorTruth first = truth_at(0.0);
    NavigationState state =
        filter.start(0.0, first.world_from_vehicle,
                     first.world_from_vehicle.linear() * first.velocity.head<3>());
    test::run(filter, state, 1, 20.0, [](const auto&, const auto&, const auto&) {});
    return (truth_at(20.0).world_from_vehicle.translation() - state.now.position).norm();
  };
  EXPECT_LT(drift_by_end(Vec3::Zero()), 0.01);
  EXPECT_LT(drift_by_end(Vec3(1.0, 0.3, -0.5)), 0.05);
}

/// Fixes that come 1.33 s late give the same estimate as those that come at once.
TEST(NavigationFilter, LateFixesAreAppliedAtTheirOwnTime) {
  NavigationOptions options = usual_options();
  options.devices.push_back(device("usbl", SensorKind::usbl, 0.25, {0.3, 0.3, 0.3}));
  options.devices.back().beacons = {Vec3(0.0, 0.0, 0.0)};
  options.devices.back().sound_speed = 1e9;
  const auto end = [&](double late) {
    NavigationOptions with = options;
    with.lag = 2.0;
    with.devices.back().latency = late;
    const NavigationFilter filter(with);
    NavigationState state = wrong_start(filter, 9);
    // The last fix is of 28 s: both have it at 31 s.
    test::run(filter, state, 9, 31.0, [](const auto&, const auto&, const auto&) {});
    return state.now;
  };
  const NavigationEstimate at_once = end(0.0), late = end(1.33);
  EXPECT_LT((at_once.position - late.position).norm(), 1e-9);
  EXPECT_LT((at_once.velocity - late.velocity).norm(), 1e-9);
  EXPECT_LT((at_once.covariance - late.covariance).norm(), 1e-9);
}

TEST(NavigationFilter, AReadingOlderThanTheLagIsNotUsed) {
  NavigationOptions options = usual_options();
  options.lag = 0.5;
  const NavigationFilter filter(options);
  NavigationState state = wrong_start(filter, 1);
  test::run(filter, state, 1, 5.0, [](const auto&, const auto&, const auto&) {});
  SensorReading fix = ideal_reading(options.devices[4], truth_at(2.0));
  const NavigationEstimate before = state.now;
  EXPECT_FALSE(filter.update(state, 4, fix).used);
  EXPECT_EQ(before.position, state.now.position);
  fix.time = 4.7;
  EXPECT_TRUE(filter.update(state, 4, fix).used);
}

TEST(NavigationFilter, TheGateRefusesOutliers) {
  const NavigationFilter filter(usual_options());
  NavigationState state = wrong_start(filter, 1);
  test::run(filter, state, 1, 5.0, [](const auto&, const auto&, const auto&) {});
  SensorReading fix = ideal_reading(filter.options().devices[4], truth_at(5.0));
  fix.values[1] += 50.0;
  const NavigationEstimate before = state.now;
  const NavigationUpdate got = filter.update(state, 4, fix);
  EXPECT_TRUE(got.used);
  EXPECT_FALSE(got.accepted);
  EXPECT_GT(got.nis, 100.0);
  EXPECT_NEAR(got.innovation[1], 50.0, 3.0);
  EXPECT_EQ(before.position, state.now.position);
  fix.values[1] -= 50.0;
  EXPECT_TRUE(filter.update(state, 4, fix).accepted);
}

/// A run that is saved in the middle goes on to the same bytes.
TEST(NavigationFilter, ItsBytesAreAllItRemembers) {
  NavigationOptions options = usual_options();
  options.lag = 1.0;
  const NavigationFilter filter(options);
  NavigationState one = wrong_start(filter, 5);
  test::run(filter, one, 5, 4.0, [](const auto&, const auto&, const auto&) {});
  const std::string bytes = to_bytes(one);
  NavigationState two = navigation_state_of(bytes);
  EXPECT_EQ(to_bytes(two), bytes);
  const NavigationFilter other(options);
  for (int k = 201; k < 400; ++k) {
    const SensorReading imu = ideal_reading(options.devices[0], truth_at(k / 50.0));
    filter.update(one, 0, imu);
    other.update(two, 0, imu);
    if (k % 50 != 0) continue;
    const SensorReading fix = ideal_reading(options.devices[4], truth_at(k / 50.0 - 0.6));
    EXPECT_TRUE(filter.update(one, 4, fix).accepted);
    EXPECT_TRUE(other.update(two, 4, fix).accepted);
  }
  EXPECT_EQ(to_bytes(one), to_bytes(two));
  EXPECT_LT(one.inputs.size(), 80U);  // of a second, and an eighth more
}

TEST(NavigationFilter, BytesThatAreNoneOfItsAreRefused) {
  const NavigationFilter filter(usual_options());
  const std::string bytes = to_bytes(filter.start(0.0, Pose::Identity()));
  EXPECT_THROW(navigation_state_of(""), std::invalid_argument);
  EXPECT_THROW(navigation_state_of(bytes + "x"), std::invalid_argument);
  for (const std::size_t cut : {std::size_t{40}, bytes.size() / 2, bytes.size() - 1}) {
    EXPECT_THROW(navigation_state_of(bytes.substr(0, cut)), std::invalid_argument);
  }
  std::string many = bytes;  // a count that no memory holds
  many.replace(many.size() - 8, 8, 8, '\xff');
  EXPECT_THROW(navigation_state_of(many), std::invalid_argument);
}

TEST(NavigationFilter, ReadingsAreRunAsTheyArrive) {
  NavigationOptions options = usual_options();
  options.lag = 2.0;
  options.devices[4].latency = 1.3;
  const NavigationFilter filter(options);
  NavigationState one = wrong_start(filter, 5), two = one;
  test::run(filter, one, 5, 6.5, [](const auto&, const auto&, const auto&) {});
  std::vector<DeviceReadings> readings;
  for (int d = 0; d < 5; ++d) {
    const SensorOptions& device = options.devices[static_cast<std::size_t>(d)];
    DeviceReadings all{d, {}};
    SensorState sensor;
    while (next_time(device, sensor) < 6.5001) {
      const auto reading = sample(device, sensor, truth_at(next_time(device, sensor)), 5);
      if (reading->arrival < 6.5001) all.readings.push_back(*reading);
    }
    readings.push_back(all);
  }
  const FilterRun run = run_readings(filter, two, readings, 5);
  EXPECT_EQ(run.estimate.size(), 66U);
  EXPECT_LT((one.now.position - two.now.position).norm(), 1e-9);
  EXPECT_EQ(run.updates[4].accepted, (std::vector<bool>{true, true}));
  EXPECT_EQ(run.updates[1].nis.size(), 33U);
}

TEST(NavigationFilter, KindsThatSayNothingOfTheMotionAreNotUsed) {
  NavigationOptions options = usual_options();
  options.devices.push_back(device("leak", SensorKind::leak, 1.0, {}));
  const NavigationFilter filter(options);
  NavigationState state = wrong_start(filter, 1);
  filter.update(state, 0, ideal_reading(options.devices[0], truth_at(0.0)));
  EXPECT_FALSE(filter.update(state, 5, ideal_reading(options.devices[5], truth_at(0.0))).used);
}

TEST(NavigationFilter, RefusesBadInput) {
  const NavigationFilter filter(usual_options());
  NavigationState state = filter.start(0.0, Pose::Identity());
  const Vec3 zero = Vec3::Zero(), broken(0.0, std::nan(""), 0.0);
  filter.predict(state, 1.0, zero, zero);
  EXPECT_THROW(filter.predict(state, 1.0, zero, zero), std::invalid_argument);
  EXPECT_THROW(filter.predict(state, 2.0, broken, zero), std::invalid_argument);
  EXPECT_THROW(filter.predict(state, std::nan(""), zero, zero), std::invalid_argument);
  EXPECT_THROW(filter.predict_motion(state, 2.0, Eigen::Quaterniond(2.0, 0.0, 0.0, 0.0), zero),
               std::invalid_argument);
  SensorReading depth = ideal_reading(filter.options().devices[2], truth_at(0.5));
  EXPECT_THROW(filter.update(state, 1, depth), std::invalid_argument);
  EXPECT_THROW(filter.update(state, 9, depth), std::invalid_argument);
  depth.values[0] = std::nan("");
  EXPECT_THROW(filter.update(state, 2, depth), std::invalid_argument);
  depth.values[0] = 1.0;
  depth.time = 7.0;
  EXPECT_THROW(filter.update(state, 2, depth), std::invalid_argument);
  EXPECT_THROW(filter.device("sextant"), std::invalid_argument);
  EXPECT_THROW(filter.start(0.0, Pose::Identity(), broken), std::invalid_argument);
  NavigationOptions bad = usual_options();
  bad.gyro_noise = -1.0;
  EXPECT_THROW(NavigationFilter{bad}, std::invalid_argument);
  bad = usual_options();
  bad.devices[1].name = "imu";
  EXPECT_THROW(NavigationFilter{bad}, std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
