# SPDX-License-Identifier: BSD-3-Clause
"""Meshes made light enough to be turned in a browser; overhangs stay overhangs."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import TriangleMesh

Floats = NDArray[np.float64]
Indices = NDArray[np.int32]


def crop(mesh: TriangleMesh, low: Floats, high: Floats) -> tuple[Floats, Indices]:
    """Vertices and triangles that may reach between `low` and `high` ((2,), [m]): those that do not
    lie wholly beyond one of its four sides."""
    vertices, triangles = np.asarray(mesh.vertices), np.asarray(mesh.triangles)
    x, y = vertices[:, 0], vertices[:, 1]
    beyond = (x < low[0]) | (x > high[0]) << 1 | (y < low[1]) << 2 | (y > high[1]) << 3
    a, b, c = beyond.astype(np.uint8)[triangles].T
    return _compact(vertices, triangles[(a & b & c) == 0])


def decimate(vertices: Floats, triangles: Indices, budget: int) -> tuple[Floats, Indices]:
    """At most about `budget` triangles: vertices within a cube become their mean, triangles that
    lose a corner that way go (vertex clustering; Rossignac, Borrel 1993).

    The cube's edge follows from the area: a cloth of that area over cubes of edge h has about
    2 · area / h² triangles.
    """
    if len(triangles) <= budget:
        return vertices, triangles
    corners = vertices[triangles]
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = float(np.linalg.norm(cross, axis=1).sum()) / 2
    edge = np.sqrt(2 * area / budget)
    while True:
        clustered = _cluster(vertices, triangles, edge)
        if len(clustered[1]) <= 1.1 * budget:
            return clustered
        edge *= 1.2


def _cluster(vertices: Floats, triangles: Indices, edge: float) -> tuple[Floats, Indices]:
    cell = np.floor((vertices - vertices.min(axis=0)) / edge).astype(np.int64)
    size = cell.max(axis=0) + 1
    key = (cell[:, 0] * size[1] + cell[:, 1]) * size[2] + cell[:, 2]
    _, cluster, count = np.unique(key, return_inverse=True, return_counts=True)
    mean = np.column_stack([np.bincount(cluster, vertices[:, k]) / count for k in range(3)])
    merged = cluster[triangles]
    distinct = (
        (merged[:, 0] != merged[:, 1])
        & (merged[:, 1] != merged[:, 2])
        & (merged[:, 2] != merged[:, 0])
    )
    return _compact(mean, merged[distinct].astype(np.int32))


def _compact(vertices: Floats, triangles: NDArray[Any]) -> tuple[Floats, Indices]:
    """Only the vertices that a triangle uses."""
    used, index = np.unique(triangles, return_inverse=True)
    return vertices[used], index.reshape(-1, 3).astype(np.int32)
