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
terms : list of (row, a, b, absolute, coefficient)
    Parts of the force in the direction `row`: coefficient · ν_a · ν_b, of |ν_b| where `absolute`;
    0 to 5 are surge, sway, heave, roll, pitch, yaw.
gravity : float
    [m/s²]
water_density : float
    [kg/m³]
name : str

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
    Of the water in the world [m/s]; or a function of point and time that gives it.
free : six bools, optional
    Surge, sway, heave, roll, pitch, yaw: velocities that are not free stay as they are at the start.

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
