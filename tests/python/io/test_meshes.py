# SPDX-License-Identifier: BSD-3-Clause
"""Meshes to files and back, in every format that is written."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bathyal
from tests.support.mesh_cases import CUBE_VERTICES, cube, volume


@pytest.mark.parametrize("suffix", [".ply", ".vtp", ".obj", ".stl"])
def test_coordinates_come_back_bit_for_bit_at_survey_coordinates(tmp_path, suffix):
    mesh = cube()
    mesh.write(tmp_path / f"cube{suffix}")
    assert [path.name for path in tmp_path.iterdir()] == [f"cube{suffix}"]
    back = bathyal.read_mesh(tmp_path / f"cube{suffix}")
    corners = back.vertices[back.triangles]
    assert np.array_equal(corners, mesh.vertices[mesh.triangles])
    assert len(back.vertices) == 8
    assert volume(back) == pytest.approx(1.0)


@pytest.mark.parametrize("suffix", [".ply", ".vtp"])
def test_what_rides_along_comes_back(tmp_path, suffix):
    attributes = {
        "uncertainty": np.linspace(0.27, 0.66, 8),
        "red": np.arange(8.0) * 30,
        "green": np.zeros(8),
        "blue": np.full(8, 255.0),
        "a b%": np.array([np.nan, np.inf, *range(6)]),
    }
    datum = {"crs": 'PROJCS["UTM 2N",\n AUTHORITY["EPSG","32602"]]', "vertical_datum": "MSL"}
    mesh = cube(attributes=attributes, **datum)
    bathyal.write_mesh(mesh, tmp_path / f"cube{suffix}")
    back = bathyal.read_mesh(tmp_path / f"cube{suffix}")
    assert set(back.attributes) == set(attributes)
    for name, values in attributes.items():
        assert np.array_equal(back.attributes[name], values, equal_nan=True), name
    assert back.crs.split() == datum["crs"].split()
    assert back.vertical_datum == "MSL"
    assert np.array_equal(back.triangles, mesh.triangles)


def test_obj_keeps_colours_and_the_reference_system(tmp_path):
    colours = {name: np.arange(8.0) * k for k, name in enumerate(("red", "green", "blue"), 1)}
    bathyal.write_mesh(cube(attributes=colours, crs="EPSG:32602"), tmp_path / "a.obj")
    back = bathyal.read_mesh(tmp_path / "a.obj")
    assert back.crs == "EPSG:32602"
    for name, values in colours.items():
        assert np.array_equal(back.attributes[name], values)


def test_stl_is_binary_where_that_loses_nothing_that_matters(tmp_path):
    small = bathyal.TriangleMesh(CUBE_VERTICES, cube().triangles)
    bathyal.write_mesh(small, tmp_path / "small.stl")
    bathyal.write_mesh(cube(), tmp_path / "far.stl")
    assert len((tmp_path / "small.stl").read_bytes()) == 84 + 12 * 50
    assert (tmp_path / "far.stl").read_bytes().startswith(b"solid")
    assert volume(bathyal.read_mesh(tmp_path / "small.stl")) == pytest.approx(1.0)


@given(
    points=st.lists(
        st.tuples(*[st.floats(-1e7, 1e7, allow_subnormal=False)] * 3), min_size=3, max_size=12
    ),
    suffix=st.sampled_from([".ply", ".vtp", ".obj", ".stl"]),
    seed=st.integers(0, 2**32 - 1),
)
@settings(max_examples=80, deadline=None)
def test_any_mesh_comes_back_corner_for_corner(tmp_path_factory, points, suffix, seed):
    path = tmp_path_factory.getbasetemp() / f"any{suffix}"
    vertices = np.array(points)
    triangles = np.random.default_rng(seed).integers(0, len(points), (7, 3))
    bathyal.write_mesh(bathyal.TriangleMesh(vertices, triangles), path)
    back = bathyal.read_mesh(path)
    loss = 1e-5 if suffix == ".stl" else 0.0
    assert np.allclose(back.vertices[back.triangles], vertices[triangles], rtol=0, atol=loss)


def test_the_same_mesh_gives_the_same_bytes(tmp_path):
    for suffix in (".ply", ".vtp", ".obj", ".stl"):
        paths = [tmp_path / f"{i}{suffix}" for i in range(2)]
        for path in paths:
            bathyal.write_mesh(cube(crs="EPSG:32602"), path)
        assert paths[0].read_bytes() == paths[1].read_bytes()
