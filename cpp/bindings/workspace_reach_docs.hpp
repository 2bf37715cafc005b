// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Docstrings of ReachMap, Standpoint and what makes them.

namespace bathyal::python::workspace_docs {

inline constexpr const char* kReachMap = R"(Where the tip of an arm can be, in the vehicle's frame.

A box of cubes around all of the reach: what `Workspace.reach_map` returns and
`bathyal.read_reach_map` reads. Voxel (i, j, k) begins at ``origin + voxel * (i, j, k)``; answers
are those of its middle.

Parameters
----------
origin : (3,) array
    Corner of the first voxel, in the vehicle's frame [m].
voxel : float
    Edge of a voxel [m].
approach : (K, 3) array
    Unit vectors along which the tool's z axis points.
reached_along : (nx, ny, nz, K) array of bool
reached, free : (nx, ny, nz) array of bool
manipulability, clearance : (nx, ny, nz) array

Raises
------
ValueError
    For arrays whose shapes do not match, vectors that are not of unit length, a voxel that is not
    positive, or a voxel that is free or reached along a direction and not reached.
)";

inline constexpr const char* kWorkspaceReachMap = R"(Map the reach of the arm on its vehicle.

By forward sampling (Zacharias, Borst, Hirzinger 2007): postures of low discrepancy are swept
through the range of the first joint; one whose tip lies in a voxel proves that the voxel's middle
is reached where the first-order step to it stays within the limits and is short. The border is
settled by inverse kinematics from neighbours' postures. Whether anything collides is looked at
afterwards, at time 0 where something moves.

Parameters
----------
voxel : float
    Edge of a voxel [m].
directions : int
    Of approach: 6 (the faces of a cube), 26 (with its edges and corners) or 98.
samples : int
    Postures drawn, at most 2²¹; 0: one for four voxels, 2¹⁶ at least.
seed : int
    Of the postures.
check_clearance : bool
    Whether to make `ReachMap.free` and `ReachMap.clearance`.
num_threads : int
    0 means all; the same bytes for any number.

Returns
-------
ReachMap

Raises
------
ValueError
    For options out of range, or more than 2²⁸ pairs of a voxel and a direction.

Examples
--------
>>> import bathyal
>>> arm = bathyal.Arm.from_dh(a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0])
>>> reach = bathyal.Workspace(arm, radii=0.05).reach_map(voxel=0.08, directions=6)
>>> reach.reached.shape, int(reach.reached.sum())
((27, 27, 3), 396)
)";

inline constexpr const char* kStandpoint =
    R"(Where a vehicle should be, and what its arm reaches from there.

What `bathyal.best_standpoint` returns.
)";

inline constexpr const char* kBestStandpoint =
    R"(Find where a vehicle should be, level, for its arm to reach most of `targets`.

Places on a lattice and headings are scored by the reach map of arm, hull and what is fixed to them;
the best that leave the hull room are moved uphill, and those are scored by
`Workspace.check_target`, which decides. The score is the number of targets reached and their mean
margin, in (0, 1): depth / (depth + 0.1 m), where the depth is the distance from the target to the
border of the free part of the reach map: how far the vehicle may be off.

The hull has room where it keeps `hull_clearance` from the bottom's triangles and lies above them,
seen from above (where the scene has no bottom: above its highest point), and keeps out of volumes
fixed to the world. Without a hull that goes for the vehicle's origin.

Parameters
----------
arm : Arm
mount : (4, 4) array or None
    vehicle_from_base.
hull : Hull or None
    In the vehicle's frame.
scene : Scene or None
    In the world: the bottom and what lies on it.
targets : (N, 3) array
    In the world [m].
keepouts : list of KeepOut
    Each in the frame that it names; those that move, at time 0.
radii, capsules, allowed
    As of `Workspace`.
voxel : float
    Of the reach map [m].
headings : int
    Looked at first, evenly over a turn, 1 to 360.
step : float
    Between the places looked at first [m].
hull_clearance : float
    [m], 0 or more.
refined : int
    Places that are refined and checked.
alternatives : int
    At most, 0 or more.
seed : int
    Of the reach map and the checks of targets.
num_threads : int
    0 means all; the same bytes for any number.

Returns
-------
Standpoint

Raises
------
ValueError
    For no target, one that is not finite, options out of range, and as `Workspace`.

Warns
-----
UserWarning
    As `Workspace`.

Examples
--------
>>> import bathyal, numpy as np
>>> arm = bathyal.arms.maevskiy_zanin()
>>> mount = np.eye(4)
>>> mount[:3, 3] = 0.5, 0.0, -0.2
>>> square = np.array([[-3, -3, 0], [3, -3, 0], [3, 3, 0], [-3, 3, 0]], dtype=float)
>>> bottom = bathyal.TriangleMesh(square, [[0, 1, 2], [0, 2, 3]])
>>> targets = [[0.0, 0.0, 0.02], [0.3, 0.1, 0.02]]
>>> found = bathyal.best_standpoint(
...     arm, mount, None, bathyal.Scene(bottom), targets, radii=0.03, voxel=0.1, headings=8, step=0.2
... )
>>> found.status, found.reached.tolist()
('all', [True, True])
)";

}  // namespace bathyal::python::workspace_docs
