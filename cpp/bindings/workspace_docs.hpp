// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Docstrings of the room workspace.

namespace bathyal::python::workspace_docs {

inline constexpr const char* kHullReport = R"(What is wrong with the mesh of a hull, as numbers.

Vertices of equal position count as one. ``print`` it to read it; `warnings` has a sentence for each
thing that is wrong.
)";

inline constexpr const char* kHull = R"(The body of a vehicle, which an arm must stay out of.

Any mesh that encloses a volume will do: inside out, self-intersecting, in several parts or with
holes; `report` says what is wrong with it. Inside is what ``bathyal.Scene(mesh).contains`` says
(generalised winding number), found sooner. Any number of threads may query it at once.

Parameters
----------
mesh : TriangleMesh
    In the vehicle's frame [m]: x forward, y port, z up.
num_threads : int
    For the build; 0 means all.

Raises
------
ValueError
    For a mesh that encloses nothing: without triangles, or flat.

Examples
--------
>>> import bathyal
>>> tetrahedron = bathyal.TriangleMesh([[0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3]],
...                                    [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
>>> hull = bathyal.Hull(tetrahedron)
>>> hull, hull.contains([[0.5, 0.5, 0.5], [5, 5, 5]]).tolist()
(Hull(4 triangles, closed), [True, False])
>>> hull.report.volume, hull.report.warnings
(4.5, [])
)";

inline constexpr const char* kHullContains = R"(Whether each point lies inside.

The answer of ``bathyal.Scene(mesh).contains``; a point on the surface is inside. Of 1000 points and
more each is first looked up in a grid of voxels, made at the first such call: where no triangle
passes through its voxel, the voxel's answer holds, elsewhere the triangles between the point and a
point of known winding number are counted.

Parameters
----------
points : (N, 3) array
    In the vehicle's frame [m], finite.
num_threads : int
    0 means all.

Returns
-------
(N,) array of bool
)";

inline constexpr const char* kHullSignedDistance = R"(Distance to the surface, below 0 inside.

Parameters
----------
points : (N, 3) array
    In the vehicle's frame [m], finite.
num_threads : int
    0 means all.

Returns
-------
(N,) array
    [m]
)";

inline constexpr const char* kHullVoxels = R"(The hull's bounding box filled with voxels.

The array of inside voxels of Maevskiy, Zanin (2020), Modular control systems for manipulators and
intervention-class AUVs; a voxel is inside where its middle is.

Parameters
----------
size : float
    Edge of a voxel [m]; no more than 2²⁸ voxels.
num_threads : int
    0 means all.

Returns
-------
Voxels
    ``.origin`` (3,), ``.size``, ``.inside`` (nx, ny, nz) bool. The box is centred on the hull's.

Examples
--------
>>> import bathyal
>>> tetrahedron = bathyal.TriangleMesh([[0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3]],
...                                    [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
>>> voxels = bathyal.Hull(tetrahedron).voxels(0.5)
>>> voxels.inside.shape, int(voxels.inside.sum()), bool(voxels.inside[0, 0, 0])
((6, 6, 6), 35, True)
)";

inline constexpr const char* kKeepOut = R"(A volume that an arm must stay out of.

Made by `sphere`, `box`, `cylinder`, `cone`, `half_space` or `mesh`. Lengths in metres, angles in
radians; points and distances are in the frame that it names, distances below 0 inside. All but
`mesh` are convex, with exact distances, inside too.

Examples
--------
>>> import bathyal
>>> modem = bathyal.KeepOut.sphere(0.5, (0, 0, 1), frame="hull", name="modem")
>>> modem
KeepOut.sphere(frame="hull", name="modem")
>>> modem.distance([[0, 0, 1], [0, 0, 3]]).tolist()
[-0.5, 1.5]
)";

inline constexpr const char* kKeepOutFrameDoc =
    "What it is fixed to: \"hull\" (the vehicle's frame), \"world\", or the name of a link.";

inline constexpr const char* kSphere = R"(A sphere.

Parameters
----------
radius : float
    [m], above 0.
center : (3,) array
    In the frame it is fixed to [m].
frame : str
    What it is fixed to: "hull" (the vehicle's frame), "world", or the name of a link.
name : str, optional
    What reports call it; the kind unless given.

Examples
--------
>>> import bathyal
>>> bathyal.KeepOut.sphere(0.5, (0, 0, 1)).contains([[0, 0, 1.4], [0, 0, 1.6]]).tolist()
[True, False]
)";

inline constexpr const char* kBox = R"(A box.

Parameters
----------
size : (3,) array
    Full lengths along x, y and z of its own frame, whose origin is its middle [m], above 0.
pose : (4, 4) array, optional
    frame_from_box; identity unless given.
frame, name
    As `sphere`.

Examples
--------
>>> import bathyal
>>> bathyal.KeepOut.box((2, 1, 1)).distance([[0, 0, 0], [2, 0, 0]]).tolist()
[-0.5, 1.0]
)";

inline constexpr const char* kCylinder = R"(A cylinder along z of its own frame.

Parameters
----------
radius, length : float
    [m], above 0; the middle is the origin of its own frame.
pose : (4, 4) array, optional
    frame_from_cylinder; identity unless given.
frame, name
    As `sphere`.

Examples
--------
>>> import bathyal
>>> bathyal.KeepOut.cylinder(0.5, 2).distance([[0, 0, 0], [0, 0, 3]]).tolist()
[-0.5, 2.0]
)";

inline constexpr const char* kCone = R"(A cone with a flat end: the beam of an optical modem.

Parameters
----------
length : float
    From the apex, the origin of its own frame, along +z to the flat end [m], above 0.
pose : (4, 4) array, optional
    frame_from_cone; identity unless given.
radius : float
    Of the flat end [m], above 0; or
angle : float
    Full opening angle at the apex [rad], above 0 and below π.
frame, name
    As `sphere`.

Examples
--------
>>> import bathyal
>>> beam = bathyal.KeepOut.cone(5.0, radius=5.0, frame="hull", name="modem beam")
>>> beam.contains([[1, 0, 2], [2, 0, 1]]).tolist()
[True, False]
)";

inline constexpr const char* kHalfSpace = R"(Everything behind a plane.

Parameters
----------
normal : (3,) array
    Towards the free side, any length but 0.
offset : float
    The plane is ``normal · x = offset``; or
point : (3,) array
    A point of the plane [m].
frame, name
    As `sphere`.

Examples
--------
>>> import bathyal
>>> below = bathyal.KeepOut.half_space((0, 0, 2), point=(0, 0, -1), frame="world")
>>> below.distance([[3, 4, 1], [0, 0, -2]]).tolist()
[2.0, -1.0]
)";

inline constexpr const char* kMesh = R"(What a mesh encloses.

Parameters
----------
mesh : TriangleMesh or Hull
    In the frame it is fixed to [m]; inside as `Hull` has it.
frame, name
    As `sphere`.

Raises
------
ValueError
    For a mesh that encloses nothing.

Examples
--------
>>> import bathyal
>>> tetrahedron = bathyal.TriangleMesh([[0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3]],
...                                    [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
>>> bathyal.KeepOut.mesh(tetrahedron, name="crate").contains([[1, 1, 0.5]]).tolist()
[True]
)";

inline constexpr const char* kKeepOutContains = R"(Whether each point lies inside or on the border.

Parameters
----------
points : (N, 3) array
    In the frame it is fixed to [m], finite.
num_threads : int
    0 means all.

Returns
-------
(N,) array of bool
)";

inline constexpr const char* kKeepOutDistance = R"(Signed distance of each point, below 0 inside.

Parameters
----------
points : (N, 3) array
    In the frame it is fixed to [m], finite.
num_threads : int
    0 means all.

Returns
-------
(N,) array
    [m]
)";

inline constexpr const char* kCapsuleDistance = R"(Signed distance of capsules.

The least signed distance along the axis, less the radius: a capsule that reaches into the volume
has a negative one; of a mesh, minus the radius and the depth of the deeper end. Within 1e-12 of the
sizes.

Parameters
----------
a, b : (N, 3) arrays
    Ends of the axes, in the frame it is fixed to [m].
radius : float or (N,) array
    [m], 0 or more.
num_threads : int
    0 means all.

Returns
-------
(N,) array
    [m]

Raises
------
ValueError
    For a value that is not finite, a radius below 0, rows that do not match.

Examples
--------
>>> import bathyal
>>> ball = bathyal.KeepOut.sphere(1.0)
>>> ball.capsule_distance([[-5, 0, 3]], [[5, 0, 3]], 0.5).tolist()
[1.5]
)";

inline constexpr const char* kMoved = R"(The same volume carried along: an obstacle that moves.

Parameters
----------
pose : (4, 4) array, Trajectory or callable
    frame_from_given: what was given in the frame is moved by it. A function of the time [s] is
    called every 0.05 s from 0 to 600 s. It takes the place of an earlier one.

Returns
-------
KeepOut
    Its own `contains` and `distance` are of the volume as it was given.
)";

}  // namespace bathyal::python::workspace_docs
