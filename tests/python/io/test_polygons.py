# SPDX-License-Identifier: BSD-3-Clause
"""Polygons cut into triangles."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bathyal.io.formats.meshes.cells import cells_of
from bathyal.io.formats.meshes.polygons import triangles_of_polygons
from tests.support.mesh_cases import UTM


def test_concave_polygons_are_cut_without_folding():
    arrow = np.array([[0, 0, 0], [2, 1, 0], [0, 2, 0], [1, 1, 0.0]])
    for start in range(4):
        polygon = np.roll(np.arange(4), start)
        triangles = triangles_of_polygons(cells_of([polygon]), arrow)
        a, b, c = np.moveaxis(arrow[triangles], 1, 0)
        areas = np.cross(b - a, c - a)[:, 2] / 2
        assert np.all(areas > 0)
        assert areas.sum() == pytest.approx(1.0)


@given(
    radii=st.lists(st.floats(0.2, 1.0), min_size=4, max_size=30),
    turn=st.floats(0, 6.28),
    down=st.booleans(),
)
@settings(max_examples=100, deadline=None)
def test_star_shaped_polygons_keep_their_area(radii, turn, down):
    angle = turn + np.linspace(0, 2 * np.pi, len(radii), endpoint=False)
    flat = np.array(radii)[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    points = UTM + flat @ np.array([[0.6, 0, 0.8], [0, 1, 0]])
    points = points[::-1].copy() if down else points
    x, y = flat.T
    known = 0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))
    triangles = triangles_of_polygons(cells_of([np.arange(len(points))]), points)
    a, b, c = np.moveaxis(points[triangles] - UTM, 1, 0)
    normals = np.cross(b - a, c - a) / 2
    assert np.linalg.norm(normals, axis=1).sum() == pytest.approx(known, abs=1e-7)
    assert len(triangles) == len(points) - 2
