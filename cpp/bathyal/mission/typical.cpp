// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/mission/typical.hpp"

#include <string>

namespace bathyal {
namespace {

SensorOptions sensor(const std::string& name, SensorKind kind, double rate, double noise) {
  SensorOptions options;
  options.name = name;
  options.kind = kind;
  options.rate = rate;
  for (int i = 0; i < options.channel_count(); ++i) {
    options.channels[static_cast<std::size_t>(i)].noise = noise;
  }
  return options;
}

}  // namespace

std::vector<SensorOptions> typical_sensors() {
  SensorOptions compass = sensor("compass", SensorKind::compass, 10.0, 0.003);
  compass.channels[2].bias = 0.009;  // half a degree
  SensorOptions imu = sensor("imu", SensorKind::imu, 50.0, 0.002);
  for (int i = 3; i < 6; ++i) imu.channels[static_cast<std::size_t>(i)].noise = 0.02;
  SensorOptions dvl = sensor("dvl", SensorKind::dvl, 5.0, 0.005);
  for (int i = 0; i < 3; ++i) dvl.channels[static_cast<std::size_t>(i)].scale = 0.002;
  dvl.range = 50.0;
  SensorOptions altimeter = sensor("altimeter", SensorKind::altimeter, 5.0, 0.02);
  altimeter.range = 50.0;
  SensorOptions gps = sensor("gps", SensorKind::gps, 1.0, 1.5);
  gps.vehicle_from_sensor.translation().z() = 0.3;
  return {sensor("depth", SensorKind::depth, 10.0, 0.01), compass, imu, dvl, altimeter, gps,
          sensor("leak", SensorKind::leak, 2.0, 0.001)};
}

NavigationOptions typical_navigation() {
  NavigationOptions options;
  options.initial_position = Vec3(0.5, 0.5, 0.1);
  options.initial_attitude = Vec3(0.01, 0.01, 0.02);
  options.gyro_noise = 0.002;
  options.log_noise = 0.02;
  options.log_walk = 0.05;
  options.log_scale = 0.005;
  options.lag = 5.0;
  return options;
}

}  // namespace bathyal
