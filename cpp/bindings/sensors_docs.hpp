// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bathyal::python::sensors_docs {

inline constexpr const char* kSensor = R"(A sensor of a vehicle, and what is wrong with it.

Its channels by kind, in SI units; "its frame" is the frame of the mount:

- "depth": below the mean surface.
- "imu": rates of turn x, y, z and specific forces x, y, z, in its frame.
- "dvl": velocity over ground x, y, z, in its frame.
- "compass": roll, pitch, yaw of the vehicle [rad]; world_from_vehicle = Rz Ry Rx, yaw
  counterclockwise from the world's x, pitch positive bow down.
- "gps": position of the antenna in the world x, y, z; only above the surface.
- "usbl": position of the transponder in the world x, y, z; late by the two-way travel time to the
  ship.
- "lbl": range to each beacon.
- "altimeter": altitude.
- "current": velocity of the water past the sensor x, y, z, in its frame.
- "rpm": turns of the propeller [1/s].
- "leak": water in the hull [kg].
- "modem": one-way travel time from the beacon [s].

Errors are given once for all channels or one a channel, in the channel's unit; 0 unless given.

Parameters
----------
kind : str
name : str, optional
    Keys the noise, so that no other sensor changes it; the kind unless given.
rate : float
    Of samples [Hz]; sample k is due at k / rate.
latency : float
    From validity to arrival [s].
dropout : float
    Part of the samples that never come.
range : float
    Beyond it nothing is heard [m]; of a dvl and an altimeter the altitude.
sound_speed : float
    [m/s]; of usbl, lbl and modem.
vehicle_from_sensor : (4, 4) array, optional
    The mount.
beacons : (B, 3) array, optional
    In the world [m]: the ship of "usbl" and "modem", one row; 1 to 12 of "lbl".
noise : float or array
    Standard deviation of each sample.
bias : float or array
    Standard deviation of a constant, drawn once a seed.
scale : float or array
    Standard deviation of a scale error, drawn once a seed, as a part.
walk : float or array
    Random walk, per √s.
markov, markov_time : float or array
    Standard deviation and correlation time [s] of a Gauss–Markov drift.
outlier_rate, outlier_size : float or array
    Part of the samples, and standard deviation of what is added to them.
quantum : float or array
    Values are multiples of it.

Raises
------
ValueError
    For an unknown kind, a value out of its range (the field is named), or missing beacons.

Examples
--------
>>> import bathyal, numpy as np
>>> gauge = bathyal.Sensor("depth", rate=2.0, noise=0.05)
>>> time = np.arange(5) / 2
>>> pose = np.tile(np.eye(4), (5, 1, 1))
>>> pose[:, 2, 3] = -10.0
>>> gauge.simulate(time, pose, seed=1).values[:, 0].round(2).tolist()
[9.97, 10.01, 10.01, 10.01, 9.95]
)";

inline constexpr const char* kSimulate = R"(What the sensor reports of a motion.

Samples are taken at the first given time at or after each is due: times should be at least as dense
as the samples.

Parameters
----------
time : (N,) array
    Rising, from 0 on [s].
pose : (N, 4, 4) array
    world_from_vehicle.
velocity : (N, 6) array, optional
    Over ground and of turn, in the vehicle [m/s, rad/s]; at rest unless given.
acceleration : (N, 6) array, optional
    Change of the numbers of `velocity` [m/s², rad/s²]; 0 unless given.
water_velocity : (N, 3) array, optional
    In the world [m/s]; 0 unless given.
altitude : (N,) array, optional
    [m]; NaN where there is no bottom, as everywhere unless given.
propeller_rate, leak : (N,) array, optional
    [1/s], [kg]; 0 unless given.
surface : float
    z of the mean sea surface [m]; gps is heard above it.
gravity : float
    [m/s²]
seed : int
    Of all noise.

Returns
-------
SensorReadings
    Without samples that dropped out.

Raises
------
ValueError
    For times that do not rise or are below 0, other counts of rows, poses that are not rigid, or
    numbers that are not finite.
)";

inline constexpr const char* kReadings = R"(What a sensor reports, one row a sample.

Parameters
----------
sensor : Sensor
time : (K,) array
    At which the values were so, rising [s].
values : (K, C) array
    One column a channel.
arrival : (K,) array, optional
    At which they are known on board [s]; at once, or as late as the sensor's latency says, unless
    given.
valid : (K,) array of bool, optional
    False: the sensor says itself that it measured nothing. True unless given.

Raises
------
ValueError
    For times that do not rise, or another count of rows or columns.
)";

inline constexpr const char* kAllan = R"(Overlapping Allan deviation of equally spaced samples.

White noise of density n falls as n/√τ, a random walk of k per √s rises as k √(τ/3) (IEEE Std 952,
annex C).

Parameters
----------
rate_data : (N,) array
    Such as rates of turn [rad/s]; 4 or more, finite.
sample_rate : float
    [Hz]
factors : (K,) array of int, optional
    Averaging times as numbers of samples, 1 to N / 2; 1, 2, 4, … N / 4 unless given.

Returns
-------
interval : (K,) array
    Averaging times [s].
deviation : (K,) array
    In the unit of the data.

Raises
------
ValueError
    For fewer samples, ones that are not finite, a sample rate not above 0, factors out of range.

Examples
--------
>>> import bathyal
>>> bathyal.allan_deviation([1.0, -1.0] * 8, 10.0, [1, 2])[1].tolist()
[1.4142135623730951, 0.0]
)";

inline constexpr const char* kReckon = R"(Positions from attitudes and velocities alone.

Velocities turned into the world are integrated by the trapezoidal rule.

Parameters
----------
time : (N,) array
    Rising [s].
attitude : (N,) or (N, 3) array
    Yaw, or roll, pitch, yaw [rad]: yaw counterclockwise from the world's x, pitch positive bow
    down.
velocity : (N, 3) array
    In the vehicle: forward, to port, up [m/s].

Returns
-------
(N, 3) array
    In the world, from 0 at the first time on [m].

Raises
------
ValueError
    For times that do not rise, other counts of rows, or numbers that are not finite.

Examples
--------
A heading 1° off costs 17.45 m a kilometre:

>>> import bathyal, numpy as np
>>> ahead = [[1.0, 0.0, 0.0]] * 2
>>> bathyal.dead_reckon([0.0, 1000.0], np.radians([1.0, 1.0]), ahead)[1].round(2).tolist()
[999.85, 17.45, 0.0]
)";

}  // namespace bathyal::python::sensors_docs
