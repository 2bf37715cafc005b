# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of measured data: vehicles, munitions, a wreck, corals."""

from __future__ import annotations

import numpy as np
import pytest

import bathyal
from tests.support.file_cases import measured
from tests.support.mesh_cases import area, volume

# What is stated with the files: triangles and signed volume [m³] of what is closed, each with its
# tolerance (the figures are given with five or six digits, one with four).
CLOSED = {
    "COLLISION-Slocum-Glider": (124, 0.453234, 2e-5),
    "Slocum-Glider-Propeller": (238, 8.1604e-5, 2e-5),
    "caldus_collision": (32, 7.48856, 2e-5),
    "caracara_collision": (20, 2.19599, 2e-5),
    "torpedo_mk48_collision": (284, 1.24303, 2e-5),
    "uxo_a_collision": (316, 0.0560857, 2e-5),
    "uxo_b_collision": (348, 0.163788, 2e-5),
    "uxo_c_collision": (220, 0.501132, 2e-5),
    "smilodon_collision": (12, 18.9497, 2e-5),
}
INSIDE_OUT = {"COLLISION-Wave_Glider-umbilical": (12, -0.0070979, 2e-5)}
SELF_INTERSECTING = {"uxo_b": (3994, 0.1496, 1e-4)}
OVERLAPPING_PARTS = {"COLLISION-Wave_Glider": 6, "glider_hybrid_whoi_collision": 3}
OPEN = ("Slocum-Glider", "glider_hybrid_whoi_body", "sunkenship_distort", "mbari_mars")
TRIANGLES = {"caldus": 1418, "sunkenship_distort": 4171}


def hull(name):
    return bathyal.read_mesh(measured(f"hulls/{name}.dae"))


def box_of(mesh):
    """40 000 points in the mesh's box, and how large that is [m³]."""
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    return np.random.default_rng(1).uniform(low, high, (40_000, 3)), np.prod(high - low)


@pytest.mark.parametrize("name", CLOSED | INSIDE_OUT | SELF_INTERSECTING)
def test_closed_hulls_have_their_known_triangles_and_volume(name):
    mesh = hull(name)
    triangles, known, tolerance = (CLOSED | INSIDE_OUT | SELF_INTERSECTING)[name]
    report = bathyal.mesh_report(mesh)
    assert report.triangle_count == len(mesh.triangles) == triangles
    assert report.volume == pytest.approx(known, rel=tolerance)
    assert volume(mesh) == pytest.approx(report.volume, rel=1e-9)
    assert report.closed
    assert (report.components, report.boundary_edges, report.nonmanifold_edges) == (1, 0, 0)
    assert report.inconsistent_edges == report.zero_area_triangles == 0


@pytest.mark.parametrize("name", CLOSED | INSIDE_OUT)
def test_what_lies_inside_a_hull_is_its_volume(name):
    """Also where its triangles face inward."""
    mesh = hull(name)
    points, box = box_of(mesh)
    share = bathyal.Scene(mesh).contains(points).mean()
    error = np.sqrt(share * (1 - share) / len(points))
    assert share * box == pytest.approx(abs(volume(mesh)), abs=4.5 * error * box + 1e-9)


def parts(mesh):
    """The mesh's pieces that share no vertex."""
    label = np.arange(len(mesh.vertices))
    for _ in range(len(label)):
        np.minimum.at(label, mesh.triangles, label[mesh.triangles].min(axis=1, keepdims=True))
    of_triangle = label[mesh.triangles[:, 0]]
    return [
        bathyal.TriangleMesh(mesh.vertices, mesh.triangles[of_triangle == part])
        for part in np.unique(of_triangle)
    ]


@pytest.mark.parametrize("name", OVERLAPPING_PARTS)
def test_parts_of_a_hull_that_overlap_add_up(name):
    """Two wound against each other cancel where both are (in the Wave Glider some face inward)."""
    mesh = hull(name)
    report = bathyal.mesh_report(mesh)
    assert report.closed
    pieces = parts(mesh)
    assert report.components == len(pieces) == OVERLAPPING_PARTS[name]
    points, _ = box_of(mesh)
    each = np.array([bathyal.Scene(piece).contains(points) for piece in pieces])
    turns = np.sign([volume(piece) for piece in pieces]) @ each
    assert (each.sum(axis=0) > 1).any()
    np.testing.assert_array_equal(bathyal.Scene(mesh).contains(points), turns != 0)


@pytest.mark.parametrize("name", OPEN)
def test_open_hulls_are_called_open(name):
    report = bathyal.mesh_report(hull(name))
    assert not report.closed
    assert np.isnan(report.volume)
    assert len(report.boundary_loops) > 0 < report.boundary_edges


@pytest.mark.parametrize("name", TRIANGLES)
def test_other_hulls_have_their_known_triangles(name):
    assert len(hull(name).triangles) == TRIANGLES[name]


def test_every_hull_is_read():
    paths = sorted(measured("hulls").glob("*.dae"))
    assert len(paths) == 19
    assert all(len(bathyal.read_mesh(path).triangles) >= 12 for path in paths)


def test_the_wreck_has_its_known_size():
    mesh = bathyal.read_mesh(measured("hulls/sunkenship_distort.dae"))
    assert np.ptp(mesh.vertices, axis=0) == pytest.approx([17.5, 12.6, 7.2], abs=0.05)


def test_scanned_corals():
    coral = bathyal.read_mesh(measured("seabed/coral-mcap/mcap_derived.ply"))
    assert (len(coral.vertices), len(coral.triangles)) == (5568, 10939)
    assert np.ptp(coral.vertices[:, 2]) == pytest.approx(0.2185397, abs=5e-8)
    assert area(coral) == pytest.approx(0.2698, abs=5e-5)
    colony = bathyal.read_mesh(measured("seabed/coral-colony/colony_plot.ply"))
    assert (len(colony.vertices), len(colony.triangles)) == (5773, 11117)
    assert set(colony.attributes) >= {"red", "green", "blue"}
    for colour in ("red", "green", "blue"):
        values = colony.attributes[colour]
        assert values.max() > 100
        assert np.all((values >= 0) & (values <= 255) & (values == np.floor(values)))
