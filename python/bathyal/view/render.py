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
    """Bodies at rest as one camera sees them, made ready once for the pictures of a series."""

    def __init__(
        self, bodies: Sequence[Drawn], camera: Camera, size: tuple[int, int], samples: int = 2
    ) -> None:
        """`size` is width and height [pixels]; each is the mean of `samples`² rays."""
        self.camera, self.size, self.samples = camera, size, samples
        self.directions = camera.rays(size[0] * samples, size[1] * samples)
        self.solid = _Group([body for body in bodies if body.opacity >= 1])
        self.glass = [_Group([body]) for body in bodies if body.opacity < 1]
        rays = len(self.directions)
        seen = _Seen(
            _sky(self.directions), np.full(rays, np.inf), np.zeros((rays, 3)), np.zeros(rays),
            np.zeros(rays, bool),
        )  # fmt: skip
        self._look(self.solid, seen)
        rows = np.flatnonzero(np.isfinite(seen.range))
        seen.dark[rows] = self.solid.shades(seen.point[rows])
        self.seen = seen
        self.panes = [self._pane(group) for group in self.glass]

    def picture(self, moving: Sequence[Drawn] = ()) -> NDArray[np.uint8]:
        """(height, width, 3) 8-bit picture of the bodies at rest and those that move."""
        seen = _Seen(*(part.copy() for part in vars(self.seen).values()))
        solid = _Group([body for body in moving if body.opacity >= 1])
        front = self._look(solid, seen)
        seen.dark[front] = self.solid.shades(seen.point[front])
        rows = np.flatnonzero(np.isfinite(seen.range) & ~seen.dark)
        seen.dark[rows] = solid.shades(seen.point[rows])
        rows = np.flatnonzero(np.isfinite(seen.range))
        lit = np.clip(seen.lit[rows], 0, 1) * np.where(seen.dark[rows], _IN_SHADOW, 1.0)
        seen.colour[rows] *= (_AMBIENT + _DIFFUSE * lit)[:, None]
        panes = self.panes + [self._pane(_Group([b])) for b in moving if b.opacity < 1]
        for pane in panes:
            before = pane.range < seen.range[pane.rows]
            rows, opacity = pane.rows[before], pane.opacity
            seen.colour[rows] = (1 - opacity) * seen.colour[rows] + opacity * pane.tint[before]
        (width, height), fine = self.size, self.samples
        tiles = seen.colour.reshape(height, fine, width, fine, 3).mean(axis=(1, 3))
        return np.asarray(np.clip(255 * tiles + 0.5, 0, 255).astype(np.uint8))

    def _look(self, group: _Group, seen: _Seen) -> NDArray[np.intp]:
        """Enter what a group shows in front of all before; the rays that meet it."""
        if group.scene is None:
            return np.empty(0, np.intp)
        hits = group.scene.cast(self.camera.eye, self.directions)
        reach = np.asarray(hits.range)
        front = np.flatnonzero(reach < seen.range)
        seen.range[front] = reach[front]
        normal = _facing(np.asarray(hits.normal)[front], self.directions[front])
        seen.lit[front] = normal @ _LIGHT
        off = normal * _OFF * reach[front, None]
        seen.point[front] = np.asarray(hits.point)[front] + off
        seen.colour[front] = group.colours(hits, front)
        return front

    def _pane(self, group: _Group) -> _Pane:
        """The nearest surface of a body that one sees through."""
        if group.scene is None:
            return _Pane(np.empty(0, np.intp), np.empty(0), np.empty((0, 3)), 0.0)
        hits = group.scene.cast(self.camera.eye, self.directions)
        reach = np.asarray(hits.range)
        rows = np.flatnonzero(np.isfinite(reach))
        normal = _facing(np.asarray(hits.normal)[rows], self.directions[rows])
        shade = (0.8 + 0.2 * np.clip(normal @ _LIGHT, 0, 1))[:, None]
        body = group.bodies[0]
        return _Pane(rows, reach[rows], shade * np.array(to_rgb(body.colour)), body.opacity)


@dataclass(frozen=True)
class _Seen:
    """What each ray meets: colour, range, place just off the surface, light on it, shadow."""

    colour: Floats
    range: Floats
    point: Floats
    lit: Floats
    dark: NDArray[np.bool_]


@dataclass(frozen=True)
class _Pane:
    """Rays that meet a body that one sees through, how far it is, its colour there."""

    rows: NDArray[np.intp]
    range: Floats
    tint: Floats
    opacity: float


class _Group:
    """Bodies under one hierarchy."""

    def __init__(self, bodies: Sequence[Drawn]) -> None:
        self.bodies = [body for body in bodies if len(body.triangles)]
        meshes = [TriangleMesh(body.vertices, body.triangles) for body in self.bodies]
        self.scene = Scene(meshes) if meshes else None

    def shades(self, points: Floats) -> NDArray[np.bool_]:
        """Which of (N, 3) points lie in a body's shadow."""
        if self.scene is None or not len(points):
            return np.zeros(len(points), bool)
        hits = self.scene.cast(points, np.broadcast_to(_LIGHT, points.shape))
        return np.asarray(np.isfinite(hits.range), bool)

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
