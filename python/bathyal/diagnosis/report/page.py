# SPDX-License-Identifier: BSD-3-Clause
"""A diagnosis as one page of HTML that needs no network."""

from __future__ import annotations

import base64
import html
import io
import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import matplotlib
import numpy as np
from matplotlib.figure import Figure

from bathyal._core import BEYOND_NOISE
from bathyal.diagnosis.report.advice import next_steps
from bathyal.diagnosis.report.cards import causes_of, table
from bathyal.diagnosis.report.figure import (
    MOST_CURVES,
    VERDICT_SIGNS,
    curve_figure,
    curves_of,
    gain_figure,
    pair_figure,
    residual_figure,
    show_figure,
    support_figure,
)
from bathyal.diagnosis.report.numbers import (
    chance_text,
    gained_share_text,
    length_text,
    share_text,
)
from bathyal.diagnosis.report.panels import MOST_MARKS, MOST_PARTS
from bathyal.diagnosis.report.quantities import supports
from bathyal.diagnosis.report.style import PAGE
from bathyal.diagnosis.report.text import (
    VERDICTS,
    facts_of,
    headline,
    leftover_text,
    summary,
)
from bathyal.io.files import PathLike, replacing
from bathyal.view.palette import AFTER, GAP, INK, VERDICT_COLOURS
from bathyal.view.text import sentence

if TYPE_CHECKING:
    from bathyal._core import Diagnosis


def write_page(
    report: Diagnosis,
    path: PathLike,
    *,
    title: str = "",
    facts: Mapping[str, str] | None = None,
    step: Callable[[float, str], None] | None = None,
) -> None:
    """Save a diagnosis as one page: the verdict, what to do, then a picture for each step.

    Parameters
    ----------
    report : Diagnosis
    path : path
        ``.html``; everything is inside. The same bytes for the same report; the whole file or none
        of it. Pictures draw single rows thinned out where there are many, and say so.
    title : str
        What was diagnosed.
    facts : mapping of str to str, optional
        Lines for the box to the right of the text; `facts_of` unless given.
    step : callable, optional
        Called with the share that is done, 0 to 1, and what is being drawn.
    """
    step = step or (lambda share, text: None)
    drawings: dict[str, str] = {}
    for place, (name, (caption, draw)) in enumerate(_DRAWINGS.items()):
        step(place / len(_DRAWINGS), f"Drawing {caption}")
        figure = draw(report)
        drawings[name] = "" if figure is None else _image(figure, caption)
    page = PAGE.format(
        title=html.escape(title or f"{report.fit.arm.name or 'An arm'}, {len(report.data):,} rows"),
        ink=INK,
        red=GAP,
        blue=AFTER,
        verdict=VERDICT_COLOURS[report.verdict],
        sign=VERDICT_SIGNS[report.verdict],
        name=VERDICTS[report.verdict][0],
        headline=html.escape(_without_title(report)),
        tiles=_tiles(report),
        found=html.escape(summary(report, warnings=False)),
        warnings="".join(f"<p>{html.escape(warning)}</p>" for warning in report.warnings),
        wanting="".join(f"<li>{html.escape(text)}</li>" for text in next_steps(report)),
        facts=_facts(facts_of(report) if facts is None else facts),
        marks=_marks_text(report),
        structures=_structures(report),
        causes=causes_of(report),
        curves_note=_curves_note(report),
        model=_model(report),
        beyond=_beyond(report),
        held=html.escape(_held(report)),
        parts=_parts(report),
        residuals=_residuals(report),
        poses=_poses(report),
        **{f"{name}_picture": drawing for name, drawing in drawings.items()},
    )
    with replacing(path) as aside:
        aside.write_text(page, encoding="utf-8")
    step(1.0, "Drawn")


_MOST_SHOWN = 15  # dependences in the table
_DRAWINGS: dict[str, tuple[str, Callable[[Any], Figure | None]]] = {
    "show": ("residuals of geometry alone against each quantity", show_figure),
    "pair": ("residuals over pairs of quantities", pair_figure),
    "curve": ("what each cause adds to its joint", curve_figure),
    "support": (
        "where the data lie within the joints' limits, wide gaps left pale",
        support_figure,
    ),
    "gain": ("error on data held out, before and after", gain_figure),
    "residuals": ("residuals with the causes taken out", residual_figure),
}


def _image(figure: Figure, caption: str) -> str:
    """A drawing as an image inside the page: letters are outlines, so that no font is missing."""
    stream = io.BytesIO()
    with matplotlib.rc_context({"svg.hashsalt": "bathyal", "svg.fonttype": "path"}):
        figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    code = base64.b64encode(stream.getvalue()).decode("ascii")
    wide = figure.get_figwidth() * 96
    return (
        f"<img style='width:{wide:.0f}px' alt='{html.escape(caption, quote=True)}' "
        f"src='data:image/svg+xml;base64,{code}'>"
    )


# The verdict --------------------------------------------------------------------------------------


def _without_title(report: Diagnosis) -> str:
    text = headline(report).removeprefix(f"{VERDICTS[report.verdict][0]}: ").rstrip(".")
    return text[:1].upper() + text[1:]


def _tiles(report: Diagnosis) -> str:
    """The numbers that matter, large."""
    held = report.held_out
    tiles = []
    if report.verdict == "clean":
        least = min((s.p_value for s in report.shown), default=math.nan)
        chance = chance_text(least) if math.isfinite(least) else f"p > {BEYOND_NOISE}"
        tiles += [
            (length_text(report.detectable), "per axis would have been seen"),
            (chance, "for the most suspect structure"),
            (length_text(held.rms_before), "error on data held out (3-D rms)"),
        ]
    elif report.verdict == "none":
        tiles.append((f"{len(report.data):,}", "poses, none held out"))
    else:
        share, of_what = gained_share_text(report, report.gain).split(" of ")
        change = f"{length_text(held.rms_before)} → {length_text(held.rms_after)}"
        tiles += [
            (change, "error on data held out (3-D rms)"),
            (share, f"of {of_what} is gone"),
            (chance_text(held.p_value), "p-value of the gain"),
        ]
    if report.verdict == "unknown" and report.leftover is not None:
        tiles.append((length_text(report.leftover.size), "per axis has no name"))
    tiles.append((length_text(report.noise), f"noise per axis, by {report.noise_source}"))
    return "".join(
        f"<div><b>{html.escape(value)}</b><span>{html.escape(label)}</span></div>"
        for value, label in tiles
    )


def _facts(facts: Mapping[str, str]) -> str:
    return "".join(
        f"<tr><th>{html.escape(name)}</th><td>{html.escape(value)}</td></tr>"
        for name, value in facts.items()
    )


# Show ---------------------------------------------------------------------------------------------


def _marks_text(report: Diagnosis) -> str:
    count = len(report.data)
    rows = (
        f"{MOST_MARKS:,} of {count:,} rows are drawn, evenly chosen; the means are of all. "
        if count > MOST_MARKS
        else ""
    )
    return f"{rows}Marks that would lie outside a panel are drawn on its edge."


def _structures(report: Diagnosis) -> str:
    shown = sorted(report.shown, key=lambda s: (s.p_value, -s.size))
    if not shown:
        return f"<p>No structure that was looked for has a chance below {BEYOND_NOISE}.</p>"
    rows = [
        (
            s.against, length_text(s.size), share_text(s.share), chance_text(s.p_value),
            s.words, "strong" if s.is_beyond_noise else "weak",
        )
        for s in shown[:_MOST_SHOWN]
    ]  # fmt: skip
    head = ("against", "size per axis", "of variance above noise", "chance", "what it looks like")
    text = table(head, (row[:5] for row in rows), (row[5] for row in rows), kind="prose")
    if len(shown) > _MOST_SHOWN:
        text += f"<p>{len(shown) - _MOST_SHOWN} more are listed in report.json.</p>"
    return text


# Name -------------------------------------------------------------------------------------------


def _curves_note(report: Diagnosis) -> str:
    count = len(curves_of(report))
    if count == 0:
        return ""
    more = f" {MOST_CURVES} of {count} curves are drawn." if count > MOST_CURVES else ""
    return (
        "<p class='small'>What a cause adds to its joint. The band is its 95 % interval, from the "
        "numbers' own intervals taken as independent; ticks along the foot are the poses "
        f"measured.{more}</p>"
    )


# Extend -------------------------------------------------------------------------------------------


def _model(report: Diagnosis) -> str:
    if not report.effects:
        return "<p>The model is the arm that was identified; nothing is added to its geometry.</p>"
    listed = "".join(f"<li>{html.escape(effect.words)}</li>" for effect in report.effects)
    partial = (
        "" if report.verdict == "named" else
        "<p><b>Use it with care: the verdict does not vouch for these causes.</b></p>"
    )  # fmt: skip
    return (
        f"{partial}<p>The model is the arm that was identified, and inside it:</p><ul>{listed}</ul>"
    )


def _beyond(report: Diagnosis) -> str:
    """The covariates that were recorded, and their ranges."""
    rows = [
        (one.name, f"{one.low:.4g} … {one.high:.4g} {one.unit}".replace("-", "−"))
        for one in supports(report)
        if one.share is None
    ]
    return table(("range", "from … to"), rows) if rows else ""


# Measure the gain ---------------------------------------------------------------------------------


def _held(report: Diagnosis) -> str:
    return sentence(report.held_out.how or "No data could be held out")


def _residuals(report: Diagnosis) -> str:
    if not report.effects and not report.ambiguous:
        return ""
    return (
        f"<h3>Residuals with the causes taken out</h3><p>{html.escape(leftover_text(report))}</p>"
    )


def _parts(report: Diagnosis) -> str:
    held = report.held_out
    if report.verdict == "none":
        return ""
    rows = [("all held out", "", length_text(held.rms_before), length_text(held.rms_after))]
    if held.nested is not None:
        nested = length_text(held.nested.rms_after)
        rows.append((f"causes chosen anew for each of {held.nested.folds} parts", "", "", nested))
    parts = held.parts if len(held.parts) > 1 else []
    rows += [
        (part.name, f"{part.rows:,}", length_text(part.rms_before), length_text(part.rms_after))
        for part in parts
    ]
    whole = table(("", "rows", "before", "after"), rows)
    if len(rows) <= MOST_PARTS:
        return whole
    note = f"All {len(held.parts):,} parts; the picture shows the first {MOST_PARTS}."
    return f"<details><summary>{note}</summary>{whole}</details>"


# Next ---------------------------------------------------------------------------------------------


def _poses(report: Diagnosis) -> str:
    if report.next_poses is None or np.size(report.next_poses) == 0:
        return ""
    arm = report.fit.arm
    slides = [kind == "prismatic" for kind in arm.joint_types]
    head = ["", *(f"joint {k} [{'mm' if s else '°'}]" for k, s in enumerate(slides, 1))]
    rows = [
        [str(number)] + [f"{1e3 * q:.1f}" if s else f"{math.degrees(q):.2f}"
                         for q, s in zip(pose, slides, strict=True)]
        for number, pose in enumerate(np.atleast_2d(report.next_poses), 1)
    ]  # fmt: skip
    rows = [[cell.replace("-", "−") for cell in row] for row in rows]
    return (
        "<h2>Poses to measure next</h2><p>Here the causes that are left differ most. Measure them "
        f"as the others were, and diagnose again with all data together.</p>{table(head, rows)}"
    )
