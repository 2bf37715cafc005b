// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/navigation/sensor.hpp"

namespace bathyal {

/// What the filter takes for granted of its start, its sensors and the water. Standard deviations,
/// 0 or more; a quantity whose deviations are all 0 is held as it is.
struct NavigationOptions {
  // Of the start.
  Vec3 initial_position = Vec3::Zero();  ///< along x, y, z of the world [m]
  Vec3 initial_velocity = Vec3::Zero();  ///< likewise [m/s]
  Vec3 initial_attitude = Vec3::Zero();  ///< of small turns about x, y, z of the world [rad]
  double initial_gyro_bias = 0.0;        ///< of each axis [rad/s]
  double initial_accel_bias = 0.0;       ///< of each axis [m/s²]

  // Of inertial sensors.
  double gyro_noise = 0.0;   ///< [rad/√s]; of a reported attitude: its random walk
  double gyro_walk = 0.0;    ///< of the bias [rad/s/√s]
  double accel_noise = 0.0;  ///< [m/s/√s]
  double accel_walk = 0.0;   ///< of the bias [m/s²/√s]

  // Of a motion that is reckoned from a velocity log (predict_motion).
  double log_noise = 0.0;  ///< of each velocity along each axis [m/s]
  double log_walk = 0.0;   ///< of the position reckoned from it, along each axis [m/√s]

  // Of quantities that are estimated along with the motion.
  double log_scale = 0.0;        ///< of the velocity log's scale, as a part
  double log_mount = 0.0;        ///< of its mount, about each axis [rad]
  double current = 0.0;          ///< along x and along y of the world [m/s]; Gauss–Markov
  double current_time = 3600.0;  ///< its correlation time [s], above 0
  double fix_lever =
      0.0;  ///< of where position fixes belong to, along each axis in the vehicle [m]

  double gravity = 9.81;      ///< [m/s²], above 0
  double mean_surface = 0.0;  ///< z of the mean surface in the world [m]
  double gate = 0.9999;       ///< readings less probable than 1 − gate are refused; 1: none
  double lag = 0.0;           ///< how late readings may come [s]
  std::vector<SensorOptions> devices;  ///< names, mounts and errors of those whose readings come

  /// \throw std::invalid_argument that names the field
  void check() const;
};

}  // namespace bathyal
