# SPDX-License-Identifier: BSD-3-Clause
"""The figure of a cast: sound speed, temperature and salinity by depth."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray

from bathyal.io.files import PathLike, replacing
from bathyal.view.palette import AFTER, BEFORE, DEPTH, INK

if TYPE_CHECKING:
    from bathyal._core import Profile

_DPI = 150


def cast_figure(profile: Profile) -> Figure:
    """Draw what a cast measured against depth, one panel a quantity, the surface on top."""
    panels = _panels(profile)
    figure = Figure(figsize=(1.2 + 2.6 * len(panels), 5.0), layout="constrained", dpi=_DPI)
    FigureCanvasAgg(figure)
    axes = figure.subplots(1, len(panels), sharey=True, squeeze=False)[0]
    for place, (label, values, colour) in zip(axes, panels, strict=True):
        known = np.isfinite(values) & np.isfinite(profile.depth)
        place.plot(values[known], profile.depth[known], color=colour, lw=1.2)
        place.set_xlabel(label)
        place.grid(alpha=0.25)
        place.ticklabel_format(axis="x", useOffset=False)
    axes[0].set_ylabel("depth [m]")
    axes[0].set_ylim(np.nanmax(profile.depth), min(0.0, np.nanmin(profile.depth)))
    title = " · ".join(filter(None, [profile.source.split(";")[0], profile.instrument]))
    figure.suptitle(title, fontsize=9, color=INK)
    return figure


def _panels(profile: Profile) -> list[tuple[str, NDArray[np.float64], str]]:
    speed, label = profile.sound_speed, "sound speed [m/s]"
    if speed is None and profile.temperature is not None and profile.salinity is not None:
        speed, label = profile.with_sound_speed().sound_speed, "sound speed, computed [m/s]"
    found = [
        (label, speed, DEPTH[3]),
        ("temperature [°C]", profile.temperature, BEFORE),
        ("salinity", profile.salinity, AFTER),
    ]
    return [(name, values, colour) for name, values, colour in found if values is not None]


def write_figure(figure: Figure, path: PathLike) -> None:
    """Save a figure in the format of its suffix, the whole file or none of it."""
    with replacing(path) as aside:
        figure.savefig(aside)
