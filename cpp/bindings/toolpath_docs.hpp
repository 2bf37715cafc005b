// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Docstrings of the tool path's functions.

namespace bathyal::python {

inline constexpr const char* kFindTargetsDoc = R"(Where camera axes meet the bottom.

On a plane by eq 2–3 with t ≥ 0, on meshes the nearest hit at t ≥ 0 (eq 4–9). Normals point out of
the bottom: on a mesh to the side its triangles are wound for, on a plane to the side of up.

Parameters
----------
surface : Scene or Plane
aims : (K, 6) array
    px py pz, a point of each axis [m], and dx dy dz, its direction of any length but zero.
world_from_vehicle : (4, 4) array, optional
    Pose of the vehicle, identity unless given.
frame : {"vehicle", "world"}
    Frame of the aims: the vehicle's (`world_from_vehicle` moves them) or the world's.
vertical : {"gravity", "vehicle"}
    The world's z or the vehicle's; for a plane it decides which side is out of the bottom.
grazing_angle : float
    Incidence above which a hit is "grazing" [rad].
max_range : float
    Hits beyond it are misses [m].
num_threads : int
    0 = all.

Returns
-------
Targets

Raises
------
ValueError
    For aims that are not finite or have no direction.

Notes
-----
Status: "hit"; "grazing", a hit with its point beyond `grazing_angle`; "parallel", the axis runs
along the plane; "behind", the bottom is met at t < 0 only; "hole", the axis passes between the open
ends of the bottom on its two sides; "miss", anything else.

References
----------
Filaretov, Konoplin, Konoplin (2018), eq 1–9.

Examples
--------
>>> import bathyal
>>> targets = bathyal.find_targets(bathyal.Plane((0, 0, 1), -5.0), [[0, 0, 0, 3, 0, -4]])
>>> targets.point[0].tolist(), float(targets.range[0]), str(targets.status[0])
([3.75, 0.0, -5.0], 6.25, 'hit')
)";

inline constexpr const char* kPlanToolpathDoc = R"(Plan the path of a tool along the bottom.

Through the targets the camera axes point at, in their order: the upright section between each pair
and the next, oriented and timed.

Parameters
----------
surface, aims, world_from_vehicle, frame, vertical, grazing_angle, max_range, num_threads
    As in find_targets; `vertical` also decides how the bottom is cut.
missed : {"leave_out", "refuse"}
    Aims without a target: left out with a warning, the stretch over them a gap; or an error.
orientation : {"blended", "piecewise_constant"}
    Turns spread over `blend_length`, or the paper's form: constant on a facet, T_j twice on an
    edge, once per facet, the tool turning in place.
blend_length : float
    Path over which one turn is spread [m].
angular_rate : float
    Limit of the tool's whole frame [rad/s]; the feed slows where it must.
speed, acceleration : float
    Limits of the tool's point along its path [m/s], [m/s²]; it starts and ends at rest.
standoff : float
    Of the tool's point from the bottom [m].
offset : {"rolling", "plain"}
    How the standoff is kept. Rolling: the point is the centre of a ball of that radius that rolls
    over the bottom. Plain: each T_j moved along its own a_j. Without standoff, and on a plane, both
    are the same.
step : float
    Longest stretch between samples on the bottom [m]; 0 keeps the T_j as cut. T_j always stay.
normal_radius : float
    Radius of the footprint normals are taken over [m]; 0 takes facet normals.
tool_radius, tool_length : float
    The tool's body, a capsule from its point back along a_j [m]; length 0 checks no body.
contact_tolerance : float
    How far ground may reach into the body without a contact flag [m].

Returns
-------
ToolPath

Raises
------
ValueError
    For no aims, aims that are not finite, or no target at all.

Notes
-----
A gap is crossed straight between two samples, the first flagged, the tool at rest at both. Targets
that coincide give no length. A target above the next one is joined down the wall between them. One
target gives one sample. Read `warnings`.

Rolling, no sample is nearer to any mesh of the scene than `standoff`, and of the straight stretch
between two samples d apart nothing is nearer than √(standoff² − d²/4). The ball's centre keeps to
the upright plane of each section, moved sideways by the standoff times the section's mean sine of
the slope across it; `surface` is what the ball touches, up to the standoff off the section, and a_j
points from there to the centre. A hollow too narrow for the ball it touches on both sides and
passes over: there a_j jumps, which is blended (over two standoffs at most) or turned in place, as
between facets. A target it cannot touch is passed straight above. With `normal_radius` > 0 a_j is
the normal of the footprint round what is touched. A section the ball cannot roll over keeps the
plain offset, raised off the bottom, with a warning. `tool_radius` plays no part: a body wider than
the standoff may meet ground, which `contact` flags. Plain, the path over ground more concave than
the standoff turns back, crosses itself and comes nearer; `crossing` flags it.

References
----------
Filaretov, Konoplin, Konoplin (2018), section 2.

Examples
--------
>>> import bathyal
>>> bottom = bathyal.Plane((0, 0, 1), -5.0)
>>> aims = [[0, 0, 0, 0, 0, -1], [2, 0, 0, 0, 0, -1]]
>>> path = bathyal.plan_toolpath(bottom, aims, speed=0.1, acceleration=0.1)
>>> path.position.tolist()
[[0.0, 0.0, -5.0], [2.0, 0.0, -5.0]]
>>> path.approach[0].tolist(), path.travel[0].tolist()
([0.0, 0.0, 1.0], [1.0, 0.0, 0.0])
>>> round(float(path.time[-1]), 3)
21.0
)";

inline constexpr const char* kCoverPolygonDoc = R"(Aims that mow a polygon in parallel lines.

Two axes straight down for every straight stretch, at its beginning and its end; plan_toolpath joins
them along the bottom. A concave polygon is mown cell by cell; the way to the next cell may leave it.

Parameters
----------
surface : Scene or Plane
polygon : (N, 2) array
    Corners (x, y) in the world [m], in either sense.
spacing : float
    Widest distance between neighbouring lines [m]; the outermost lie half of it inside.
direction : float
    Of the lines, from the world's x towards y [rad].
margin : float
    Kept from every edge [m].

Returns
-------
(K, 6) array
    Aims in the world frame: hand them on with ``frame="world"`` where `world_from_vehicle` is given.

Raises
------
ValueError
    For fewer than three corners, no area, or edges that meet each other.

Examples
--------
>>> import bathyal
>>> square = [[0, 0], [4, 0], [4, 2], [0, 2]]
>>> aims = bathyal.cover_polygon(bathyal.Plane((0, 0, 1), -5.0), square, spacing=1.0)
>>> aims[:, :3].tolist()
[[0.0, 0.5, -4.0], [4.0, 0.5, -4.0], [4.0, 1.5, -4.0], [0.0, 1.5, -4.0]]
)";

}  // namespace bathyal::python
