# SPDX-License-Identifier: BSD-3-Clause
"""Closed meshes of simple bodies, for pictures: vertices (V, 3) [m] and triangles (T, 3)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Indices = NDArray[np.int32]
Mesh = tuple[Floats, Indices]

SIDES = 20
_RINGS = 5  # of a capsule's cap
_BALL_RINGS = 17


def capsule(start: Floats, end: Floats, radius: float) -> Mesh:
    """All points within `radius` of a segment; a ball where the segment has no length."""
    length = float(np.linalg.norm(end - start))
    if length == 0:
        return ball(start, radius)
    angle = np.linspace(0, np.pi / 2, _RINGS)
    cap = radius * np.column_stack([-np.cos(angle), np.sin(angle)])
    profile = np.vstack([cap, _side(length, radius), cap[::-1] * [-1, 1] + [length, 0]])
    return turned(profile, start, (end - start) / length)


def prism(start: Floats, end: Floats, radius: float, sides: int = SIDES) -> Mesh:
    """A cylinder, or a prism of few sides, with its ends."""
    length = float(np.linalg.norm(end - start))
    end_caps = np.array([[0, 0], [0, radius], [length, radius], [length, 0]])
    profile = np.vstack([end_caps[:2], _side(length, radius), end_caps[2:]])
    return turned(profile, start, (end - start) / length, sides)


def cone(apex: Floats, end: Floats, radius: float) -> Mesh:
    """From its apex to the middle of its round end."""
    length = float(np.linalg.norm(end - apex))
    profile = np.array([[0, 0], [length, radius], [length, 0]])
    return turned(profile, apex, (end - apex) / length, 2 * SIDES)


def ball(center: Floats, radius: float) -> Mesh:
    """A sphere."""
    angle = np.linspace(0, np.pi, _BALL_RINGS)
    profile = radius * np.column_stack([-np.cos(angle), np.sin(angle)])
    profile[[0, -1], 1] = 0.0  # the poles are points
    return turned(profile, np.asarray(center, float), np.array([0.0, 0.0, 1.0]), 2 * SIDES)


def box(size: Floats) -> Mesh:
    """About the origin, `size` (3,) its full lengths, normals outwards."""
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    triangles = [[face[0], face[k], face[k + 1]] for face in faces for k in (1, 2)]
    return corners * np.asarray(size) / 2, np.array(triangles, np.int32)


def patch(point: Floats, normal: Floats, half: float) -> Mesh:
    """A square of a plane about a point."""
    x, y = rings(np.asarray(normal) / np.linalg.norm(normal), 4)[:2] * half
    corners = np.asarray(point) + np.array([x + y, -x + y, -x - y, x - y])
    return corners, np.array([[0, 1, 2], [0, 2, 3]], np.int32)


def rings(axis: Floats, sides: int) -> Floats:
    """(sides, 3) unit vectors square to an axis."""
    helper = np.eye(3)[np.argmin(np.abs(axis))]
    x = np.cross(axis, helper)
    x /= np.linalg.norm(x)
    angle = np.arange(sides)[:, None] * (2 * np.pi / sides)
    return np.asarray(np.cos(angle) * x + np.sin(angle) * np.cross(axis, x))


def turned(profile: Floats, start: Floats, axis: Floats, sides: int = SIDES) -> Mesh:
    """A body of revolution: `profile` (K, 2) is the way along the axis and the radius there."""
    around = rings(axis, sides)
    vertices = start + profile[:, None, :1] * axis + profile[:, None, 1:] * around
    k, i = np.meshgrid(np.arange(len(profile) - 1), np.arange(sides), indexing="ij")
    a, b = k * sides + i, k * sides + (i + 1) % sides
    quads = np.stack([a, b, b + sides, a, b + sides, a + sides], axis=-1)
    return vertices.reshape(-1, 3), quads.reshape(-1, 3).astype(np.int32)


def _side(length: float, radius: float) -> Floats:
    """Rings between the ends: painters sort faces by their middles, which must lie close."""
    along = np.linspace(0, length, max(2, round(length / radius)) + 1)[1:-1]
    return np.column_stack([along, np.full(len(along), radius)])
