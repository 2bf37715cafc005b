# SPDX-License-Identifier: BSD-3-Clause
"""Diagnoses with known contents, for tests of what is said and drawn of them.

They are put together by hand around a UR10 whose encoder errs by a known harmonic, so that words,
pictures and files are tried on every verdict without a search.
"""

from __future__ import annotations

from functools import cache
from types import SimpleNamespace

import numpy as np

import bathyal
from bathyal._core import BEYOND_NOISE

NOISE = 0.03e-3  # [m per axis]
HARMONIC = {"cos": 3e-4, "sin": -4e-4}  # [rad], of order 2 along joint 3
ORDER = 2.0


class Estimate(SimpleNamespace):
    """A number with its interval."""

    def __float__(self) -> float:
        return float(self.value)


class Arm:
    """The corrected arm, as far as a report needs it: its file, and what it was taught."""

    gaps = (np.empty((0, 2)),) * 7

    def write(self, path: object) -> None:
        with open(path, "w", encoding="utf-8") as stream:
            stream.write('{"format": "bathyal arm"}\n')


class Structure(SimpleNamespace):
    """A dependence of the residuals."""

    @property
    def is_beyond_noise(self) -> bool:
        return bool(self.p_value <= BEYOND_NOISE)


class Report(SimpleNamespace):
    """A diagnosis with the attributes of `bathyal.Diagnosis`."""


def estimate(value: float, unit: str, std: float) -> Estimate:
    return Estimate(
        value=value, unit=unit, std=std, interval=(value - 1.96 * std, value + 1.96 * std)
    )


def cause(name: str, joint: int | None, words: str, odds: float = 1.0) -> SimpleNamespace:
    return SimpleNamespace(name=name, joint=joint, words=words, odds=odds)


def structure(
    kind: str, against: str, words: str, size: float, share: float, p_value: float, **facts: object
) -> SimpleNamespace:
    """`facts`: coordinates, period, covariate, component."""
    given: dict[str, object] = {
        "coordinates": [], "period": None, "covariate": None, "component": None, "joint": None
    }  # fmt: skip
    return Structure(
        kind=kind, against=against, words=words, size=size, share=share, p_value=p_value,
        **given | facts,
    )  # fmt: skip


def on_joint(number: int, words: str, size: float, share: float, p_value: float) -> SimpleNamespace:
    return structure(
        "joints", f"joint {number}", words, size, share, p_value, coordinates=[number - 1]
    )


def on_pair(
    first: int, second: int, words: str, size: float, share: float, p_value: float
) -> SimpleNamespace:
    against = f"joints {first} and {second}"
    coordinates = [first - 1, second - 1]
    return structure("joints", against, words, size, share, p_value, coordinates=coordinates)


def vibration(
    period: float, words: str, size: float, share: float, p_value: float
) -> SimpleNamespace:
    against = f"time, period {period:.4g} s"
    return structure("time", against, words, size, share, p_value, period=period)


def effect(name: str, joint: int | None, words: str, **numbers: object) -> SimpleNamespace:
    given = {
        "parameters": {}, "gain": 0.9, "held_out_before": 4e-4, "held_out_after": 0.6e-4,
        "p_value": 1e-300, "size": 2e-4, "rivals": [], "rows": [], "nested_folds": 0,
    }  # fmt: skip
    return SimpleNamespace(name=name, joint=joint, words=words, **{**given, **numbers})


def harmonic() -> SimpleNamespace:
    return effect(
        "joint_harmonic", 2, "a harmonic of order 2 along joint 3",
        parameters={
            "order": estimate(ORDER, "", 0.0),
            "cos": estimate(HARMONIC["cos"], "rad", 6e-6),
            "sin": estimate(HARMONIC["sin"], "rad", 5e-6),
        },
        rivals=[
            cause("joint_map", 2, "a smooth curve along joint 3 with 3 terms", 0.21),
            cause("joint_scale", 2, "joint 3 counts too much", 1e-9),
        ],
    )  # fmt: skip


@cache
def measured(count: int = 240, sessions: int = 2) -> bathyal.Tracked:
    """A UR10 whose joint 3 errs, seen by a tracker; temperature, time and session recorded."""
    random = np.random.default_rng(5)
    arm = bathyal.arms.ur10()
    q = random.uniform(-2.2, 2.2, (count, 6))
    true = q.copy()
    true[:, 2] += HARMONIC["cos"] * np.cos(ORDER * q[:, 2])
    true[:, 2] += HARMONIC["sin"] * np.sin(ORDER * q[:, 2])
    seen = arm.forward(true)[:, :3, 3] + random.normal(0, NOISE, (count, 3))
    time = np.cumsum(random.uniform(20, 40, count))
    return bathyal.Tracked(
        q, seen, session=np.arange(count) * sessions // count,
        covariates={"time": time, "temperature": 20 + 2 * np.sin(time / 4000)},
    )  # fmt: skip


@cache
def fits(count: int = 240, sessions: int = 2) -> tuple[bathyal.ArmFit, np.ndarray]:
    """Geometry alone, and what would be left (N, 3) with the harmonic taken out."""
    data = measured(count, sessions)
    random = np.random.default_rng(6)
    fit = bathyal.identify_arm(bathyal.arms.ur10(), data)
    return fit, random.normal(0, NOISE, (len(data), 3))


def base(count: int = 240, sessions: int = 2) -> Report:
    """What all verdicts share: geometry alone, and something against joint 3."""
    data = measured(count, sessions)
    fit, rest = fits(count, sessions)
    before = np.linalg.norm(fit.residuals, axis=1)
    after = np.linalg.norm(rest, axis=1)
    name = "session {}" if sessions > 1 else "all"
    session = np.asarray(data.covariates["session"]).ravel()
    parts = [
        SimpleNamespace(
            name=name.format(s + 1), rows=int((session == s).sum()),
            rms_before=rms(before[session == s]), rms_after=rms(after[session == s]),
        )
        for s in range(sessions)
    ]  # fmt: skip
    noise = np.sqrt(3) * NOISE
    return Report(
        verdict="named",
        effects=[harmonic()],
        ambiguous=[],
        next_poses=np.empty((0, 6)),
        shown=[
            on_joint(3, "The residual turns over twice along joint 3", 2e-4, 0.93, 1e-300),
            structure("position", "position", "The residual bends with z", 0.4e-4, 0.11, 0.004),
            structure("time", "time", "Nothing along time", 0.0, 0.0, 0.63),
            structure("covariate", "temperature", "Nothing along temperature", 0.0, 0.0, 0.88,
                      covariate="temperature"),
            on_pair(2, 3, "The residual depends on joints 2 and 3 together", 0.9e-4, 0.3, 1e-5),
        ],
        leftover=structure("none", "", "", 0.0, 0.0, 0.7),
        held_out=SimpleNamespace(
            how="20 blocks of poses that lie near each other were held out in turn", blocks=20,
            rms_before=rms(before),
            rms_after=rms(after), noise=noise, p_value=2e-6, parts=parts, before=before,
            after=after, nested=None,
        ),
        gain=(rms(before) ** 2 - rms(after) ** 2) / (rms(before) ** 2 - noise**2),
        model=Arm(),
        fit=fit,
        data=data,
        noise=NOISE,
        noise_source="exact repeats of 12 poses",
        noise_is_measured=True,
        detectable=0.012e-3,
        residuals_before=fit.residuals,
        residuals_after=rest,
        warnings=["The arm's masses are not known: loads count as lumped moments."],
    )  # fmt: skip


def rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.square(values))))


def named() -> Report:
    return base()


def clean() -> Report:
    report = base()
    held = report.held_out
    held.before, held.rms_before = held.after, held.rms_after
    held.p_value = 0.6
    for part in held.parts:
        part.rms_before = part.rms_after
    report.__dict__.update(
        verdict="clean", effects=[], gain=0.0, warnings=[],
        residuals_before=report.residuals_after,
        shown=[on_joint(k, f"Nothing along joint {k}", 0.0, 0.0, 0.1 * k)
               for k in range(1, 7)],
    )  # fmt: skip
    return report


def ambiguous() -> Report:
    report = base()
    report.__dict__.update(
        verdict="ambiguous",
        effects=[
            harmonic(),
            effect(
                "tool_slip",
                None,
                "the tool slipped after 120 rows",
                parameters={"moment": estimate(120, "", 0.0), "shift_x": estimate(3e-4, "m", 1e-5)},
            ),
        ],
        ambiguous=[
            cause("tool_slip", None, "the tool slipped after 120 rows"),
            cause("base_shift", None, "the base moved between sessions 1 and 2", 0.8),
            cause("drift", None, "the base drifts", 0.11),
        ],
        next_poses=np.random.default_rng(7).uniform(-2, 2, (5, 6)),
    )
    return report


def unknown() -> Report:
    report = base()
    held = report.held_out
    held.after, held.rms_after = 0.8 * held.before, 0.8 * held.rms_before
    for part in held.parts:
        part.rms_after = 0.8 * part.rms_before
    report.__dict__.update(
        verdict="unknown",
        gain=0.37,
        leftover=vibration(12.1, "The residual swings with time, period 12.1 s", 1.6e-4, 0.8, 1e-9),
        residuals_after=0.8 * report.residuals_before,
    )
    return report


def none() -> Report:
    report = base(count=40, sessions=1)
    held = report.held_out
    nothing = np.empty(0)
    held.__dict__.update(
        how="40 poses make fewer than four blocks", blocks=0, rms_before=np.nan, rms_after=np.nan,
        p_value=1.0, parts=[], before=nothing, after=nothing,
    )  # fmt: skip
    report.__dict__.update(verdict="none", effects=[], gain=float("nan"), detectable=float("nan"))
    report.residuals_after = report.residuals_before
    return report


def many(count: int = 20) -> Report:
    """Many causes, of every kind that is drawn or listed in its own way."""
    report = base()
    kinds = [
        ("joint_map", 1, "a smooth curve along joint 2",
         {"cos_1": (1e-4, "rad", 2e-6), "sin_1": (2e-4, "rad", 2e-6), "cos_2": (5e-5, "rad", 2e-6),
          "sin_2": (-3e-5, "rad", 2e-6), "terms": (2.0, "", 0.0), "wave": (1.0, "", 0.0)}),
        ("joint_scale", 0, "joint 1 counts too much", {"scale": (1.2e-3, "1", 2e-5)}),
        ("joint_coupling", 3, "joint 4 is moved along by joint 3",
         {"by": (2.0, "", 0.0), "ratio": (-0.002, "1", 1e-4)}),
        ("backlash", 4, "play in joint 5", {"gap": (8e-4, "rad", 3e-5)}),
        ("joint_compliance", 1, "joint 2 gives way under load",
         {"compliance": (2.1e-6, "rad/(N m)", 1e-7)}),
        ("base_shift", None, "the base moved between sessions <1> & 2",
         {f"{kind}_{axis}_2": (1e-4, unit, 1e-5) for kind, unit in (("shift", "m"), ("turn", "rad"))
          for axis in "xyz"}),
        ("thermal", None, "the links grow when warm: Größe µ ✓",
         {"expansion": (2.3e-5, "1/K", 1e-6)}),
        ("drift", None, "the base drifts", {"rate_x": (2e-8, "m/s", 1e-9)}),
        ("outliers", None, "3 rows that disagree", {}),
    ]  # fmt: skip
    report.effects = []
    for k in range(count):
        name, joint, words, numbers = kinds[k % len(kinds)]
        estimates = {key: estimate(*value) for key, value in numbers.items()}
        report.effects.append(
            effect(name, joint, words, parameters=estimates, gain=0.5 / (k + 1),
                   rows=list(range(12)) if name == "outliers" else [])
        )  # fmt: skip
    return report


CASES = {
    "named": named,
    "clean": clean,
    "ambiguous": ambiguous,
    "unknown": unknown,
    "none": none,
    "many": many,
}
