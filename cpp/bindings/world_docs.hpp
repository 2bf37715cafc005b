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
name : str or Material
    A Material alone says it all.
strength : float
    μ of Lambert's law σ₀ = μ cos²θ, linear; the paper's K_d.
angle, backscatter : (K,) arrays, optional
    A measured law: σ₀ [dB] by the angle of incidence [rad], rising.
sediment : Sediment, optional
    For the models that compute σ₀ from it.

Raises
------
ValueError
    For an empty name, numbers out of their range, a Material and more.

Examples
--------
>>> import bathyal
>>> world = bathyal.World()
>>> world.set_material("shell", 0.02, sediment=world.material("gravel").sediment)
>>> world.material("shell")
Material("shell", -17 dB, sediment)
)";

inline constexpr const char* kMaterialOf = R"(A material by its name, or its row in `materials`.

Returns
-------
Material

Raises
------
ValueError
    For a name or a row of none.
)";

inline constexpr const char* kHitMaterial = R"(Of what each of N rays is made that it met.

Parameters
----------
hits : Hits
    Of ``scene.cast``.

Returns
-------
(N,) array of int
    Rows of `materials`, −1 where the ray met nothing.

Raises
------
ValueError
    For hits of another scene, where they name rows or triangles that there are not.

Examples
--------
>>> import bathyal
>>> world = bathyal.World()
>>> floor = bathyal.TriangleMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
>>> world.add(floor, material="mud")
0
>>> now = world.at(0)
>>> row = now.material(now.scene.cast((1, 1, 3), [[0, 0, -1], [0, 0, 1]]))
>>> row.tolist(), now.materials[row[0]].name
([6, -1], 'mud')
)";

inline constexpr const char* kSediment =
    R"(What the model of a rough, penetrable bottom takes (APL-UW TR 9407, 1994).

Ratios are to the water above it; see docs/sonar_model.md. Sand unless given.

Parameters
----------
density_ratio, speed_ratio : float
    Of density and sound speed.
loss : float
    Imaginary over real wave number.
volume : float
    Scattering in the volume over its absorption, σ₂.
spectral_exponent : float
    γ of the relief's spectrum, 2.4 to 3.9.
spectral_strength : float
    w₂ of the relief's spectrum [cm⁴], at 1 cm⁻¹.

Raises
------
ValueError
    For a number out of its range.
)";

inline constexpr const char* kMaterial = R"(How a surface scatters sound back.

By its table where it has one, else by its sediment, else by Lambert's law σ₀ = μ cos²θ; which of
them a sonar takes is its switch ``backscatter``.

Parameters
----------
name : str
strength : float
    μ, linear.
angle, backscatter : (K,) arrays, optional
    A measured law: σ₀ [dB] by the angle of incidence [rad], rising.
sediment : Sediment, optional

Raises
------
ValueError
    For an empty name, numbers out of their range.

Examples
--------
>>> import bathyal
>>> bathyal.World().material("sand")
Material("sand", -22 dB, sediment)
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
