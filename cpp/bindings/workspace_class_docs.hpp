// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Docstrings of Workspace and what it answers.

namespace bathyal::python::workspace_docs {

inline constexpr const char* kCapsule = R"(All points within a radius of a segment, its axis.

Parameters
----------
start, end : (3,) arrays
    Ends of the axis [m]; a ball where they are one point.
radius : float
    [m], 0 or more.

Raises
------
ValueError
    For an end that is not finite, a radius that is negative or not finite.
)";

inline constexpr const char* kWorkspace = R"(An arm on a vehicle among what it must not touch.

Maevskiy, Zanin (2020). The arm hangs at `mount`; its own ``arm.base`` plays no part, its tip is
``arm.tool``. Targets and goals are in the world, keep-outs in the frame that they name, results in
the vehicle's frame. Its foot, link 0, is bolted to the vehicle and is compared with nothing.
Immutable: `attach`, `detach` and `with_vehicle_pose` give another one. Any number of threads may
query it.

Parameters
----------
arm : Arm
mount : (4, 4) array, optional
    vehicle_from_base; the identity unless given.
hull : Hull, optional
    In the vehicle's frame.
scene : Scene, optional
    In the world: the bottom and what lies on it. Below a surface that faces up is inside.
keepouts : list of KeepOut
    Each in the frame that it names; obstacles that move are keep-outs that were `moved`.
vehicle_pose : (4, 4) array, Trajectory or callable, optional
    world_from_vehicle; the identity unless given. A function of the time [s] is called every 0.05 s
    from 0 to 600 s and interpolated; for other times give a Trajectory.
vehicle_pose_std : (6,) array, optional
    Standard deviations of the vehicle's pose: of the origin along the vehicle's axes [m], then of
    the rotation about them [rad]. Distances to what is fixed to the world are less by three
    standard deviations of where that takes a point, whatever the direction (first order). Of
    `check_target`, whose points are in the world, those to what is fixed to the vehicle.
vehicle_body : RigidBody, optional
    Of the vehicle without the arm, in the vehicle's frame: for `static_trim`.
radii : float or (L,) array, optional
    Thickness of the arm, one or one each of L links: capsules along the segments from joint to
    joint [m]. Unless it or `capsules` is given, capsules are fitted to the links' shapes: those for
    collisions, else those for the eye.
capsules : dict, optional
    By the name of a link a list of Capsules in the link's frame; links not named have none.
allowed : list of (str, str)
    Pairs of links that may touch, by name.

Raises
------
ValueError
    For poses that are not rigid, a keep-out whose frame is neither "hull", "world" nor a link's
    name, links that are not there.

Warns
-----
UserWarning
    Where the arm has no shapes, and is bare segments, or a mesh of it cannot be read; and for what
    `warnings` lists.

Examples
--------
>>> import bathyal
>>> arm = bathyal.Arm.from_dh(a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0])
>>> ball = bathyal.KeepOut.sphere(0.2, (0.9, 0.6, 0), name="ball")
>>> ws = bathyal.Workspace(arm, keepouts=[ball], radii=0.05)
>>> near = ws.clearance([0.0, 0.0])
>>> round(near.distance, 6), near.link, near.against
(0.35, 'link_2', 'ball')
>>> ws.check_target([[0.6, 0.3, 0.0], [2.0, 0.0, 0.0]]).status.tolist()
['free', 'unreachable']
)";

inline constexpr const char* kClearance = R"(How near postures come to what must not be touched.

Parameters
----------
q : (N, n) or (n,) array
    [rad] or [m]; may lie beyond the limits.
time : float or (N,) array
    [s]; matters where the vehicle or a keep-out moves.
tip_contact : bool
    Whether the end of the tool may touch the scene: what lies within two radii (at least 1 mm) and
    `tip_depth` of the tip is then not compared with it.
num_threads : int
    0 means all.

Returns
-------
Clearances
    Of a single posture without the first dimension.
)";

inline constexpr const char* kClearances =
    R"(How near each posture comes to what must not be touched.

Links that are compared with nothing are listed in ``Workspace.excluded``. Of a single posture the
arrays have no first dimension.
)";

inline constexpr const char* kCheckMotion = R"(Whether a motion is free of contact everywhere.

Rows are joined by straight lines in joint space, and the check is continuous between them: an
interval is free when in its middle every distance is larger than what the motion to its ends can
take any point by; else it is halved. No thin plate is stepped over. A body that stays nearer than
0.01 mm may count as contact.

Parameters
----------
q_path : (M, n) array
    [rad] or [m]; one row is a posture that is held.
time : (M,) array, optional
    Of each row, rising [s]; needed where the vehicle or a keep-out moves, and for `stopping`.
stopping : bool
    Whether the arm must be able to stop, too: at every moment it may run on along the line between
    two rows by its stopping distance, speed² / (2 acceleration) of the coordinate that stops last.
    The contact is then the last moment at which an order to stop comes in time.
acceleration : float or (n,) array, optional
    With which each coordinate brakes [rad/s²] or [m/s²]; unless given its rate limit is reached from
    rest in half a second (1 rad/s², 0.5 m/s² of a joint without one).
tip_contact : bool
    As of `clearance`.

Returns
-------
MotionCheck

Raises
------
ValueError
    For no row, values that are not finite, times that do not rise, or none where they are needed.

Examples
--------
>>> import bathyal
>>> arm = bathyal.Arm.from_dh(a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0])
>>> pole = bathyal.KeepOut.sphere(0.01, (0.0, 0.9, 0.0), name="pole")
>>> ws = bathyal.Workspace(arm, keepouts=[pole], radii=0.02)
>>> swing = ws.check_motion([[0.0, 0.0], [3.0, 0.0]])
>>> swing.free, round(swing.contact, 2), swing.link, swing.against
(False, 0.51, 'link_2', 'pole')
)";

inline constexpr const char* kMotionCheck =
    "The first contact of a motion; falsy where there is one.";

inline constexpr const char* kCheckTarget = R"(Whether the arm may be sent to points.

The indicator of Maevskiy, Zanin (2020). Postures are looked for by inverse kinematics of the tip's
position, in any orientation, from 25 starts; the end of their tool may touch the scene. A redundant
arm may have a free posture that was not among them.

Parameters
----------
points : (N, 3) array
    In the world [m].
time : float
    [s]; matters where the vehicle or a keep-out moves.
seed : int
    Of the starts.
num_threads : int
    0 means all.

Returns
-------
TargetChecks

Raises
------
ValueError
    For a point that is not finite.
)";

inline constexpr const char* kTargetChecks =
    R"(Whether the arm may be sent to each point, and why not.
)";

inline constexpr const char* kAttach =
    R"(The same workspace with a tool or a sample in the arm's hand.

Parameters
----------
capsules : list of Capsule
    Its outline, in the tool's frame (origin in the tool centre point). Not compared with the last
    link.
body : RigidBody, optional
    What it weighs and displaces, in the tool's frame.

Returns
-------
Workspace
    Another one; this one stays as it is.
)";

inline constexpr const char* kWithTipDepth =
    R"(The same workspace, the tool allowed deeper into the scene.

Parameters
----------
tip_depth : float
    How deep the end of the tool may be in the scene with ``tip_contact=True`` [m], 0 or more: of a
    plan of `plan_sampling` its `depth`.

Returns
-------
Workspace
    Another one; this one stays as it is.

Raises
------
ValueError
    For a depth that is negative or not finite.
)";

inline constexpr const char* kPlaceCapsules = R"(The arm's capsules in postures.

Parameters
----------
q : (N, n) or (n,) array
    [rad] or [m].

Returns
-------
(N, C, 7) array
    Of each capsule start and end of the axis in the vehicle's frame and the radius [m]; `C` as in
    `capsule_links`. Of a single posture (C, 7).
)";

inline constexpr const char* kWithLinkRadii =
    R"(The same arm with thickness: a cylinder along each of its segments.

The segments lead from joint to joint, along d and a of each row of the table, and to the tool
centre point; those that a sliding joint draws out are left bare.

Parameters
----------
arm : Arm
radii : float or (L,) array
    One for all links, or one each, the foot first [m].
density : float, optional
    Mean density of the cylinders [kg/m³]: where given, links without mass and volume take those of
    their cylinders, and their inertia.

Returns
-------
Arm
    The cylinders are among the collision shapes of its links.

Raises
------
ValueError
    For another count, a radius that is negative or not finite, a density that is not positive.
)";

}  // namespace bathyal::python::workspace_docs
