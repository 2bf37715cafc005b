// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Docstrings of Workspace.plan and its result.

namespace bathyal::python::workspace_docs {

inline constexpr const char* kMotionPlan =
    "A motion from rest to rest that touches nothing, or why none was found; falsy without one.";

inline constexpr const char* kPlan = R"(A motion to a goal that touches nothing.

The straight motion in joint space where it is free; else two trees of straight motions that grow
from the start and from the goal towards each other (RRT-Connect, Kuffner, LaValle 2000), each
checked without gaps as `check_motion`; then shortcuts; then the corners are rounded and the motion
is timed within speed, acceleration and jerk limits. Limits and `check_motion` are verified again on
the rows handed out. Where the vehicle or a keep-out moves, the motion is free at its own times.

Give one of `goal`, `pose` and `point`. A pose and a point are reached by one of several postures,
in the vehicle's place at `time`.

Parameters
----------
q_start : (n,) array
    [rad] or [m].
goal : (n,) array, optional
    Joint values, taken as they are: no whole turns are left out.
pose : (4, 4) array, optional
    world_from_tool.
point : (3,) array, optional
    Of the tip in the world [m], in any orientation.
seed : int
    Of the search: the same seed gives the same bytes.
max_checks : int
    Postures and straight motions that are looked at, at most.
max_seconds : float
    A safety stop [s].
velocity, acceleration, jerk : float or (n,) array, optional
    Limits of each joint, [rad] or [m] with s, s² and s³. Unless given: the arm's speeds (1 rad/s,
    0.25 m/s where a joint has none), reached from rest in half a second (1 rad/s², 0.5 m/s²), and
    the acceleration within 0.1 s.
step : float
    Between two rows, at most [s].
tolerance : float
    How far any joint may leave the straight motions at their corners [rad], [m]; 0: a stop at each.
tip_contact : bool
    Whether the end of the tool may touch the scene.
time : float
    Of the start [s]; matters where something moves.

Returns
-------
MotionPlan

Raises
------
ValueError
    For a goal that is missing or given twice, of another length or not finite, a pose that is not
    rigid, limits that are not positive.

Examples
--------
>>> import bathyal
>>> arm = bathyal.Arm.from_dh(a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0])
>>> post = bathyal.KeepOut.sphere(0.1, (0.7, 0, 0), name="post")
>>> ws = bathyal.Workspace(arm, keepouts=[post], radii=0.03)
>>> plan = ws.plan([-0.6, 0], [0.6, 0])
>>> plan.status, plan.path.shape[1], bool(ws.check_motion(plan.path))
('solved', 2, True)
>>> ws.plan([-0.6, 0], [0, 0])
MotionPlan(goal_in_collision: At the goal link_2 touches post.)
)";

}  // namespace bathyal::python::workspace_docs
