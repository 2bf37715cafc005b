# SPDX-License-Identifier: BSD-3-Clause
"""Meshes with a known shape, and motions, for the tests of Scene."""

from pathlib import Path

import numpy as np
from hypothesis import strategies as st

import bathyal

HULLS = Path(__file__).resolve().parents[3] / "shared" / "data" / "hulls"
UTM = np.array([512345.25, 7212345.5, -52.0])


def seabed(columns=60, rows=40, offset=(0.0, 0.0, 0.0)):
    x, y = np.meshgrid(np.arange(columns, dtype=float), np.arange(rows, dtype=float))
    z = np.sin(0.3 * x) + 2.0 * np.cos(0.05 * y + 0.11 * x)
    vertices = np.column_stack([x.ravel(), y.ravel(), z.ravel()]) + offset
    corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    triangles = np.concatenate(
        [
            np.column_stack([corner, corner + 1, corner + columns + 1]),
            np.column_stack([corner, corner + columns + 1, corner + columns]),
        ]
    )
    return bathyal.TriangleMesh(vertices, triangles)


def box(half=(1.0, 2.0, 3.0), centre=(0.0, 0.0, 0.0)):
    signs = np.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)]) * 2.0 - 1.0
    triangles = [
        (0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4),
        (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5),
    ]  # fmt: skip
    return bathyal.TriangleMesh(signs * half + centre, triangles)


def sphere(radius=1.0, centre=(0.0, 0.0, 0.0), rings=24, sectors=48):
    polar = np.linspace(0.0, np.pi, rings + 1)[1:-1]
    around = 2.0 * np.pi * np.arange(sectors) / sectors
    p, a = np.meshgrid(polar, around, indexing="ij")
    body = np.stack([np.sin(p) * np.cos(a), np.sin(p) * np.sin(a), np.cos(p)], axis=-1)
    vertices = np.concatenate([body.reshape(-1, 3), [[0, 0, 1], [0, 0, -1]]])
    north, south = len(vertices) - 2, len(vertices) - 1
    triangles = []
    for j in range(sectors):
        k = (j + 1) % sectors
        triangles.append((north, j, k))
        for i in range(rings - 2):
            upper, lower = i * sectors, (i + 1) * sectors
            triangles += [(upper + j, lower + j, lower + k), (upper + j, lower + k, upper + k)]
        last = (rings - 2) * sectors
        triangles.append((last + j, south, last + k))
    return bathyal.TriangleMesh(radius * vertices + centre, triangles)


def moved(mesh, rotation, offset):
    return bathyal.TriangleMesh(mesh.vertices @ rotation.T + offset, mesh.triangles)


def rotation_from(quaternion):
    w, x, y, z = np.array(quaternion) / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


quaternions = st.tuples(*[st.floats(-1.0, 1.0) for _ in range(4)]).filter(
    lambda q: np.linalg.norm(q) > 0.1
)
