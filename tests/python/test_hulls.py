# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of measured data: vehicles, munitions, a wreck, corals."""

from __future__ import annotations

import numpy as np
import pytest

import bathyal
from file_cases import measured
from mesh_cases import area, volume

HULLS = {
    "COLLISION-Slocum-Glider": (124, 0.453234),
    "Slocum-Glider-Propeller": (238, 8.1604e-5),
    "caldus_collision": (32, 7.48856),
    "caracara_collision": (20, 2.19599),
    "torpedo_mk48_collision": (284, 1.24303),
    "uxo_a_collision": (316, 0.0560857),
    "uxo_b_collision": (348, 0.163788),
    "uxo_c_collision": (220, 0.501132),
    "smilodon_collision": (12, 18.9497),
    "COLLISION-Wave_Glider-umbilical": (12, -0.0070979),
    "uxo_b": (3994, 0.1496),
}


HULL_TRIANGLES = {"caldus": 1418, "sunkenship_distort": 4171}


@pytest.mark.parametrize("name", HULLS)
def test_hulls_have_their_known_triangles_and_volume(name):
    mesh = bathyal.read_mesh(measured(f"hulls/{name}.dae"))
    triangles, known_volume = HULLS[name]
    assert len(mesh.triangles) == triangles
    assert volume(mesh) == pytest.approx(known_volume, rel=1e-4 if name == "uxo_b" else 2e-5)


@pytest.mark.parametrize("name", HULL_TRIANGLES)
def test_hulls_that_are_not_closed_have_their_known_triangles(name):
    assert len(bathyal.read_mesh(measured(f"hulls/{name}.dae")).triangles) == HULL_TRIANGLES[name]


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
