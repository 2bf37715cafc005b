# SPDX-License-Identifier: BSD-3-Clause
"""What an identification found, how surely, and what to touch next, in sentences."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Arm, ArmFit, Touches, Tracked
from bathyal.identify.report.tables import distances, point_name
from bathyal.view.text import number

Floats = NDArray[np.float64]

# What a status of `FitParameter` says.
STATUS = {
    "identified": "identified",
    "gauge": "redundant",
    "prior": "with a prior",
    "not_identifiable": "not determined",
    "fixed": "fixed on request",
    "pruned": "set to nominal",
}

_LOOKS = 4000  # poses at which the tip is predicted
_STILL = math.radians(30.0)  # a turning joint that moved less hardly moved
_STILL_SHARE = 0.15  # of a sliding joint's way
_FEW = 20  # degrees of freedom below which noise is known to worse than 16 %
_MOST_LISTED = 4  # known distances, one by one
_WEAK = 1e-3  # standard deviation of what is hardly determined [m, rad] …
_WEAK_SHARE = 20.0  # … and so many times the median of all
_FINE = 3.0  # the worst pose is worth a touch where it is so many times the median


def surely_text(fit: ArmFit) -> str:
    """How accurate the identified arm is over the whole of its limits."""
    _, std = _looks(fit)
    share = float(np.mean(np.isinf(std)))
    text = []
    if share < 1.0:
        median, most = np.quantile(std[np.isfinite(std)], [0.5, 0.95])
        text.append(
            f"Over the arm's limits its tip is predicted to {_mm(median)} (standard deviation, all "
            f"axes together; median), and to {_mm(most)} or better in 95 of 100 poses."
        )
    if share > 0.0:
        where = "Everywhere" if share == 1.0 else f"In {share:.0%} of its poses"
        text.append(
            f"{where} the tip depends on what the data do not determine, and has no standard "
            "deviation."
        )
    return " ".join(text)


def predicted_tip(fit: ArmFit) -> str:
    """The same in short: "0.277 mm (median; 0.426 mm in 95 of 100 poses)"."""
    _, std = _looks(fit)
    if not np.isfinite(std).all():
        return "no accuracy known: it depends on what the data do not determine"
    median, most = np.quantile(std, [0.5, 0.95])
    return f"{_mm(median)} (1 sigma, median over the limits; 95 of 100 poses: {_mm(most)})"


def known_text(fit: ArmFit, data: Touches | Tracked) -> str:
    """Known distances, given and found; empty where there are none."""
    known = distances(fit, data)
    if not known:
        return ""
    if len(known) > _MOST_LISTED:
        off = [1e3 * (d.found - d.given) for d in known]
        ends = f"{number(min(off), sign='+')} … {number(max(off), sign='+')}"
        return f"{len(known)} known distances were found, off by {ends} mm."
    listed = [
        f"{d.first} to {d.second} given {1e3 * d.given:.3f} mm, found {1e3 * d.found:.3f} mm"
        for d in known
    ]
    return f"Known distances: {'; '.join(listed)}."


def next_touches(fit: ArmFit, data: Touches | Tracked) -> list[str]:
    """What to measure next, the most important first; how to check the arm where all is well."""
    needed = [
        *_about_size(fit, data),
        *_about_still_joints(fit.arm, data),
        *_about_undetermined(fit, data),
        *_about_weak(fit),
        *_about_worst_pose(fit, data),
        *_about_count(fit, data),
    ]
    if needed:
        return needed
    if fit.warnings:
        return ["Resolve the warnings before you touch more."]
    check = (
        "measure a dozen poses that were not used, and compare"
        if isinstance(data, Tracked)
        else "touch a point that was not used in a dozen poses, and see that they agree"
    )
    return [f"To check the arm, {check}."]


def _about_size(fit: ArmFit, data: Touches | Tracked) -> list[str]:
    if isinstance(data, Tracked) or not fit.scale_source.startswith("prior"):
        return []
    if len(fit.point_labels) < 2:
        return [
            "Touch a second point at a distance that you measured, and give it as a known distance."
        ]
    first, second = (point_name(data, label) for label in fit.point_labels[:2])
    return [
        f"Measure one distance between touched points, say {first} to {second}, and give it as a "
        "known distance."
    ]


def _about_still_joints(arm: Arm, data: Touches | Tracked) -> list[str]:
    moved = np.ptp(data.q, axis=0)
    still = []
    for name, kind, much, way in zip(
        arm.joint_names, arm.joint_types, moved, arm.upper - arm.lower, strict=True
    ):
        if kind == "revolute" and much < _STILL:
            still.append(f"{name} moved over {math.degrees(much):.3g}°")
        elif kind == "prismatic" and math.isfinite(way) and much < _STILL_SHARE * way:
            still.append(f"{name} moved over {_mm(much)} of its {_mm(way)}")
    if not still:
        return []
    return [f"Spread the joints further: {', '.join(still)}."]


def _about_undetermined(fit: ArmFit, data: Touches | Tracked) -> list[str]:
    lost = [p for p in fit.parameters if p.status == "not_identifiable"]
    if not lost:
        return []
    names = ", ".join(p.name for p in lost)
    return [
        f"The data do not determine {names}: {_more(data)}, with every joint far from where it "
        "was, or give the maker's tolerances as priors."
    ]


def _about_weak(fit: ArmFit) -> list[str]:
    identified = [p for p in fit.parameters if p.status == "identified" and p.std > 0]
    if not identified:
        return []
    median = float(np.median([p.std for p in identified]))
    weak = [p.name for p in identified if p.std > max(_WEAK, _WEAK_SHARE * median)]
    if not weak:
        return []
    return [
        f"The data hardly determine {', '.join(weak)}: turn the joints further from where they "
        "were, or give the maker's tolerances as priors."
    ]


def _about_worst_pose(fit: ArmFit, data: Touches | Tracked) -> list[str]:
    q, std = _looks(fit)
    if not np.isfinite(std).all():
        return []
    worst = int(np.argmax(std))
    if std[worst] < _FINE * np.median(std):
        return []
    pose = ", ".join(
        f"{1e3 * value:.0f} mm" if kind == "prismatic" else f"{math.degrees(value):.0f}°"
        for value, kind in zip(q[worst], fit.arm.joint_types, strict=True)
    )
    return [
        f"The tip is predicted least accurately, to {_mm(std[worst])}, near the pose ({pose}): "
        f"{_more(data)} about there{_planned(data)}."
    ]


def _planned(data: Touches | Tracked) -> str:
    return "" if isinstance(data, Tracked) else "; `bathyal touches plan` chooses such poses"


def _about_count(fit: ArmFit, data: Touches | Tracked) -> list[str]:
    if fit.degrees_of_freedom >= _FEW:
        return []
    return [
        f"Only {fit.degrees_of_freedom:.0f} degrees of freedom remain to estimate the noise, so "
        f"that standard deviations are rough: {_more(data)}."
    ]


def _looks(fit: ArmFit) -> tuple[Floats, Floats]:
    """Poses over the arm's limits, the same every time, and the predicted tip's std at each [m]."""
    lower, upper = np.maximum(fit.arm.lower, -np.pi), np.minimum(fit.arm.upper, np.pi)
    q = np.random.default_rng(0).uniform(lower, upper, (_LOOKS, fit.arm.size))
    return q, np.asarray(fit.tip_std(q))


def _more(data: Touches | Tracked) -> str:
    return "measure more poses" if isinstance(data, Tracked) else "touch more points, more often"


def _mm(metres: float) -> str:
    if metres >= 1.0:
        return f"{metres:.3g} m"
    return f"{1e3 * metres:.3g} mm"
