# SPDX-License-Identifier: BSD-3-Clause
"""Seas of few parts, of which the echo is known on paper."""

from __future__ import annotations

import numpy as np

import bathyal


def at(x: float = 0.0, y: float = 0.0, z: float = 0.0) -> np.ndarray:
    """A level pose, bow to +x."""
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


def plate(low: tuple[float, float], high: tuple[float, float]) -> bathyal.TriangleMesh:
    """A rectangle at z = 0, wound upwards."""
    (a, b), (c, d) = low, high
    corners = [[a, b, 0], [c, b, 0], [c, d, 0], [a, d, 0]]
    return bathyal.TriangleMesh(np.array(corners, float), [[0, 1, 2], [0, 2, 3]])


def ball(radius: float, rings: int) -> bathyal.TriangleMesh:
    """About the origin, of longitudes and latitudes, wound outwards."""
    polar, turn = np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, 2 * rings + 1)[:-1]
    p, t = np.meshgrid(polar, turn, indexing="ij")
    points = radius * np.stack([np.sin(p) * np.cos(t), np.sin(p) * np.sin(t), np.cos(p)], axis=2)
    i, j = np.meshgrid(np.arange(rings), np.arange(2 * rings), indexing="ij")
    a, b = i * 2 * rings + j, i * 2 * rings + (j + 1) % (2 * rings)
    down = 2 * rings
    faces = np.concatenate([
        np.stack([a, a + down, b + down], axis=2).reshape(-1, 3),
        np.stack([a, b + down, b], axis=2).reshape(-1, 3),
    ])  # fmt: skip
    return bathyal.TriangleMesh(points.reshape(-1, 3), faces)


def world_of(*parts) -> bathyal.World:
    """Of meshes, or (mesh, pose) pairs."""
    world = bathyal.World()
    for part in parts:
        mesh, pose = part if isinstance(part, tuple) else (part, None)
        world.add(mesh, pose=pose, material="sand")
    return world


def flat_world() -> bathyal.World:
    """A bottom of 400 m at z = 0."""
    return world_of(plate((-200, -200), (200, 200)))


def pointer(**fields) -> bathyal.Sonar:
    """A pencil beam to port."""
    narrow = {
        "beams": 1, "tilt": 0.0, "axis_tilt": 0.0, "fan_width": 0.01, "fan_span": 0.01,
        "beam_width": 0.01, "rays_across_beam": 9, "rays_along_fan": 9,
    }  # fmt: skip
    return bathyal.sonars.side_scan().replace(**(narrow | fields))


def cut(ping: bathyal.Ping, beam: int, low: float, high: float) -> float:
    """Energy of the samples whose middles lie between two ranges."""
    return float(ping.intensity[beam][(ping.range >= low) & (ping.range < high)].sum())


def decibel(power):
    """10 log₁₀."""
    return 10.0 * np.log10(power)
