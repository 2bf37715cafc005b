// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bathyal::python::uvms_docs {

inline constexpr const char* kArmOnVehicle =
    R"(A vehicle and the arm that it carries, as one tree of bodies in water.

The arm moves the vehicle by its weight, its inertia and the water that it moves. Arm, mount, the
capsules that the links are in the water, and what is attached to the tool are those of the
workspace; hull, scene and keep-outs play no part. A link has the mass, inertia and volume that
`Arm.links` give; 0 is none.

Parameters
----------
vehicle : Vehicle
    Without the arm. Gravity and water density are its own.
workspace : Workspace
added_mass : float
    Of a link across its axis, over the mass of the water that its cylinder displaces.
drag : float
    C_D of a link across its axis, over its projected area. Along the axis there is none.
strips : int
    Of each capsule, for its drag.

Raises
------
ValueError
    For values out of range.

Notes
-----
Equations of motion by articulated bodies (Featherstone, Rigid Body Dynamics Algorithms, 2008, table
9.4), hull and links each with Fossen's terms; links in the water by strip theory (McLain and Rock,
1998).

Examples
--------
>>> import bathyal, numpy as np
>>> bodies = [bathyal.Link(f"link_{k}", mass=0.8, volume=4e-4) for k in range(7)]
>>> arm = bathyal.Arm.from_dh(a=[0, -0.3, -0.3, 0, 0, 0], alpha=[np.pi/2, 0, 0, np.pi/2, -np.pi/2, 0],
...     d=[0.1, 0, 0, 0.1, 0.1, 0.1], theta=[0] * 6, links=bodies)
>>> mount = np.eye(4)
>>> mount[:3, 3] = 0.25, 0, -0.1
>>> workspace = bathyal.Workspace(arm, mount, radii=0.03)
>>> both = bathyal.ArmOnVehicle(bathyal.vehicles.bluerov2_heavy(), workspace)
>>> reach = np.array([[0, 0, 0, 0, 0, 0], [0, -1.0, 0.5, 0, 0, 0]])
>>> motion = both.simulate(np.eye(4), reach, np.zeros(6), 4.0, time=[0.0, 2.0])
>>> motion.pose.shape, motion.torque.shape
((401, 4, 4), (401, 6)))";

inline constexpr const char* kSimulateArm =
    R"(How vehicle and arm move while the arm carries a motion out, in deep water.

Parameters
----------
state : (4, 4) array, or (pose, velocity)
    world_from_vehicle at rest, or with the velocity (6,) over ground in the vehicle's frame.
q : (n,) or (K, n) array
    A posture that is held, or rows of a motion: a cubic spline goes through them, at rest before
    the first and after the last.
thrust : (6,) array, or function
    Force and moment on the vehicle about its origin, along its axes [N, N m], or
    f(time, pose, velocity).
duration : float
    [s], 0 or more.
step : float
    Of the integration (Runge–Kutta, fourth order) [s].
current : (3,) array, optional
    Velocity of the water in the world [m/s].
time : (K,) array
    Of the rows of `q` and `tip_wrench`, rising [s]; needed where there are several.
tip_wrench : (6,) or (K, 6) array, optional
    Force and moment on the tool at its centre point, along the vehicle's axes: what the bottom
    pushes back with; straight between rows.

Returns
-------
ArmMotion

Raises
------
ValueError
    For shapes that do not fit, times that do not rise, a step beyond the limit of the fastest mode.
Error
    Where the motion runs away.)";

inline constexpr const char* kArmAcceleration =
    R"(Accelerations of vehicle and arm, and the torques that go with them.

Parameters
----------
state : (4, 4) array, or (pose, velocity)
q, rate : (n,) array
    Coordinates of the arm and their rates [rad or m, and per s].
torque : (n,) array, optional
    Of the drives, positive along the coordinates [N m, N]: the accelerations of the joints are
    found. For arms without joints that mimic others.
acceleration : (n,) array, optional
    Of the coordinates: the torques are found. Zeros where neither is given.
thrust, tip_wrench : (6,) array, optional
    As of `simulate`.
current : (3,) array, optional

Returns
-------
tuple
    (6,) dν/dt of the vehicle in its frame, (n,) accelerations, (n,) torques.

Raises
------
ValueError
    For shapes that do not fit, or both of torque and acceleration.)";

inline constexpr const char* kHold =
    R"(How the vehicle holds its pose by its thrusters while the arm works.

The controller has the model that it was made with; the truth is this object. Each period it asks
for a wrench, less what is expected of arm and bottom (fed forward); the allocation gives it to the
thrusters, which lag as theirs do. Pose and velocity are measured without error.

Parameters
----------
state, q, duration, step, current, time, tip_wrench
    As of `simulate`.
allocation : Allocation
    With the thrusters.
controller : PoseHold
    Of the vehicle without its arm, as it is believed to be.
expected_wrench : (6,) or (K, 6) array, optional
    What arm and bottom are expected to exert on the vehicle, about its origin [N, N m]: the
    `wrench` of `plan_sampling` or of `Workspace.wrench`. None: feedback alone.
period : float
    Of the controller, a whole number of steps [s].
voltage : float
    Of the thrusters [V].

Returns
-------
TrimHold

Raises
------
ValueError
    For an expected wrench that the thrusters cannot balance; the axis and time are named. And as
    `simulate`.)";

}  // namespace bathyal::python::uvms_docs
