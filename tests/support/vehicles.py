# SPDX-License-Identifier: BSD-3-Clause
"""A vehicle with the arm of Maevskiy, Zanin (2020). Its hull is ours: theirs is not published."""

from __future__ import annotations

import numpy as np

import bathyal

Q_START = np.radians([0.0, -45.0, 50.0])


def pose(x: float = 0.0, y: float = 0.0, z: float = 0.0, yaw: float = 0.0) -> np.ndarray:
    c, s = np.cos(yaw), np.sin(yaw)
    return np.array([[c, -s, 0, x], [s, c, 0, y], [0, 0, 1, z], [0, 0, 0, 1.0]])


def box_mesh(low, high) -> bathyal.TriangleMesh:
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
    triangles = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
                 [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]  # fmt: skip
    return bathyal.TriangleMesh(np.asarray(low) + corners * np.subtract(high, low), triangles)


HULL = bathyal.Hull(box_mesh([-0.8, -0.35, -0.25], [0.5, 0.35, 0.25]))
MOUNT = pose(0.5, 0.0, -0.2)


def flat_bottom(depth: float = -1.2, half: float = 4.0) -> bathyal.Scene:
    """The plane z = `depth`, normals up."""
    corners = np.array([[-half, -half], [half, -half], [half, half], [-half, half]])
    vertices = np.column_stack([corners, np.full(4, depth)])
    return bathyal.Scene(bathyal.TriangleMesh(vertices, [[0, 1, 2], [0, 2, 3]]))


def sampler(**around) -> bathyal.Workspace:
    """The paper's arm at the bow of our hull."""
    return bathyal.Workspace(bathyal.arms.maevskiy_zanin(), MOUNT, hull=HULL, **around)
