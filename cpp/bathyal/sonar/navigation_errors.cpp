// SPDX-License-Identifier: BSD-3-Clause
// What the errors of a vehicle's navigation may be, and are by class.
#include <numbers>

#include "bathyal/base/check.hpp"
#include "bathyal/sonar/navigation.hpp"

namespace bathyal {

void NavigationErrors::check() const {
  check_not_negative("fix_interval", fix_interval);
  check_not_negative("fix_noise", fix_noise);
  check_range("speed_scale", speed_scale, -0.5, 0.5);
  check_not_negative("position_walk", position_walk);
  check_range("heading_bias", heading_bias, -std::numbers::pi, std::numbers::pi);
  check_not_negative("heading_walk", heading_walk);
  check_not_negative("heading_noise", heading_noise);
  check_range("pitch_bias", pitch_bias, -0.5 * std::numbers::pi, 0.5 * std::numbers::pi);
  check_range("roll_bias", roll_bias, -0.5 * std::numbers::pi, 0.5 * std::numbers::pi);
  check_not_negative("attitude_noise", attitude_noise);
  check_not_negative("attitude_lag", attitude_lag);
  check_finite("depth_bias", depth_bias);
  check_not_negative("depth_noise", depth_noise);
  check_finite("altitude_bias", altitude_bias);
  check_not_negative("altitude_noise", altitude_noise);
  check_not_negative("rate", rate);
  check_not_negative("latency", latency);
}

NavigationErrors inertial_navigation() {
  NavigationErrors errors;
  errors.speed_scale = 0.001;
  errors.position_walk = 0.01;
  errors.heading_bias = 0.0005;
  errors.heading_noise = 0.0002;
  errors.attitude_noise = 0.0002;
  errors.depth_bias = 0.05;
  errors.depth_noise = 0.01;
  errors.altitude_noise = 0.02;
  errors.rate = 50.0;
  errors.latency = 0.005;
  return errors;
}

NavigationErrors compass_navigation() {
  NavigationErrors errors;
  errors.speed_scale = 0.005;
  errors.position_walk = 0.03;
  errors.heading_bias = 0.02;
  errors.heading_noise = 0.005;
  errors.pitch_bias = 0.003;
  errors.roll_bias = -0.003;
  errors.attitude_noise = 0.003;
  errors.attitude_lag = 0.05;
  errors.depth_bias = 0.2;
  errors.depth_noise = 0.05;
  errors.altitude_noise = 0.05;
  errors.rate = 10.0;
  errors.latency = 0.05;
  return errors;
}

NavigationErrors usbl_navigation() {
  NavigationErrors errors = compass_navigation();
  errors.fix_interval = 2.0;
  errors.fix_noise = 1.0;
  return errors;
}

}  // namespace bathyal
