# SPDX-License-Identifier: BSD-3-Clause
"""An arm's reach as a cloud of voxels to turn and zoom."""

from __future__ import annotations

import numpy as np
import plotly.graph_objects as go  # type: ignore[import-untyped]

from bathyal._core import ReachMap
from bathyal.view.palette import DEPTH, GAP, INK

POINT_BUDGET = 60_000
_HALF = "half of it, y below that of the middle, is left out to look inside"


def show_reach(reach: ReachMap) -> go.Figure:
    """The voxels that are reached, coloured by the directions of approach.

    Half of the reach is left out, so that its inside is seen; of many voxels every k-th is drawn.
    Those reached only in collision are a trace of their own, red, to be switched off.

    Parameters
    ----------
    reach : ReachMap

    Returns
    -------
    plotly.graph_objects.Figure
    """
    reached = np.asarray(reach.reached)
    checked = bool(np.isfinite(reach.clearance).any())
    blocked = reached & ~np.asarray(reach.free) if checked else np.zeros_like(reached)
    cells = np.argwhere(reached)
    if len(cells):
        cells = cells[cells[:, 1] >= (cells[:, 1].min() + cells[:, 1].max()) // 2]
    every = max(1, -(-len(cells) // POINT_BUDGET))
    cells = cells[::every]
    points = np.asarray(reach.origin) + reach.voxel * (cells + 0.5)
    hit = blocked[tuple(cells.T)]
    share = 100.0 * np.asarray(reach.directions)[tuple(cells.T)] / max(1, len(reach.approach))
    scale = [[k / (len(DEPTH) - 1), colour] for k, colour in enumerate(DEPTH[::-1])]
    size = max(2.0, min(6.0, 200.0 * reach.voxel))
    bar = {"title": "directions [%]", "thickness": 14}
    figure = go.Figure(
        [
            _trace("reached" if not checked else "free", points[~hit], size)
            .update(marker={"color": share[~hit], "colorscale": scale, "colorbar": bar})
            .update(marker={"cmin": 0, "cmax": 100}),
            _trace("only in collision", points[hit], size).update(marker={"color": GAP}),
        ]
    )
    note = f"Every {every}. voxel of {1e3 * reach.voxel:.3g} mm; {_HALF}"
    figure.update_layout(
        scene={
            "aspectmode": "data",
            **{f"{axis}axis": {"title": {"text": f"{axis} [m]"}} for axis in "xyz"},
        },
        margin={"l": 0, "r": 0, "t": 36, "b": 0},
        legend={"x": 0.01, "y": 0.98},
        title={"text": note, "font": {"size": 12}, "x": 0.01, "y": 0.99},
        font={"color": INK},
    )
    return figure


def _trace(name: str, points: np.ndarray, size: float) -> go.Scatter3d:
    x, y, z = (points[:, k].astype(np.float32) for k in range(3))
    return go.Scatter3d(x=x, y=y, z=z, name=name, mode="markers", marker={"size": size})
