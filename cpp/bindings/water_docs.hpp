// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bathyal::python {

inline constexpr const char* kProfileDoc = R"(A cast: properties of the water by depth.

As read from a file its rows are in the file's order, the way down and the way up, with NaN where
the instrument gave nothing; `cleaned` makes of it what a `Water` takes. A column that was not
measured is None.

Parameters
----------
depth : (K,) array
    Below the surface [m].
temperature, salinity, sound_speed, pressure : (K,) array, optional
    [°C], practical, [m/s], above the atmosphere's [dbar].
position : (latitude, longitude), optional
    North and east [deg].
time : float, optional
    Since 1970-01-01 UTC [s].
instrument, source : str
    What measured, and from which file it came.

Raises
------
ValueError
    For no row, columns of another length, infinite numbers.

Examples
--------
>>> import bathyal
>>> cast = bathyal.Profile([0, 20, 60], temperature=[18, 14, 9], salinity=[34, 34.5, 35])
>>> cast.with_sound_speed().sound_speed.round(1).tolist()
[1514.6, 1503.2, 1487.1]
)";

inline constexpr const char* kCleanedDoc = R"(The way down, fit for a `Water`.

Rows with a number missing and those above the surface are left out, and those not deeper than one
before; rows of equal depth become their mean. A column without any number is left out.

Parameters
----------
step : float
    Mean of the rows in each layer of this thickness [m]; 0 keeps each row.

Returns
-------
Profile

Raises
------
ValueError
    Where fewer than two rows remain.
)";

inline constexpr const char* kWithSoundSpeedDoc = R"(The same cast with the sound speed computed.

Parameters
----------
formula, temperature_scale : str
    As of `bathyal.sound_speed`. Rows with a number missing get NaN.
latitude : float, optional
    [deg]; by default the cast's own, without one 45.

Returns
-------
Profile
)";

inline constexpr const char* kCurrentDoc = R"(Horizontal current by depth and time.

Linear between depths and times, at the ends as there.

Parameters
----------
depth : (K,) array
    Rising [m].
velocity : (K, 2) array
    x and y of the world [m/s]; (T, K, 2) with `time`.
time : (T,) array, optional
    Rising [s].

Examples
--------
>>> import bathyal
>>> current = bathyal.Current([0, 30], [[0.6, 0.0], [0.1, 0.0]])
>>> current.at(15.0).round(3).tolist()
[0.35, 0.0]
)";

inline constexpr const char* kWavesDoc = R"(A sea state of linear (Airy) waves.

Components of the JONSWAP spectrum (Hasselmann and others 1973), one drawn in each of equal bands
between half and four times the peak's frequency. Orbits follow Wheeler's stretching (1970).

Parameters
----------
height : float
    Significant [m].
period : float
    Of the peak [s], 0.5 to 60.
peak_enhancement : float
    γ, 1 to 20; 1 is the spectrum of Pierson and Moskowitz (1964).
direction : float
    The waves travel towards, about z from x [rad].
spreading : float
    s of cos²ˢ(½Δ) about it, 0 to 1 000; infinite for long crests.
components : int
depth : float
    Of the water [m].
seed : int

Examples
--------
>>> import bathyal
>>> sea = bathyal.Waves(height=1.5, period=7, seed=1)
>>> sea
Waves(200 components, significant height 1.5 m)
)";

inline constexpr const char* kTideDoc = R"(Height of the sea surface above its mean by time.

Parameters
----------
constituents : list of (name, (amplitude, phase))
    M2, S2, N2, K2, K1, O1, P1, Q1 or M4, its amplitude [m] and its phase at time 0 [rad]:
    amplitude · cos(rate · time − phase). No nodal factors.

Examples
--------
>>> import bathyal
>>> tide = bathyal.Tide([("M2", (1.2, 0.0)), ("S2", (0.4, 0.5))])
>>> round(tide.height(0.0), 3)
1.551
)";

inline constexpr const char* kWaterDoc =
    R"(The water of a world: one place that sonars and vehicles read.

Depth counts from the mean surface; a profile moves with neither tide nor waves. Without a surface
the water is the same everywhere, as it is at `reference_depth`.

Parameters
----------
profile : Profile or list of Profile, optional
    By depth, linear between rows, above the first and below the last as there (`covers`). A sound
    speed that a profile does not have is computed; a temperature or salinity that it does not have
    is the number below.
surface : float, optional
    z of the mean sea surface [m]; None: out of reach.
time : (T,) array, optional
    Of several profiles, rising [s]; linear between, at the ends as there.
reference_depth : float
    [m]
temperature, salinity : float
    Of water without a profile [°C], practical.
sound_speed : float, optional
    Of water without a profile [m/s]; None: computed.
formula : str
    As of `bathyal.sound_speed`.
ph : float
latitude : float, optional
    [deg], for depth and pressure; by default the profile's, without one 45.
current : Current or (2,) array, optional
    [m/s]
waves : Waves, optional
tide : Tide, optional
    Both need a surface.

Raises
------
ValueError
    For a profile of one row, unsorted or doubled depths, NaN, numbers that no water has, waves or a
    tide without a surface.

Examples
--------
>>> import bathyal
>>> cast = bathyal.Profile([0, 20, 60], temperature=[18, 14, 9], salinity=[34, 34.5, 35])
>>> water = bathyal.Water(cast, surface=0.0)
>>> round(water.sound_speed(-20.0), 1), water.covers(80)
(1503.2, False)
>>> round(water.absorption(100e3, depth=50), 1)
33.5
)";

inline constexpr const char* kSoundPathDoc = R"(The path of sound in a profile: arcs of circles.

Sound speed is linear between the rows of a profile; there a ray of sound is an arc of a circle, and
place, direction and time along it are closed forms. A path lies in a vertical plane.

Parameters
----------
water : Water or Profile
start_depth : float
    [m]
launch_angle : float
    Below the horizontal, −½π to ½π [rad].
max_time, max_distance : float
    End of the path [s], horizontal [m].
surface : bool
    Whether depth 0 is the sea surface, at which a path ends.
surface_reflects : bool
    At which it is reflected instead.
time : float
    Of the water [s].

Examples
--------
>>> import bathyal
>>> cast = bathyal.Profile([0, 1000], sound_speed=[1500.0, 1517.0])
>>> path = bathyal.SoundPath(cast, 100.0, 0.0, max_time=0.5)
>>> path.at([0.5]).round(3).tolist()  # bent upwards, to less speed
[[0.5, 750.832, 96.809, -0.008]]
)";

inline constexpr const char* kTraceSoundDoc = R"(Where beams are after their travel times.

What reduces a sounding of a multibeam sonar: along the path of sound in a profile. Arguments
broadcast.

Parameters
----------
water : Water or Profile
launch_angle : float or array
    Below the horizontal, −½π to ½π [rad]: ½π minus the angle from the vertical.
travel_time : float or array
    One way [s]: half of what the sonar measures.
start_depth : float or array
    Of the sonar [m].
time : float
    Of the water [s].

Returns
-------
TracedSound
    ``.across`` and ``.depth`` [m], ``.angle`` [rad]; NaN where the path has met the surface.

Examples
--------
>>> import bathyal
>>> cast = bathyal.Profile([0, 10, 100], sound_speed=[1520.0, 1500.0, 1490.0])
>>> found = bathyal.trace_sound(cast, [0.5, 1.0], 0.04, 2.0)
>>> found.across.round(2).tolist(), found.depth.round(2).tolist()
([52.19, 32.04], [31.7, 52.69])
)";

inline constexpr const char* kEigenraysDoc =
    R"(All ways of sound from a depth to another at a distance.

By a fan of launch angles, and bisection between those that pass the point on different sides.

Parameters
----------
water : Water or Profile
from_depth, to_depth : float
    [m]
distance : float
    Horizontal [m].
angles : int
    Of the fan: two ways closer than its spacing may be missed.
steepest : float
    Of the fan [rad]; the straight line to the point is always within it.
surface_reflects : bool
time : float
    Of the water [s].

Returns
-------
list of Eigenray
    The quickest first; empty in a shadow.
)";

}  // namespace bathyal::python
