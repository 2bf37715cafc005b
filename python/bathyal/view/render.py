# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of bodies by the engine's own rays: what is near hides what is far, light casts shadows.

Each pixel is a ray into a scene of the bodies; bodies that one sees through are mixed in, each by
its nearest surface.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.colors import to_rgb
from numpy.typing import NDArray

from bathyal._core import Scene, TriangleMesh
from bathyal.view.palette import DEPTH

Floats = NDArray[np.float64]
Indices = NDArray[np.int32]

_LIGHT = np.array([0.35, -0.45, 0.82]) / np.linalg.norm([0.35, -0.45, 0.82])
_AMBIENT, _DIFFUSE, _IN_SHADOW = 0.52, 0.48, 0.35
_SKY_TOP, _SKY_LOW = np.array([0.86, 0.91, 0.95]), np.array([0.97, 0.98, 0.98])
_OFF = 1e-4  # of the picture's size: where a ray of shadow leaves its surface


@dataclass(frozen=True)
class Drawn:
    """A mesh in the world as it is drawn; a colour of "depth" is that of its height."""

    vertices: Floats
    triangles: Indices
    colour: str
    opacity: float = 1.0


@dataclass(frozen=True)
class Camera:
    """Where it is, what it looks at [m], and its field of view from bottom to top [rad]."""

    eye: Floats
    target: Floats
    field: float = 0.6

    def rays(self, width: int, height: int) -> Floats:
        """(height · width, 3) directions, row by row from the top."""
        ahead = (self.target - self.eye) / np.linalg.norm(self.target - self.eye)
        right = np.cross(ahead, [0.0, 0.0, 1.0])
        right /= np.linalg.norm(right)
        up = np.cross(right, ahead)
        half = np.tan(self.field / 2)
        v, u = np.meshgrid(
            half * (1 - 2 * (np.arange(height) + 0.5) / height),
            half * (2 * (np.arange(width) + 0.5) / width - 1) * width / height,
            indexing="ij",
        )
        return np.asarray((ahead + u[..., None] * right + v[..., None] * up).reshape(-1, 3))


def looking_at(low: Floats, high: Floats, aspect: float, field: float = 0.6) -> Camera:
    """A camera from the south-west above that sees a box, `aspect` its width over its height."""
    back = np.array([0.62, -1.0, 0.42])
    back /= np.linalg.norm(back)
    radius = float(np.linalg.norm(high - low)) / 2
    distance = 0.86 * radius / np.sin(field / 2) / min(1.0, aspect)
    middle = (low + high) / 2
    return Camera(middle + distance * back, middle, field)


class Stage:
    """Bodies at rest, made ready once for the pictures of a series."""

    def __init__(self, bodies: Sequence[Drawn]) -> None:
        self.solid = _Group([body for body in bodies if body.opacity >= 1])
        self.glass = [_Group([body]) for body in bodies if body.opacity < 1]

    def picture(
        self, moving: Sequence[Drawn], camera: Camera, width: int, height: int, samples: int = 2
    ) -> NDArray[np.uint8]:
        """(height, width, 3) 8-bit picture of the bodies at rest and those that move.

        Each pixel is the mean of `samples`² rays.
        """
        solid = _Group([body for body in moving if body.opacity >= 1])
        glass = self.glass + [_Group([body]) for body in moving if body.opacity < 1]
        directions = camera.rays(width * samples, height * samples)
        groups = [group for group in (self.solid, solid) if group.scene is not None]
        colour = _sky(directions)
        nearest = np.full(len(directions), np.inf)
        point = np.zeros_like(directions)
        lit = np.zeros(len(directions))
        for group in groups:
            hits = group.scene.cast(camera.eye, directions)  # type: ignore[union-attr]
            front = np.flatnonzero(np.asarray(hits.range) < nearest)
            nearest[front] = np.asarray(hits.range)[front]
            point[front] = np.asarray(hits.point)[front]
            normal = _facing(np.asarray(hits.normal)[front], directions[front])
            lit[front] = normal @ _LIGHT
            point[front] += normal * _OFF * nearest[front, None]
            colour[front] = group.colours(hits, front)
        seen = np.flatnonzero(np.isfinite(nearest))
        lit[seen[self._shadowed(groups, point[seen])]] *= _IN_SHADOW
        shade = _AMBIENT + _DIFFUSE * np.clip(lit[seen], 0, 1)
        colour[seen] *= shade[:, None]
        for group in glass:
            self._mix(group, camera, directions, nearest, colour)
        tiles = colour.reshape(height, samples, width, samples, 3).mean(axis=(1, 3))
        return np.asarray(np.clip(255 * tiles + 0.5, 0, 255).astype(np.uint8))

    @staticmethod
    def _shadowed(groups: Sequence[_Group], points: Floats) -> NDArray[np.bool_]:
        dark = np.zeros(len(points), bool)
        if len(points):
            for group in groups:
                hits = group.scene.cast(points, np.broadcast_to(_LIGHT, points.shape))  # type: ignore[union-attr]
                dark |= np.isfinite(np.asarray(hits.range))
        return dark

    @staticmethod
    def _mix(
        group: _Group, camera: Camera, directions: Floats, nearest: Floats, colour: Floats
    ) -> None:
        if group.scene is None:
            return
        hits = group.scene.cast(camera.eye, directions)
        front = np.flatnonzero(np.asarray(hits.range) < nearest)
        normal = _facing(np.asarray(hits.normal)[front], directions[front])
        shade = (0.8 + 0.2 * np.clip(normal @ _LIGHT, 0, 1))[:, None]
        opacity = group.bodies[0].opacity
        tint = shade * np.array(to_rgb(group.bodies[0].colour))
        colour[front] = (1 - opacity) * colour[front] + opacity * tint


class _Group:
    """Bodies under one hierarchy."""

    def __init__(self, bodies: Sequence[Drawn]) -> None:
        self.bodies = [body for body in bodies if len(body.triangles)]
        meshes = [TriangleMesh(body.vertices, body.triangles) for body in self.bodies]
        self.scene = Scene(meshes) if meshes else None

    def colours(self, hits: object, rows: NDArray[np.intp]) -> Floats:
        mesh = np.asarray(hits.mesh)[rows]  # type: ignore[attr-defined]
        tints = np.array(
            [to_rgb("white" if b.colour == "depth" else b.colour) for b in self.bodies]
        )
        colour = tints[mesh]
        for number, body in enumerate(self.bodies):
            if body.colour == "depth":
                own = np.flatnonzero(mesh == number)
                height = np.asarray(hits.point)[rows[own], 2]  # type: ignore[attr-defined]
                colour[own] = _depth_colour(height, body.vertices[:, 2])
        return np.asarray(colour)


def _facing(normal: Floats, directions: Floats) -> Floats:
    towards = np.sum(normal * directions, axis=1, keepdims=True)
    return np.asarray(np.where(towards > 0, -normal, normal))


def _depth_colour(height: Floats, heights: Floats) -> Floats:
    low, high = np.quantile(heights, [0.002, 0.998])
    share = np.clip((height - low) / max(float(high - low), 1e-9), 0, 1)
    table = np.array([to_rgb(colour) for colour in DEPTH])
    steps = np.linspace(0, 1, len(table))
    return np.column_stack([np.interp(share, steps, table[:, k]) for k in range(3)])


def _sky(directions: Floats) -> Floats:
    up = directions[:, 2] / np.linalg.norm(directions, axis=1)
    share = np.clip(0.5 + up, 0, 1)[:, None]
    return np.asarray((1 - share) * _SKY_LOW + share * _SKY_TOP)
