// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Docstrings of Workspace.move and Workspace.follow.

namespace bathyal::python::workspace_docs {

inline constexpr const char* kTipMove = R"(The tip moved towards a target, as far as it came.
)";

inline constexpr const char* kMove = R"(Moves the tip straight towards a target in the world.

By default damped least squares within joint limits and rates, by strict priorities: joint limits
and rates; clearance (velocity dampers: Faverjon, Tournassoud 1987); position of the tip; its axis
or orientation; away from limits and from what is near in what the others leave free. It slides
along what is in its way and halts where no step brings the tip nearer; a way round is for `plan`.
"pseudo_inverse" is the stepping of Maevskiy, Zanin (2020): Δq = J⁺ ΔX, ΔX the way to the target
over `steps`; a forbidden intermediate posture, or one beyond a limit, ends it.

Parameters
----------
q_start : (n,) array
    Where it begins [rad] or [m].
point : (3,) array, optional
    Where the tip is to be, in the world [m]; this or `pose`.
pose : (4, 4) array, optional
    world_from_tool; this or `point`.
method : {"damped", "pseudo_inverse"}
task : {"pose", "position_axis", "position"}, optional
    What of the pose must be met; "position_axis" leaves the turn about `axis` free. Unless given
    "pose"; of a point "position".
axis : (3,) array
    In the tool's frame; of "position_axis".
position_tolerance : float, optional
    [m]; unless given 1e-4, and 1e-2 of "pseudo_inverse" as in the paper.
angle_tolerance : float, optional
    [rad]; unless given 1e-3, and 1e-2 of "pseudo_inverse".
steps : int
    k of "pseudo_inverse".
speed : float
    Of the tip at most [m/s].
angular_rate : float
    Of the tool at most [rad/s].
period : float
    Between the steps of "damped" [s]; slowed where limits ask for it.
clearance : float
    Kept by "damped" [m].
influence : float
    Below this distance approaching is slowed [m].
approach : float
    Greatest speed of approach at `influence`, falling to 0 at `clearance` [m/s].
max_steps : int
    Of "damped".
velocity : float or (n,) array, optional
    Rate limits [rad/s] or [m/s]; unless given the arm's, 1 rad/s or 0.25 m/s of a joint that has
    none.
acceleration : float or (n,) array, optional
    [rad/s²] or [m/s²]; unless given each rate limit is reached from rest in half a second.
tip_contact : bool
    As of `clearance`: whether the end of the tool may touch the scene.
time : float
    At which it begins [s]; the target is taken as it lies then.

Returns
-------
TipMove

Raises
------
ValueError
    For a target that is not finite or not rigid, both or none of `point` and `pose`, values of
    another count, options out of range.

Examples
--------
>>> import bathyal
>>> arm = bathyal.Arm.from_dh(a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0])
>>> ws = bathyal.Workspace(arm, radii=0.05)
>>> move = ws.move([0.5, 0.5], point=[0.3, 0.6, 0.0])
>>> move.status, bool(move.position_error <= 1e-4)
('reached', True)
)";

inline constexpr const char* kFollowedPath = R"(A tool path as joint motion.

Rows are joined by straight lines in joint space and free of contact between them, too.
)";

inline constexpr const char* kFollow = R"(Turns a tool path of `plan_toolpath` into joint motion.

Sample by sample, with rows between where samples are far apart, by the priorities of `move`. It
begins in that of several postures with which the longest stretch is followed. The path's times are
kept where the arm can, and stretched near singular postures and wherever rates or accelerations
would be passed. At a gap, and where a stretch ends, the tool is lifted along a_j, taken across and
brought down again; what no posture follows is cut out and listed. It begins and ends at rest on the
path: the way there and away is for `plan`.

Parameters
----------
path : ToolPath
    In the world.
q_start : (n,) array, optional
    Posture near which to begin [rad] or [m].
task : {"position_axis", "pose", "position"}
    The turn about the tool's z is free; its x runs along the path, too; or the position alone.
position_tolerance : float
    At every row [m].
angle_tolerance : float
    At every row [rad].
step : float
    Of the tool path between rows at most [m].
lift : float
    Height at which gaps are crossed, along a_j [m].
shortest : float
    A stretch between two cuts that is shorter is cut, too [m].
transit_speed : float
    Of the tip on the way across at most [m/s].
transit_rate : float
    Of the tool on the way across at most [rad/s].
clearance : float
    That is kept to what must not be touched [m].
influence : float
    What is nearer is kept away by redundancy, where there is any [m].
candidates : int
    Postures tried at the beginning of a stretch.
velocity : float or (n,) array, optional
    Rate limits [rad/s] or [m/s]; unless given the arm's, 1 rad/s or 0.25 m/s of a joint that has
    none.
acceleration : float or (n,) array, optional
    [rad/s²] or [m/s²]; unless given each rate limit is reached from rest in half a second.
tip_contact : bool, optional
    Whether the end of the tool may touch the scene; unless given, where the path has no standoff.
time : float
    At which it begins [s].
seed : int
    Of the postures.

Returns
-------
FollowedPath

Raises
------
ValueError
    For a workspace in which something moves, a path without samples, options out of range.
)";

}  // namespace bathyal::python::workspace_docs
