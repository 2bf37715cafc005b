# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of a diagnosis: one for each step, and a sheet with all of it."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from bathyal.diagnosis.report.curves import JointCurve, joint_curve
from bathyal.diagnosis.report.panels import (
    MOST_PARTS,
    draw_against,
    draw_curve,
    draw_histogram,
    draw_pair,
    draw_parts,
    draw_supports,
    limit_of,
    plain,
)
from bathyal.diagnosis.report.quantities import (
    Quantity,
    Residuals,
    concerns,
    pair_of,
    quantities,
    residuals_of,
    supports,
)
from bathyal.diagnosis.report.text import evidence_texts, headline, significant, summary
from bathyal.view.palette import GAP, INK, VERDICT_COLOURS

if TYPE_CHECKING:
    from bathyal._core import Diagnosis

MOST_CURVES = 12
"""Curves that the page draws; its table lists the others."""
VERDICT_SIGNS = {"clean": "✔", "named": "◆", "ambiguous": "≈", "unknown": "?", "none": "○"}
"""What says a verdict without colour."""
_WIDE = 11.0  # in, of a picture on the page
_PANEL = 1.95  # in, height of a row of panels
_ABREAST = 4
_MARGINS = (0.56, 0.10, 0.42, 0.22)  # in, of a panel: left, right, foot, head
_MOST_PAIRS = 3
_DPI = 110
# The sheet: A4 upright; places are shares of the page.
_SIZE_IN = (8.27, 11.69)
_SHEET_DPI = 160
_LEFT, _RIGHT = 0.07, 0.97
_LAST_ROW = ((0.17, 0.37), (0.60, 0.37))  # left ends and widths
_BANNER = 0.052
_LINE = 0.0128
_LETTERS = 122
_ON_SHEET = 8  # panels of step one
_TALLEST = 0.19  # of a row
_CURVES_ON_SHEET = 2
_EVIDENCE_LETTERS = 44  # in a line, of a third of the sheet
_WARNINGS_SHOWN = 4
_MOST_LINES = 16  # of the paragraph


def show_figure(report: Diagnosis) -> Figure:
    """Step one: residuals of geometry alone against every recorded quantity; what is
    beyond noise is framed."""
    return _against_all(report, residuals_of(report, report.residuals_before), list(report.shown))


def pair_figure(report: Diagnosis) -> Figure | None:
    """Step one, where two quantities together are beyond noise; None where none are."""
    known = quantities(report)
    pairs = [
        (pair, structure)
        for structure in significant(report.shown)
        if (pair := pair_of(structure, known)) is not None
    ][:_MOST_PAIRS]
    if not pairs:
        return None
    residuals = residuals_of(report, report.residuals_before)
    limit = limit_of([], residuals)
    margins = (0.62, 0.25, 0.42, 0.26)
    figure, grid = _panels((3.2, 2.5), len(pairs), min(3, len(pairs)), margins)
    for axes, (pair, structure) in zip(grid, pairs, strict=True):
        draw_pair(axes, pair, residuals, structure, limit=limit)
    return figure


def residual_figure(report: Diagnosis) -> Figure | None:
    """The same with the causes taken out, on a scale of its own; None where none were."""
    if not report.effects and not report.ambiguous:
        return None
    left = [] if report.leftover is None else [report.leftover]
    return _against_all(report, residuals_of(report, report.residuals_after), left)


def curve_figure(report: Diagnosis) -> Figure | None:
    """Step two: what each effect adds to its joint; None where no effect is a joint's curve."""
    curves = curves_of(report)[:MOST_CURVES]
    if not curves:
        return None
    figure, grid = _panels((_WIDE / 3, 2.5), len(curves), min(3, len(curves)))
    for axes, curve in zip(grid, curves, strict=True):
        draw_curve(axes, curve)
    return figure


def support_figure(report: Diagnosis) -> Figure:
    """Step three: where the data lie within the joints' limits."""
    ranges = supports(report)
    figure, (axes,) = _panels((8.6, 0.2 + 0.28 * len(ranges)), 1, 1, (2.3, 2.6, 0.1, 0.1))
    draw_supports(axes, ranges)
    return figure


def gain_figure(report: Diagnosis) -> Figure | None:
    """Step four: error on data held out, part by part and row by row; None where nothing was."""
    if report.verdict == "none":
        return None
    parts = min(len(report.held_out.parts), MOST_PARTS)
    high = max(2.9, 1.0 + 0.24 * parts)
    figure = _figure(_WIDE, high)
    foot, tall = 0.45 / high, (high - 0.8) / high
    draw_parts(figure.add_axes((0.15, foot, 0.38, tall)), report)
    draw_histogram(figure.add_axes((0.60, foot, 0.39, tall)), report)
    return figure


def curves_of(report: Diagnosis) -> list[JointCurve]:
    """The curve of each effect that has one."""
    found = (joint_curve(report, effect) for effect in report.effects)
    return [curve for curve in found if curve is not None]


def diagnosis_figure(report: Diagnosis, *, title: str = "") -> Figure:
    """Draw a diagnosis on one sheet: the verdict, the paragraph, and a picture of each step.

    Parameters
    ----------
    report : Diagnosis
    title : str
        What was diagnosed, above the verdict.

    Returns
    -------
    matplotlib.figure.Figure
        With an Agg canvas of its own: no window, and nothing of pyplot's state is touched.
    """
    figure = Figure(figsize=_SIZE_IN, dpi=_SHEET_DPI, facecolor="white")
    FigureCanvasAgg(figure)
    top = _write_banner(figure, report, title)
    top = _write(figure, top, [(summary(report, warnings=False), INK)], _MOST_LINES)
    warnings = list(report.warnings)
    shown = warnings[:_WARNINGS_SHOWN]
    if len(warnings) > len(shown):
        shown.append(f"… and {len(warnings) - len(shown)} more in report.html")
    top = _write(figure, top, [(f"! {warning}", GAP) for warning in shown], 3)
    _draw_sheet(figure, report, top - 0.012)
    return figure


def _write_banner(figure: Figure, report: Diagnosis, title: str) -> float:
    """The verdict across the sheet, to be read from two metres."""
    top = 0.985
    if title:
        figure.text(_LEFT, top, plain(title), fontsize=9, color=INK, va="top")
        top -= 0.022
    colour = VERDICT_COLOURS[report.verdict]
    lines = textwrap.wrap(headline(report), 52, max_lines=3, placeholder=" …")
    height = _BANNER * (0.4 + 0.6 * len(lines))
    figure.add_artist(
        _box((_LEFT - 0.01, top - height), _RIGHT - _LEFT + 0.02, height, colour, figure)
    )
    figure.text(
        _LEFT + 0.004, top - height / 2, VERDICT_SIGNS[report.verdict], fontsize=21, color="white",
        va="center", weight="bold",
    )  # fmt: skip
    figure.text(
        _LEFT + 0.052, top - height / 2, "\n".join(map(plain, lines)), fontsize=15.5,
        color="white", va="center", weight="bold", linespacing=1.15,
    )  # fmt: skip
    return top - height - 0.012


def _box(corner: tuple[float, float], wide: float, high: float, colour: str, figure: Figure) -> Any:
    from matplotlib.patches import Rectangle

    return Rectangle(corner, wide, high, color=colour, transform=figure.transFigure, zorder=-1)


def _write(figure: Figure, top: float, paragraphs: Sequence[tuple[str, str]], most: int) -> float:
    """Paragraphs of `most` lines each; returns where the next may begin."""
    for text, colour in paragraphs:
        lines = _wrapped(text, _LETTERS)
        if len(lines) > most:
            lines = [*lines[: most - 1], "… the rest is in report.html"]
        figure.text(
            _LEFT, top, "\n".join(map(plain, lines)), va="top", fontsize=8, color=colour,
            linespacing=1.25,
        )  # fmt: skip
        top -= _LINE * len(lines) + 0.004
    return top


def _wrapped(text: str, letters: int) -> list[str]:
    """Lines, none of which parts a chance from its number."""
    lines = textwrap.wrap(text.replace("p < ", "p\u00a0<\u00a0"), letters)
    return [line.replace("\u00a0", " ") for line in lines]


def _draw_sheet(figure: Figure, report: Diagnosis, top: float) -> None:
    """Rows of pictures below the text: what is there, the curves, the gain."""
    curves = curves_of(report)[:_CURVES_ON_SHEET]
    residuals = residuals_of(report, report.residuals_before)
    known = quantities(report)
    order = sorted(known, key=lambda one: _chance(one, list(report.shown)))
    held_out = report.verdict != "none"
    chosen = [one for one in known if one in order[: _ON_SHEET if held_out else 2 * _ON_SHEET]]
    down = -(-len(chosen) // _ABREAST)
    shares = [1.0] * down + ([1.25] if curves else []) + ([1.35] if held_out else [])
    height = min(top / sum(shares), _TALLEST)
    bands = []
    for share in shares:
        bands.append((top - share * height, share * height))
        top -= share * height
    limit = limit_of(chosen, residuals)
    grid = []
    for k, one in enumerate(chosen):
        bottom, high = bands[k // _ABREAST]
        axes = figure.add_axes(_cell(k % _ABREAST, _ABREAST, bottom, high))
        grid.append(axes)
        found = _structure(one, list(report.shown))
        draw_against(axes, one, residuals, found, limit=limit, font=6.5)
        if k % _ABREAST == 0:
            axes.set_ylabel("residual [mm]", fontsize=6.5, color=INK, labelpad=1)
    _legends(grid, chosen, 6)
    for k, curve in enumerate(curves):
        axes = figure.add_axes(_cell(k, 3, *bands[down]))
        draw_curve(axes, curve, font=6.5)
    if curves:
        _write_evidence(figure, report, len(curves), *bands[down])
    if not held_out:
        return
    bottom, high = bands[-1]
    places = [(left, bottom + 0.03, wide, high - 0.055) for left, wide in _LAST_ROW]
    draw_parts(figure.add_axes(places[0]), report, font=6.5)
    draw_histogram(figure.add_axes(places[1]), report, font=6.5)


def _write_evidence(
    figure: Figure, report: Diagnosis, curves: int, bottom: float, height: float
) -> None:
    """Why these causes, to the right of their curves."""
    left = _cell(curves, 3, bottom, height)[0]
    letters = int(_EVIDENCE_LETTERS * (3 - curves))
    lines = [line for text in evidence_texts(report) for line in _wrapped(text, letters)]
    most = int(height / _LINE) - 3
    if len(lines) > most:
        lines = [*lines[: most - 1], "… the rest is in report.html"]
    figure.text(
        left, bottom + height - 0.023, "\n".join(map(plain, ["Why these", *lines])), va="top",
        fontsize=7.5, color=INK, linespacing=1.3,
    )  # fmt: skip


def _cell(
    place: int, abreast: int, bottom: float, height: float
) -> tuple[float, float, float, float]:
    step = (_RIGHT - _LEFT + 0.02) / abreast
    return (_LEFT + place * step, bottom + 0.024, 0.82 * step, height - 0.047)


def _against_all(report: Diagnosis, residuals: Residuals, found: list[Any]) -> Figure:
    known = quantities(report)
    abreast = min(_ABREAST, len(known))
    figure, grid = _panels((_WIDE / _ABREAST, _PANEL), len(known), abreast)
    limit = limit_of(known, residuals)
    for k, one in enumerate(known):
        draw_against(grid[k], one, residuals, _structure(one, found), limit=limit)
        if k % abreast == 0:
            grid[k].set_ylabel("residual [mm]", fontsize=8, color=INK, labelpad=2)
    _legends(grid, known, 7.5)
    return figure


def _legends(grid: Sequence[Any], known: Sequence[Quantity], font: float) -> None:
    """In the first panel of each kind: along a joint, or by axis."""
    kinds = [one.joint is None for one in known]
    for place in {kinds.index(kind) for kind in kinds}:
        grid[place].legend(
            fontsize=font, frameon=False, ncols=3, loc="upper left", handletextpad=0.2,
            columnspacing=0.8, borderaxespad=0.1,
        )  # fmt: skip


def _structure(quantity: Quantity, found: list[Any]) -> Any | None:
    """The most certain structure against a quantity."""
    own = [structure for structure in found if concerns(structure, quantity)]
    return min(own, key=lambda structure: structure.p_value, default=None)


def _chance(quantity: Quantity, found: list[Any]) -> float:
    structure = _structure(quantity, found)
    return 1.0 if structure is None else float(structure.p_value)


def _figure(wide: float, high: float) -> Figure:
    figure = Figure(figsize=(wide, high), dpi=_DPI, facecolor="white")
    FigureCanvasAgg(figure)
    return figure


def _panels(
    size: tuple[float, float],
    count: int,
    abreast: int,
    margins: tuple[float, float, float, float] = _MARGINS,
) -> tuple[Figure, list[Axes]]:
    """A figure of so many panels, `size` [in] each with its margins: left, right, foot, head."""
    wide, high = size
    left, right, foot, head = margins
    down = -(-count // abreast)
    figure = _figure(wide * abreast, high * down)
    places = [(k % abreast, down - 1 - k // abreast) for k in range(count)]
    grid = [
        figure.add_axes(
            (
                (column * wide + left) / (wide * abreast),
                (row * high + foot) / (high * down),
                (wide - left - right) / (wide * abreast),
                (high - foot - head) / (high * down),
            )
        )
        for column, row in places
    ]
    return figure, grid
