# SPDX-License-Identifier: BSD-3-Clause
"""The picture of a world from above: shaded, coloured by height, its objects marked."""

from __future__ import annotations

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import LightSource, LinearSegmentedColormap
from matplotlib.figure import Figure
from numpy.typing import NDArray

from bathyal._core import Scene, World
from bathyal.view.palette import DEPTH

Floats = NDArray[np.float64]

_LONGER_IN = 10.0
_DPI = 130
_CELLS = 900  # along the longer side
_SCALE = LinearSegmentedColormap.from_list("height", DEPTH)


def world_figure(world: World, time: float = 0.0, *, title: str = "") -> Figure:
    """Draw a world as it is at a time.

    Parameters
    ----------
    world : World
    time : float
        [s]
    title : str

    Returns
    -------
    matplotlib.figure.Figure
        With an Agg canvas of its own.
    """
    scene = world.at(time).scene
    low, high = _bounds(scene)
    size = high[:2] - low[:2]
    cell = float(size.max()) / _CELLS
    x = np.arange(low[0] + cell / 2, high[0], cell)
    y = np.arange(low[1] + cell / 2, high[1], cell)
    height = _heights(scene, x, y, high[2] + 1.0)
    shade = LightSource(azdeg=315, altdeg=35).shade(
        np.where(np.isfinite(height), height, np.nanmean(height)),
        cmap=_SCALE, blend_mode="soft", dx=cell, dy=cell, vert_exag=1.0,
    )  # fmt: skip
    shade[~np.isfinite(height)] = 1.0
    wide, tall = _LONGER_IN * size / size.max()
    figure = Figure(
        figsize=(wide + 1.6, tall + 0.9), dpi=_DPI, facecolor="white", layout="constrained"
    )
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    axes.imshow(shade, origin="lower", extent=(low[0], high[0], low[1], high[1]))
    scale = axes.imshow(
        height, origin="lower", extent=(low[0], high[0], low[1], high[1]), cmap=_SCALE, alpha=0.0
    )
    bar = figure.colorbar(scale, ax=axes, label="z [m]", fraction=0.03, pad=0.01)
    if bar.solids is not None:
        bar.solids.set(alpha=1.0)
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    axes.set_title(title, loc="left", fontsize=11)
    return figure


def _bounds(scene: Scene) -> tuple[Floats, Floats]:
    """Of all that is there."""
    lows, highs = [], []
    for mesh, pose, scale in zip(scene.meshes, scene.poses, scene.scales, strict=True):
        vertices = np.asarray(mesh.vertices)
        if len(vertices):
            corners = scale * vertices @ pose[:3, :3].T + pose[:3, 3]
            lows.append(corners.min(axis=0))
            highs.append(corners.max(axis=0))
    return np.min(lows, axis=0), np.max(highs, axis=0)


def _heights(scene: Scene, x: Floats, y: Floats, top: float) -> Floats:
    """(len(y), len(x)) of what is seen from above; NaN where there is nothing."""
    grid = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    origins = np.column_stack([grid, np.full(len(grid), top)])
    hits = scene.cast(origins, np.broadcast_to([0.0, 0.0, -1.0], origins.shape))
    ranges = np.asarray(hits.range)
    height = np.where(np.isfinite(ranges), top - ranges, np.nan)
    return height.reshape(len(y), len(x))
