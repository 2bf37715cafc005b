# SPDX-License-Identifier: BSD-3-Clause
"""Meshes, rays and planes that are wrong or odd, each case in a process of its own."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import bathyal
from tests.support.alone import Case, check, refused, works
from tests.support.bad_input import ANY, FAR, GRID, same, scene

FLAT = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])


def degenerate() -> None:
    mesh = bathyal.TriangleMesh(FLAT, [[0, 0, 1], [1, 1, 1], [0, 1, 2], [0, 1, 2]])
    hits = bathyal.Scene(mesh).cast([[0.2, 0.2, 1.0]], [[0.0, 0, -1]])
    same(hits.range, [1.0])
    assert hits.triangle.tolist() == [2]


def never_hit() -> None:
    empty = bathyal.Scene(bathyal.TriangleMesh(FLAT, np.zeros((0, 3), dtype=int)))
    hits = empty.cast(np.zeros((3, 3)), np.eye(3))
    assert np.isinf(hits.range).all()
    assert (hits.triangle == -1).all()
    assert not empty.contains(np.zeros((2, 3))).any()
    assert empty.section(bathyal.Plane([1, 0, 0], 0.5)) == []


def hits_far_away() -> None:
    hits = scene(FAR).cast([[2.3 + FAR, 2.2 + FAR, FAR + 5]], [[0, 0, -7.0]])
    assert hits.triangle[0] >= 0
    same(hits.point[0, :2], [2.3 + FAR, 2.2 + FAR])


CASES: list[Case] = [
    refused(
        "mesh: an index below 0", "triangles", lambda: bathyal.TriangleMesh(FLAT, [[0, 1, -1]])
    ),
    refused(
        "mesh: an index too large", "triangles", lambda: bathyal.TriangleMesh(FLAT, [[0, 1, 3]])
    ),
    refused(
        "mesh: an index beyond 32 bits",
        "triangles",
        lambda: bathyal.TriangleMesh(FLAT, [[0, 1, 2**40]]),
    ),
    refused(
        "mesh: indices that are not whole",
        "triangles",
        lambda: bathyal.TriangleMesh(FLAT, [[0, 1, 1.5]]),
    ),
    refused("mesh: four corners", "triangles", lambda: bathyal.TriangleMesh(FLAT, [[0, 1, 2, 0]])),
    refused("mesh: no triangles argument", "triangles", lambda: bathyal.TriangleMesh(FLAT, None)),
    works("mesh: triangles without area, and twice", degenerate),
    works("scene: no triangles", never_hit),
    works(
        "scene: unsigned indices",
        lambda: bathyal.Scene(bathyal.TriangleMesh(FLAT, np.array([[0, 1, 2]], dtype="u8"))),
    ),
    refused("scene: no mesh", "mesh", lambda: bathyal.Scene([]), ANY),
    refused("scene: not a mesh", "mesh", lambda: bathyal.Scene(GRID), ANY),
    refused("scene: None", "mesh", lambda: bathyal.Scene(None), ANY),
    works(
        "cast: no rays",
        lambda: same(len(scene().cast(np.zeros((0, 3)), np.zeros((0, 3))).range), 0),
    ),
    works(
        "cast: one origin, many directions",
        lambda: same(len(scene().cast([2.3, 2.2, 5], [[0, 0, -1.0]] * 4).range), 4),
    ),
    works("cast: 1e7 m away", hits_far_away),
    works(
        "cast: float32 and strided",
        lambda: same(
            scene()
            .cast(np.array([[1.2, 1.1, 5.0], [0, 0, 0]], "f4")[::2], np.array([[0, 0, -1]], "f4"))
            .triangle
            >= 0,
            [True],
        ),
    ),
    works(
        "cast: a tiny direction",
        lambda: same(scene().cast([[2.5, 2.5, 5]], [[0, 0, -1e-300]]).triangle >= 0, [True]),
    ),
    works(
        "cast: a huge direction",
        lambda: same(scene().cast([[2.5, 2.5, 5]], [[0, 0, -1e300]]).triangle >= 0, [True]),
    ),
    refused("cast: a zero direction", "directions", lambda: scene().cast([[0, 0, 1]], [[0, 0, 0]])),
    refused(
        "cast: a NaN direction", "directions", lambda: scene().cast([[0, 0, 1]], [[0, math.nan, 0]])
    ),
    refused(
        "cast: an infinite origin",
        "origins",
        lambda: scene().cast([[0, math.inf, 1]], [[0, 0, -1]]),
    ),
    refused(
        "cast: two origins, three directions",
        "origins|directions",
        lambda: scene().cast(np.zeros((2, 3)), np.ones((3, 3))),
    ),
    refused("cast: a wrong shape", "directions", lambda: scene().cast([[0, 0, 1]], [[0, 0]])),
    refused("nearest: NaN", "points", lambda: scene().nearest([[math.nan, 0, 0]])),
    refused("contains: a wrong shape", "points", lambda: scene().contains([1.0, 2.0])),
    refused("section: two equal points", "b|up", lambda: scene().section([1, 1, 0], [1, 1, 0])),
    refused(
        "section: two points over each other", "b|up", lambda: scene().section([1, 1, 0], [1, 1, 4])
    ),
    refused("section: no plane", "plane|`a`", lambda: scene().section(None), ANY),
    refused("plane: a zero normal", "normal", lambda: bathyal.Plane([0, 0, 0], 1.0)),
    refused("plane: a NaN normal", "normal", lambda: bathyal.Plane([0, math.nan, 1], 1.0)),
    refused("plane: an infinite offset", "offset", lambda: bathyal.Plane([0, 0, 1], math.inf)),
    refused("mesh_report: not a mesh", "mesh", lambda: bathyal.mesh_report(GRID), ANY),
]


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_bad_input(case: Case, tmp_path: Path) -> None:
    check(case, tmp_path)
