// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bathyal::python::vehicle_docs {

inline constexpr const char* kVehicle = R"(A vehicle in water.

Its frame is x forward, y port, z up, its origin the centre of buoyancy. Velocities and forces are
(6,): linear, then angular; force, then moment. `bathyal.vehicles` has published ones.

Parameters
----------
mass : float
    [kg]
inertia : (3, 3) array
    About the centre of mass [kg m²].
center_of_mass : (3,) array
    [m]
volume : float
    Of the water displaced [m³].
added_mass : (6, 6) array, optional
    Symmetric, of no negative energy; none unless given.
linear_drag : (6, 6) array, optional
    D of the force −D ν.
quadratic_drag : (6,) array, optional
    c of the force −c abs(ν) ν along and about each axis; kept as terms.
terms : list of (row, a, b, absolute, coefficient)
    Parts of the force in the direction `row`: coefficient · ν_a · ν_b, of abs(ν_b) where `absolute`;
    0 to 5 are surge, sway, heave, roll, pitch, yaw.
parts : (P, 5) array, optional
    Balls that represent it where it leaves the water or meets the bottom: centre [m], radius [m],
    share of the volume. They balance about the origin. Without any it does neither.
gravity : float
    [m/s²]
water_density : float
    [kg/m³]
name : str
z_down : bool
    The numbers are of axes x forward, y starboard, z down, as most tables are printed; they are
    turned once.

Raises
------
ValueError
    For a value out of its range, or masses that make no positive definite matrix.

Notes
-----
M_RB ν̇ + C_RB(ν) ν + M_A ν̇_r + C_A(ν_r) ν_r + D(ν_r) + g(R) = τ + ρ V a, with ν_r the velocity
through the water and a the water's acceleration (Fossen, Handbook of Marine Craft Hydrodynamics and
Motion Control, ch. 6 to 8).

Examples
--------
>>> import bathyal, numpy as np
>>> remus = bathyal.vehicles.remus100()
>>> surge = [True, False, False, False, False, False]
>>> motion = remus.simulate(np.eye(4), [3.86, 0, 0, 0, 0, 0], 60.0, free=surge)
>>> motion.velocity[-1, 0].round(3)
np.float64(1.543)
)";

inline constexpr const char* kSimulate = R"(Its motion under a force.

By the classical Runge–Kutta method of fourth order with a fixed step, of position, unit quaternion
and velocity.

Parameters
----------
state : (4, 4) array, or (pose, velocity)
    world_from_vehicle at rest, or with a velocity (6,) over ground in the vehicle's frame.
thrust : (6,) array or function
    Force and moment about the vehicle's origin, in its frame [N, N m]; or a function of time,
    world_from_vehicle and velocity that gives them, called four times a step.
duration, step : float
    [s]
current : (3,) array or function, optional
    Of the water in the world [m/s]; or a function of point and time that gives it, called twelve
    times a step: its change over a step is the water's acceleration, which pushes the vehicle.
free : six bools, optional
    Surge, sway, heave, roll, pitch, yaw: velocities that are not free stay as they are at the start.
world : World, optional
    Its water moves the vehicle, where no `current` is given; its surface and bottom act on the
    vehicle's `parts`: lost buoyancy and drag, a damped spring and friction. Objects are where they
    are at time 0.

Returns
-------
VehicleMotion

Raises
------
ValueError
    For wrong shapes, or a step beyond the stability limit of the fastest mode, which is named.
bathyal.Error
    Where the motion runs away.
)";

inline constexpr const char* kAcceleration = R"(dν/dt under a force.

Parameters
----------
state : (4, 4) array, or (pose, velocity)
    As of `simulate`.
thrust : (6,) array
    Force and moment about the origin, in the vehicle's frame [N, N m].
current : (3,) array, optional
    Of the water in the world [m/s].

Returns
-------
(6,) array
    [m/s², rad/s²]
)";

inline constexpr const char* kReplace = R"(The vehicle with other values.

Parameters
----------
**changes
    Keywords of `Vehicle`; `quadratic_drag` takes the place of the terms along and about an axis by
    its own velocity, squared with its sign.

Returns
-------
Vehicle

Raises
------
ValueError
    For a name that is not known, or as `Vehicle`.
)";

inline constexpr const char* kFromMesh = R"(A first model from a closed hull.

Added mass and drag are those of the ellipsoid of equal volume, its half axes as the roots of the
hull's principal second moments.

Parameters
----------
mesh : TriangleMesh
    Closed; axes x forward, y port, z up.
mass : float, optional
    [kg]; neutral unless given.
center_of_mass : (3,) array, optional
    In the mesh's frame [m]; at the centre of volume unless given: then nothing rights it.
inertia : (3, 3) array, optional
    About the centre of mass [kg m²]; of an even solid unless given.
drag_coefficient : (3,) array, optional
    C of ½ ρ C A v² along x, y, z, of the ellipsoid's shadow; 1 unless given.
gravity : float
    [m/s²]
water_density : float
    [kg/m³]

Returns
-------
Vehicle
    Its origin is the hull's centre of volume.
vehicle_from_mesh : (4, 4) array

Raises
------
ValueError
    For a mesh that is not closed, or values out of range.
)";

inline constexpr const char* kEllipsoid = R"(Added mass of an ellipsoid about its centre.

Parameters
----------
half_axes : (3,) array
    Along x, y, z [m].
water_density : float
    [kg/m³]

Returns
-------
(6, 6) array
    [kg, kg m²] (Lamb, Hydrodynamics, art. 114, 115)

Raises
------
ValueError
    For a half axis that is not above 0.
)";

}  // namespace bathyal::python::vehicle_docs
