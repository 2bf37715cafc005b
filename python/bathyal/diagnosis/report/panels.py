# SPDX-License-Identifier: BSD-3-Clause
"""What the pictures of a diagnosis are put together from, each drawn into axes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.ticker import MaxNLocator

from bathyal.diagnosis.report.curves import JointCurve
from bathyal.diagnosis.report.numbers import chance_text, length_text
from bathyal.diagnosis.report.quantities import (
    Binned,
    Quantity,
    Residuals,
    Support,
    binned,
    mapped,
)
from bathyal.identify.report.curves import thinned
from bathyal.view.palette import AFTER, BEFORE, COMPONENTS, INK

if TYPE_CHECKING:
    from bathyal._core import Diagnosis

MOST_MARKS = 1500
"""Rows that a panel draws one by one; means are always of all."""
MOST_PARTS = 30
"""Parts of what was held out that a picture shows."""
_SHAPES = ("o", "s", "^")
_INTERVAL = 1.96
_INSIDE = 0.98  # of the marks lie within the frame, the others on its edge
_SHOWN = 0.995  # of what a histogram counts lies left of its last bin
_BARS = 36
_GREY = "#8a8f98"
_DIVERGING = LinearSegmentedColormap.from_list(
    "residual", [COMPONENTS[2], "#f4f4f2", COMPONENTS[0]]
)
_LONGEST_NAME = 30
_MOST_TICKS = 6


def plain(text: str) -> str:
    """Text that no letter of is a command to the drawing library."""
    return " ".join(str(text).split()).replace("$", r"\$")


def shortened(text: str, most: int = _LONGEST_NAME) -> str:
    return plain(text if len(text) <= most else f"{text[: most - 1]}…")


def limit_of(known: Sequence[Quantity], residuals: Residuals) -> float:
    """Half the height of panels of residuals side by side [m]."""
    size = float(np.quantile(np.abs(residuals.world), _INSIDE)) if residuals.world.size else 0.0
    means = (binned(one, residuals.against(one)) for one in known)
    highest = max((float(np.max(np.abs(b.mean))) for b in means), default=0.0)
    return max(1.15 * max(size, highest), 1e-9)


def draw_against(
    axes: Axes,
    quantity: Quantity,
    residuals: Residuals,
    found: Any | None,
    *,
    limit: float,
    font: float = 8.0,
) -> None:
    """Residuals against one quantity: marks, and means with their 95 % intervals. `found` is the
    structure against it, where there is one; beyond noise it has a background of its own."""
    shown = residuals.against(quantity)
    rows = thinned(len(shown), MOST_MARKS)
    top = 1e3 * limit
    colours = COMPONENTS if quantity.joint is None else (INK,)
    for axis, colour in enumerate(colours):
        marks = np.clip(1e3 * shown[rows, axis], -top, top)
        axes.plot(
            quantity.values[rows], marks, ls="none", marker=_SHAPES[axis], ms=1.4, mew=0,
            color=colour, alpha=0.22, rasterized=True,
        )  # fmt: skip
    means = binned(quantity, shown)
    _draw_means(axes, means, colours)
    axes.axhline(0, color=_GREY, lw=0.6, zorder=1)
    axes.set(ylim=(-top, top))
    if means.by_value:
        axes.set_xticks(means.place[:: -(-len(means.place) // _MOST_TICKS)])
        axes.margins(x=0.2)
    else:
        axes.xaxis.set_major_locator(MaxNLocator(4))
    axes.yaxis.set_major_locator(MaxNLocator(5))
    _title(axes, found, font)
    dress(axes, plain(quantity.label), "", font)


def _draw_means(axes: Axes, means: Binned, colours: Sequence[str]) -> None:
    joined = not means.by_value
    width = float(np.ptp(means.place)) * (0.006 if joined else 0.05)
    for axis, colour in enumerate(colours):
        axes.errorbar(
            means.place + (axis - len(colours) // 2) * width, 1e3 * means.mean[:, axis],
            1e3 * _INTERVAL * means.error[:, axis], color=colour, marker=_SHAPES[axis], ms=3.2,
            lw=1.1 if joined else 0, elinewidth=0.9, mec="white", mew=0.4, zorder=3,
            label="xyz"[axis] if len(colours) > 1 else "along the joint's own way",
        )  # fmt: skip


def _title(axes: Axes, found: Any | None, font: float) -> None:
    if found is not None and found.is_beyond_noise:
        text = f"● {length_text(found.size)}, {chance_text(found.p_value)}"
        axes.set_title(text, fontsize=font, weight="bold", color=INK, loc="left", pad=4)
        axes.set_facecolor("#fff6e0")
    else:
        text = "nothing beyond noise" if found is None else f"noise, {chance_text(found.p_value)}"
        axes.set_title(text, fontsize=font, color=_GREY, loc="left", pad=4)


def draw_pair(
    axes: Axes,
    pair: tuple[Quantity, Quantity],
    residuals: Residuals,
    found: Any,
    *,
    limit: float,
    font: float = 8.0,
) -> None:
    """Mean residuals over two quantities at once."""
    across, up, cells = mapped(pair, residuals.world)
    mesh = axes.pcolormesh(
        across, up, 1e3 * cells, cmap=_DIVERGING, vmin=-1e3 * limit, vmax=1e3 * limit,
        rasterized=True,
    )  # fmt: skip
    bar = axes.figure.colorbar(mesh, ax=axes, pad=0.02, aspect=14)
    bar.ax.tick_params(labelsize=font - 1.5, length=2)
    bar.set_label("mm", fontsize=font - 1, color=INK, labelpad=1)
    _title(axes, found, font)
    axes.set_facecolor("white")
    axes.xaxis.set_major_locator(MaxNLocator(4))
    axes.yaxis.set_major_locator(MaxNLocator(4))
    dress(axes, plain(pair[0].label), plain(pair[1].label), font)


def draw_curve(axes: Axes, curve: JointCurve, *, font: float = 8.0) -> None:
    """What an effect adds to a joint, its band, and where the poses lie."""
    axes.fill_between(curve.place, curve.low, curve.high, color=AFTER, alpha=0.25, lw=0)
    axes.plot(curve.place, curve.middle, color=AFTER, lw=1.6)
    axes.axhline(0, color=_GREY, lw=0.6, zorder=0)
    foot = axes.get_xaxis_transform()
    seen = np.sort(curve.seen)[thinned(len(curve.seen), MOST_MARKS)]
    axes.plot(seen, np.full(len(seen), 0.02), "|", color=INK, ms=4, mew=0.4, alpha=0.4,
              transform=foot, rasterized=True)  # fmt: skip
    axes.margins(y=0.14)
    axes.xaxis.set_major_locator(MaxNLocator(5))
    axes.yaxis.set_major_locator(MaxNLocator(5))
    axes.set_title(shortened(curve.title, 52), fontsize=font, color=INK, loc="left", pad=4)
    dress(axes, plain(curve.across), plain(curve.up), font)


def draw_parts(axes: Axes, report: Diagnosis, *, font: float = 8.0) -> None:
    """Error on data held out before and after, in total and part by part, and noise."""
    held = report.held_out
    parts = list(held.parts)[:MOST_PARTS]
    rows = [("all held out", held.rms_before, held.rms_after)]
    if len(parts) > 1:
        rows += [(part.name, part.rms_before, part.rms_after) for part in parts]
    rows = [row for row in rows if math.isfinite(row[1]) and math.isfinite(row[2])]
    if not rows:
        _nothing(axes, "nothing was held out", font)
        return
    place = np.arange(len(rows))
    before, after = (1e3 * np.array([row[at] for row in rows]) for at in (1, 2))
    axes.hlines(place, before, after, color="#c9ccd1", lw=[2.4, *[1.2] * (len(rows) - 1)], zorder=1)
    style: dict[str, Any] = {"ls": "none", "ms": 6, "zorder": 3}
    axes.plot(before, place, marker="o", color=BEFORE, label="geometry alone", **style)
    axes.plot(after, place, marker="D", color=AFTER, label="with the causes", **style)
    axes.axvline(1e3 * held.noise, color=INK, lw=1.1, ls=(0, (4, 2)), label="noise")
    axes.set(ylim=(len(rows) - 0.4, -0.6), yticks=place)
    axes.set_yticklabels([shortened(row[0]) for row in rows])
    axes.set_xlim(0, 1.12 * max(*before, *after, 1e3 * held.noise, 1e-9))
    axes.legend(fontsize=font - 0.5, frameon=False, loc="lower center", ncols=3,
                bbox_to_anchor=(0.45, 1.0), handletextpad=0.3, columnspacing=1.0)  # fmt: skip
    dress(axes, "error on data held out, 3-D rms [mm]", "", font)


def draw_histogram(axes: Axes, report: Diagnosis, *, font: float = 8.0) -> None:
    """How far each row that was held out is from its prediction, before and after."""
    held = report.held_out
    errors = [
        (1e3 * values[np.isfinite(values)], colour, name)
        for values, colour, name in (
            (np.asarray(held.before, float), BEFORE, "geometry alone"),
            (np.asarray(held.after, float), AFTER, "with the causes"),
        )
    ]
    errors = [one for one in errors if one[0].size]
    if not errors:
        _nothing(axes, "nothing was held out", font)
        return
    end = max(float(np.quantile(values, _SHOWN)) for values, _, _ in errors)
    edges = np.linspace(0, max(end, 1e-9), _BARS + 1)
    for values, colour, name in errors:
        counts = np.histogram(np.minimum(values, edges[-1]), edges)[0]
        axes.stairs(counts, edges, fill=True, color=colour, alpha=0.22, lw=0)
        axes.stairs(counts, edges, color=colour, lw=1.6, label=name,
                    ls="-" if colour == AFTER else (0, (5, 1.5)))  # fmt: skip
    axes.axvline(1e3 * held.noise, color=INK, lw=1.1, ls=(0, (4, 2)), label="noise (rms)")
    axes.set_xlim(0, edges[-1])
    axes.set_ylim(bottom=0)
    axes.legend(fontsize=font - 0.5, frameon=False, loc="upper right")
    axes.yaxis.set_major_locator(MaxNLocator(5, integer=True))
    dress(axes, "error of a row held out [mm]; the last bar holds all beyond", "rows", font)


def draw_supports(axes: Axes, ranges: Sequence[Support], *, font: float = 8.0) -> None:
    """Where the data lie within what each joint can do."""
    ranges = [one for one in ranges if one.share is not None]
    if not ranges:
        _nothing(axes, "no joint has limits", font)
        return
    for place, one in enumerate(ranges):
        assert one.least is not None
        assert one.most is not None
        way = one.most - one.least
        left, wide = (one.low - one.least) / way, (one.high - one.low) / way
        axes.barh(place, 1, color="#ececea", height=0.62)
        axes.barh(place, wide, left=left, color=AFTER, height=0.62)
        for low, high in one.gaps:
            share = (high - low) / way
            axes.barh(place, share, left=(low - one.least) / way, color="#ececea", height=0.62)
        unit = "°" if one.unit == "°" else f" {one.unit}"
        text = f"{one.low:.0f} … {one.high:.0f}{unit}".replace("-", "−")
        limits = f"of {one.least:.0f} … {one.most:.0f}{unit}".replace("-", "−")
        axes.text(1.02, place, f"{text} {limits}", va="center", fontsize=font, color=INK)
    axes.set(ylim=(len(ranges) - 0.5, -0.5), xlim=(0, 1), xticks=[], yticks=range(len(ranges)))
    axes.set_yticklabels([shortened(one.name) for one in ranges])
    dress(axes, "", "", font)
    axes.tick_params(axis="y", length=0)
    for side in ("bottom", "left"):
        axes.spines[side].set_visible(False)


def _nothing(axes: Axes, text: str, font: float) -> None:
    axes.text(0.5, 0.5, text, ha="center", va="center", fontsize=font + 1, color=_GREY,
              transform=axes.transAxes)  # fmt: skip
    axes.set(xticks=[], yticks=[])
    dress(axes, "", "", font)


def dress(axes: Axes, across: str, up: str, font: float) -> None:
    axes.set_xlabel(across, fontsize=font, color=INK, labelpad=2)
    axes.set_ylabel(up, fontsize=font, color=INK, labelpad=2)
    axes.tick_params(labelsize=font - 0.8, length=2.5, pad=2)
    axes.xaxis.get_offset_text().set_fontsize(font - 1.5)
    axes.yaxis.get_offset_text().set_fontsize(font - 1.5)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
