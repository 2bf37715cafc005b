# SPDX-License-Identifier: BSD-3-Clause
"""What a diagnosis shows first: its verdict, its numbers, one next step."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from bathyal._core import Touches
from bathyal.diagnosis.report.numbers import (
    chance_text,
    estimate_text,
    gained_share_text,
    is_setting,
    length_text,
    parameter_name,
)
from bathyal.diagnosis.report.text import (
    amplitude_text,
    any_text,
    causes_text,
    groups_of,
    headline,
    is_of_noise,
    settled,
    significant,
    sure_in_the_main,
)
from bathyal.view.brief import MOST_NUMBERS, Brief
from bathyal.view.text import counted, listed

if TYPE_CHECKING:
    from bathyal._core import Diagnosis

_MOST_CAUSES = 2  # with a row of their own
_MOST_PARAMETERS = 2  # of one cause
_COVARIATES = ("temperature", "time", "payload", "direction", "session")


def brief_of(report: Diagnosis) -> Brief:
    """The diagnosis at first sight.

    Parameters
    ----------
    report : Diagnosis

    Returns
    -------
    Brief
    """
    numbers = _NUMBERS[report.verdict](report)
    return Brief(headline(report), dict(list(numbers.items())[:MOST_NUMBERS]), _next_step(report))


def _named(report: Diagnosis) -> dict[str, str]:
    return _causes(report.effects) | _gain(report) | _noise(report)


def _clean(report: Diagnosis) -> dict[str, str]:
    least = min(report.shown, key=lambda s: s.p_value, default=None)
    trend = (
        {}
        if least is None
        else {"strongest trend": f"against {least.against}, {chance_text(least.p_value)}"}
    )
    return {
        **_data(report),
        "held-out error": _held_out_before(report),
        **_noise(report),
        "detectable": f"{length_text(report.detectable)} per axis, or more",
        **trend,
    }


def _ambiguous(report: Diagnosis) -> dict[str, str]:
    certain = settled(report)[:1]
    sure = {"certain": f"{certain[0].words}; {_size(certain[0])}"} if certain else {}
    if sure_in_the_main(report):
        sure |= {"open": "; ".join(any_text(group) for group in groups_of(report)[:2])}
    return sure | _gain(report) | _noise(report)


def _unknown(report: Diagnosis) -> dict[str, str]:
    rest = report.leftover
    structures = significant(report.shown)
    trend = rest if rest is not None and rest.size > 0 else structures[0] if structures else None
    numbers = {}
    if trend is not None:
        numbers["depends on"] = (
            f"{trend.against}: {length_text(trend.size)} per axis, {chance_text(trend.p_value)}"
        )
    if report.effects:
        return {
            **numbers, "part of it may be": causes_text(report.effects), **_gain(report),
            **_noise(report),
        }  # fmt: skip
    return {**numbers, "held-out error": _held_out_before(report), **_noise(report)}


def _none(report: Diagnosis) -> dict[str, str]:
    return {**_data(report), "fitted error": f"{length_text(report.fit.rms_after)} (3-D rms)",
            **_noise(report)}  # fmt: skip


_NUMBERS = {
    "clean": _clean,
    "named": _named,
    "ambiguous": _ambiguous,
    "unknown": _unknown,
    "none": _none,
}


def _causes(effects: list[Any]) -> dict[str, str]:
    """A row of each of the first causes."""
    shown = effects[:_MOST_CAUSES]
    titles = ["size"] if len(effects) < 2 else [f"size of cause {k + 1}" for k in range(len(shown))]
    return {title: _size(effect) for title, effect in zip(titles, shown, strict=False)}


def _size(effect: Any) -> str:
    if len(effect.rows):
        return counted(len(effect.rows), "row")
    found = {key: value for key, value in effect.parameters.items() if not is_setting(value)}
    amplitude = amplitude_text(effect)
    if amplitude:
        texts = [f"amplitude {amplitude}"]
    elif len(found) <= _MOST_PARAMETERS:
        texts = [f"{parameter_name(key)} {estimate_text(key, value)}"
                 for key, value in found.items()]  # fmt: skip
    else:
        texts = [counted(len(found), "parameter")]
    if not is_of_noise(effect):
        texts.append(f"moves the tip by {length_text(effect.size)} per axis")
    return "; ".join(texts)


def _gain(report: Diagnosis) -> dict[str, str]:
    held = report.held_out
    numbers = {
        "held-out error": f"{length_text(held.rms_before)} → {length_text(held.rms_after)} "
        f"(3-D rms; noise alone {length_text(held.noise)})"
    }
    if held.nested is not None:
        numbers["causes chosen anew"] = (
            f"{length_text(held.nested.rms_after)} (3-D rms of {held.nested.folds} parts held out "
            "of the whole diagnosis)"
        )
    if math.isfinite(report.gain):
        numbers["explained"] = (
            f"{gained_share_text(report, report.gain)}, {chance_text(held.p_value)}"
        )
    return numbers


def _held_out_before(report: Diagnosis) -> str:
    held = report.held_out
    return f"{length_text(held.rms_before)} (3-D rms; noise alone {length_text(held.noise)})"


def _noise(report: Diagnosis) -> dict[str, str]:
    return {"noise": f"{length_text(report.noise)} per axis"}


def _data(report: Diagnosis) -> dict[str, str]:
    what = "touches" if isinstance(report.data, Touches) else "poses"
    return {what: f"{len(report.data):,}"}


def _next_step(report: Diagnosis) -> str:
    missing = [name for name in _COVARIATES if name not in report.data.covariates]
    if report.verdict == "named":
        return "Check the corrected arm on a dozen poses that were not used."
    if report.verdict == "clean":
        return "Use the identified arm; four times the poses halve what is detectable."
    if report.verdict == "ambiguous":
        count = np.size(report.next_poses) and len(report.next_poses)
        if count:
            return (f"Measure the {counted(count, 'pose')} of the report, where the alternatives "
                    "differ most, and diagnose again.")  # fmt: skip
        return "Record more covariates, or measure in another order: no pose separates them."
    if report.verdict == "unknown":
        if missing:
            return f"Record {listed(missing)} as well, and diagnose again."
        return "Repeat a few poses, each approached from both sides, and see what changes."
    if isinstance(report.data, Touches):
        return "Touch each point in twice as many poses, or more points, and diagnose again."
    return "Measure two or three times as many poses, and diagnose again."
