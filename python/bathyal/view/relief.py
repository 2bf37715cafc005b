# SPDX-License-Identifier: BSD-3-Clause
"""The bottom seen from straight above, as an image: heights by vertical rays, and their shading.

What it costs depends on the pixels, not on the triangles: a sheet of two million triangles and a
coral of ten thousand take the same time.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Plane

if TYPE_CHECKING:
    from bathyal._core import Scene, TriangleMesh

Floats = NDArray[np.float64]

# The light comes from the north-west, as on maps, half way up.
_LIGHT = np.array([-0.5, 0.5, np.sqrt(0.5)])


@dataclass(frozen=True)
class Relief:
    """Heights on a grid of square pixels, row 0 in the south.

    height : (rows, columns) array
        z of the highest sheet at each pixel's centre [m]; NaN where there is no bottom.
    x, y : (columns,), (rows,) arrays
        Pixel centres [m].
    """

    height: Floats
    x: Floats
    y: Floats

    @property
    def pixel(self) -> float:
        """Side of a pixel [m]."""
        return float(self.x[1] - self.x[0])

    @property
    def extent(self) -> tuple[float, float, float, float]:
        """West, east, south and north edge [m]."""
        half = self.pixel / 2
        return (self.x[0] - half, self.x[-1] + half, self.y[0] - half, self.y[-1] + half)


def meshes_in_world(scene: Scene) -> list[TriangleMesh]:
    """Each row's mesh where its pose puts it."""
    return [scene.mesh_in_world(row) for row in range(len(scene.meshes))]


def bounds(surface: Scene | Plane, *points: Floats) -> tuple[Floats, Floats]:
    """Lowest and highest corner (3,) of the bottom's meshes and of what else is given [m].

    A plane has no bounds of its own. Rows that are not finite do not count.
    """
    clouds = [np.asarray(p).reshape(-1, 3) for p in points]
    if not isinstance(surface, Plane):
        clouds += [mesh.vertices for mesh in meshes_in_world(surface)]
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for cloud in clouds:
        finite = cloud if np.isfinite(cloud).all() else cloud[np.isfinite(cloud).all(axis=1)]
        if len(finite):
            low, high = np.minimum(low, finite.min(axis=0)), np.maximum(high, finite.max(axis=0))
    if not np.isfinite(low).all():
        return np.zeros(3), np.zeros(3)
    return low, high


def height_image(
    surface: Scene | Plane,
    low: Floats,
    high: Floats,
    *,
    pixels: int = 700,
    samples: int = 2,
) -> Relief:
    """Look straight down on the bottom between the corners `low` and `high` ((2,) or (3,), [m]).

    `pixels` counts the longer side. Each pixel is the mean of `samples` × `samples` rays, so that
    soundings closer than a pixel do not flicker.
    """
    low, high = np.asarray(low, float)[:2], np.asarray(high, float)[:2]
    size = np.maximum(high - low, 1e-9)
    pixel = size.max() / pixels
    shape = np.maximum(np.ceil(size / pixel).astype(int), 2)
    centre = (low + high) / 2
    fine = pixel / samples
    x, y = (
        centre[k] + (np.arange(shape[k] * samples) - (shape[k] * samples - 1) / 2) * fine
        for k in range(2)
    )
    height = _heights(surface, x, y).reshape(shape[1], samples, shape[0], samples)
    seen = np.isfinite(height)
    total = np.where(seen, height, 0.0).sum(axis=(1, 3))
    count = seen.sum(axis=(1, 3))
    mean = np.divide(total, count, out=np.full(total.shape, np.nan), where=2 * count >= samples**2)
    x, y = (v.reshape(-1, samples).mean(axis=1) for v in (x, y))
    return Relief(mean, x, y)


def _heights(surface: Scene | Plane, x: Floats, y: Floats) -> Floats:
    """z of the highest sheet over the grid of `x` and `y`, row by row (N,)."""
    grid_x, grid_y = (g.ravel() for g in np.meshgrid(x, y))
    if isinstance(surface, Plane):
        nx, ny, nz = surface.normal
        return np.asarray((surface.offset - nx * grid_x - ny * grid_y) / nz)
    low, high = bounds(surface)
    above = float(high[2] + 1.0 + 0.1 * (high[2] - low[2]))
    origins = np.column_stack([grid_x, grid_y, np.full(grid_x.size, above)])
    down = np.broadcast_to([0.0, 0.0, -1.0], origins.shape)
    depth: Floats = surface.cast(origins, down).range
    return above - depth


def exaggeration(relief: Relief) -> float:
    """How much heights must be stretched about their mean plane for the shading to show them: 1 for
    rough ground and for none at all, up to 50 for flat, rounded to 1, 2 or 5 times a power of
    ten."""
    gradient = _gradient(relief)
    slope = np.hypot(*(part - mean for part, mean in zip(gradient, _tilt(gradient), strict=True)))
    slope = slope[np.isfinite(slope)]
    steep = float(np.quantile(slope, 0.9)) if slope.size else 0.0
    if steep < 1e-6:
        return 1.0
    return _round_125(float(np.clip(0.35 / steep, 1.0, 50.0)))


def shade(relief: Relief, stretch: float) -> Floats:
    """Brightness from 0 (turned away from the light) to 1 (facing it) of each pixel; flat ground
    gives about 0.7 and pixels without bottom NaN."""
    gradient = _gradient(relief)
    slope_x, slope_y = (
        mean + stretch * (part - mean) for part, mean in zip(gradient, _tilt(gradient), strict=True)
    )
    normal = np.stack([-slope_x, -slope_y, np.ones_like(slope_x)])
    facing = np.tensordot(_LIGHT, normal / np.linalg.norm(normal, axis=0), axes=1)
    return np.where(
        np.isfinite(relief.height), np.clip(np.nan_to_num(facing, nan=0.7), 0, 1), np.nan
    )


def _gradient(relief: Relief) -> tuple[Floats, Floats]:
    """dz/dx and dz/dy: central, one-sided at a hole, NaN where neither side has a bottom."""
    return (_slope(relief.height, relief.pixel), _slope(relief.height.T, relief.pixel).T)


def _tilt(gradient: tuple[Floats, Floats]) -> tuple[float, float]:
    """Median slopes: those of the mean plane, which are not stretched."""
    finite = (part[np.isfinite(part)] for part in gradient)
    x, y = (float(np.median(part)) if part.size else 0.0 for part in finite)
    return x, y


def _slope(height: Floats, pixel: float) -> Floats:
    step = np.diff(height, axis=1) / pixel
    edge = np.full((height.shape[0], 1), np.nan)
    before, after = np.hstack([edge, step]), np.hstack([step, edge])
    both = (before + after) / 2
    return np.where(np.isfinite(both), both, np.where(np.isfinite(before), before, after))


def _round_125(value: float) -> float:
    """The nearest of 1, 2, 5, 10, 20, … by ratio."""
    power = 10.0 ** np.floor(np.log10(value))
    steps = np.array([1.0, 2.0, 5.0, 10.0]) * power
    return float(steps[np.argmin(np.abs(np.log(steps / value)))])
