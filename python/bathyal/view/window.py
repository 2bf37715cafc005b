# SPDX-License-Identifier: BSD-3-Clause
"""Which part of the bottom a picture shows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bathyal.view.relief import bounds

if TYPE_CHECKING:
    from bathyal._core import Plane, Scene, ToolPath

Floats = NDArray[np.float64]

# A survey up to so many times as wide as the path's surroundings is shown whole.
_WHOLE_UP_TO = 2.5


@dataclass(frozen=True)
class Window:
    """Corners (2,) of what the map shows [m]; `whole` when that is all of the survey."""

    low: Floats
    high: Floats
    whole: bool


def surroundings(path: ToolPath, aims: Floats) -> tuple[Floats, Floats]:
    """Corners (2,) of a rectangle with the path, its targets and a margin of a quarter [m]."""
    points = np.vstack([path.surface, path.targets.point])
    points = points[np.isfinite(points).all(axis=1)][:, :2]
    if len(points) == 0:
        points = aims[np.isfinite(aims).all(axis=1), :2]
    if len(points) == 0:
        return np.zeros(2), np.zeros(2)
    low, high = points.min(axis=0), points.max(axis=0)
    size = float(np.max(high - low))
    margin = 0.25 * size if size > 0 else 1.0
    return low - margin, high + margin


def view_window(surface: Scene, aims: Floats, path: ToolPath) -> tuple[Floats, Floats]:
    """Corners (2,) of what a view shows: the whole survey, or the path's surroundings, as a map."""
    low, high = (corner[:2] for corner in bounds(surface))
    near = surroundings(path, aims)
    return (low, high) if _shown_whole(low, high, *near) else near


def map_window(surface: Scene | Plane, aims: Floats, path: ToolPath, aspect: float) -> Window:
    """The whole survey where the path can be seen on it, the path's surroundings otherwise;
    `aspect` is the width of the map over its height."""
    low, high = (corner[:2] for corner in bounds(surface))
    near_low, near_high = surroundings(path, aims)
    if np.any(high <= low):  # a plane, or a scene without a triangle
        return Window(*_shaped(near_low, near_high, aspect), whole=True)
    if _shown_whole(low, high, near_low, near_high):
        margin = 0.02 * (high - low)
        return Window(*_shaped(low - margin, high + margin, aspect), whole=True)
    return Window(*_shaped(near_low, near_high, aspect), whole=False)


def _shown_whole(low: Floats, high: Floats, near_low: Floats, near_high: Floats) -> bool:
    return bool(np.max(high - low) <= _WHOLE_UP_TO * np.max(near_high - near_low))


def _shaped(low: Floats, high: Floats, aspect: float) -> tuple[Floats, Floats]:
    size, centre = np.maximum(high - low, 1e-6), (low + high) / 2
    size = np.maximum(size, [size[1] * aspect, size[0] / aspect])
    return centre - size / 2, centre + size / 2
