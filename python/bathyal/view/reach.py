# SPDX-License-Identifier: BSD-3-Clause
"""The picture of an arm's reach: slices through its map, across each axis."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import LinearSegmentedColormap, ListedColormap
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from numpy.typing import NDArray

from bathyal._core import ReachMap
from bathyal.view.palette import DEPTH, GAP, INK

Floats = NDArray[np.float64]

_SIZE_IN = (11.69, 8.27)
_DPI = 140
_AXES = "xyz"
_SCALE = LinearSegmentedColormap.from_list("reach", DEPTH[::-1])


def reach_figure(reach: ReachMap) -> Figure:
    """Draw a map on one page: by columns the slices across z, y and x.

    Each slice is the one of its axis in which most voxels are reached. Above, the share of the
    directions of approach; below, the manipulability. Voxels reached only in collision are drawn in
    red.

    Parameters
    ----------
    reach : ReachMap

    Returns
    -------
    matplotlib.figure.Figure
        With an Agg canvas of its own.
    """
    figure = Figure(figsize=_SIZE_IN, dpi=_DPI, facecolor="white")
    FigureCanvasAgg(figure)
    reached, free = np.asarray(reach.reached), np.asarray(reach.free)
    checked = bool(np.isfinite(reach.clearance).any())
    share = 100.0 * np.asarray(reach.directions) / max(1, len(reach.approach))
    rows = [
        ("directions reached [%]", share, 100.0),
        ("manipulability", np.asarray(reach.manipulability), _greatest(reach.manipulability)),
    ]
    grid = figure.subplots(2, 3, squeeze=False, gridspec_kw={"wspace": 0.35})
    for axes_row, (name, values, top) in zip(grid, rows, strict=True):
        for axes, across in zip(axes_row, (2, 1, 0), strict=True):
            at = int(np.argmax(reached.sum(axis=tuple(k for k in range(3) if k != across))))
            blocked = np.take(reached & ~free, at, across) if checked else None
            shown = np.where(np.take(reached, at, across), np.take(values, at, across), np.nan)
            image = _draw_slice(axes, reach, across, at, shown, blocked, top)
        figure.colorbar(image, ax=list(axes_row), label=name, fraction=0.02, pad=0.01)
    figure.suptitle(_title(reach, checked), x=0.02, y=0.98, ha="left", fontsize=12, color=INK)
    return figure


def _greatest(values: NDArray[np.float32]) -> float:
    finite = np.asarray(values)[np.isfinite(values)]
    return float(finite.max()) if finite.size and finite.max() > 0 else 1.0


def _title(reach: ReachMap, checked: bool) -> str:
    litres = 1e3 * reach.voxel**3
    text = f"Reach {np.sum(reach.reached) * litres / 1e3:.2f} m³"
    if checked:
        text += f", {np.sum(reach.free) * litres / 1e3:.2f} m³ free of collision (red: the rest)"
    return f"{text}; voxels of {1e3 * reach.voxel:.3g} mm, {len(reach.approach)} directions"


def _draw_slice(
    axes: Axes,
    reach: ReachMap,
    across: int,
    at: int,
    shown: Floats,
    blocked: NDArray[np.bool_] | None,
    top: float,
) -> AxesImage:
    along = [k for k in range(3) if k != across]
    low = np.asarray(reach.origin)
    high = low + reach.voxel * np.array(reach.reached.shape)
    extent = (low[along[0]], high[along[0]], low[along[1]], high[along[1]])
    image = axes.imshow(
        shown.T, _SCALE, vmin=0.0, vmax=top, origin="lower", extent=extent, interpolation="nearest"
    )
    if blocked is not None and blocked.any():
        over = np.where(blocked, 1.0, np.nan)
        red = ListedColormap([GAP])
        axes.imshow(over.T, red, alpha=0.55, origin="lower", extent=extent, interpolation="nearest")
    axes.set_xlabel(f"{_AXES[along[0]]} [m]")
    axes.set_ylabel(f"{_AXES[along[1]]} [m]")
    middle = low[across] + reach.voxel * (at + 0.5)
    axes.set_title(f"{_AXES[across]} = {middle:.3g} m", fontsize=10, color=INK)
    axes.plot(0.0, 0.0, "+", color=INK, markersize=9)  # the vehicle's origin
    axes.set_xlim(extent[0], extent[1])
    axes.set_ylim(extent[2], extent[3])
    return image
