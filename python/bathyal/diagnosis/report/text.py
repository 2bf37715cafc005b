# SPDX-License-Identifier: BSD-3-Clause
"""What a diagnosis found and how surely, in sentences; what to do: `advice`."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from bathyal._core import BEYOND_NOISE, Touches
from bathyal.diagnosis.report.advice import next_steps
from bathyal.diagnosis.report.numbers import (
    chance_text,
    estimate_text,
    figures,
    gained_share_text,
    is_setting,
    length_text,
    odds_text,
    parameter_name,
    share_text,
    shown_unit,
    spaced,
)
from bathyal.view.text import bare, counted, listed, lower, sentence, upper

if TYPE_CHECKING:
    from bathyal._core import Diagnosis

# What each verdict says, in a word or two and in a sentence.
VERDICTS = {
    "clean": ("Clean", "Geometry explains the data to within noise."),
    "named": ("Named", "What the simulation gets wrong is identified."),
    "ambiguous": ("Ambiguous", "These data cannot distinguish the causes."),
    "unknown": ("Unknown", "No cause in the library explains what is beyond noise."),
    "none": ("No verdict", "No data could be held out."),
}
_MOST_LISTED = 3  # causes, with their numbers, in the paragraph
_MOST_PARAMETERS = 4  # of one cause, in the paragraph
_MOST_ROWS = 10  # by number


def summary(report: Diagnosis, *, warnings: bool = True) -> str:
    """The diagnosis as one paragraph: verdict, causes, the gain on held-out data, what remains
    unexplained, and what to do.

    Parameters
    ----------
    report : Diagnosis
    warnings : bool
        Whether the report's warnings are at the end.

    Returns
    -------
    str
    """
    parts = [*_FOUND[report.verdict](report), *next_steps(report)[:2]]
    if warnings:
        parts += [f"Warning: {warning}" for warning in report.warnings]
    return " ".join(sentence(part) for part in parts if part)


def facts_of(report: Diagnosis) -> dict[str, str]:
    """What was diagnosed, in short: lines for a box or a screen."""
    data, arm = report.data, report.fit.arm
    what = "touches" if isinstance(data, Touches) else "poses"
    return {
        "verdict": VERDICTS[report.verdict][0],
        "arm": f"{arm.name or 'arm'}, {arm.size} joints",
        what: f"{len(data):,}",
        "covariates": ", ".join(sorted(data.covariates)) or "none",
        "geometry alone": f"{length_text(report.fit.rms_after)} (rms, 3-D, fitted)",
        "noise": f"{length_text(report.noise)} per axis, by {bare(report.noise_source)}",
    }


def headline(report: Diagnosis) -> str:
    """The verdict in one line."""
    title = VERDICTS[report.verdict][0]
    if report.verdict == "named":
        return f"{title}: {causes_text(report.effects)}."
    if report.verdict == "ambiguous" and report.ambiguous:
        groups = groups_of(report)
        if sure_in_the_main(report):
            lesser = (
                "a lesser choice is" if len(groups) == 1 else f"{len(groups)} lesser choices are"
            )
            return f"{title}: mainly {causes_text(settled(report))}. {upper(lesser)} open."
        choices = [any_text(group) for group in groups[:_MOST_LISTED]]
        return f"{title}: {listed(choices + _more(groups, 'choice'), '; ')}."
    if report.verdict == "unknown":
        return f"{title}: no cause in the library explains {_unexplained(report)}."
    if report.verdict == "clean":
        return f"{title}: geometry explains the data to within noise."
    return f"{title}: {lower(VERDICTS[report.verdict][1])}"


def causes_text(causes: Sequence[Any]) -> str:
    """Causes by name, all at once: "a wave along joint 3; and 2 more"."""
    names = [str(cause.words) for cause in causes[:_MOST_LISTED]]
    rest = len(causes) - len(names)
    return listed(names + ([f"{rest} more"] if rest else []), "; ") if names else "no cause"


def any_text(causes: Sequence[Any]) -> str:
    """Causes by name, one of them: "a slip, a shift or any of 3 others"."""
    return _any_of([str(cause.words) for cause in causes])


def groups_of(report: Diagnosis) -> list[list[Any]]:
    """Causes that the data cannot distinguish, group by group: each begins with the one that was
    chosen."""
    chosen = {_key(effect) for effect in report.effects}
    groups: list[list[Any]] = []
    for cause in report.ambiguous:
        if not groups or _key(cause) in chosen:
            groups.append([])
        groups[-1].append(cause)
    return groups


def settled(report: Diagnosis) -> list[Any]:
    """Causes without an alternative that fits as well."""
    undecided = {_key(cause) for cause in report.ambiguous}
    return [effect for effect in report.effects if _key(effect) not in undecided]


def sure_in_the_main(report: Diagnosis) -> bool:
    """Whether a cause without alternatives has a larger effect than any undecided one."""
    sizes = {_key(effect): effect.size for effect in report.effects if not is_of_noise(effect)}
    sure = [sizes[_key(effect)] for effect in settled(report) if _key(effect) in sizes]
    open_ones = [sizes.get(_key(group[0]), 0.0) for group in groups_of(report)]
    return bool(sure) and max(sure) > max(open_ones, default=0.0)


def _key(cause: Any) -> tuple[str, int | None, str]:
    return cause.name, cause.joint, cause.words


def effect_text(effect: Any) -> str:
    """A cause with its numbers: "a wave of order 2 along joint 3 with amplitude 0.03°, …"."""
    if len(effect.rows):
        return f"{effect.words} ({_rows(effect.rows)})"
    numbers = [
        f"{parameter_name(name)} {estimate_text(name, estimate)}"
        for name, estimate in effect.parameters.items()
        if not is_setting(estimate)
    ]
    if len(numbers) > _MOST_PARAMETERS:
        return f"{effect.words}, with {len(numbers)} parameters"
    amplitude = amplitude_text(effect)
    numbers = [f"amplitude {amplitude}", *numbers] if amplitude else numbers
    return f"{effect.words} with {', '.join(numbers)}" if numbers else str(effect.words)


def amplitude_text(effect: Any) -> str:
    """√(cos² + sin²) of a harmonic; empty for other causes."""
    if effect.name != "joint_harmonic" or not {"cos", "sin"} <= effect.parameters.keys():
        return ""
    cos, sin = effect.parameters["cos"], effect.parameters["sin"]
    unit, factor = shown_unit("cos", cos.unit)
    return f"{figures(factor * math.hypot(float(cos.value), float(sin.value)))}{spaced(unit)}"


def gain_text(report: Diagnosis) -> str:
    """What the causes gain on held-out data."""
    held = report.held_out
    text = (
        f"On data held out ({lower(bare(held.how))}) the error falls from "
        f"{length_text(held.rms_before)} to {length_text(held.rms_after)} (3-D rms; noise alone "
        f"{length_text(held.noise)})"
    )
    if math.isfinite(report.gain):
        text += f": {gained_share_text(report, report.gain)} is explained"
    return f"{text} ({chance_text(held.p_value)}).{_nested_text(report)}"


def _nested_text(report: Diagnosis) -> str:
    """What is added to the held-out error by the choice of causes, where that was measured."""
    nested = report.held_out.nested
    if nested is None:
        return ""
    return (
        f" With the causes, too, chosen anew without each of {nested.folds} parts it is "
        f"{length_text(nested.rms_after)}."
    )


def evidence_texts(report: Diagnosis) -> list[str]:
    """Of each cause a sentence: what it explains of held-out data, and the best alternative."""
    return [sentence(_evidence(report, effect)) for effect in report.effects]


def is_of_noise(effect: Any) -> bool:
    """Whether a cause is of the noise, or of single rows, and does not reduce the held-out error:
    it is decided by likelihood."""
    return effect.name in ("outliers", "range_noise", "quantisation")


def _evidence(report: Diagnosis, effect: Any) -> str:
    if is_of_noise(effect):
        return f"{upper(effect.words)}: {noise_evidence(effect)}"
    text = (
        f"{upper(effect.words)}: {gained_share_text(report, effect.gain)} on data "
        f"held out ({length_text(effect.held_out_before)} without it, "
        f"{length_text(effect.held_out_after)} with it; {chance_text(effect.p_value)})"
    )
    if not effect.rivals:
        return text
    best = max(effect.rivals, key=lambda alternative: alternative.odds)
    return f"{text}; best alternative: {best.words}, {odds_text(best.odds)}"


def noise_evidence(effect: Any) -> str:
    """Why a cause of the noise was named."""
    if len(effect.rows):
        return "farther off than noise explains"
    return f"the log likelihood of data held out gains {figures(effect.gain)}"


def leftover_text(report: Diagnosis) -> str:
    """What the named causes do not explain."""
    left = report.leftover
    if left is None or left.size <= 0 or not left.is_beyond_noise:
        return "Nothing beyond noise remains unexplained."
    text = f"Unexplained: {bare(left.words)}"
    return f"{text} ({length_text(left.size)} per axis, {chance_text(left.p_value)})."


def structure_text(shown: Any) -> str:
    """A dependence of the residuals, with its size and p-value."""
    return (
        f"{bare(shown.words)} ({length_text(shown.size)} per axis, {share_text(shown.share)} of "
        f"the variance above noise, {chance_text(shown.p_value)})"
    )


def significant(shown: Iterable[Any]) -> list[Any]:
    """Structures beyond noise, the largest first."""
    return sorted((s for s in shown if s.is_beyond_noise), key=lambda s: -s.size)


# What was found -----------------------------------------------------------------------------------


def _named(report: Diagnosis) -> list[str]:
    return [
        _with_numbers(report.effects, VERDICTS["named"][0]),
        gain_text(report),
        leftover_text(report),
    ]


def _clean(report: Diagnosis) -> list[str]:
    least = min(report.shown, key=lambda s: s.p_value, default=None)
    suspect = (
        f"no dependence has a p-value below {BEYOND_NOISE}, corrected for all tests"
        if least is None
        else f"the strongest dependence, on {least.against}, has {chance_text(least.p_value)}"
    )
    held = report.held_out
    return [
        f"Clean: geometry explains {len(report.data):,} poses to within noise; {suspect}.",
        f"An effect that moves the tip by {length_text(report.detectable)} or more per axis would "
        f"have been detected; {noise_text(report)}.",
        f"Geometry alone predicts held-out data to {length_text(held.rms_before)} "
        f"(3-D rms; noise alone {length_text(held.noise)}).",
    ]


def noise_text(report: Diagnosis) -> str:
    """How large the noise is, and what determines it."""
    return f"noise is {length_text(report.noise)} per axis, by {bare(report.noise_source)}"


def _ambiguous(report: Diagnosis) -> list[str]:
    choices = []
    groups = groups_of(report)
    for first, *others in groups[:_MOST_LISTED]:
        odds = [first.words, *(f"{cause.words} ({odds_text(cause.odds)})" for cause in others)]
        choices.append(_any_of(odds))
    choices += _more(groups, "choice")
    apart, sure = listed(choices, "; "), settled(report)
    found = (
        [_with_numbers(sure, "Ambiguous, but mainly"),
         f"Among lesser causes these data cannot distinguish: {apart}."]
        if sure_in_the_main(report)
        else [f"Ambiguous, these data cannot distinguish: {apart}.",
              _with_numbers(sure, "Certain is")]
    )  # fmt: skip
    return [*found, gain_text(report), leftover_text(report)]


def _unknown(report: Diagnosis) -> list[str]:
    found = significant(report.shown)
    left = report.leftover
    looks = f"It looks like this: {bare(left.words)}" if left is not None and left.words else ""
    if looks and left.size > 0:
        looks += (
            f" ({length_text(left.size)} per axis, {share_text(left.share)} of the variance above "
            f"noise, {chance_text(left.p_value)})"
        )
    shown = f"Before anything was named: {structure_text(found[0])}." if found else ""
    if not report.effects:
        held = report.held_out
        return [
            headline(report),
            f"{looks}." if looks else "",
            shown,
            f"Geometry alone predicts held-out data to {length_text(held.rms_before)} "
            f"(3-D rms; noise alone {length_text(held.noise)}).",
        ]
    return [
        headline(report),
        f"{looks}." if looks else "",
        _with_numbers(report.effects, "A part of it may be"),
        "A cause that explains a part is not the cause.",
        gain_text(report),
    ]


def _none(report: Diagnosis) -> list[str]:
    held = report.held_out
    why = bare(held.how) if held is not None and held.how else "the data are too few"
    found = significant(report.shown)
    shown = f"What the residuals show: {structure_text(found[0])}." if found else (
        "The residuals show no dependence beyond noise.")  # fmt: skip
    return [
        f"No verdict, no data could be held out: {why}.",
        f"Without held-out data a cause cannot be distinguished from chance, so none is named. "
        f"{shown}",
    ]


_FOUND = {
    "clean": _clean,
    "named": _named,
    "ambiguous": _ambiguous,
    "unknown": _unknown,
    "none": _none,
}


def _with_numbers(effects: Sequence[Any], how: str) -> str:
    """Causes with their numbers."""
    texts = [
        f"{effect_text(e)} (moves the tip by {length_text(e.size)} per axis)"
        if not is_of_noise(e)
        else effect_text(e)
        for e in effects[:_MOST_LISTED]
    ]
    if len(effects) > _MOST_LISTED:
        texts.append(f"{len(effects) - _MOST_LISTED} more with smaller numbers")
    return f"{how}: {listed(texts, '; ')}." if texts else ""


# Grammar ------------------------------------------------------------------------------------------


def _unexplained(report: Diagnosis) -> str:
    rest = report.leftover
    if rest is None or rest.size <= 0:
        return "what is beyond noise"
    return f"{length_text(rest.size)} per axis beyond noise"


def _rows(rows: Sequence[int]) -> str:
    shown = ", ".join(str(row) for row in rows[:_MOST_ROWS])
    rest = len(rows) - _MOST_ROWS
    return f"rows {shown}" + (f" and {rest} more" if rest > 0 else "")


def _any_of(causes: Sequence[str]) -> str:
    rest = len(causes) - _MOST_LISTED
    if rest > 0:
        causes = [*causes[:_MOST_LISTED], f"any of {counted(rest, 'other')}"]
    return listed(causes, last=" or ")


def _more(items: Sequence[Any], what: str) -> list[str]:
    """The number of those that are not listed one by one."""
    rest = len(items) - _MOST_LISTED
    return [counted(rest, f"more {what}")] if rest > 0 else []
