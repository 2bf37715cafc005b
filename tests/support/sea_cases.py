# SPDX-License-Identifier: BSD-3-Clause
"""Shapes, worlds and a pencil beam for cases of sonars that have an answer on paper."""

from __future__ import annotations

import numpy as np

import bathyal


def at(x=0.0, y=0.0, z=0.0):
    """(4, 4) pose at a place [m], axes along the world's."""
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


def plate(low, high, z=0.0):
    """A horizontal rectangle between two corners (x, y), seen from above [m]."""
    (x, y), (u, v) = low, high
    corners = [[x, y, z], [u, y, z], [u, v, z], [x, v, z]]
    return bathyal.TriangleMesh(corners, [[0, 1, 2], [0, 2, 3]])


def ball(radius, rings, inward=False):
    """A sphere about the origin of `rings` rings and twice as many meridians, volume a bit low."""
    sectors = 2 * rings
    down = np.pi * np.arange(1, rings) / rings
    turn = np.pi * np.arange(sectors) / rings
    ring = np.stack(
        [
            np.sin(down)[:, None] * np.cos(turn),
            np.sin(down)[:, None] * np.sin(turn),
            np.cos(down)[:, None] * np.ones(sectors),
        ],
        axis=-1,
    )
    vertices = radius * np.vstack([[0, 0, 1], ring.reshape(-1, 3), [0, 0, -1]])
    k = np.arange(sectors)
    after = (k + 1) % sectors
    top = np.stack([0 * k, 1 + k, 1 + after], axis=1)
    last = 1 + (rings - 2) * sectors
    bottom = np.stack([0 * k + len(vertices) - 1, last + after, last + k], axis=1)
    pieces = [top, bottom]
    for i in range(rings - 2):
        up, low = 1 + i * sectors, 1 + (i + 1) * sectors
        pieces.append(np.stack([up + k, low + k, low + after], axis=1))
        pieces.append(np.stack([up + k, low + after, up + after], axis=1))
    triangles = np.vstack(pieces)
    return bathyal.TriangleMesh(vertices, triangles[:, ::-1] if inward else triangles)


def world_of(*things, strength=1.0):
    """A world of meshes, or pairs of a mesh and its pose, of one Lambert material."""
    world = bathyal.World()
    world.set_material("white", strength)
    for thing in things:
        mesh, pose = thing if isinstance(thing, tuple) else (thing, None)
        world.add(mesh, pose, material="white")
    return world


def flat_world(half=200.0, strength=1.0):
    """A horizontal bottom at z = 0."""
    return world_of(plate((-half, -half), (half, half)), strength=strength)


def pointer(**fields):
    """A pencil beam of 0.02 rad to port, horizontal, every effect off."""
    narrow = {
        "beam_width": 0.02,
        "fan_width": 0.02,
        "fan_span": 0.02,
        "tilt": 0.0,
        "axis_tilt": 0.0,
    }
    plain = bathyal.sonars.side_scan().replace(
        beams=1, rays_across_beam=100, rays_along_fan=100, **narrow
    )
    return plain.replace(**fields)


def cut(ping, beam, low, high):
    """The energy of a row between two slant ranges, from the middle of `low`'s sample on."""
    inside = (ping.range >= low) & (ping.range < high)
    return float(ping.intensity[beam, inside].sum(dtype=float))


def decibel(ratio):
    return 10.0 * np.log10(ratio)
