# SPDX-License-Identifier: BSD-3-Clause
"""The picture of a side-scan record: pings downwards, port on the left, metres on the axes."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray

Floats = NDArray[np.float64]

_WIDTH_IN = 12.0
_TALLEST_IN, _LOWEST_IN = 24.0, 3.0
_DPI = 130
_MOST_ROWS = 4000
_PERCENTILES = (0.5, 99.3)
_LINES = ("cyan", "lime")


def waterfall_figure(
    intensity: NDArray[np.floating],
    ranges: Floats,
    distance: Floats,
    *,
    title: str = "",
    lines: Mapping[str, Floats] | None = None,
    axis: str = "slant range [m]",
) -> Figure:
    """Draw the rows of a side-scan.

    Parameters
    ----------
    intensity : (P, 2, samples) array
        Power, port and starboard, near to far; drawn is its amplitude, between the percentiles 0.5
        and 99.3 of what is above 0.
    ranges : (samples,) array
        Middles of the samples [m].
    distance : (P,) array
        Along the track [m].
    title : str
    lines : mapping, optional
        Ranges (P, 2) by name, drawn on both sides [m].
    axis : str
        What `ranges` are.

    Returns
    -------
    matplotlib.figure.Figure
        With an Agg canvas of its own.
    """
    step = max(1, -(-len(intensity) // _MOST_ROWS))
    amplitude = np.sqrt(np.asarray(intensity[::step], float))
    image = np.concatenate([amplitude[:, 0, ::-1], amplitude[:, -1]], axis=1)
    heard = image[np.isfinite(image) & (image > 0)]
    low, high = np.percentile(heard, _PERCENTILES) if len(heard) else (0.0, 1.0)
    reach = float(ranges[-1] + 0.5 * (ranges[1] - ranges[0])) if len(ranges) > 1 else 1.0
    length = float(distance[-1] - distance[0]) if len(distance) > 1 else 1.0
    height = float(np.clip(_WIDTH_IN * length / (2 * reach) + 1.2, _LOWEST_IN, _TALLEST_IN))
    figure = Figure(figsize=(_WIDTH_IN, height), dpi=_DPI, facecolor="white", layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    axes.imshow(
        image, cmap="copper", vmin=0.0 if low == high else low, vmax=high, aspect="auto",
        extent=(-reach, reach, length, 0.0), interpolation="nearest",
    )  # fmt: skip
    along = distance - distance[0]
    for colour, (name, values) in zip(_LINES, (lines or {}).items(), strict=False):
        axes.plot(-values[:, 0], along, color=colour, lw=0.6, label=name)
        axes.plot(values[:, -1], along, color=colour, lw=0.6)
    if lines:
        axes.legend(loc="upper right", fontsize=8)
    axes.set_xlim(-reach, reach)
    axes.set_ylim(length, 0.0)
    axes.set_xlabel(f"port    {axis}    starboard")
    axes.set_ylabel("along track [m]")
    axes.set_title(title, loc="left", fontsize=11)
    axes.xaxis.set_major_formatter(lambda x, _: f"{abs(x):g}")
    return figure
