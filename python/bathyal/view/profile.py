# SPDX-License-Identifier: BSD-3-Clause
"""The profile of a plan: the section under the path, the tool above it, normals at true angle."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.patheffects import withStroke
from matplotlib.ticker import MaxNLocator

from bathyal._core import Plane
from bathyal.view.map import LEGEND_HANDLERS, MAX_NUMBERS
from bathyal.view.palette import BOTTOM, GAP, INK, PALE, segment_colour
from bathyal.view.relief import Floats
from bathyal.view.stations import Stations, runs, spread, unroll

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from bathyal._core import Scene, ToolPath

_ARROWS = 60
_ARROW_PT = 20.0


def draw(axes: Axes, surface: Scene | Plane, path: ToolPath) -> None:
    """Draw height against distance along the section, one segment after the other."""
    axes.set_xlabel("distance along the section, from target to target [m]", fontsize=9)
    axes.set_ylabel("height z [m]", fontsize=9)
    axes.tick_params(labelsize=8)
    if len(path.position) == 0:
        axes.text(0.5, 0.5, "no path", ha="center", transform=axes.transAxes, color=GAP)
        axes.set(xticks=[], yticks=[])
        return
    stations = unroll(path)
    stretch = _set_limits(axes, stations)
    _draw_bottom(axes, surface, stations)
    _draw_tool(axes, stations, path)
    _draw_normals(axes, stations)
    _draw_targets(axes, path, stations)
    scale = "true to scale" if stretch == 1 else f"heights × {stretch:g}"
    axes.set_title(
        f"Section ({scale}; $a_j$ at its true angle from the vertical)",
        fontsize=9, loc="left", color=INK,
    )  # fmt: skip
    axes.ticklabel_format(useOffset=False, style="plain")
    axes.yaxis.set_major_locator(MaxNLocator(6))
    ticks = np.asarray(MaxNLocator(8).tick_values(0.0, stations.end[-1]))
    axes.set_xticks(ticks[(ticks >= 0) & (ticks <= stations.end[-1])])  # nothing lies beyond
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    axes.legend(
        loc="lower right", bbox_to_anchor=(1.0, 0.99), fontsize=8, frameon=False, ncols=5,
        handlelength=2.0, columnspacing=1.4, borderaxespad=0.1, handler_map=LEGEND_HANDLERS,
    )  # fmt: skip


def _set_limits(axes: Axes, stations: Stations) -> float:
    """Fits the axes to the path and returns by how much heights are stretched: 1 where that fills
    at least a fifth of the page's height, else the next round number."""
    both = np.vstack([stations.bottom, stations.tool])
    low, high = both.min(axis=0), both.max(axis=0)
    length = max(high[0] - low[0], 1e-3)
    box = axes.get_window_extent()
    width = 1.04 * length
    room = width * box.height / box.width  # the height that the page shows true to scale
    relief = max(high[1] - low[1], 0.01 * room)
    filled = relief / room
    stretch = 1.0 if filled > 0.2 else round_down(0.55 / filled)
    height = max(room / stretch, relief / 0.72)
    if height > room:  # steeper than the page: narrow the drawing, keep it true to scale
        width = height * box.width / box.height
    middle = (low + high) / 2
    # Room for the arrows and the legend above, a little ground below.
    bottom = middle[1] - 0.5 * relief - 0.36 * (height - relief)
    axes.set_xlim(middle[0] - width / 2, middle[0] + width / 2)
    axes.set_ylim(bottom, bottom + height)
    return stretch


def round_down(value: float) -> float:
    """The largest of 1, 2, 5, 10, 20, … that is not above `value` (at least 1)."""
    if value <= 1:
        return 1.0
    power = 10.0 ** np.floor(np.log10(value))
    return float(max(step for step in (power, 2 * power, 5 * power) if step <= value * (1 + 1e-9)))


def _draw_bottom(axes: Axes, surface: Scene | Plane, stations: Stations) -> None:
    """Every sheet that the section's plane cuts, so that one sees which the path follows."""
    labelled = False
    for number, along in enumerate(stations.along):
        begin, end = stations.begin[number], stations.end[number]
        if end <= begin:
            continue
        for line in _cuts(surface, stations.start[number], along, end - begin):
            distance = begin + (line - stations.start[number]) @ along
            axes.plot(
                distance, line[:, 2], color=BOTTOM, lw=2.6, zorder=3, solid_capstyle="round",
                label=None if labelled else "bottom",
            )  # fmt: skip
            axes.fill_between(
                distance, line[:, 2], axes.get_ylim()[0], color=BOTTOM, alpha=0.18, lw=0, zorder=1
            )
            labelled = True


def _cuts(surface: Scene | Plane, start: Floats, along: Floats, length: float) -> list[Floats]:
    end = start + along * length
    if isinstance(surface, Plane):
        both = np.vstack([start, end])
        both[:, 2] -= surface.distance(both) / surface.normal[2]
        return [both]
    return [np.asarray(line.points) for line in surface.section(start, end)]


def _draw_tool(axes: Axes, stations: Stations, path: ToolPath) -> None:
    segment = np.asarray(path.segment)
    first = True
    for begin, end in runs(path):
        axes.plot(
            *stations.tool[begin : end + 1].T, color=segment_colour(segment[begin]), lw=1.9,
            zorder=6, path_effects=[withStroke(linewidth=2.9, foreground=INK)],
            label="tool path, by segment" if first else None,
        )  # fmt: skip
        first = False
    for number, row in enumerate(np.flatnonzero(path.gap)):
        axes.plot(
            *stations.tool[row : row + 2].T, "--", color=GAP, lw=1.8, zorder=7,
            label="gap: no bottom known" if number == 0 else None,
        )  # fmt: skip
        axes.axvspan(*sorted(stations.tool[row : row + 2, 0]), color=GAP, alpha=0.08, lw=0)


def _draw_normals(axes: Axes, stations: Stations) -> None:
    rows = spread(stations.bottom, _ARROWS)
    axes.quiver(
        *stations.tool[rows].T, *stations.approach[rows].T, angles="uv", units="dots",
        scale_units="dots", scale=1 / (_ARROW_PT * axes.figure.dpi / 72), width=1.6, headwidth=4,
        headlength=5, headaxislength=4.5, color=INK, zorder=5, label="approach $a_j$",
    )  # fmt: skip
    joined = np.full((3 * len(rows), 2), np.nan)
    joined[0::3], joined[1::3] = stations.bottom[rows], stations.tool[rows]
    axes.plot(*joined.T, color=INK, lw=0.5, alpha=0.6, zorder=4)


def _draw_targets(axes: Axes, path: ToolPath, stations: Stations) -> None:
    """The targets lie where segments meet: their numbers are those of the map."""
    known = np.flatnonzero(np.isfinite(path.targets.point).all(axis=1))
    height = path.targets.point[known, 2]
    x = [stations.at_target(row) for row in known.tolist()]
    for distance in x:
        axes.axvline(distance, color=INK, lw=0.5, ls=":", alpha=0.6, zorder=2)
    axes.plot(x, height, "o", ms=6, mfc=PALE, mec=INK, mew=1.3, zorder=8, ls="none")
    every = max(1, len(known) // MAX_NUMBERS)
    for row, distance in zip(known[::every], x[::every], strict=True):
        axes.annotate(
            str(row), (distance, 0.02), xycoords=("data", "axes fraction"), fontsize=9,
            weight="bold", color=INK, ha="center", zorder=9,
            path_effects=[withStroke(linewidth=2.5, foreground=PALE)],
        )  # fmt: skip
