# SPDX-License-Identifier: BSD-3-Clause
"""What a diagnosis found and how surely, in sentences; what to do: `diagnosis_advice`."""

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
    "clean": ("Clean", "Nothing is there beyond noise."),
    "named": ("Named", "What the simulation got wrong has a name."),
    "ambiguous": ("Ambiguous", "These data cannot tell the causes apart."),
    "unknown": ("Unknown", "Something is there that no cause of the library explains."),
    "none": ("No verdict", "No data could be held out."),
}
_MOST_TOLD = 3  # causes, with their numbers, in the paragraph
_MOST_PARAMETERS = 4  # of one cause, in the paragraph
_MOST_ROWS = 10  # by number


def summary(report: Diagnosis, *, warnings: bool = True) -> str:
    """The diagnosis as one paragraph: verdict, causes, the gain on data not used, what is left, and
    what to do.

    Parameters
    ----------
    report : Diagnosis
    warnings : bool
        Whether the report's warnings stand at the end.

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
        "recorded beside": ", ".join(sorted(data.covariates)) or "nothing",
        "geometry alone": f"{length_text(report.fit.rms_after)} (rms, 3-D, fitted)",
        "noise": f"{length_text(report.noise)} per axis, by {bare(report.noise_source)}",
    }


def headline(report: Diagnosis) -> str:
    """The verdict in one line."""
    title = VERDICTS[report.verdict][0]
    if report.verdict == "named":
        return f"{title}: {_causes(report.effects)}."
    if report.verdict == "ambiguous" and report.ambiguous:
        groups = groups_of(report)
        if sure_in_the_main(report):
            lesser = (
                "a lesser choice is" if len(groups) == 1 else f"{len(groups)} lesser choices are"
            )
            return f"{title}: in the main {_causes(settled(report))}. {upper(lesser)} open."
        told = [_any_of([str(cause.words) for cause in group]) for group in groups[:_MOST_TOLD]]
        return f"{title}: {listed(told + _more(groups, 'choice'), '; ')}."
    if report.verdict == "unknown":
        return f"{title}: something is there that no cause of the library explains."
    if report.verdict == "clean":
        return f"{title}: nothing beyond noise."
    return f"{title}: {lower(VERDICTS[report.verdict][1])}"


def groups_of(report: Diagnosis) -> list[list[Any]]:
    """Causes that the data cannot tell apart, group by group: each begins with the one that was
    chosen."""
    chosen = {_key(effect) for effect in report.effects}
    groups: list[list[Any]] = []
    for cause in report.ambiguous:
        if not groups or _key(cause) in chosen:
            groups.append([])
        groups[-1].append(cause)
    return groups


def settled(report: Diagnosis) -> list[Any]:
    """Causes that have no rival among those that cannot be told apart."""
    doubtful = {_key(cause) for cause in report.ambiguous}
    return [effect for effect in report.effects if _key(effect) not in doubtful]


def sure_in_the_main(report: Diagnosis) -> bool:
    """Whether a cause without rivals does more than any of those that cannot be told apart."""
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
    told = [
        f"{parameter_name(name)} {estimate_text(name, estimate)}"
        for name, estimate in effect.parameters.items()
        if not is_setting(estimate)
    ]
    if len(told) > _MOST_PARAMETERS:
        return f"{effect.words}, told by {len(told)} numbers"
    amplitude = amplitude_text(effect)
    told = [f"amplitude {amplitude}", *told] if amplitude else told
    return f"{effect.words} with {', '.join(told)}" if told else str(effect.words)


def amplitude_text(effect: Any) -> str:
    """√(cos² + sin²) of a harmonic; empty for other causes."""
    if effect.name != "joint_harmonic" or not {"cos", "sin"} <= effect.parameters.keys():
        return ""
    cos, sin = effect.parameters["cos"], effect.parameters["sin"]
    unit, factor = shown_unit("cos", cos.unit)
    return f"{figures(factor * math.hypot(float(cos.value), float(sin.value)))}{spaced(unit)}"


def gain_text(report: Diagnosis) -> str:
    """What the causes bring on data that were not used."""
    held = report.held_out
    text = (
        f"On data held out ({lower(bare(held.how))}) the error falls from "
        f"{length_text(held.rms_before)} to {length_text(held.rms_after)} (3-D rms), with a "
        f"floor of {length_text(held.noise)} by noise"
    )
    if math.isfinite(report.gain):
        text += f": {share_text(report.gain)} of the variance above noise is gone"
    return f"{text}; that this is luck has {chance_text(held.p_value)}."


def evidence_texts(report: Diagnosis) -> list[str]:
    """Of each cause a sentence: what it takes from data held out, and what else might do it."""
    return [sentence(_evidence(effect)) for effect in report.effects]


def is_of_noise(effect: Any) -> bool:
    """Whether a cause works on the noise, or on single rows, and takes nothing from the error
    held out: likelihood judges it."""
    return effect.name in ("outliers", "range_noise", "quantisation")


def _evidence(effect: Any) -> str:
    if is_of_noise(effect):
        return f"{upper(effect.words)}: {noise_evidence(effect)}"
    text = (
        f"{upper(effect.words)}: {share_text(effect.gain)} of the variance above noise on data "
        f"held out ({length_text(effect.held_out_before)} without it, "
        f"{length_text(effect.held_out_after)} with it; {chance_text(effect.p_value)})"
    )
    if not effect.rivals:
        return text
    best = max(effect.rivals, key=lambda rival: rival.odds)
    return f"{text}; next best: {best.words}, {odds_text(best.odds)}"


def noise_evidence(effect: Any) -> str:
    """Why a cause that works on the noise was named."""
    if len(effect.rows):
        return "so far off that noise does not make them"
    return f"the log likelihood of data held out gains {figures(effect.gain)}"


def leftover_text(report: Diagnosis) -> str:
    """What the named causes leave."""
    left = report.leftover
    if left is None or left.size <= 0 or not left.is_beyond_noise:
        return "Nothing beyond noise is left over."
    text = f"Left over: {bare(left.words)}"
    return f"{text} ({length_text(left.size)} per axis, {chance_text(left.p_value)})."


def structure_text(shown: Any) -> str:
    """A dependence of the residuals, with its size and chance."""
    return (
        f"{bare(shown.words)} ({length_text(shown.size)} per axis, {share_text(shown.share)} of "
        f"the variance above noise, {chance_text(shown.p_value)})"
    )


def significant(shown: Iterable[Any]) -> list[Any]:
    """Structures beyond noise, the largest first."""
    return sorted((s for s in shown if s.is_beyond_noise), key=lambda s: -s.size)


# What was found -----------------------------------------------------------------------------------


def _named(report: Diagnosis) -> list[str]:
    return [_told(report.effects, VERDICTS["named"][0]), gain_text(report), leftover_text(report)]


def _clean(report: Diagnosis) -> list[str]:
    least = min(report.shown, key=lambda s: s.p_value, default=None)
    suspect = (
        f"no structure that was looked for has a chance below {BEYOND_NOISE}, all tests counted"
        if least is None
        else f"the most suspect, against {least.against}, has {chance_text(least.p_value)}"
    )
    held = report.held_out
    return [
        f"Clean: {len(report.data):,} poses show nothing beyond noise that geometry does not "
        f"explain; {suspect}.",
        f"What moves the tip by {length_text(report.detectable)} or more per axis would have been "
        f"seen; {noise_text(report)}.",
        f"Geometry alone foretells data that were held out to {length_text(held.rms_before)} "
        f"(3-D rms), with a floor of {length_text(held.noise)} by noise.",
    ]


def noise_text(report: Diagnosis) -> str:
    """How large the noise is, and by what."""
    return f"noise is {length_text(report.noise)} per axis, by {bare(report.noise_source)}"


def _ambiguous(report: Diagnosis) -> list[str]:
    told = []
    groups = groups_of(report)
    for first, *others in groups[:_MOST_TOLD]:
        odds = [first.words, *(f"{cause.words} ({odds_text(cause.odds)})" for cause in others)]
        told.append(_any_of(odds))
    told += _more(groups, "choice")
    apart, sure = listed(told, "; "), settled(report)
    stand = "stands" if len(sure) == 1 else "stand"
    found = (
        [_told(sure, f"Ambiguous, but in the main this {stand}"),
         f"Among lesser causes these data cannot tell apart: {apart}."]
        if sure_in_the_main(report)
        else [f"Ambiguous, these data cannot tell apart: {apart}.",
              _told(sure, f"Beside them {stand}")]
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
            f"Geometry alone foretells data that were held out to {length_text(held.rms_before)} "
            f"(3-D rms), with a floor of {length_text(held.noise)} by noise.",
        ]
    return [
        headline(report),
        f"{looks}." if looks else "",
        _told(report.effects, "A part of it may be"),
        "A cause that explains a part is not the cause.",
        gain_text(report),
    ]


def _none(report: Diagnosis) -> list[str]:
    held = report.held_out
    why = bare(held.how) if held is not None and held.how else "the data are too few"
    found = significant(report.shown)
    shown = f"What the residuals show: {structure_text(found[0])}." if found else (
        "Within the data themselves nothing stands out.")  # fmt: skip
    return [
        f"No verdict, no data could be held out: {why}.",
        f"Without data held out, a cause cannot be told from luck, so none is named. {shown}",
    ]


_FOUND = {
    "clean": _clean,
    "named": _named,
    "ambiguous": _ambiguous,
    "unknown": _unknown,
    "none": _none,
}


def _told(effects: Sequence[Any], how: str) -> str:
    """Causes with their numbers."""
    told = [
        f"{effect_text(e)} (moves the tip by {length_text(e.size)} per axis)"
        if not is_of_noise(e)
        else effect_text(e)
        for e in effects[:_MOST_TOLD]
    ]
    if len(effects) > _MOST_TOLD:
        told.append(f"{len(effects) - _MOST_TOLD} more with smaller numbers")
    return f"{how}: {listed(told, '; ')}." if told else ""


# Grammar ------------------------------------------------------------------------------------------


def _causes(effects: Sequence[Any]) -> str:
    told = [str(effect.words) for effect in effects[:_MOST_TOLD]]
    rest = len(effects) - len(told)
    return listed(told + ([f"{rest} more"] if rest else []), "; ") if told else "no cause"


def _rows(rows: Sequence[int]) -> str:
    told = ", ".join(str(row) for row in rows[:_MOST_ROWS])
    rest = len(rows) - _MOST_ROWS
    return f"rows {told}" + (f" and {rest} more" if rest > 0 else "")


def _any_of(causes: Sequence[str]) -> str:
    rest = len(causes) - _MOST_TOLD
    if rest > 0:
        causes = [*causes[:_MOST_TOLD], f"any of {counted(rest, 'other')}"]
    return listed(causes, last=" or ")


def _more(told: Sequence[Any], what: str) -> list[str]:
    """What stands for those that are not told one by one."""
    rest = len(told) - _MOST_TOLD
    return [counted(rest, f"more {what}")] if rest > 0 else []
