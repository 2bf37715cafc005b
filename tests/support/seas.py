# SPDX-License-Identifier: BSD-3-Clause
"""Small worlds and sonars for tests."""

from __future__ import annotations

import numpy as np

import bathyal


def flat(z: float = 0.0, half: float = 200.0) -> bathyal.TriangleMesh:
    corners = [[-half, -half, z], [half, -half, z], [half, half, z], [-half, half, z]]
    return bathyal.TriangleMesh(corners, [[0, 1, 2], [0, 2, 3]])


def flat_world(**options) -> bathyal.World:
    world = bathyal.World()
    world.add(flat(), name="bottom", **options)
    return world


def at(x: float = 0.0, y: float = 0.0, z: float = 10.0) -> np.ndarray:
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


def line(length: float, speed: float = 2.0, z: float = 10.0) -> bathyal.Trajectory:
    """Along x, from 0."""
    return bathyal.Trajectory([0.0, length / speed], np.stack([at(z=z), at(length, z=z)]))


def small_side_scan(**changes) -> bathyal._core.Sonar:
    sonar = bathyal.sonars.side_scan()
    return sonar.replace(**{"range": 40.0, "samples": 400, "rays_along_fan": 800, **changes})
