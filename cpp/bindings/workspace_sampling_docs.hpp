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
>>> ws = bathyal.Workspace(arm).attach([], bathyal.RigidBody(2.0))
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
>>> ws = bathyal.Workspace(arm, vehicle_body=body).attach([], bathyal.RigidBody(0.1))
>>> trim = ws.static_trim([0.0])  # 0.1 kg at 0.9 m forward: nose down
>>> round(trim.pitch, 4), trim.status
(0.2213, 'upright')
)";

inline constexpr const char* kTrim = R"(How a vehicle hangs in the water.

``world_from_vehicle = Rz(heading) Ry(pitch) Rx(roll)``, at any heading; the vehicle's x is forward,
y port, z up. Arrays (N,) of N postures, numbers of a single one.
)";

}  // namespace bathyal::python::workspace_docs
