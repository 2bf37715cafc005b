# SPDX-License-Identifier: BSD-3-Clause
"""The picture of a plan: the bottom from above, the profile of the section, and what was planned."""

from __future__ import annotations

import os
import textwrap
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from bathyal import map_figure, profile_figure
from bathyal._core import Plane
from bathyal.files import replacing
from bathyal.palette import GAP, INK

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from bathyal._core import Scene, ToolPath

# A4 turned on its side.
_SIZE_IN = (11.69, 8.27)
_DPI = 160


def plan_figure(
    bottom: Scene | Plane,
    aims: np.ndarray,
    path: ToolPath,
    *,
    title: str = "",
    facts: Mapping[str, str] | None = None,
    warnings: Sequence[str] | None = None,
    crs: str = "",
) -> Figure:
    """Draw a plan on one page.

    Parameters
    ----------
    bottom : Scene or Plane
        What the path was planned on.
    aims : (K, 6) array
        Camera axes: origin and direction [m], in the frame of the bottom.
    path : ToolPath
        What `plan_toolpath` returned for them.
    title : str
    facts : mapping of str to str, optional
        Lines for the box beside the map.
    warnings : sequence of str, optional
        Those of the path unless given.
    crs : str
        Coordinate reference system; north is marked only when there is one.

    Returns
    -------
    matplotlib.figure.Figure
        Of its own Agg canvas; no window and no global state of pyplot is touched.
    """
    aims = np.asarray(aims, float).reshape(-1, 6)
    figure = Figure(figsize=_SIZE_IN, dpi=_DPI, facecolor="white")
    FigureCanvasAgg(figure)
    rows = figure.add_gridspec(
        2, 1, height_ratios=[2.15, 1.0], left=0.065, right=0.985, top=0.93, bottom=0.07, hspace=0.17
    )
    top = rows[0].subgridspec(1, 2, width_ratios=[3.1, 1.0], wspace=0.20)
    side = top[1].subgridspec(2, 1, height_ratios=[1.0, 1.25], hspace=0.08)

    window = map_figure.window(bottom, aims, path)
    map_figure.draw(figure.add_subplot(top[0]), bottom, aims, path, window, crs=crs)
    locator = figure.add_subplot(side[0])
    located = map_figure.draw_locator(locator, bottom, window)
    told = path.warnings if warnings is None else warnings
    _draw_facts(figure.add_subplot(side[1] if located else top[1]), facts or {}, told)
    if not located:
        locator.remove()
    profile_figure.draw(figure.add_subplot(rows[1]), bottom, path)
    if title:
        figure.suptitle(title, x=0.065, y=0.975, ha="left", fontsize=13, weight="bold", color=INK)
    return figure


def write_png(figure: Figure, path: str | os.PathLike[str]) -> None:
    """Save a figure, the whole file or none of it; the same bytes for the same figure."""
    with replacing(path) as aside:
        figure.savefig(aside, format="png", metadata={"Software": "bathyal"})


def _draw_facts(axes: Axes, facts: Mapping[str, str], warnings: Sequence[str]) -> None:
    axes.set_axis_off()
    style: dict[str, Any] = {"transform": axes.transAxes, "va": "top", "color": INK}
    y, line = 1.0, 0.052
    for name, value in facts.items():
        wrapped = textwrap.wrap(value, 24) or [""]
        axes.text(0.0, y, name, fontsize=8.5, alpha=0.75, **style)
        axes.text(1.0, y, "\n".join(wrapped), fontsize=8.5, ha="right", **style)
        y -= line * len(wrapped) + 0.008
    y -= line / 2
    shown = list(warnings[:4])
    if len(warnings) > len(shown):
        shown.append(f"and {len(warnings) - len(shown)} more: see path.json")
    for warning in shown:
        wrapped = textwrap.wrap(warning, 40)
        axes.text(0.0, y, "\n".join(wrapped), fontsize=8, **{**style, "color": GAP})
        y -= line * len(wrapped) + 0.015
