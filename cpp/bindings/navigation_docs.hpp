// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/sonar/navigation.hpp"

namespace bathyal::python::navigation_docs {

inline constexpr const char* kErrors = R"(Errors of what a vehicle reports of its motion.

Without any it reports the truth. Position is reckoned from the log and the heading since the last
fix (GNSS, USBL), without fixes since the start. Noise is normal and given by its standard
deviation.

Parameters
----------
**fields : float
    Any of the properties; those not given are 0.

Raises
------
ValueError
    For a name that is none of them, or a value out of its range.

Examples
--------
>>> import bathyal, numpy as np
>>> errors = bathyal.NavigationErrors(speed_scale=0.01, heading_bias=np.radians(1.0))
>>> east = np.stack([np.eye(4), np.eye(4)])
>>> east[1, 0, 3] = 1000.0
>>> reported = errors.report(bathyal.Trajectory([0.0, 500.0], east), [0.0, 500.0])
>>> reported.position[1].round(1).tolist()
[1009.8, -17.6, 0.0]
)";

inline constexpr const char* kPreset = R"(Errors of a vehicle by class.

Parameters
----------
name : str
    "inertial" (with a Doppler log, some 0.1 % of the way), "compass" (magnetic, with a Doppler log,
    some 2 % of the way) or "usbl" (that, with a fix of 1 m from a ship every 2 s).

Returns
-------
NavigationErrors
)";

inline constexpr const char* kReport = "What a vehicle reports, one row a time.";

inline constexpr const char* kReportCall = R"(What a vehicle on a trajectory reports.

Parameters
----------
trajectory : Trajectory
    world_from_vehicle.
time : (P,) array
    Rising [s].
surface : float, optional
    z of the mean sea surface [m], for the depth.
seed : int
    Of noise and walks.

Returns
-------
NavigationReport

Raises
------
ValueError
    For times that do not rise, or more than 10⁸ readings.
)";

struct Field {
  const char* name;
  double NavigationErrors::*member;
  const char* doc;
};

inline const std::vector<Field>& fields() {
  using E = NavigationErrors;
  static const std::vector<Field> all = {
      {"fix_interval", &E::fix_interval, "Between fixes [s]; 0: there are none."},
      {"fix_noise", &E::fix_noise, "Of a fix, along x and along y [m]."},
      {"speed_scale", &E::speed_scale, "Of the log, as a part of the speed, −0.5 to 0.5."},
      {"position_walk", &E::position_walk, "Of a reckoned position, in x and in y [m/√s]."},
      {"heading_bias", &E::heading_bias, "Clockwise [rad]."},
      {"heading_walk", &E::heading_walk, "Drift of a gyro [rad/√s]."},
      {"heading_noise", &E::heading_noise, "[rad]"},
      {"pitch_bias", &E::pitch_bias, "[rad]"},
      {"roll_bias", &E::roll_bias, "[rad]"},
      {"attitude_noise", &E::attitude_noise, "Of pitch and of roll [rad]."},
      {"attitude_lag", &E::attitude_lag, "By which heading, pitch and roll are late [s]."},
      {"depth_bias", &E::depth_bias, "[m]"},
      {"depth_noise", &E::depth_noise, "[m]"},
      {"altitude_bias", &E::altitude_bias, "[m]"},
      {"altitude_noise", &E::altitude_noise, "[m]"},
      {"rate", &E::rate,
       "Of readings [Hz]; between them the last one is reported. 0: one at each ping."},
      {"latency", &E::latency, "What is reported at t was so at t − latency [s]."},
  };
  return all;
}

}  // namespace bathyal::python::navigation_docs
