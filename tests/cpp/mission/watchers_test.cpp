// SPDX-License-Identifier: BSD-3-Clause
// What watchers make of readings alone: a vehicle at rest at 10 m, 8 m above the bottom.
#include "bathyal/mission/watchers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "bathyal/base/random.hpp"
#include "bathyal/mission/typical.hpp"
#include "bathyal/vehicle/device_presets.hpp"

namespace bathyal {
namespace {

using Change = std::function<bool(SensorReading&)>;  // false: it is lost

/// First report of a minute in which one sensor's readings are changed.
std::string first_report(const std::string& name, const Change& change) {
  const VehicleSystem system(bluerov2_heavy_system());
  const std::vector<SensorOptions> sensors = typical_sensors();
  const Watchers watchers(system, sensors);
  WatcherState state = watchers.fresh();
  std::vector<SensorState> samples(sensors.size());
  std::vector<SensorReading> before(sensors.size());
  for (SensorReading& reading : before) reading.index = -1;
  VehicleCommands commands;
  commands.thrusters.assign(system.thrusters().size(), 0.0);
  const std::vector<double> still(system.thrusters().size(), 0.0);
  std::vector<DeviceReport> reports;
  SensorTruth truth;
  truth.world_from_vehicle = Eigen::Translation3d(0.0, 0.0, -10.0) * Pose::Identity();
  truth.altitude = 8.0;
  for (int k = 0; k < 3000 && reports.empty(); ++k) {
    truth.time = 0.02 * k;
    for (std::size_t i = 0; i < sensors.size(); ++i) {
      auto reading = sample(sensors[i], samples[i], truth, 1);
      if (!reading || (sensors[i].name == name && !change(*reading))) continue;
      watchers.reading(state, static_cast<int>(i), before[i], *reading,
                       Eigen::Quaterniond::Identity(), nullptr, reports);
      before[i] = *reading;
    }
    watchers.tick(state, truth.time, 0.02, commands, still, {}, 16.0, 0.0, 0.8, reports);
  }
  return reports.empty() ? "" : reports.front().device + " " + reports.front().kind;
}

bool as_it_is(SensorReading& /*reading*/) { return true; }

TEST(Watchers, SoundSensorsAreLeftAlone) { EXPECT_EQ(first_report("", as_it_is), ""); }

TEST(Watchers, ASilentSensorIsOff) {
  EXPECT_EQ(first_report("depth", [](SensorReading& r) { return r.time < 5.0; }), "depth off");
}

TEST(Watchers, LostAndLateSamplesAreCounted) {
  EXPECT_EQ(first_report("depth", [](SensorReading& r) { return r.index % 2 == 0; }),
            "depth intermittent");
  const auto late = [](SensorReading& r) {
    r.arrival += 0.5;
    return true;
  };
  EXPECT_EQ(first_report("compass", late), "compass delayed");
}

TEST(Watchers, OfThreeThatKnowHowItRisesTheOneApartIsNamed) {
  const auto drift = [](double rate) {
    return [rate](SensorReading& r) {
      r.values[0] += rate * r.time;
      return true;
    };
  };
  EXPECT_EQ(first_report("depth", drift(0.05)), "depth wrong");
  const auto up = [](SensorReading& r) {
    r.values[2] += 0.05;
    return true;
  };
  EXPECT_EQ(first_report("dvl", up), "dvl wrong");
  EXPECT_EQ(first_report("altimeter", drift(0.05)), "");  // the bottom may slope
}

TEST(Watchers, CompassGyroAndGravityJudgeOneAnother) {
  const auto turning = [](SensorReading& r) {
    r.values[2] = std::remainder(r.values[2] + 0.03 * r.time, 6.283185307179586);
    return true;
  };
  EXPECT_EQ(first_report("compass", turning), "compass wrong");
  const auto biased = [](SensorReading& r) {
    for (std::size_t i = 0; i < 6; ++i) r.values[i] += 0.2;
    return true;
  };
  EXPECT_EQ(first_report("imu", biased), "imu wrong");
  const auto scaled = [](SensorReading& r) {
    for (std::size_t i = 3; i < 6; ++i) r.values[i] *= 1.1;
    return true;
  };
  EXPECT_EQ(first_report("imu", scaled), "imu wrong");
}

TEST(Watchers, JumpsThatNoVehicleMakesAreTheSensorsOwn) {
  RandomStream draw(3);
  const auto garbage = [&draw](SensorReading& r) {
    for (std::size_t i = 0; i < 3; ++i) r.values[i] = draw.normal();
    return true;
  };
  EXPECT_EQ(first_report("dvl", garbage), "dvl wrong");
  EXPECT_EQ(first_report("compass", garbage), "compass wrong");
}

}  // namespace
}  // namespace bathyal
