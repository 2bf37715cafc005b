// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bathyal::python {

inline constexpr const char* kSeabedModelDoc =
    R"(A generated bottom as a function of the place, on an endless plane.

Fractal relief, sand ripples with crests that meander and fork, boulders, a trench, a cliff, scour
around given points. No height depends on how a mesh of it is cut or where it begins. Angles are
counted from x towards y.

Parameters
----------
seed : int
depth : float
    The mean height is −depth [m].
slope, slope_direction : float
    Of the whole bottom, and in which direction it rises [rad].
relief_rms : float
    Of a relief whose power spectral density goes with k^−exponent [m], 0 for none.
relief_exponent : float
    Of the spectrum over the plane, 1 to 6; along a line it is one less.
relief_longest, relief_shortest : float
    Wavelengths between which the spectrum goes [m].
ripple_height, ripple_wavelength : float
    Trough to crest, 0 for none, and crest to crest [m].
ripple_direction : float
    Of the current, across the crests [rad].
ripple_asymmetry : float
    How much longer the stoss side is than the lee side, in wavelengths, 0 to 0.45.
ripple_meander : float
    Rms by which crests wander, in wavelengths, 0 to 2.
ripple_defects : float
    Crests that fork: pairs per 36 square wavelengths, 0 to 1.
ripple_cover, ripple_patch : float
    Share of the bottom that has ripples, and the size of patches of them [m].
boulder_density, boulder_radius : float
    Domes per m², 0 for none, and the radius of the largest [m]; the smallest have a fifth of it.
boulder_scour : float
    Depth of the hollow around each, over its height, 0 to 1.
trench_depth, trench_width, trench_floor : float
    Depth, 0 for none, width between the tops of the walls, and width of the floor [m].
trench_direction, trench_point : float, (2,) array
    Along it [rad], and a place on its middle line [m].
cliff_height, cliff_run : float
    Height, 0 for none, and the horizontal distance over which it falls [m].
cliff_direction, cliff_point : float, (2,) array
    In which it falls [rad], and a place at half its height [m].
edge_meander : float
    Rms by which trench and cliff wander off their lines [m].
scour_points : (K, 2) array
    Middles of hollows [m].
scour_depth, scour_radius : float
    Of each [m].
num_threads : int
    0: all.

Raises
------
ValueError
    For an option out of its range.

Examples
--------
>>> import bathyal
>>> model = bathyal.SeabedModel(seed=1, relief_rms=0, trench_depth=2.0)
>>> model.height([0.0, 0.0], [0.0, 10.0])
array([-2.,  0.])
>>> model.mesh(10, 0.5)
TriangleMesh(441 vertices, 800 triangles)
)";

inline constexpr const char* kSeabedMeshDoc =
    R"(A mesh of the bottom: squares, each of two triangles, counter-clockwise from above.

Parameters
----------
size : float or (2,) array
    Its sides along x and y [m].
spacing : float
    Side of a square [m]: the largest that divides the mesh's side and is no larger.
origin : (2,) array
    Its middle [m]. Tiles whose corners are whole numbers of half squares from zero have the same
    bytes along their borders, and as the whole.

Returns
-------
TriangleMesh
    With an attribute ``material`` of the vertices, as `material` gives it.

Raises
------
ValueError
    For a size or spacing that is not above 0, more than 5·10⁷ squares, or ripples shorter than two
    spacings.
)";

inline constexpr const char* kMakeSeabedDoc = R"(A mesh of a generated bottom.

As ``SeabedModel(seed=seed, …).mesh(size, spacing, origin=origin)``: see there for the options.

Parameters
----------
size : float or (2,) array
    Its sides along x and y [m].
spacing : float
    Side of a square [m]: the largest that divides the mesh's side and is no larger.
origin : (2,) array
    Its middle [m]: a large bottom is made tile by tile.
seed : int
relief_rms, ripple_height, boulder_density, trench_depth, cliff_height, … : float
    As given to SeabedModel.

Returns
-------
TriangleMesh
    With an attribute ``material`` of the vertices: 0 silt, 1 sand, where ripples are, 2 rock.

Examples
--------
>>> import bathyal
>>> bathyal.make_seabed((40, 20), 0.25, seed=3, ripple_height=0.05)
TriangleMesh(13041 vertices, 25600 triangles)
)";

inline constexpr const char* kTriangleMaterialDoc =
    R"(Material of each triangle of a generated bottom.

Parameters
----------
mesh : TriangleMesh
    With an attribute ``material`` of the vertices, as make_seabed gives.

Returns
-------
(T,) array of int
    Rows of ``SeabedModel.materials``: the middle of the values of the three corners.

Examples
--------
>>> import bathyal
>>> mesh = bathyal.make_seabed(1, 0.5)
>>> bathyal.triangle_material(mesh)
array([0, 0, 0, 0, 0, 0, 0, 0], dtype=int16)
)";

}  // namespace bathyal::python
