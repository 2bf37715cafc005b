// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/navigation/navigation_options.hpp"

namespace bathyal::python::navigation_filter_docs {

inline constexpr const char* kFilter =
    R"(Error-state Kalman filter of position, velocity, attitude and biases.

24 errors: position, velocity, attitude (small turns in the world), gyro bias, accelerometer bias,
log scale, log mount, current, fix lever; those whose deviations are all 0 stay what they are. The
world is flat and does not turn, z up. Readings that come late are applied at their own time.

Parameters
----------
devices : sequence of Sensor
    Those whose readings come; their mounts and errors are what the filter takes for granted.
time : float
    At which it begins [s].
pose : (4, 4) array, optional
    world_from_vehicle then; the identity unless given.
velocity : (3,) array
    Over ground then, in the world [m/s].
record : bool
    Whether all it does is kept for `smooth`, some 12 kB a step.
initial_position, initial_velocity, initial_attitude : float or (3,) array
    Standard deviations of the start, along and about the world's axes [m, m/s, rad].
**options : float
    initial_gyro_bias [rad/s], initial_accel_bias [m/s²], gyro_noise [rad/√s], gyro_walk [rad/s/√s],
    accel_noise [m/s/√s], accel_walk [m/s²/√s]; log_noise [m/s] and log_walk [m/√s] of a motion
    reckoned by `predict_motion`; log_scale (a part), log_mount [rad], current [m/s] with
    current_time [s], fix_lever [m]; gravity [m/s²], mean_surface [m], gate (readings less probable
    than 1 − gate are refused; 1: none), lag (how late readings may come [s]).

Raises
------
ValueError
    For a name that is none of them, a value out of its range, two devices of one name, or a pose
    that is not rigid.

Examples
--------
>>> import bathyal
>>> gps = bathyal.Sensor("gps", noise=0.5)
>>> navigation = bathyal.NavigationFilter([gps], initial_position=10.0, log_walk=0.1)
>>> for second in range(5):
...     navigation.predict_motion(float(second), [0.0, 0.0, 0.0], [1.5, 0.0, 0.0])
>>> navigation.update("gps", 4.0, [6.5, 0.0, 0.0]).accepted
True
>>> navigation.position.round(2).tolist()
[6.5, 0.0, 0.0]
)";

inline constexpr const char* kPredict = R"(By an inertial sample.

Between samples rates and forces change linearly; the first one only begins.

Parameters
----------
time : float
    After the one before [s].
rate : (3,) array
    Of turn, in the vehicle [rad/s].
force : (3,) array
    Specific force at the vehicle's origin, in the vehicle [m/s²]; at rest 9.81 up.

Raises
------
ValueError
    For a time that does not rise, or numbers that are not finite.
)";

inline constexpr const char* kPredictMotion = R"(By a reported attitude and a velocity log.

The turn since the last report counts, not the attitude itself: a constant error of it is one of the
start's attitude.

Parameters
----------
time : float
    After the one before [s].
attitude : (3,) array
    Roll, pitch, yaw as reported [rad].
velocity : (3,) array
    In the vehicle [m/s]: over ground, or through the water where the option `current` is above 0.

Raises
------
ValueError
    For a time that does not rise, or numbers that are not finite.
)";

inline constexpr const char* kUpdate = R"(By a reading of a device, at the reading's own time.

One of an imu predicts. Kinds that say nothing of the motion, and readings older than the lag, are
not used.

Parameters
----------
device : str
    Its name.
time : float
    Of the reading [s]; at most a second after the filter's.
values : array
    One a channel.

Returns
-------
NavigationUpdate

Raises
------
ValueError
    For an unknown device, another count of values, a time too far ahead, or values that are not
    finite.
)";

inline constexpr const char* kRun = R"(All readings of several sensors, as they arrive.

Parameters
----------
readings : sequence of SensorReadings
    One of them of an imu.
every : int
    Which estimates are kept: one in so many samples of the imu.

Returns
-------
NavigationTrack

Raises
------
ValueError
    For a sensor that is none of the filter's devices; as `update`.
)";

inline constexpr const char* kTrack =
    "Estimates over time, one row each; standard deviations are the filter's own.";

inline constexpr const char* kSmooth = R"(A track reckoned from attitude and log, through its fixes.

Forward by `NavigationFilter.predict_motion`, then back: each estimate is the best given all fixes.
Estimated along the way are heading, scale and mount of the log, current, and where in the vehicle
the fixes belong to. A velocity that repeats the row before to the last bit is an old value that
is held: it is replaced by what lies linearly between the fresh ones.

Parameters
----------
time : (N,) array
    Rising [s]; two or more.
attitude : (N,) or (N, 3) array
    Yaw, or roll, pitch, yaw, as `dead_reckon` takes them [rad].
velocity : (N, 3) array
    In the vehicle: forward, to port, up [m/s].
fix_time : (F,) array
    Rising, within `time` [s].
fix_position : (F, 3) array
    In the world [m].
fix_noise : float or (3,) array
    Standard deviation [m].
initial_attitude : float or (3,) array
    Standard deviation of the attitude about the world's axes [rad].
**options : float
    As of `NavigationFilter`; gyro_noise, log_noise, log_walk, log_scale, current, current_time and
    fix_lever have defaults for a vehicle with an attitude reference and a velocity log.

Returns
-------
NavigationTrack
    One row a time. Its `fix_point` is what goes through the fixes; `position` is that of the log.

Raises
------
ValueError
    For times that do not rise, fixes outside them, other counts of rows, numbers that are not
    finite, or a noise that is not above 0.

Examples
--------
>>> import bathyal, numpy as np
>>> time = np.arange(0.0, 101.0)
>>> log = np.tile([1.02, 0.0, 0.0], (101, 1))
>>> track = bathyal.smooth(time, 0.0 * time, log, [0.0, 100.0], [[0, 0, 0], [100, 0, 0]])
>>> track.position[50].round(1).tolist()
[50.0, 0.0, 0.0]
)";

struct Option {
  const char* name;
  double NavigationOptions::*member;
};

inline const std::vector<Option>& options() {
  using O = NavigationOptions;
  static const std::vector<Option> all = {{"initial_gyro_bias", &O::initial_gyro_bias},
                                          {"initial_accel_bias", &O::initial_accel_bias},
                                          {"gyro_noise", &O::gyro_noise},
                                          {"gyro_walk", &O::gyro_walk},
                                          {"accel_noise", &O::accel_noise},
                                          {"accel_walk", &O::accel_walk},
                                          {"log_noise", &O::log_noise},
                                          {"log_walk", &O::log_walk},
                                          {"log_scale", &O::log_scale},
                                          {"log_mount", &O::log_mount},
                                          {"current", &O::current},
                                          {"current_time", &O::current_time},
                                          {"fix_lever", &O::fix_lever},
                                          {"gravity", &O::gravity},
                                          {"mean_surface", &O::mean_surface},
                                          {"gate", &O::gate},
                                          {"lag", &O::lag}};
  return all;
}

}  // namespace bathyal::python::navigation_filter_docs
