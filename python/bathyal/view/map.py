# SPDX-License-Identifier: BSD-3-Clause
"""The map of a plan: hill-shaded depth from above, aims, targets, path, tool frames."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.legend_handler import HandlerBase
from matplotlib.patches import FancyArrowPatch, Rectangle
from matplotlib.patheffects import withStroke
from matplotlib.quiver import Quiver
from matplotlib.ticker import FuncFormatter, MaxNLocator

from bathyal.view.palette import DEPTH, GAP, INK, PALE, segment_colour
from bathyal.view.relief import Floats, Relief, bounds, exaggeration, height_image, shade
from bathyal.view.stations import axis_ends, runs, spread
from bathyal.view.window import Window

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from bathyal._core import Plane, Scene, ToolPath

_DEPTH_MAP = LinearSegmentedColormap.from_list("bathyal_depth", DEPTH)
_CASED = [withStroke(linewidth=3.2, foreground=INK)]
_HALO = [withStroke(linewidth=2.5, foreground=PALE)]
_APPROACH_ARROWS = 32
MAX_NUMBERS = 40  # targets with their number next to them


def draw(
    axes: Axes,
    bar_axes: Axes,
    surface: Scene | Plane,
    aims: Floats,
    path: ToolPath,
    window: Window,
    *,
    crs: str = "",
) -> None:
    """Draw the map and its colour bar; what is drawn is labelled for a legend."""
    relief = height_image(surface, window.low, window.high)
    stretch = exaggeration(relief)
    norm = _depth_norm(relief)
    axes.imshow(_shaded(relief, norm, stretch), extent=relief.extent, origin="lower", zorder=1)
    axes.set_facecolor("#f3f3f1")
    axes.set(xlim=relief.extent[:2], ylim=relief.extent[2:], aspect="equal")
    _label_axes(axes, crs)
    _add_colour_bar(axes, bar_axes, norm, stretch)
    _draw_aims(axes, aims, path)
    _draw_path(axes, path, relief)
    _draw_targets(axes, path)
    _draw_scale_bar(axes)
    if crs:
        _draw_north(axes)


def draw_locator(axes: Axes, surface: Scene | Plane, window: Window) -> None:
    """Draw where the map lies in the survey."""
    low, high = bounds(surface)
    relief = height_image(surface, low, high, pixels=240, samples=1)
    image = _shaded(relief, _depth_norm(relief), exaggeration(relief))
    axes.imshow(image, extent=relief.extent, origin="lower")
    width, height = window.high - window.low
    axes.add_patch(Rectangle(tuple(window.low), width, height, fill=False, ec=GAP, lw=1.2))
    centre = (window.low + window.high) / 2
    axes.plot(*centre, marker="o", ms=16, mfc="none", mec=GAP, mew=1.2)
    axes.set(xticks=[], yticks=[], aspect="equal", anchor="N")
    size = high - low
    axes.set_title(
        f"the survey, {length_text(size[0])} × {length_text(size[1])}", fontsize=8.5, color=INK
    )


class _ArrowHandler(HandlerBase):
    """Arrows appear in a legend as arrows: matplotlib draws them as rectangles."""

    def create_artists(
        self, legend: Any, handle: Any, x: float, y: float, width: float, height: float,
        fontsize: float, trans: Any,
    ) -> list[FancyArrowPatch]:  # fmt: skip
        middle = y + height / 2
        arrow = FancyArrowPatch(
            (x, middle), (x + width, middle), arrowstyle="-|>", mutation_scale=8, color=INK
        )
        arrow.set_transform(trans)
        return [arrow]


LEGEND_HANDLERS = {Quiver: _ArrowHandler()}


def length_text(metres: float) -> str:
    """A length as people say it: 3.4 km, 27 m, 38 cm."""
    if metres >= 1000:
        return f"{metres / 1000:.3g} km"
    return f"{metres:.3g} m" if metres >= 1 else f"{metres * 100:.3g} cm"


def plain_text(value: float) -> str:
    """A coordinate with thin spaces between thousands."""
    text = f"{value:,.10g}" if value != int(value) else f"{int(value):,}"
    return text.replace(",", "\N{THIN SPACE}").replace("-", "\N{MINUS SIGN}")


def _depth_norm(relief: Relief) -> Normalize:
    height = relief.height[np.isfinite(relief.height)]
    if height.size == 0:
        return Normalize(0.0, 1.0)
    low, high = np.quantile(height, [0.002, 0.998])
    middle, half = (low + high) / 2, max((high - low) / 2, 1e-6)
    return Normalize(middle - half, middle + half)


def _shaded(relief: Relief, norm: Normalize, stretch: float) -> Floats:
    """(rows, columns, 4) colours: depth darkened and lightened by the shade, clear over holes."""
    light = shade(relief, stretch)[..., None]
    colour: Floats = _DEPTH_MAP(norm(np.nan_to_num(relief.height)))
    rgb = colour[..., :3]
    # Overlay: dark stays dark and bright stays bright, so that depth is still read from colour.
    light = np.nan_to_num(0.5 + 0.75 * (light - 0.7))
    shaded = np.where(light < 0.5, rgb * (2 * light), 1 - (1 - rgb) * (2 - 2 * light))
    colour[..., :3] = np.clip(0.25 * rgb + 0.75 * shaded, 0, 1)
    colour[..., 3] = np.isfinite(relief.height)
    return colour


def _label_axes(axes: Axes, crs: str) -> None:
    names = ("easting", "northing") if crs else ("x", "y")
    for axis, limits, name in (
        (axes.xaxis, axes.get_xlim(), names[0]),
        (axes.yaxis, axes.get_ylim(), names[1]),
    ):
        offset = tick_offset(*limits)
        axis.set_major_locator(MaxNLocator(6))
        axis.set_major_formatter(
            FuncFormatter(lambda value, _, offset=offset: plain_text(round(value - offset, 9)))
        )
        note = f"  (+ {plain_text(offset)} m)" if offset else ""
        axis.set_label_text(f"{name} [m]{note}", fontsize=9)
    axes.tick_params(labelsize=8)


def tick_offset(low: float, high: float) -> float:
    """What the tick labels omit: whole metres, so that far coordinates stay readable."""
    size = high - low
    if max(abs(low), abs(high)) < 1000 or abs(low) < 5 * size:
        return 0.0
    round_to = 10.0 ** max(np.ceil(np.log10(size)), 0)
    return float(np.floor(low / round_to) * round_to)


def _add_colour_bar(axes: Axes, bar_axes: Axes, norm: Normalize, stretch: float) -> None:
    bar = axes.figure.colorbar(ScalarMappable(norm, _DEPTH_MAP), cax=bar_axes)
    bar.set_label("height z [m]", fontsize=9, labelpad=5)
    bar.ax.tick_params(labelsize=8)
    bar.ax.ticklabel_format(useOffset=False)
    if stretch > 1:
        note = f"shading: heights × {stretch:g}, light from upper left"
    else:
        note = "shading: light from upper left"
    axes.text(
        0.995, 0.01, note, transform=axes.transAxes, ha="right", fontsize=7, color=INK,
        path_effects=_HALO, zorder=15,
    )  # fmt: skip


def _draw_aims(axes: Axes, aims: Floats, path: ToolPath) -> None:
    targets = path.targets
    hit = np.isfinite(targets.point).all(axis=1)
    end = axis_ends(aims, path)
    label = {True: "camera axis", False: "camera axis without target"}
    for is_hit, line, colour in ((True, "-", PALE), (False, ":", GAP)):
        rows = np.flatnonzero(hit == is_hit)
        if not len(rows):
            continue
        joined = np.full((3 * len(rows), 2), np.nan)
        joined[0::3], joined[1::3] = aims[rows, :2], end[rows, :2]
        axes.plot(
            *joined.T, line, color=colour, lw=1.0, zorder=6, label=label[is_hit],
            path_effects=[withStroke(linewidth=1.8, foreground=INK)] if is_hit else None,
        )  # fmt: skip
        axes.plot(*aims[rows, :2].T, "s", ms=4, mfc=colour, mec=INK, mew=0.8, zorder=7)


def _draw_path(axes: Axes, path: ToolPath, relief: Relief) -> None:
    position = np.asarray(path.position)
    segment = np.asarray(path.segment)
    for number, (begin, end) in enumerate(runs(path)):
        axes.plot(
            *position[begin : end + 1, :2].T, color=segment_colour(segment[begin]), lw=1.9,
            path_effects=_CASED, zorder=9, solid_capstyle="round",
            label="tool path, by segment" if number == 0 else None,
        )  # fmt: skip
    for number, row in enumerate(np.flatnonzero(path.gap)):
        axes.plot(
            *position[row : row + 2, :2].T, "--", color=GAP, lw=2.0, zorder=10,
            label="gap: no bottom known" if number == 0 else None,
        )  # fmt: skip
    rows = spread(position[:, :2], _APPROACH_ARROWS)
    width = relief.extent[1] - relief.extent[0]
    axes.quiver(
        *position[rows, :2].T, *(np.asarray(path.approach)[rows, :2] * width * 0.07).T,
        angles="xy", scale_units="xy", scale=1, width=0.0018, color=INK, zorder=11,
        headwidth=4, headlength=5, headaxislength=4.5, label="approach $a_j$, horizontal part",
    )  # fmt: skip


def _draw_targets(axes: Axes, path: ToolPath) -> None:
    point = np.asarray(path.targets.point)
    rows = np.flatnonzero(np.isfinite(point).all(axis=1))
    axes.plot(
        *point[rows, :2].T, "o", ms=6, mfc=PALE, mec=INK, mew=1.3, zorder=12, ls="none",
        label="target $A_i$, aim $i$ from 0",
    )  # fmt: skip
    every = max(1, len(rows) // MAX_NUMBERS)
    for row in rows[::every]:
        axes.annotate(
            str(row), tuple(point[row, :2]), xytext=(5, 5), textcoords="offset points", fontsize=9,
            weight="bold", color=INK, path_effects=_HALO, zorder=13,
        )  # fmt: skip


def _draw_scale_bar(axes: Axes) -> None:
    west, east = axes.get_xlim()
    south, north = axes.get_ylim()
    steps = np.array([1, 2, 5, 10]) * 10.0 ** np.floor(np.log10((east - west) / 5))
    length = steps[steps <= (east - west) / 4].max()
    x, y = west + 0.03 * (east - west), south + 0.04 * (north - south)
    for part, colour in ((0, INK), (1, PALE)):
        axes.add_patch(
            Rectangle(
                (x + part * length / 2, y), length / 2, 0.009 * (north - south), fc=colour, ec=INK,
                lw=0.8, zorder=15,
            )
        )  # fmt: skip
    axes.text(
        x + length / 2, y + 0.018 * (north - south), length_text(length), ha="center", fontsize=8.5,
        color=INK, path_effects=_HALO, zorder=15,
    )  # fmt: skip


def _draw_north(axes: Axes) -> None:
    north = axes.annotate(
        "N", xy=(0.965, 0.965), xytext=(0.965, 0.875), xycoords="axes fraction", ha="center",
        va="center", fontsize=11, weight="bold", color=INK, path_effects=_HALO, zorder=15,
        arrowprops={"arrowstyle": "-|>", "color": INK, "lw": 1.6},
    )  # fmt: skip
    if north.arrow_patch is not None:
        north.arrow_patch.set_path_effects([*_HALO])
