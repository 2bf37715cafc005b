// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bathyal/geometry/shared_array.hpp"
#include "bathyal/geometry/trajectory.hpp"

namespace bathyal {

/// Errors of what a vehicle reports of its motion. Without any it reports the truth. Noise is
/// normal, of each reading its own, by its standard deviation; a bias is the same all the time.
struct NavigationErrors {
  // Position: fixes (GNSS, USBL), and reckoned from log and heading since the last one. Without
  // fixes it is reckoned from where the vehicle was at first.
  double fix_interval = 0.0;   ///< between fixes [s], 0 (none) or more
  double fix_noise = 0.0;      ///< of a fix, along x and along y [m]
  double speed_scale = 0.0;    ///< of the log, as a part of the speed, −0.5 to 0.5
  double position_walk = 0.0;  ///< of a reckoned position, in x and in y [m/√s]

  double heading_bias = 0.0;    ///< [rad], −π to π
  double heading_walk = 0.0;    ///< drift of a gyro from 0 on [rad/√s]
  double heading_noise = 0.0;   ///< [rad]
  double pitch_bias = 0.0;      ///< [rad], −π/2 to π/2
  double roll_bias = 0.0;       ///< [rad], −π/2 to π/2
  double attitude_noise = 0.0;  ///< of pitch and of roll [rad]
  double attitude_lag = 0.0;    ///< by which heading, pitch and roll are late [s]

  double depth_bias = 0.0;      ///< [m]
  double depth_noise = 0.0;     ///< [m]
  double altitude_bias = 0.0;   ///< [m]
  double altitude_noise = 0.0;  ///< [m]

  double rate = 0.0;  ///< of readings [Hz]: between them the last one is reported; 0: at each ping
  double latency = 0.0;  ///< what is reported at t was so at t − latency [s]

  /// \throw std::invalid_argument for a value out of its range; lengths, noise, walks, rates and
  ///        times are finite and not below 0, biases in metres finite.
  void check() const;
};

/// Of a vehicle by class: an inertial system with a Doppler log, some 0.1 % of the way.
NavigationErrors inertial_navigation();
/// A magnetic compass with a Doppler log, some 2 % of the way.
NavigationErrors compass_navigation();
/// A magnetic compass, placed from a ship by an ultra-short baseline every 2 s.
NavigationErrors usbl_navigation();

/// What a vehicle reports, one value a time. Heading is clockwise from y, pitch positive with the
/// bow up, roll positive with starboard down [rad].
struct ReportedNavigation {
  PointMatrix position;  ///< in the world [m]
  std::vector<double> heading, pitch, roll;
  std::vector<double> depth;  ///< below the mean surface [m]; NaN without one
  std::vector<double> speed;  ///< over ground, horizontal [m/s]
};

/// What a vehicle on a trajectory reports at rising times. The height in `position` has the errors
/// of the depth, whether there is a surface or not. Depends on the errors, the trajectory, the
/// times' first, and the seed: parts of a survey take theirs from the whole.
/// \throw std::invalid_argument as check(), for times that do not rise, or more than 10⁸ readings.
ReportedNavigation report_navigation(const NavigationErrors& errors,
                                     const Trajectory& world_from_vehicle,
                                     const std::vector<double>& time,
                                     std::optional<double> surface = {}, std::uint64_t seed = 0);

/// What it reports of an altitude at a ping [m]; NaN stays NaN.
double report_altitude(const NavigationErrors& errors, double altitude, std::int64_t ping,
                       std::uint64_t seed);

}  // namespace bathyal
