// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bathyal::python::control_docs {

inline constexpr const char* kAllocation = R"(From a wrench to the commands of thrusters.

The weighted least squares of the wrench's error with each thrust within what the thruster can give
at the voltage, solved exactly by an active set (Stark and Parker 1995). When the thrusters cannot
give it, what weighs most is kept first: heave, roll and pitch, then yaw, then surge and sway.

Parameters
----------
thrusters : list of Thruster
weights : (6,) array, optional
    Of an error in surge to yaw, above 0; 1, 1, 100, 100, 100, 10 unless given.
effort : float
    Weight of the thrusts themselves, which shares the work out.

Raises
------
ValueError
    For none or more than 32 thrusters, or weights that are not above 0.

Examples
--------
>>> import bathyal
>>> rov = bathyal.VehicleSystem.bluerov2_heavy()
>>> allocation = bathyal.Allocation(rov.thrusters)
>>> allocation.rank(failed=[0]), allocation.rank(failed=[4, 5])
((6, []), (5, ['pitch']))
>>> given = allocation.allocate([20, 0, 10, 0, 0, 1], voltage=15.0)
>>> bool(abs(given.achieved - [20, 0, 10, 0, 0, 1]).max() < 1e-4), given.saturated
(True, False)
)";

inline constexpr const char* kRank =
    R"(Rank of the thrusters' matrix, and which directions are lost.

In the order heave, yaw, surge, sway, roll, pitch a direction is kept if it is independent of those
kept before it; roll and pitch come last as a vehicle rights itself in them.

Parameters
----------
failed : list of int
    Rows of thrusters that do not work.

Returns
-------
rank : int
lost : list of str
)";

inline constexpr const char* kAllocate = R"(Thrusts and commands for a wrench.

Directions that are lost do not count, so that the others are held.

Parameters
----------
wrench : (6,) array
    About the vehicle's origin, in its frame [N, N m].
voltage : float
    Of the supply, which limits the thrusts [V].
failed : list of int
    Rows of thrusters that do not work.
)";

inline constexpr const char* kPoseHold = R"(Holds depth, heading, pitch, roll and position.

A PID whose gains are the model's: in each direction the error obeys
(s + i ω)(s² + 2 ζ ω s + ω²) = 0 times the vehicle's mass matrix with its added mass; weight,
buoyancy and the drag of a known current are fed forward (Fossen 2011, sect. 12.2). The integral of
position stays as it is in the world when the vehicle turns, and does not wind up.

Parameters
----------
vehicle : Vehicle
frequency : (6,) array, optional
    ω, surge to yaw [rad/s].
damping : float
    ζ
integral : float
    i; 0: no integral part.
axes : list of 6 bool
    What is controlled.

Raises
------
ValueError
    For a frequency or damping that is not above 0.
)";

inline constexpr const char* kPoseStep =
    R"(The wrench to ask for; the state is changed for the next step.

Parameters
----------
state : PoseHoldState
pose : (4, 4) array
    world_from_vehicle, as measured.
velocity : (6,) array
    Over ground, in the vehicle's frame.
target : (4, 4) array, optional
    The pose to hold; the world's origin unless given.
target_velocity : (6,) array, optional
    Over ground, in the vehicle's frame.
current : (3,) array, optional
    What is known of it, in the world [m/s].
time : float
    Since the last step [s].

Returns
-------
(6,) array
    About the vehicle's origin, in its frame [N, N m].
)";

inline constexpr const char* kCruise = R"(Speed, heading and depth by a propeller and fins.

State feedback by pole placement (Ackermann's formula) on the model, linear about straight and level
motion: sway, yaw rate, heading and its integral by the rudder; heave, pitch rate, pitch, depth and
its integral by the stern plane.

Parameters
----------
system : VehicleSystem
speed : float
    At which the gains are found [m/s].
heading_frequency, depth_frequency, speed_frequency : float
    Natural, of the slower modes [rad/s].
damping : float
    Ratio.
integral : float
    The integrals' poles, times the frequency.
most_pitch : float
    That a depth error asks for [rad].
rudder, stern_plane, propeller : int
    Rows of the system's fins and thrusters.

Raises
------
ValueError
    For a value out of its range, or a fin that does not turn the vehicle.
)";

inline constexpr const char* kCruiseStep =
    R"(Fin angles and thrust; the state is changed for the next step.

Parameters
----------
state : CruiseState
pose : (4, 4) array
    world_from_vehicle, as measured.
velocity : (6,) array
    Through the water, in the vehicle's frame.
speed, heading, z : float
    To hold: through the water [m/s], about z from x [rad], of the origin in the world [m].
climb : float
    dz over the way run, of the path to hold.
time : float
    Since the last step [s].

Returns
-------
rudder, stern_plane : float
    [rad]
thrust : float
    [N]
)";

inline constexpr const char* kLine = R"(Follows straight legs between points, in the level plane.

Integral line of sight (Børhaug, Pavlov, Pettersen 2008): steers α − atan((y + σ i) / Δ) with y the
offset to port of the leg of course α.

Parameters
----------
points : (K, 2) array
    In the world [m].
lookahead : float
    Δ [m]
integral : float
    σ, gain on the offset that a current makes.
acceptance : float
    A point this near is reached [m].

Raises
------
ValueError
    For fewer than two points, or two in a row that are the same.

Examples
--------
>>> import bathyal
>>> line = bathyal.LineOfSight([[0, 0], [100, 0], [100, 50]])
>>> state = bathyal.LineOfSightState()
>>> heading, cross_track = line.step(state, [10, 2, -5], 0.1)
>>> round(heading, 3), cross_track
(-0.245, 2.0)
)";

inline constexpr const char* kFollow = R"(The path to steer to keep a distance to an uneven bottom.

The lowest path that is nowhere nearer to the bottom, measured upwards, than `altitude` and nowhere
climbs or falls more than `steepest`, over the bottom ahead and as far behind.

Parameters
----------
position : (3,) array
    In the world [m].
heading : float
    The way over ground, about z from x [rad].
bottom : callable
    Height of the bottom at (x, y) [m], as a chart or a sonar that looks ahead gives it.
altitude : float
    [m]
lookahead : float
    How far ahead the bottom is known [m].
lead : float
    Steers for the path so far ahead, for the vehicle's own lag [m].
steepest : float
    Height over way.
spacing : float
    Of the samples [m].

Returns
-------
z : float
    [m]
climb : float
    Of the path there.

Examples
--------
>>> import bathyal
>>> bathyal.follow_bottom([0, 0, -20], 0.0, lambda x, y: -25.0)
(-22.0, 0.0)
)";

}  // namespace bathyal::python::control_docs
