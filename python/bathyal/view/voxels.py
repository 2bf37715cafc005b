# SPDX-License-Identifier: BSD-3-Clause
"""The picture of a hull filled with voxels, the paper's first look at what is inside."""

from __future__ import annotations

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure

from bathyal._core import Voxels
from bathyal.view.palette import DEPTH, INK

_SIZE_IN = (11.69, 4.6)
_DPI = 140
_AXES = "xyz"
_COLOURS = ListedColormap(["white", DEPTH[len(DEPTH) // 2]])


def voxels_figure(voxels: Voxels) -> Figure:
    """Draw slices of the voxels: across z, y and x, where each cuts most of the inside.

    Maevskiy, Zanin (2020): the array of inside voxels.

    Parameters
    ----------
    voxels : Voxels

    Returns
    -------
    matplotlib.figure.Figure
        With an Agg canvas of its own.
    """
    figure = Figure(figsize=_SIZE_IN, dpi=_DPI, facecolor="white")
    FigureCanvasAgg(figure)
    inside = np.asarray(voxels.inside)
    low = np.asarray(voxels.origin)
    high = low + voxels.size * np.array(inside.shape)
    for axes, across in zip(figure.subplots(1, 3), (2, 1, 0), strict=True):
        along = [k for k in range(3) if k != across]
        at = int(np.argmax(inside.sum(axis=tuple(along))))
        axes.imshow(
            np.take(inside, at, across).T, _COLOURS, vmin=0, vmax=1, origin="lower",
            extent=(low[along[0]], high[along[0]], low[along[1]], high[along[1]]),
            interpolation="nearest",
        )  # fmt: skip
        middle = low[across] + voxels.size * (at + 0.5)
        axes.set_title(f"{_AXES[across]} = {middle:.3g} m", fontsize=10, color=INK)
        axes.set_xlabel(f"{_AXES[along[0]]} [m]")
        axes.set_ylabel(f"{_AXES[along[1]]} [m]")
    figure.suptitle(
        f"Inside {inside.sum() * voxels.size**3:.4g} m³: {inside.sum():,} of {inside.size:,} "
        f"voxels of {1e3 * voxels.size:.3g} mm",
        x=0.02, ha="left", fontsize=12, color=INK,
    )  # fmt: skip
    figure.tight_layout()
    return figure
