# SPDX-License-Identifier: BSD-3-Clause
"""A motion as pictures take it: bodies, where their carriers are at each frame, and curves."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Indices = NDArray[np.int32]

_SOON = 1e-9  # [s] within which times are one
AT_REST = -1  # carrier of what does not move


@dataclass(frozen=True)
class Body:
    """A mesh of one colour.

    Attributes
    ----------
    name : str
    kind : {"bottom", "hull", "link", "keepout", "target"}
    vertices, triangles : (V, 3), (T, 3) arrays
        [m], in the frame of the carrier; in the world of a body at rest.
    colour : str
        ``#rrggbb``; a bottom is coloured by depth.
    opacity : float
    carrier : int
        Column of `Motion.poses` that it moves with, or `AT_REST`.
    """

    name: str
    kind: str
    vertices: Floats
    triangles: Indices
    colour: str
    opacity: float = 1.0
    carrier: int = AT_REST


@dataclass(frozen=True)
class Panel:
    """Curves that share an axis: each name with its values, one a row of `Motion.time`."""

    title: str
    curves: Mapping[str, Floats]


@dataclass(frozen=True)
class Light:
    """What the indicator shows: each frame one of `colours`' keys, with a text."""

    name: str
    state: Sequence[str]  # (F,) "go", "caution", "stop"
    text: Sequence[str]  # (F,)


@dataclass(frozen=True)
class Motion:
    """What moves, and what is known of it at each frame.

    Attributes
    ----------
    time : (F,) array
        [s], rising.
    poses : (F, C, 4, 4) array
        world_from_carrier.
    bodies : sequence of Body
    panels : sequence of Panel
    phases : sequence of (str, float, float)
        Name, begin and end [s].
    lights : sequence of Light
    path : (F, 3) array
        Of the tip, in the world; empty for none.
    title : str
    facts : mapping of str to str
    warnings : sequence of str
    """

    time: Floats
    poses: Floats
    bodies: Sequence[Body]
    panels: Sequence[Panel] = ()
    phases: Sequence[tuple[str, float, float]] = ()
    lights: Sequence[Light] = ()
    path: Floats = field(default_factory=lambda: np.empty((0, 3)))
    title: str = ""
    facts: Mapping[str, str] = field(default_factory=dict)
    warnings: Sequence[str] = ()

    def row_at(self, moment: float) -> int:
        """The last row that is not after a time [s]."""
        row = int(np.searchsorted(self.time, moment + _SOON, side="right")) - 1
        return min(max(row, 0), len(self.time) - 1)

    def phase_at(self, moment: float) -> str:
        """The name of the phase that a time [s] is in, the first of two; empty for none."""
        for name, begin, end in self.phases:
            if begin <= moment <= end + _SOON:
                return name
        return ""

    def world_vertices(self, body: Body, frame: int) -> Floats:
        """(V, 3) of a body at a frame [m]."""
        if body.carrier == AT_REST:
            return body.vertices
        pose = self.poses[frame, body.carrier]
        return np.asarray(body.vertices @ pose[:3, :3].T + pose[:3, 3])

    def box(self) -> tuple[Floats, Floats]:
        """Corners of what moves, the hull and the path, at the first, middle and last frames."""
        frames = sorted({0, len(self.time) // 2, len(self.time) - 1})
        seen = [
            self.world_vertices(body, frame)
            for body in self.bodies
            if body.kind in ("hull", "link", "target")
            for frame in frames
        ]
        points = np.vstack([*seen, self.path, np.empty((0, 3))])
        if len(points) == 0:
            return np.zeros(3), np.ones(3)
        return points.min(axis=0), points.max(axis=0)


def frames_of(time: Floats, most: int) -> NDArray[np.intp]:
    """Rows, the first and the last among them, about evenly spread in time, `most` at most."""
    time = np.asarray(time, float)
    if len(time) <= most:
        return np.arange(len(time))
    wanted = np.linspace(time[0], time[-1], most)
    return np.unique(np.clip(np.searchsorted(time, wanted), 0, len(time) - 1))
