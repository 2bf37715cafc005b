# SPDX-License-Identifier: BSD-3-Clause
"""Small bottoms whose pictures and files the tests look at."""

from __future__ import annotations

import numpy as np

import bathyal

UTM = np.array([621_000.0, 7_244_000.0, 0.0])


def bottom(*, offset: np.ndarray | None = None, hole: bool = True, crs: str = "") -> bathyal.Scene:
    """20 m × 12 m of waves, a vertex every half metre; with `hole` nothing between x = 9 and 11."""
    x, y = np.meshgrid(np.arange(0, 20.1, 0.5), np.arange(0, 12.1, 0.5))
    z = -30 + 0.4 * np.sin(x) + 0.1 * y
    vertices = np.column_stack([x.ravel(), y.ravel(), z.ravel()])
    rows, columns = x.shape
    first = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    triangles = np.vstack(
        [
            np.column_stack([first, first + 1, first + columns]),
            np.column_stack([first + 1, first + columns + 1, first + columns]),
        ]
    )
    if hole:
        middle = vertices[triangles, 0].mean(axis=1)
        triangles = triangles[(middle < 9) | (middle > 11)]
    shift = np.zeros(3) if offset is None else offset
    return bathyal.Scene(bathyal.TriangleMesh(vertices + shift, triangles, crs=crs))


def aims(*, offset: np.ndarray | None = None, miss: bool = True) -> np.ndarray:
    """Three axes straight down, on either side of the hole; with `miss` a fourth outside it all."""
    places = [[2.2, 3.1, -20], [6.3, 4.2, -20], [16.4, 8.7, -20]]
    if miss:
        places.append([60.0, 3.0, -20])
    origins = np.array(places) + (np.zeros(3) if offset is None else offset)
    return np.column_stack([origins, np.tile([0.0, 0.0, -1.0], (len(places), 1))])


def planned(*, offset: np.ndarray | None = None, hole: bool = True, miss: bool = True, **options):
    """A bottom, its aims, and the path over it."""
    surface, axes = bottom(offset=offset, hole=hole), aims(offset=offset, miss=miss)
    return surface, axes, bathyal.plan_toolpath(surface, axes, **{"step": 0.2, **options})
