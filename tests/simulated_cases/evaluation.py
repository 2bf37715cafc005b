# SPDX-License-Identifier: BSD-3-Clause
"""Holds what a diagnosis says against the answer that it has not seen."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from time import perf_counter
from typing import Any

import numpy as np

from tests.simulated_cases.arms import Array
from tests.simulated_cases.cases import Answer, Case, draw_case
from tests.simulated_cases.effect_shapes import cause_of
from tests.support.model_agreement import difference

Cause = tuple[Any, ...]
Diagnose = Callable[[Case], Any]
"""Makes a report like that of bathyal.diagnose."""


@dataclass
class Evaluated:
    """One case: what was asked and what came back, in few enough numbers to be sent about."""

    seed: int
    kind: str
    size: float
    outside: str
    expected: list[str]
    verdict: str
    named: list[str]
    exact: bool = False  # the verdict asked for, with the very set of causes
    holds: bool = False  # ambiguous, and its list holds the truth
    listed: int = 0  # of ambiguous: how many
    partial: int = 0  # false names that are listed with `unknown`
    pairs: list[tuple[str, str]] = field(default_factory=list)  # true name, name that was given
    inside: list[tuple[str, float, bool]] = field(default_factory=list)  # parameter, z, covered
    error: float = float("nan")  # rms of predicted tips against the truth, in noises
    refit_error: float = float("nan")  # the same of a refit that is given the causes
    held_out: float = float("nan")  # rms per axis on blocks held out, in noises
    seconds: float = 0.0
    failure: str = ""


def engine(case: Case) -> Any:
    """The diagnosis under test, one thread: cases run in parallel."""
    import bathyal

    return bathyal.diagnose(case.bathyal_arm(), case.data(), num_threads=1)


def evaluate(seed: int, diagnose: Diagnose = engine) -> Evaluated:
    case = draw_case(seed)
    answer = case.answer
    start = perf_counter()
    try:
        report = diagnose(case)
    except Exception as error:
        out = Evaluated(seed, answer.kind, answer.size, answer.outside, [], "failed", [])
        out.failure = f"{type(error).__name__}: {error}"
        return out
    seconds = perf_counter() - start
    failure = _other_model(report, case)
    truth = {_true_cause(e): e for e in answer.effects}
    named = {_as_reported(_named_cause(e), e, truth): e for e in report.effects}
    out = Evaluated(
        seed,
        answer.kind,
        answer.size,
        answer.outside,
        [_words(c) for c in truth],
        str(report.verdict),
        [_words(c) for c in named],
        seconds=seconds,
        failure=failure,
    )
    _verdict(out, answer, truth, named, report)
    out.pairs = _pairs(answer, truth, named, out.verdict)
    if out.exact and answer.kind == "inside" and answer.size >= 1:
        for cause, fact in truth.items():
            out.inside += _covered(fact, named[cause])
    if getattr(report, "residuals_after", None) is not None:
        out.error, out.refit_error = _errors(case, np.asarray(report.residuals_after))
        out.held_out = float(report.held_out.rms_after / np.sqrt(3) / answer.noise)
    return out


def _other_model(report: Any, case: Case) -> str:
    """What is wrong where the model that is handed out is not that of the report's residuals."""
    if getattr(report, "model", None) is None:  # an oracle's
        return ""
    most = 1e-9
    found = difference(report, case.data())
    return f"the model is {found:.1e} m off the report's residuals" if found > most else ""


def _verdict(
    out: Evaluated,
    answer: Answer,
    truth: dict[Cause, Any],
    named: dict[Cause, Any],
    report: Any,
) -> None:
    listed = [(c.name, c.joint) for c in report.ambiguous]
    out.listed = len(listed)
    if answer.kind == "inside":
        same = set(truth) == set(named) and all(
            _same_rows(truth[cause], named[cause]) for cause in truth
        )
        out.exact = out.verdict == "named" and same
        could = [cause_of(*entry)[:2] for entry in listed]
        could += [cause[:2] for cause in named]
        out.holds = out.verdict == "ambiguous" and all(c[:2] in could for c in truth)
    elif answer.kind == "confounded":
        names = {name for name, _ in listed}
        out.exact = out.verdict == "ambiguous" and set(answer.alternatives) <= names
    else:
        out.exact = out.verdict == answer.verdict
        out.partial = len(named) if out.verdict == "unknown" else 0


def _true_cause(fact: dict[str, Any]) -> Cause:
    if fact["name"] == "joint_coupling":
        return ("joint_coupling", fact["joint"], int(fact["settings"]["by"]))
    return cause_of(fact["name"], fact["joint"])


def _named_cause(effect: Any) -> Cause:
    if effect.name == "joint_coupling":
        return ("joint_coupling", effect.joint, int(float(effect.parameters["by"])))
    return cause_of(effect.name, effect.joint)


def _as_reported(cause: Cause, effect: Any, truth: dict[Cause, Any]) -> Cause:
    """A base that gives way and a link that bends count as one cause."""
    for true, fact in truth.items():
        bending = cause[0] == true[0] == "bending"
        if bending and "base_compliance" in (fact["name"], effect.name):
            return true
    return cause


def _same_rows(fact: dict[str, Any], effect: Any) -> bool:
    return fact["name"] != "outliers" or sorted(int(r) for r in effect.rows) == fact["rows"]


def _words(cause: Cause) -> str:
    return " ".join(str(part) for part in cause if part is not None)


def _pairs(
    answer: Answer, truth: dict[Cause, Any], named: dict[Cause, Any], verdict: str
) -> list[tuple[str, str]]:
    """Which name each true cause was given: its own, else one that nothing true accounts for."""
    spare = [cause[0] for cause in named if cause not in truth]
    if answer.kind != "inside":
        given = sorted(c[0] for c in named) if verdict == "named" else [verdict]
        return [((answer.outside and "outside") or answer.kind, g) for g in given[:1]]
    out = []
    for cause in truth:
        if cause in named:
            out.append((cause[0], cause[0]))
        else:
            rest = "not named" if verdict == "named" else verdict
            out.append((cause[0], spare.pop(0) if spare and verdict == "named" else rest))
    return out


def _covered(fact: dict[str, Any], effect: Any) -> list[tuple[str, float, bool]]:
    """Of each parameter that both know: how many standard deviations it is off, and whether the
    interval holds the truth. A map tells an order of its own by two of its numbers."""
    truth = dict(fact["parameters"])
    if fact["name"] != effect.name:
        if (fact["name"], effect.name) != ("joint_harmonic", "joint_map"):
            return []
        order = fact["settings"]["order"]
        terms = sum(name.startswith("cos_") for name in effect.parameters)
        if order not in range(1, terms + 1):
            return []
        truth = {f"{w}_{i}": 0.0 for w in ("cos", "sin") for i in range(1, terms + 1)} | {
            f"{w}_{order:.0f}": truth[w] for w in ("cos", "sin")
        }
    elif fact["name"] == "joint_harmonic":
        found = float(effect.parameters["order"]) if "order" in effect.parameters else None
        if found is not None and abs(found - fact["settings"]["order"]) > 0.03:
            return []  # the numbers of another order are other numbers
    elif fact["name"] == "joint_map":
        own, found = (sum(n.startswith("cos_") for n in p) for p in (truth, effect.parameters))
        if found < own:
            return []  # with fewer terms the numbers of those that are left are other numbers
        truth |= {f"{w}_{i}": 0.0 for w in ("cos", "sin") for i in range(own + 1, found + 1)}
    elif fact["name"] == "quantisation":
        return []  # a step is found or not
    out = []
    for name, value in truth.items():
        if name in effect.parameters:
            found = effect.parameters[name]
            low, high = found.interval
            std = max(found.std, 1e-300)
            off = (value - found.value) / std
            out.append((f"{fact['name']}.{name}", float(off), bool(low <= value <= high)))
    return out


def _errors(case: Case, residuals: Array) -> tuple[float, float]:
    """Model less measurement, less the error of the measurement: the error of the prediction.
    Touches leave the tip less its point, whose error has the other sign."""
    sealed = case.sealed
    keep = np.ones(len(residuals), bool)
    for fact in case.answer.effects:
        keep[fact.get("rows", [])] = False
    error = sealed.errors.copy()
    if sealed.point is None:
        wrong = residuals + error
        if np.sum(wrong[keep] ** 2) > np.sum((residuals - error)[keep] ** 2):
            wrong = residuals - error
    else:
        for label in np.unique(sealed.point):
            at = sealed.point == label
            error[at] -= error[at].mean(axis=0)
        wrong = residuals - error
        if np.sum(wrong[keep] ** 2) > np.sum((residuals + error)[keep] ** 2):
            wrong = residuals + error
    refit = sealed.refit_error()
    noise = case.answer.noise
    return (
        float(np.sqrt(np.mean(wrong[keep] ** 2)) / noise),
        float(np.sqrt(np.mean(refit[keep] ** 2)) / noise),
    )
