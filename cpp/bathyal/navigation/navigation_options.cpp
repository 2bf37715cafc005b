// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/navigation/navigation_options.hpp"

#include <string>

#include "bathyal/base/check.hpp"

namespace bathyal {
namespace {

void check_deviations(std::string_view name, const Vec3& values) {
  for (const double value : values) check_not_negative(name, value);
}

void check_devices(const std::vector<SensorOptions>& devices) {
  for (std::size_t i = 0; i < devices.size(); ++i) {
    devices[i].check();
    for (std::size_t j = 0; j < i; ++j) {
      if (devices[i].name == devices[j].name) {
        throw_argument("devices", "names that differ", "\"" + devices[i].name + "\" twice");
      }
    }
  }
}

}  // namespace

void NavigationOptions::check() const {
  check_deviations("initial_position", initial_position);
  check_deviations("initial_velocity", initial_velocity);
  check_deviations("initial_attitude", initial_attitude);
  check_not_negative("initial_gyro_bias", initial_gyro_bias);
  check_not_negative("initial_accel_bias", initial_accel_bias);
  check_not_negative("gyro_noise", gyro_noise);
  check_not_negative("gyro_walk", gyro_walk);
  check_not_negative("accel_noise", accel_noise);
  check_not_negative("accel_walk", accel_walk);
  check_not_negative("log_noise", log_noise);
  check_not_negative("log_walk", log_walk);
  check_not_negative("log_scale", log_scale);
  check_not_negative("log_mount", log_mount);
  check_not_negative("current", current);
  check_positive("current_time", current_time);
  check_not_negative("fix_lever", fix_lever);
  check_positive("gravity", gravity);
  check_finite("mean_surface", mean_surface);
  check_range("gate", gate, 0.5, 1.0);
  check_not_negative("lag", lag);
  check_devices(devices);
}

}  // namespace bathyal
