// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Docstrings of Scene and its queries.

namespace bathyal::python {

inline constexpr const char* kSceneDoc =
    R"(One or more meshes, made ready for rays, nearest points and sections.

Answers are decided in double, the same bytes on every instruction set and for any number of
threads; equal ranges or distances give the lowest (mesh, triangle). The meshes are shared, not
copied. Any number of threads may query it at once.

A row of the list is an instance: ``.mesh`` in answers is that row, and a mesh that occurs several
times (the same object, or the same arrays) is held, and made ready, once. With poses each row is
where its pose puts it; everything that goes in or comes out is in the world, and ``meshes`` stay as
given. A ray is moved into the mesh's frame and decided there on its own vertices: at the identity
to the same bytes as without poses. Each instance is watertight in itself; across two that share an
edge that is not promised.

Parameters
----------
mesh : TriangleMesh, or a sequence of them
    One at least; meshes without triangles are allowed and never hit.
poses : (K, 4, 4) array, optional
    world_from_mesh of each, rigid; of a rotation that is off by less than 1e-6 the nearest one is
    taken. Without: all meshes are in the world as they are.
scales : (K,) array, optional
    Metres of the world for one of the mesh, from 1e-9 to 1e9: x in the world is
    scale · rotation · x + translation. Without: 1.
num_threads : int
    For the build; 0 means all.

Raises
------
ValueError
    For no mesh, or poses or scales of another number, not rigid or out of range: names the first.

Examples
--------
>>> import bathyal, numpy as np
>>> floor = bathyal.TriangleMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
>>> bathyal.Scene(floor)
Scene(1 mesh, 1 triangle)
>>> poses = np.array([np.eye(4), np.eye(4)])
>>> poses[1, 2, 3] = -10.0
>>> scene = bathyal.Scene([floor, floor], poses=poses, scales=[1, 4])
>>> hits = scene.cast((0, 0, 5), [[1, 1, -5], [12, 3, -15]])
>>> hits.mesh.tolist(), hits.point.tolist()
([0, 1], [[1.0, 1.0, 0.0], [12.0, 3.0, -10.0]])
)";

inline constexpr const char* kWithPosesDoc = R"(The same meshes at other poses, as another scene.

It shares the meshes, their scales and what was made ready of them; only the tree over the instances
is made anew, so that a moving fish does not rebuild the bottom. This scene stays as it is. From a
scene of several meshes that was made without poses, each call makes them ready one by one first.

Parameters
----------
poses : (K, 4, 4) array
    world_from_mesh of each row, as of the constructor.
num_threads : int
    0 means all.

Returns
-------
Scene

Examples
--------
>>> import bathyal, numpy as np
>>> floor = bathyal.TriangleMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
>>> scene = bathyal.Scene(floor, poses=[np.eye(4)])
>>> lower = np.eye(4)
>>> lower[2, 3] = -2
>>> [s.cast((1, 1, 3), (0, 0, -1)).range[0].item() for s in (scene, scene.with_poses([lower]))]
[3.0, 5.0]
)";

inline constexpr const char* kMeshInWorldDoc = R"(A row's mesh where its pose and scale put it.

Parameters
----------
mesh : int
    Row of the scene.

Returns
-------
TriangleMesh
    The mesh itself where it is at the identity, else a moved copy of its vertices with the same
    triangles and attributes, without its datum.

Examples
--------
>>> import bathyal
>>> floor = bathyal.TriangleMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
>>> bathyal.Scene(floor, scales=[2]).mesh_in_world(0).vertices.max().item()
8.0
)";

inline constexpr const char* kNearestDoc = R"(The closest point of all triangles to each point.

Decided in double; equal distances give the lowest (mesh, triangle). A triangle without area counts
as the segment or point that it is.

Parameters
----------
points : (N, 3) array
    [m], finite.
num_threads : int
    0 means all.

Returns
-------
Nearest
    ``.distance`` (N,) [m], ``.point`` (N, 3), ``.mesh`` (N,), ``.triangle`` (N,) and
    ``.barycentric`` (N, 3). A scene without triangles gives inf, NaN and −1.

Examples
--------
>>> import bathyal
>>> floor = bathyal.TriangleMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
>>> near = bathyal.Scene(floor).nearest([[1, 1, 3], [-3, 0, -4]])
>>> near.distance.tolist(), near.point.tolist()
([3.0, 5.0], [[1.0, 1.0, 0.0], [0.0, 0.0, 0.0]])
)";

inline constexpr const char* kNearestSegmentsDoc =
    R"(Where all triangles come closest to each straight segment.

Decided in double; equal distances give the lowest (mesh, triangle). Where a segment meets a
triangle, borders and ends included, its distance is exactly 0 and both points are one: decided with
exact signs, in the plane of a triangle too. A triangle without area counts as the segment or point
that it is; a segment without length is as by nearest. The distance of a capsule is that of its axis
less its radius.

Parameters
----------
start : (N, 3), (1, 3) or (3,) array
    [m], finite and no further out than 10²⁵ m. One start serves all ends.
end : (N, 3) or (3,) array
    [m], likewise.
within : float
    What is further away is not found [m]; a small distance saves time.
num_threads : int
    0 means all. The result is the same bytes for any number.

Returns
-------
NearestSegments
    ``.distance`` (N,) [m], ``.point`` (N, 3) of the scene, ``.mesh`` (N,), ``.triangle`` (N,),
    ``.barycentric`` (N, 3), ``.fraction`` (N,) along the segment and ``.segment_point`` (N, 3).
    Where nothing lies within reach: inf, NaN and −1.

Raises
------
ValueError
    For an end that is not finite or out of range: names the first row at fault.

Examples
--------
>>> import bathyal
>>> floor = bathyal.TriangleMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
>>> near = bathyal.Scene(floor).nearest_segments((1, 1, 3), [[1, 2, 2], [1, 1, -1]])
>>> near.distance.tolist(), near.fraction.tolist()
([2.0, 0.0], [1.0, 0.75])
)";

inline constexpr const char* kWindingNumberDoc = R"(How often the triangles wind around each point.

The solid angle of all triangles over 4π: 1 inside a closed mesh with outward normals, −1 inside one
turned inside out, 2 inside two of them, a fraction near the holes of an open one, the mean of the
two sides on a triangle. Jacobson, Kavan, Sorkine-Hornung (2013), Robust inside-outside segmentation
using generalized winding numbers; far triangles are taken together as in Barill, Dickson, Schmidt,
Levin, Jacobson (2018), Fast winding numbers for soups and clouds.

Parameters
----------
points : (N, 3) array
    [m], finite.
accuracy : float
    What a far cluster of triangles may be off by, as a part of its area / (4π distance²); above 0.
num_threads : int
    0 means all.

Returns
-------
(N,) array

Examples
--------
>>> import bathyal
>>> tetrahedron = bathyal.TriangleMesh([[0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3]],
...                                    [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
>>> bathyal.Scene(tetrahedron).winding_number([[0.5, 0.5, 0.5], [5, 5, 5]]).round(3) + 0.0
array([1., 0.])
)";

inline constexpr const char* kSceneContainsDoc = R"(Whether each point lies inside.

Inside is where the winding number is beyond ±1/2, so it holds for meshes that are inside out, open
or cut themselves: a hole counts as filmed over. A point on a triangle is contained. Bodies that
overlap add up; two that are wound against each other cancel where both are.

Parameters
----------
points : (N, 3) array
    [m], finite.
accuracy : float
    As in winding_number.
num_threads : int
    0 means all.

Returns
-------
(N,) array of bool

Examples
--------
>>> import bathyal
>>> tetrahedron = bathyal.TriangleMesh([[0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3]],
...                                    [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
>>> bathyal.Scene(tetrahedron).contains([[0.5, 0.5, 0.5], [5, 5, 5]]).tolist()
[True, False]
)";

inline constexpr const char* kSectionDoc = R"(The lines in which a plane cuts the scene.

``section(plane)`` cuts by a whole plane. ``section(a, b)`` cuts by the plane through two points and
the direction ``up`` and keeps what lies between them, measured along the horizontal, ends included
(Filaretov, Konoplin, Konoplin 2018: r = (b − a) × up).

Edges in the plane appear once, triangles in the plane give the outline of their region, a surface
that touches the plane at single points gives nothing there. Lines never join two meshes; they are
sorted by mesh and by where they start. Open lines run from a towards b (by a plane: from their end
with the lower x, then y, z), closed ones counter-clockwise seen from where the normal, or r, points
to. A line that starts or ends at a or b to rounding starts or ends at exactly that point.

Parameters
----------
plane : Plane
    Alone; or
a, b : (3,) array
    Two points [m], not above each other along `up`.
up : (3,) array, optional
    With two points: any length but zero; (0, 0, 1) unless given.

Returns
-------
list of Polyline
    ``.points`` (P, 3) [m], ``.mesh`` and ``.triangle`` (P − 1,), ``.closed``.

Raises
------
ValueError
    Where b lies above, below or at a along ``up``: there is no such plane.

Examples
--------
>>> import bathyal
>>> floor = bathyal.TriangleMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
>>> line, = bathyal.Scene(floor).section((0, 1, 9), (2, 1, 9))
>>> line.points.tolist()
[[0.0, 1.0, 0.0], [2.0, 1.0, 0.0]]
)";

}  // namespace bathyal::python
