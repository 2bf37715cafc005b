# SPDX-License-Identifier: BSD-3-Clause
"""What to do about a diagnosis, and what to measure next, in sentences."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from bathyal._core import Touches
from bathyal.diagnosis.report.numbers import odds_text
from bathyal.view.text import counted, listed, upper

if TYPE_CHECKING:
    from bathyal._core import Diagnosis

_NEAR = 0.1  # odds from which an alternative is mentioned
# What data without a covariate cannot show.
_BLIND = {
    "temperature": "growth with temperature",
    "time": "drift, slips and clocks out of step",
    "payload": "a load's share of what gives way",
    "direction": "backlash",
    "session": "a base or tool that moved between sessions",
}


def next_steps(report: Diagnosis) -> list[str]:
    """What to do or to measure, the most important first."""
    return [step for step in _NEXT[report.verdict](report) if step]


def _after_named(report: Diagnosis) -> list[str]:
    near = [(effect, rival) for effect in report.effects for rival in effect.rivals
            if rival.odds >= _NEAR]  # fmt: skip
    steps = [
        "Use the corrected arm (report.model) within the range of joints of the data, and check it "
        "on a dozen poses that were not used."
    ]
    for effect, rival in near[:1]:
        steps.append(
            f"{upper(rival.words)} is not far behind {effect.words} ({odds_text(rival.odds)}): "
            f"poses in which the two differ would settle it."
        )
    return [*steps, _next_poses(report), _to_record(report)]


def _after_clean(report: Diagnosis) -> list[str]:
    return [
        "Use the arm that was identified (report.fit.arm). To see smaller effects measure more: "
        "four times the poses halve what can be seen.",
        _to_record(report),
    ]


def _after_ambiguous(report: Diagnosis) -> list[str]:
    what = _next_poses(report) or (
        "No pose distinguishes them: record more covariates, or measure in another order."
    )
    return [what, "Until then any of them corrects the arm alike within the range of the data, and "
            "nowhere else.", _to_record(report)]  # fmt: skip


def _after_unknown(report: Diagnosis) -> list[str]:
    where = _where_to_look(report.leftover)
    return [
        _to_record(report) or where,
        where if _to_record(report) else "",
        "Do not put a correction on this arm until the cause is known; its geometry "
        "(report.fit.arm) may be used with the error shown here.",
        _next_poses(report),
    ]


def _after_none(report: Diagnosis) -> list[str]:
    what = (
        "touch each point in twice as many poses, or touch more points"
        if isinstance(report.data, Touches)
        else "measure two or three times as many poses, spread over the joints' ranges"
    )
    return [f"{upper(what)}, better on two days, and diagnose again.", _to_record(report)]


_NEXT = {
    "clean": _after_clean,
    "named": _after_named,
    "ambiguous": _after_ambiguous,
    "unknown": _after_unknown,
    "none": _after_none,
}


def _where_to_look(structure: Any) -> str:
    """The next step where a structure is unexplained, by what it depends on."""
    if structure.kind == "joints":
        joints = "these" if len(structure.coordinates) > 1 else "that joint"
        return (
            f"The residuals depend on {structure.against}: sweep {joints} in small steps, up and "
            "down, with the others still, and plot them."
        )
    return _BY_KIND.get(structure.kind, _WITHOUT_A_CLUE)


_BY_KIND = {
    "time": (
        "The residuals depend on time: look for what runs with that period (a pump, a machine, the "
        "sun), and measure the same poses again at another hour."
    ),
    "order": (
        "The residuals depend on the order of the rows: record the time, and measure in another "
        "order."
    ),
    "approach": (
        "The residuals depend on the side from which a joint came: record `direction`, and "
        "approach each pose from both sides."
    ),
    "position": (
        "The residuals depend on the position: check the instrument's own field with a body of "
        "known size, or measure the same positions from another station."
    ),
    "range": (
        "The residuals depend on the range from the instrument: check its ranging against a known "
        "length, or measure the same positions from another station."
    ),
    "session": (
        "The residuals depend on the session: find what was changed between sessions, and repeat "
        "one pose."
    ),
}
_WITHOUT_A_CLUE = "Repeat a few poses, each approached from both sides, and see what changes."


def _next_poses(report: Diagnosis) -> str:
    count = 0 if report.next_poses is None else len(np.atleast_2d(report.next_poses))
    if count == 0 or np.size(report.next_poses) == 0:
        return ""
    return (
        f"Measure the {counted(count, 'pose')} of report.next_poses, where the causes differ most, "
        "and diagnose again with all data together."
    )


def _to_record(report: Diagnosis) -> str:
    missing = [name for name in _BLIND if name not in report.data.covariates]
    if not missing:
        return ""
    blind = [_BLIND[name] for name in missing]
    return f"Record {listed(missing)} as well: these data cannot show {listed(blind, last=' or ')}."
