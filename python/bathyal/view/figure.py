# SPDX-License-Identifier: BSD-3-Clause
"""The picture of a plan: the bottom from above, the profile of the section, what was planned."""

from __future__ import annotations

import os
import textwrap
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from bathyal.arrays import unmasked
from bathyal.io.files import replacing
from bathyal.view import map as map_figure
from bathyal.view import profile as profile_figure
from bathyal.view.palette import GAP, INK
from bathyal.view.relief import Floats
from bathyal.view.window import map_window

if TYPE_CHECKING:
    from bathyal._core import Plane, Scene, ToolPath

# A4 turned on its side, and where things lie on it as shares of the page: left, bottom, width,
# height.
_SIZE_IN = (11.69, 8.27)
_DPI = 160
_MAP = (0.070, 0.385, 0.585, 0.545)
_COLOUR_BAR = (0.663, 0.385, 0.012, 0.545)
_SIDE = (0.745, 0.385, 0.240, 0.545)
_PROFILE = (0.070, 0.070, 0.915, 0.225)
_LINE = 0.0205
_WARNINGS_SHOWN = 4


def plan_figure(
    surface: Scene | Plane,
    aims: Floats,
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
    surface : Scene or Plane
        What the path was planned on.
    aims : (K, 6) array
        Camera axes: origin and direction [m], in the frame of the surface.
    path : ToolPath
        What `plan_toolpath` returned for them.
    title : str
    facts : mapping of str to str, optional
        Lines for the box next to the map.
    warnings : sequence of str, optional
        Those of the path unless given.
    crs : str
        Coordinate reference system; north is marked only when there is one.

    Returns
    -------
    matplotlib.figure.Figure
        With an Agg canvas of its own: no window, and nothing of pyplot's state is touched.
    """
    aims = unmasked("aims", aims).astype(float).reshape(-1, 6)
    figure = Figure(figsize=_SIZE_IN, dpi=_DPI, facecolor="white")
    FigureCanvasAgg(figure)
    aspect = _MAP[2] * _SIZE_IN[0] / (_MAP[3] * _SIZE_IN[1])
    window = map_window(surface, aims, path, aspect)

    plan = figure.add_axes(_MAP)
    map_figure.draw(plan, figure.add_axes(_COLOUR_BAR), surface, aims, path, window, crs=crs)
    top = _SIDE[1] + _SIDE[3]
    if not window.whole:
        height = 0.20
        locator = figure.add_axes((_SIDE[0], top - height - 0.012, _SIDE[2], height))
        map_figure.draw_locator(locator, surface, window)
        top -= height + 0.045
    top = _write_facts(figure, facts or {}, top)
    lines = list(path.warnings if warnings is None else warnings)
    top = _write_warnings(figure, lines, top - _LINE)
    handles, labels = plan.get_legend_handles_labels()
    figure.legend(
        handles, labels, loc="lower left", bbox_to_anchor=(_SIDE[0] - 0.008, _SIDE[1] - 0.01),
        fontsize=8, frameon=False, borderaxespad=0.0, handlelength=2.4,
        handler_map=map_figure.LEGEND_HANDLERS,
    )  # fmt: skip
    profile_figure.draw(figure.add_axes(_PROFILE), surface, path)
    if title:
        figure.text(_MAP[0], 0.955, title, fontsize=13, weight="bold", color=INK)
    return figure


def write_png(figure: Figure, path: str | os.PathLike[str]) -> None:
    """Save a figure, the whole file or none of it; the same bytes for the same figure."""
    with replacing(path) as aside:
        figure.savefig(aside, format="png", metadata={"Software": "bathyal"})


def _write_facts(figure: Figure, facts: Mapping[str, str], top: float) -> float:
    """Names to the left, values to the right; returns where the next line goes."""
    style: dict[str, Any] = {"va": "top", "fontsize": 8.5, "color": INK}
    for name, value in facts.items():
        wrapped = textwrap.wrap(value, 26) or [""]
        figure.text(_SIDE[0], top, name, alpha=0.7, **style)
        figure.text(_SIDE[0] + _SIDE[2], top, "\n".join(wrapped), ha="right", **style)
        top -= _LINE * len(wrapped)
    return top


def _write_warnings(figure: Figure, warnings: Sequence[str], top: float) -> float:
    shown = list(warnings[:_WARNINGS_SHOWN])
    if len(warnings) > len(shown):
        shown.append(f"… and {len(warnings) - len(shown)} more in path.json")
    for warning in shown:
        wrapped = textwrap.wrap(warning, 44, max_lines=4, placeholder=" …")
        figure.text(_SIDE[0], top, "\n".join(wrapped), va="top", fontsize=8, color=GAP)
        top -= _LINE * 0.95 * len(wrapped) + 0.008
    return top
