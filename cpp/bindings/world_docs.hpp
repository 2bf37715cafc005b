// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bathyal::python::world_docs {

inline constexpr const char* kWorld =
    R"(Seabed, things on it and in the water, what they are made of, and the water.

Frames: z up, [m]. Objects are rows of what rays see, in the order in which they were added.

Examples
--------
>>> import bathyal
>>> world = bathyal.World()
>>> corners = [[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]]
>>> bottom = bathyal.TriangleMesh(corners, [[0, 1, 2], [0, 2, 3]])
>>> world.add(bottom, material="sand", name="bottom")
0
>>> world.scene.cast([[0, 0, 5]], [[0, 0, -1]]).range
array([5.])
)";

inline constexpr const char* kAdd = R"(Adds an object.

Parameters
----------
mesh : TriangleMesh
    In its own frame; meshes given several times are held once.
pose : (4, 4) array, Trajectory or function, optional
    world_from_object; a function of the time in seconds is called whenever the world is looked at.
material : str
    One of `materials`.
name : str
    Not yet taken; "object_3" or the like unless given.
scale : float
    Of the mesh, above 0.

Returns
-------
int
    Its row in `scene`.

Raises
------
ValueError
    For a name that is taken, an unknown material, a pose that is not rigid.
)";

inline constexpr const char* kAt = R"(What there is at a time.

Only the tree over moving objects is made anew from moment to moment; meshes and their hierarchies
are shared.

Parameters
----------
time : float
    [s]
num_threads : int
    0 means all.

Returns
-------
WorldSnapshot
)";

}  // namespace bathyal::python::world_docs
