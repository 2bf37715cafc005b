# SPDX-License-Identifier: BSD-3-Clause
"""Meshes from STL and OBJ, and the axis that points up."""

from __future__ import annotations

import re

import numpy as np
import pytest

import bathyal
from tests.support.mesh_cases import cube, write_text

FACET = """solid a vertex in a name
 FACET  normal 0 0 1
  outer loop
   vertex 0 0 0
   vertex 1e0 0 0
   vertex 0 1 0
  endloop
 endfacet
endsolid a
"""


def test_stl_ascii_of_several_solids(tmp_path):
    second = FACET.replace("0 1 0\n", "0 2 0\n")
    mesh = bathyal.read_mesh(write_text(tmp_path / "a.stl", FACET + second), scale=0.001)
    assert len(mesh.triangles) == 2
    assert len(mesh.vertices) == 4
    assert mesh.vertices.max() == 0.002


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("endsolid a", ""),
        ("endfacet", ""),
        ("   vertex 0 1 0\n", ""),
        ("0 1 0", "0 1"),
        ("0 1 0", "0 x 0"),
        ("0 1 0", "0 nan 0"),
        ("solid a", "slid a"),
    ],
)
def test_stl_faults_are_errors(tmp_path, old, new):
    path = write_text(tmp_path / "a.stl", FACET.replace(old, new, 1))
    with pytest.raises(bathyal.Error, match=re.escape(str(path))):
        bathyal.read_mesh(path)


def test_equal_corners_of_stl_become_one_vertex_and_zero_has_no_sign(tmp_path):
    text = FACET + FACET.replace("0 0 0", "-0 0 -0.0").replace("0 1 0\n", "0 -1 0\n")
    mesh = bathyal.read_mesh(write_text(tmp_path / "a.stl", text))
    assert mesh.vertices.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, -1, 0]]
    assert mesh.triangles.tolist() == [[0, 1, 2], [0, 1, 3]]


OBJ = """# a house
mtllib none.mtl
o house
v 0 0 0
v 1 0 0 # a comment
v 1 1 0
vn 0 0 1
f 1//1 2//1 \\
 3//1
v 0 1 0
v 0.5 1.5 0
usemtl roof
f -5/1 -3/2 -2/3
f 4 3 5
l 1 2
"""


def test_obj_with_slashes_continued_lines_and_counting_back(tmp_path):
    mesh = bathyal.read_mesh(write_text(tmp_path / "a.obj", OBJ))
    assert mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3], [3, 2, 4]]
    assert mesh.vertices[4].tolist() == [0.5, 1.5, 0]


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ("f 4 3 5", "f 4 3 6", "index 5 names no point"),
        ("f 4 3 5", "f 4 3 -6", "index -1 names no point"),
        ("f 4 3 5", "f 4 3 0", "is 0 or no whole number"),
        ("f 4 3 5", "f 4 3", "2 corners"),
        ("f 4 3 5", "f 4 3 x", "'x'"),
        ("v 0 1 0", "v 0 1", "all three numbers"),
        ("v 0 1 0", "v 0 1 nan", "finite"),
        ("l 1 2", "curv 0 1 1 2", "line 15: 'curv' is not read"),
        ("f ", "# ", "5 vertices and 0 faces"),
        ("v ", "# ", "0 vertices and 3 faces"),
    ],
)
def test_obj_faults_are_errors(tmp_path, old, new, reason):
    path = write_text(tmp_path / "a.obj", OBJ.replace(old, new))
    with pytest.raises(bathyal.Error, match=reason):
        bathyal.read_mesh(path)


@pytest.mark.parametrize(
    ("up", "expected"), [("z", [1, 2, 3]), ("y", [1, -3, 2]), ("x", [-2, -3, 1])]
)
def test_the_axis_that_points_up_becomes_z(tmp_path, up, expected):
    path = write_text(tmp_path / "a.obj", "v 1 2 3\nv 0 0 0\nv 1 0 0\nf 1 2 3\n")
    assert bathyal.read_mesh(path, up=up).vertices[0].tolist() == expected


def test_normals_turn_with_the_mesh(tmp_path):
    normals = dict(zip(("nx", "ny", "nz"), np.eye(8, 3).T.copy(), strict=True))
    bathyal.write_mesh(cube(attributes=normals), tmp_path / "a.ply")
    back = bathyal.read_mesh(tmp_path / "a.ply", up="y").attributes
    assert [back[name][1] for name in ("nx", "ny", "nz")] == [0, 0, 1]
