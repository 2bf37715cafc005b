# SPDX-License-Identifier: BSD-3-Clause
"""The causes on the page of a diagnosis: a card each, with numbers, evidence and alternatives."""

from __future__ import annotations

import html
import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from bathyal.diagnosis.report.numbers import (
    chance_text,
    estimate_text,
    gained_share_text,
    is_setting,
    length_text,
    odds_text,
    parameter_name,
    setting_text,
)
from bathyal.diagnosis.report.text import amplitude_text, groups_of, is_of_noise, noise_evidence

if TYPE_CHECKING:
    from bathyal._core import Diagnosis

_FAR = 1e-3  # odds of alternatives that are not listed
_MOST_OUTLIERS = 200


def causes_of(report: Diagnosis) -> str:
    """What was named, or why nothing was, as HTML."""
    parts = []
    if report.verdict == "clean":
        parts.append("<p>Nothing is beyond noise, so there is nothing to name.</p>")
    if report.verdict == "none":
        parts.append("<p>No data could be held out, so nothing is named.</p>")
    if report.verdict == "unknown":
        partial = "What follows explains a part, and a part is not the cause." if report.effects \
            else "Nothing in the library explains it."  # fmt: skip
        parts.append(f"<p>{partial}</p>")
    if report.ambiguous:
        parts.append("<p>The data do not distinguish:</p>")
        parts += [f"<div class='card'>{_alternatives(group)}</div>" for group in groups_of(report)]
    parts += [_card(report, effect) for effect in report.effects]
    return "".join(parts)


def _card(report: Diagnosis, effect: Any) -> str:
    """A cause: its numbers to the left, the evidence to the right."""
    numbers_of = effect.parameters.items()
    texts = [setting_text(name, float(one.value)) for name, one in numbers_of if is_setting(one)]
    settings = [text for text in texts if text]
    amplitude = amplitude_text(effect)
    rows = [("amplitude", amplitude)] if amplitude else []
    rows += [
        (parameter_name(name), estimate_text(name, one))
        for name, one in numbers_of
        if not is_setting(one)
    ]
    numbers = table(("", "value (95 % interval)"), rows) if rows else ""
    if len(effect.rows):
        listed = ", ".join(str(row) for row in effect.rows[:_MOST_OUTLIERS])
        rest = len(effect.rows) - _MOST_OUTLIERS
        listed += f" and {rest:,} more" if rest > 0 else ""
        numbers += f"<p>Rows, counted from 0: {listed}</p>"
    evidence = _evidence(report, effect)
    name = f"<code>{html.escape(effect.name)}</code>"
    form = f" · {html.escape(', '.join(settings))}" if settings else ""
    bar = "" if is_of_noise(effect) else _bar(effect.gain)
    heading = html.escape(effect.words[:1].upper() + effect.words[1:])
    near = [other for other in effect.rivals if other.odds >= _FAR]
    far = "Alternatives that explain the same:" if near else _far(effect)
    note = "" if is_of_noise(effect) else far
    return (
        f"<div class='card'><h3>{heading}</h3><p class='small'>{name}{form}</p>"
        f"{bar}<div class='sides'><div>{numbers}</div><div>{evidence}</div></div>"
        f"<p class='small'>{html.escape(note)}</p>{_alternatives(near)}</div>"
    )


def _far(effect: Any) -> str:
    if not effect.rivals:
        return "It has no alternative."
    best = max(effect.rivals, key=lambda other: other.odds)
    return f"No alternative comes near: the next best, {best.words}, has {odds_text(best.odds)}."


def _bar(share: float) -> str:
    wide = 100 * min(max(share, 0.0), 1.0) if math.isfinite(share) else 0.0
    return f"<div class='gain'><i style='width:{wide:.1f}%'></i></div>"


def _evidence(report: Diagnosis, effect: Any) -> str:
    if is_of_noise(effect):
        return f"<p>{html.escape(noise_evidence(effect))}</p>"
    share, of_what = gained_share_text(report, effect.gain).split(" of ")
    return table(
        ("evidence", ""),
        [
            (f"of {of_what}", share),
            ("error held out without it", length_text(effect.held_out_before)),
            ("error held out with it", length_text(effect.held_out_after)),
            ("moves the tip, per axis", length_text(effect.size)),
            ("chance", chance_text(effect.p_value)),
        ],
    )


def _alternatives(causes: Sequence[Any]) -> str:
    if not causes:
        return ""
    rows = "".join(
        f"<tr><td>{html.escape(cause.words)}</td><td class='odds'>"
        f"<i style='width:{100 * min(max(cause.odds, 0.0), 1.0):.1f}%'></i></td>"
        f"<td>{'the best' if cause.odds >= 1 else odds_text(cause.odds)}</td></tr>"
        for cause in causes
    )
    return f"<table>{rows}</table>"


def table(
    head: Sequence[str],
    rows: Iterable[Sequence[str]],
    classes: Iterable[str] | None = None,
    kind: str = "",
) -> str:
    """A table of HTML; `classes` are those of its rows, `kind` its own."""
    titles = "".join(f"<th>{html.escape(title)}</th>" for title in head)
    rows = list(rows)
    of_rows = [""] * len(rows) if classes is None else list(classes)
    body = "".join(
        f"<tr class='{own}'>{''.join(f'<td>{html.escape(cell)}</td>' for cell in row)}</tr>"
        for row, own in zip(rows, of_rows, strict=True)
    )
    return f"<table class='{kind}'><tr>{titles}</tr>{body}</table>"
