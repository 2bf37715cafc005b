// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Docstrings of what an arm does to its vehicle, and of sampling.

namespace bathyal::python::workspace_docs {

inline constexpr const char* kWrench =
    R"(Force and moment on the vehicle by arm, attached body and bottom.

The weight of each link and of what is attached, at its centre of mass, less its buoyancy, at its
centre of buoyancy, with gravity turned into the vehicle's frame by `vehicle_pose`; the force of the
bottom on the tool; and, where rates are given, the inertia of what moves: minus the derivative of
its momentum, the vehicle taken to be at rest. The arm's foot counts with the arm. A mass or volume
of 0, unknown, adds nothing; water adds neither mass nor drag.

Parameters
----------
q : (N, n) or (n,) array
    [rad] or [m]; may lie beyond the limits.
contact : (6,) or (N, 6) array, optional
    Force and moment that the bottom exerts on the tool, at the tool centre point along the vehicle's
    axes [N, N m]. (Of the other sign than `Arm.statics`' ``wrench``, which the tool exerts.)
time : float or (N,) array
    When [s], for a vehicle that moves.
velocity, acceleration : array of q's shape, optional
    Of the coordinates [rad/s, rad/s²] or [m/s, m/s²]; at rest unless given.
gravity : (3,) array
    In the world [m/s²].
water_density : float
    [kg/m³]; 0 in air.
num_threads : int
    0 means all.

Returns
-------
(N, 6) or (6,) array
    Force, then moment about the vehicle's origin, in the vehicle's frame [N, N m].

Raises
------
ValueError
    For arguments of another shape, not finite or out of range.

Examples
--------
>>> import bathyal, numpy as np
>>> arm = bathyal.Arm.from_dh(a=[0.9], alpha=[0], d=[0], theta=[0])  # reaches forward
>>> ws = bathyal.Workspace(arm, radii=0.05).attach([], bathyal.RigidBody(2.0))
>>> np.round(ws.wrench([0.0]), 2) + 0  # its weight, and a moment that pitches the nose down
array([  0.  ,   0.  , -19.61,   0.  ,  17.65,   0.  ])
)";

inline constexpr const char* kMomentum =
    R"(Momentum of the arm's links and of what is attached, seen from the vehicle.

Parameters
----------
q, velocity : (N, n) or (n,) array
    Coordinates [rad] or [m], and their rates.
num_threads : int
    0 means all.

Returns
-------
(N, 6) or (6,) array
    Linear [kg m/s], then angular about the vehicle's origin [kg m²/s], in the vehicle's frame.

Raises
------
ValueError
    For arrays of another shape or not finite.
)";

inline constexpr const char* kStaticTrim = R"(The attitude in which the vehicle hangs at rest.

Of `vehicle_body`, the arm in a posture and what is attached to it: no moment about the vehicle's
origin remains, (Σ m r_cg − ρ Σ V r_cb) × g = 0, exact for any angle, and of the two such attitudes
the stable one. Where weight and buoyancy differ, the remaining vertical force is held at the
vehicle's origin without a moment (see `StaticTrim.buoyancy`). A mass or volume of 0 of a link,
unknown, adds nothing.

Parameters
----------
q : (N, n) or (n,) array
    [rad] or [m]; may lie beyond the limits.
gravity : float
    [m/s²]; scales `StaticTrim.righting` and `.buoyancy`, no angle.
water_density : float
    [kg/m³]
num_threads : int
    0 means all.

Returns
-------
StaticTrim
    Of a single posture numbers in place of arrays.

Raises
------
ValueError
    For a workspace without `vehicle_body`, or with one without mass or volume; for arguments of
    another shape, not finite or out of range.

Examples
--------
>>> import bathyal
>>> arm = bathyal.Arm.from_dh(a=[0.9], alpha=[0], d=[0], theta=[0])
>>> body = bathyal.RigidBody(20, center_of_mass=(0, 0, -0.02), volume=20 / 1025)
>>> ws = bathyal.Workspace(arm, radii=0.05, vehicle_body=body)
>>> ws = ws.attach([], bathyal.RigidBody(0.1))
>>> trim = ws.static_trim([0.0])  # 0.1 kg at 0.9 m forward: nose down
>>> round(trim.pitch, 4), trim.status
(0.2213, 'upright')
)";

inline constexpr const char* kTrim = R"(How a vehicle hangs in the water.

``world_from_vehicle = Rz(heading) Ry(pitch) Rx(roll)``, at any heading; the vehicle's x is forward,
y port, z up. Arrays (N,) of N postures, numbers of a single one.
)";

inline constexpr const char* kSamplingPhase = R"(One part of taking a sample, from rest to rest.

Its first row is the last of the phase before. Rows are joined by straight lines in joint space.
)";

inline constexpr const char* kSamplingPlan = R"(How to take a sample, or why there is no way.

True where there is a plan.
)";

inline constexpr const char* kPlanSampling =
    R"(How to take a soil sample at a point: approach, press, grab, lift, transport.

The sequence of Maevskiy, Zanin (2020), Modular control systems for manipulators and intervention-
class AUVs. The contact is where the line through the target along `direction` first meets the scene
within a standoff before and behind the target; without a scene the target itself. The tip
approaches to the standoff before it as `Workspace.plan` does, presses straight on by
``min(depth, force_limit / stiffness)``, grabs, lifts straight back with the sample, and is carried
to `q_transport` as `Workspace.plan` does. Press, grab and lift may touch the scene with the end of
the tool (what of the last link lies within the depth and two radii of its tip), all else nowhere;
straight ways are checked between the rows, too. The bottom pushes the
tip back by stiffness times penetration while it presses, grabs and lifts. Every phase has a way
back, checked with what is held then. The same seed gives the same bytes.

Parameters
----------
ws : Workspace
    Its vehicle at rest.
target : (3,) array
    On the bottom, in the world [m].
q_start : (n,) array, optional
    Where the arm starts. Unless given all coordinates at zero, or as near to it as limits allow;
    where that touches, the middle of the limits; else of 64 drawn postures that with the largest
    clearance.
q_transport : (n,) array, optional
    In which the sample is carried; `q_start` unless given.
tool : RigidBody, optional
    What the tool weighs, in the tool's frame; attached all the time.
tool_capsules : list of Capsule
    Its shape, in the tool's frame.
tool_pose : (4, 4) array, optional
    flange_from_tool in place of the arm's ``.tool``.
sample : RigidBody, optional
    In the tool's frame; attached from the end of the grab on.
sample_capsules : list of Capsule
    Its shape, in the tool's frame.
direction : (3,) array, optional
    Into the bottom, in the world, of any length. Unless given against the bottom's normal (the mean
    of those within 5 cm of the target, turned upwards), and without a scene straight down.
align : bool, optional
    Whether `tool_axis` points along the direction; unless given for arms of five coordinates or
    more.
tool_axis : (3,) array
    In the tool's frame.
standoff : float
    Of the tip before contact [m].
depth : float
    That the tip is pressed into the bottom [m].
stiffness, force_limit : float
    Of the bottom [N/m]; with which the tip is pressed at most [N].
grab_time : float
    [s]
press_speed : float
    Of the tip while it presses and lifts, at most [m/s].
line_tolerance : float
    How far the tip may leave its straight line [m].
velocity, acceleration, jerk : float or (n,) array, optional
    Limits of each coordinate, as of `Workspace.plan`.
step : float
    Between rows, at most; longer where `press_speed` holds the tip back [s].
time : float
    When the arm starts [s]; matters where something moves.
max_checks : int
    Postures and straight motions looked at by all planned motions together, each of which may use a
    quarter.
seed : int
    Of the searches.
inertia : bool
    Whether `SamplingPlan.wrench` has the inertia of what moves, by differences of the rows, or is
    quasi-static.
gravity : (3,) array
    In the world [m/s²].
water_density : float
    [kg/m³]
num_threads : int
    0 means all.

Returns
-------
SamplingPlan

Raises
------
ValueError
    For a target that is not finite, a vehicle that moves, postures of another length, options out
    of range.

Examples
--------
>>> import bathyal
>>> arm = bathyal.arms.maevskiy_zanin()
>>> bottom = bathyal.TriangleMesh([[-2, -2, -0.8], [2, -2, -0.8], [0, 3, -0.8]], [[0, 1, 2]])
>>> ws = bathyal.Workspace(arm, scene=bathyal.Scene(bottom))
>>> plan = bathyal.plan_sampling(ws, [0.75, 0.2, -0.8], q_start=[0.0, -0.785, 0.873])
>>> plan.status, [phase.name for phase in plan.phases]
('planned', ['approach', 'press', 'grab', 'lift', 'transport'])
>>> round(float(plan.contact_force.max()))  # [N]
100
)";

}  // namespace bathyal::python::workspace_docs
