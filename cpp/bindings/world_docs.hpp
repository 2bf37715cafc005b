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

inline constexpr const char* kAddClones = R"(Scatters copies of a mesh over what is there at time 0.

Rows that share the mesh, named name_0, name_1 and so on.

Parameters
----------
mesh : TriangleMesh
count : int
material : str
name : str
seed : int
    Of places, sizes and turns; clone i is drawn from a stream of its own.
region : (4,) floats, optional
    Low x, low y, high x, high y [m]; all that is there unless given.
scale : (2,) floats
    Least and largest.
turned : bool
    By any angle about the vertical.
tilt : float
    At most, about a horizontal axis [rad].
sunk : float
    Part of its height that lies below the ground.
apart : float
    Least distance of two of them, seen from above [m].

Returns
-------
int
    The first of their rows.

Raises
------
ValueError
    Where there is no ground or no room left for one.
)";

inline constexpr const char* kPaint =
    R"(Gives those triangles of an object another material whose middle lies within a polygon.

Parameters
----------
name : str
    Of the object.
polygon : (K, 2) array
    Its corners seen from above [m], at time 0.
material : str

Returns
-------
int
    How many triangles.
)";

inline constexpr const char* kSetMaterial = R"(Adds a material, or replaces the one of that name.

Parameters
----------
name : str
strength : float
    μ of Lambert's law σ₀ = μ cos²θ, linear; the paper's K_d.
angle, backscatter : (K,) arrays, optional
    A measured law: σ₀ [dB] by the angle of incidence [rad], rising.
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
