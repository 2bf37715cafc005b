# SPDX-License-Identifier: BSD-3-Clause
"""The table of parameters as a picture: numbers, a bar each, what became of it."""

from __future__ import annotations

import math
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from bathyal._core import ArmFit
from bathyal.identify.report.tables import INTERVAL, Line, bar_limit, lines
from bathyal.identify.report.text import STATUS
from bathyal.view.palette import INK, STATUSES
from bathyal.view.text import number

_MOST_LINES = 40
# Shares of the table's width: right ends of the columns of numbers, the bars, the status.
_NOMINAL, _VALUE, _CHANGE = 0.175, 0.282, 0.458
_BARS = (0.470, 0.185)
_STATUS_AT, _TRADES = 0.668, 0.812
_TRADES_WIDE = 40


def draw_parameters(figure: Figure, fit: ArmFit, place: tuple[float, float, float, float]) -> None:
    """Draw the table into `place` (left, bottom, width, height of the figure)."""
    shown = _shown(lines(fit))
    left, bottom, width, height = place
    axes = figure.add_axes((left + _BARS[0] * width, bottom, _BARS[1] * width, height))
    axes.set(ylim=(len(shown) - 0.5, -1.6))
    step = height * figure.get_figheight() * 72 / (len(shown) + 1.1)
    size = min(6.8, 0.78 * step)
    limit = bar_limit(shown)
    for row, line in enumerate(shown):
        _draw_bar(axes, row, line)
        _write_line(axes, row, line, size)
    _write_titles(axes, size)
    axes.set(xlim=(-limit, limit), yticks=[])
    axes.axvline(0, color=INK, lw=0.6)
    axes.xaxis.set_major_locator(MaxNLocator(5))
    axes.tick_params(labelsize=6.5, length=2.5, pad=2)
    axes.set_xlabel("change from nominal, with 95 % interval [mm, mrad]", fontsize=7, color=INK,
                    labelpad=2)  # fmt: skip
    for side in ("top", "right", "left"):
        axes.spines[side].set_visible(False)


def _shown(table: list[Line]) -> list[Line]:
    """All that fit on the sheet; those that are held go first."""
    if len(table) <= _MOST_LINES:
        return table
    free = [line for line in table if line.status not in ("gauge", "fixed")]
    return free[:_MOST_LINES]


def _draw_bar(axes: Axes, row: int, line: Line) -> None:
    if row % 2 == 0:
        axes.axhspan(row - 0.5, row + 0.5, color="#f4f4f2", lw=0, zorder=0)
    colour = STATUSES[line.status]
    axes.barh(row, line.change, height=0.62, color=colour, zorder=2)
    if math.isfinite(line.std) and line.std > 0:
        interval = INTERVAL * line.std
        ends = [line.change - interval, line.change + interval]
        axes.plot(ends, [row, row], color=INK, lw=0.9, zorder=3)
    elif math.isinf(line.std):
        axes.plot([0], [row], marker="x", ms=4, color=colour, zorder=3)


def _write_line(axes: Axes, row: int, line: Line, size: float) -> None:
    put = _writer(axes, size)
    put(0.0, row, line.name, "left", INK)
    put(_NOMINAL, row, f"{number(line.nominal)} {line.unit}", "right", INK)
    put(_VALUE, row, f"{number(line.value)} {line.unit}", "right", INK)
    put(_CHANGE, row, line.changed, "right", INK)
    put(_STATUS_AT, row, STATUS[line.status], "left", STATUSES[line.status])
    trades = f"with {line.trades}" if line.trades else ""
    if len(trades) > _TRADES_WIDE:
        trades = trades[: _TRADES_WIDE - 1].rsplit(", ", 1)[0] + " …"
    put(_TRADES, row, trades, "left", "#555555", 0.82 * size)


def _write_titles(axes: Axes, size: float) -> None:
    put = _writer(axes, size)
    for at, text, side in (
        (0.0, "parameter", "left"), (_NOMINAL, "nominal", "right"), (_VALUE, "found", "right"),
        (_CHANGE, "change ± std", "right"), (_STATUS_AT, "the data", "left"),
        (_TRADES, "null space", "left"),
    ):  # fmt: skip
        put(at, -1.0, text, side, INK, weight="bold")


def _writer(axes: Axes, size: float) -> Any:
    """Writes at a share of the table's width, in a row."""
    transform = axes.get_yaxis_transform()

    def put(
        at: float, row: float, text: str, side: str, colour: str, font: float = size,
        weight: str = "normal",
    ) -> None:  # fmt: skip
        x = (at - _BARS[0]) / _BARS[1]
        axes.text(x, row, text, ha=side, va="center", fontsize=font, color=colour,
                  transform=transform, clip_on=False, weight=weight)  # fmt: skip

    return put
