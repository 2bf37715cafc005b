# SPDX-License-Identifier: BSD-3-Clause
"""The picture of a side-scan's mosaic: north up, metres on the axes."""

from __future__ import annotations

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray

Floats = NDArray[np.float64]

_LONGER_IN = 10.0
_DPI = 130
_PERCENTILES = (0.5, 99.3)


def mosaic_figure(
    intensity: NDArray[np.floating], x: Floats, y: Floats, *, crs: str | None = None
) -> Figure:
    """Draw a mosaic.

    Parameters
    ----------
    intensity : (rows, columns) array
        Power, north to south; drawn is its amplitude, between the percentiles 0.5 and 99.3 of what
        is above 0.
    x : (columns,) array
        Middles of the cells, east [m].
    y : (rows,) array
        North, descending [m].
    crs : str, optional
        Named on the axis.

    Returns
    -------
    matplotlib.figure.Figure
        With an Agg canvas of its own.
    """
    image = np.sqrt(np.asarray(intensity, float))
    heard = image[np.isfinite(image) & (image > 0)]
    low, high = np.percentile(heard, _PERCENTILES) if len(heard) else (0.0, 1.0)
    cell = float(x[1] - x[0]) if len(x) > 1 else 1.0
    west, north = x[0] - cell / 2, y[0] + cell / 2
    size = cell * np.array([len(x), len(y)], float)
    wide, tall = _LONGER_IN * size / size.max()
    figure = Figure(
        figsize=(max(wide, 3.0) + 0.9, max(tall, 2.0) + 0.7), dpi=_DPI, facecolor="white",
        layout="constrained",
    )  # fmt: skip
    FigureCanvasAgg(figure)
    axes = figure.add_subplot(facecolor="0.93")
    axes.imshow(
        image, cmap="copper", vmin=0.0 if low == high else low, vmax=high,
        extent=(west, west + size[0], north - size[1], north), interpolation="nearest",
    )  # fmt: skip
    axes.set_xlabel(f"east [m]{f', {crs}' if crs else ''}")
    axes.set_ylabel("north [m]")
    axes.ticklabel_format(style="plain", useOffset=False)
    axes.tick_params(axis="x", labelrotation=0 if x[-1] < 1e4 else 20)
    return figure
