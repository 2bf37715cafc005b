# SPDX-License-Identifier: BSD-3-Clause
"""The picture of an identification: one sheet with what was found, how surely, and residuals."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from bathyal._core import ArmFit, Touches, Tracked
from bathyal.arm.joint_values import joint_values
from bathyal.identify.report.bars import draw_parameters
from bathyal.identify.report.curves import (
    AXIS_COLOURS,
    Curves,
    curves_of,
    rank_gap,
    thinned,
)
from bathyal.identify.report.text import known_text, next_touches, surely_text
from bathyal.view.palette import AFTER, BEFORE, GAP, INK

# A4 upright; places are shares of the page.
_SIZE_IN = (8.27, 11.69)
_DPI = 160
_LEFT, _RIGHT = 0.085, 0.965
_LINE = 0.0118  # between two lines of text
_COLUMNS = 128  # letters in a line
_WARNINGS_SHOWN = 5
_TOP, _FOOT = 0.975, 0.045
_GAP = 0.047  # between two rows of plots
_FIRST_ROW, _LAST_ROW = 0.27, 0.19  # shares of what the text leaves; the table has the rest
_CROWD = 1500  # marks that are drawn finer
_MOST_PANELS = 10
_MOST_TITLES = 8  # of points side by side


def fit_figure(fit: ArmFit, data: Touches | Tracked, *, title: str = "") -> Figure:
    """Draw an identification on one sheet.

    Warnings and the fit's own summary; distances of every pair of touches of one point before and
    after (figure 4 of Yukhimets, Gubankov 2023), of tracked poses from where they were seen; the
    singular values; each parameter's change with its 95 % interval; residuals against each
    joint.

    Parameters
    ----------
    fit : ArmFit
    data : Touches or Tracked
        What it was found from.
    title : str

    Returns
    -------
    matplotlib.figure.Figure
        With an Agg canvas of its own: no window, and nothing of pyplot's state is touched.

    Examples
    --------
    >>> import bathyal
    >>> from bathyal.identify.simulate import simulate_touches
    >>> touches = simulate_touches(bathyal.arms.ur10e(), count=8).touches
    >>> fit = bathyal.identify_arm(bathyal.arms.ur10e(), touches)
    >>> len(fit_figure(fit, touches).axes)
    9
    """
    figure = Figure(figsize=_SIZE_IN, dpi=_DPI, facecolor="white")
    FigureCanvasAgg(figure)
    top = _write_text(figure, fit, data, title)
    height = top - _FOOT - 2 * _GAP
    width = _RIGHT - _LEFT

    first = _FIRST_ROW * height
    bottom = top - first
    _draw_curves(figure.add_axes((_LEFT, bottom, 0.60 * width, first)), curves_of(fit, data))
    _draw_singular_values(figure.add_axes((_LEFT + 0.70 * width, bottom, 0.30 * width, first)), fit)
    last = _LAST_ROW * height
    table = height - first - last
    draw_parameters(figure, fit, (_LEFT, bottom - 0.8 * _GAP - table, width, table))
    _draw_residuals(figure, fit, data, (_LEFT, _FOOT, width, last))
    return figure


def _write_text(figure: Figure, fit: ArmFit, data: Touches | Tracked, title: str) -> float:
    """Title, warnings, paragraphs; returns where the plots may begin."""
    top = _TOP
    if title:
        figure.text(_LEFT, top, title, fontsize=13, weight="bold", color=INK, va="top")
        top -= 0.026
    warnings = list(fit.warnings[:_WARNINGS_SHOWN])
    if len(fit.warnings) > len(warnings):
        warnings.append(f"… and {len(fit.warnings) - len(warnings)} more in report.html")
    top = _write(figure, top, [(f"! {warning}", GAP) for warning in warnings])
    known = known_text(fit, data)
    paragraphs = [
        fit.summary(warnings=False),
        surely_text(fit),
        *([known] if known else []),
        "Next. " + " ".join(next_touches(fit, data)),
    ]
    return _write(figure, top, [(text, INK) for text in paragraphs]) - 0.03


def _write(figure: Figure, top: float, paragraphs: Sequence[tuple[str, str]]) -> float:
    for text, colour in paragraphs:
        wrapped = textwrap.wrap(text, _COLUMNS)
        figure.text(
            _LEFT, top, "\n".join(wrapped), va="top", fontsize=7.5, color=colour, linespacing=1.25
        )
        top -= _LINE * len(wrapped) + 0.004
    return top


def _draw_curves(axes: Axes, curves: Curves) -> None:
    """Before and after, one mark a pair or a pose, group after group."""
    start = 0
    style: dict[str, Any] = {"ls": "none", "marker": ".", "ms": 2.0, "rasterized": True}
    edges = [0]
    for curve in curves.curves:
        place = start + np.arange(len(curve.before))
        first = start == 0
        for values, colour, name in (
            (curve.before, BEFORE, "before"),
            (curve.after, AFTER, "after"),
        ):
            axes.plot(place, 1e3 * values, color=colour, label=name if first else None, **style)
        for rms, colour in ((curve.rms_before, BEFORE), (curve.rms_after, AFTER)):
            axes.hlines(1e3 * rms, place[0], place[-1], color=colour, lw=1.1)
        start += len(curve.before)
        edges.append(start)
    for edge in edges[1:-1]:
        axes.axvline(edge - 0.5, color="#bbbbbb", lw=0.6)
    low, high = curves.limits
    axes.set(xlim=(-0.5, start - 0.5), yscale="log", ylim=(1e3 * low, 1e3 * high))
    if len(curves.curves) <= _MOST_TITLES:
        for curve, left, right in zip(curves.curves, edges[:-1], edges[1:], strict=True):
            text = f"{curve.name}\n{1e3 * curve.rms_before:.3g} → {1e3 * curve.rms_after:.3g} mm"
            axes.text(
                (left + right) / 2, 1.01, text, transform=axes.get_xaxis_transform(),
                ha="center", va="bottom", fontsize=6.5, color=INK,
            )  # fmt: skip
    axes.legend(
        loc="lower left", fontsize=6.5, frameon=True, framealpha=0.8, markerscale=3, ncols=2
    )
    _dress(axes, curves.across, f"{curves.what} [mm]")


def _draw_singular_values(axes: Axes, fit: ArmFit) -> None:
    values, low = rank_gap(fit)
    place = np.arange(1, len(values) + 1)
    seen = place <= fit.rank
    for some, colour in ((seen, AFTER), (~seen, GAP)):
        axes.vlines(place[some], low, values[some], color=colour, lw=1.2, alpha=0.5)
        axes.plot(place[some], values[some], ".", color=colour, ms=4)
    axes.set(yscale="log", ylim=(low, 4 * values[0]), xlim=(0, len(values) + 1))
    if fit.rank < len(values):
        axes.axvspan(fit.rank + 0.5, len(values) + 0.5, color=GAP, alpha=0.06, lw=0)
    axes.set_title(f"rank {fit.rank} of {len(values)}", fontsize=7.5, color=INK)
    axes.xaxis.set_major_locator(MaxNLocator(5, integer=True))
    _dress(axes, "direction", "singular value [mm per mm, mrad]")


def _draw_residuals(
    figure: Figure, fit: ArmFit, data: Touches | Tracked, place: tuple[float, float, float, float]
) -> None:
    """One panel a joint: the three components of the residuals."""
    left, bottom, width, height = place
    joints = joint_values(fit.arm, data)[:_MOST_PANELS]
    rows = thinned(len(data))
    residuals = 1e3 * fit.residuals[rows]
    limit = 1.08 * max(float(np.max(np.abs(residuals))), 1e-12)
    step = width / len(joints)
    size, opacity = (2.2, 0.7) if len(rows) <= _CROWD else (1.2, 0.35)
    for k, joint in enumerate(joints):
        axes = figure.add_axes((left + k * step, bottom, 0.92 * step, height))
        for axis, colour in enumerate(AXIS_COLOURS):
            axes.plot(
                joint.values[rows], residuals[:, axis], ".", color=colour, ms=size, alpha=opacity,
                label="xyz"[axis], rasterized=True,
            )  # fmt: skip
        axes.axhline(0, color="#bbbbbb", lw=0.6, zorder=0)
        axes.set(ylim=(-limit, limit))
        axes.xaxis.set_major_locator(MaxNLocator(3))
        _dress(axes, f"{joint.name} [{joint.unit}]", "residual [mm]" if k == 0 else "")
        if k > 0:
            axes.set_yticklabels([])
        else:
            axes.legend(
                loc="upper left", fontsize=6, frameon=False, ncols=3, handletextpad=0.1,
                columnspacing=0.6, borderaxespad=0.1, markerscale=2,
            )  # fmt: skip


def _dress(axes: Axes, across: str, up: str) -> None:
    axes.set_xlabel(across, fontsize=7, color=INK, labelpad=2)
    axes.set_ylabel(up, fontsize=7, color=INK, labelpad=2)
    axes.tick_params(labelsize=6.5, length=2.5, pad=2)
    axes.yaxis.get_offset_text().set_fontsize(6)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
