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
    "gauge": "base or tool does it",
    "prior": "rests on a prior",
    "not_identifiable": "not told",
    "fixed": "held on request",
    "pruned": "put back to nominal",
}

_LOOKS = 4000  # poses at which the foretold tip is asked for
_STILL = math.radians(30.0)  # a turning joint that moved less hardly moved
_STILL_SHARE = 0.15  # of a sliding joint's way
_FEW = 20  # degrees of freedom below which noise is known to worse than 16 %
_MOST_TOLD = 4  # known distances, one by one
_WEAK = 1e-3  # standard deviation of what is hardly told [m, rad] …
_WEAK_SHARE = 20.0  # … and so many times the median of all
_FINE = 3.0  # the worst pose is worth a touch where it is so many times the median


def surely_text(fit: ArmFit) -> str:
    """How far the arm that was found may be trusted over the whole of its limits."""
    _, std = _looks(fit)
    share = float(np.mean(np.isinf(std)))
    text = []
    if share < 1.0:
        median, most = np.quantile(std[np.isfinite(std)], [0.5, 0.95])
        text.append(
            f"Over the arm's limits its tip is foretold to {_mm(median)} (standard deviation, all "
            f"axes together; median), and to {_mm(most)} or better in 95 of 100 poses."
        )
    if share > 0.0:
        where = "Everywhere" if share == 1.0 else f"In {share:.0%} of its poses"
        text.append(
            f"{where} the tip moves by something that nobody told, and no standard deviation can "
            "be said."
        )
    return " ".join(text)


def known_text(fit: ArmFit, data: Touches | Tracked) -> str:
    """Known distances told and found; empty where there are none."""
    known = distances(fit, data)
    if not known:
        return ""
    if len(known) > _MOST_TOLD:
        off = [1e3 * (d.found - d.given) for d in known]
        ends = f"{number(min(off), sign='+')} … {number(max(off), sign='+')}"
        return f"{len(known)} known distances were found, off by {ends} mm."
    told = [
        f"{d.first} to {d.second} told {1e3 * d.given:.3f} mm, found {1e3 * d.found:.3f} mm"
        for d in known
    ]
    return f"Known distances: {'; '.join(told)}."


def next_touches(fit: ArmFit, data: Touches | Tracked) -> list[str]:
    """What would tell more, the most important first; how to check the arm when nothing would."""
    wanting = [
        *_about_size(fit, data),
        *_about_still_joints(fit.arm, data),
        *_about_lost(fit, data),
        *_about_weak(fit),
        *_about_worst_pose(fit, data),
        *_about_count(fit, data),
    ]
    if wanting:
        return wanting
    if fit.warnings:
        return ["Look into what the warnings say before you touch more."]
    check = (
        "measure a dozen poses that were no part of this, and compare"
        if isinstance(data, Tracked)
        else "touch a point that was no part of this, in a dozen poses, and see that they agree"
    )
    return [f"Nothing in particular is wanting. To check the arm, {check}."]


def _about_size(fit: ArmFit, data: Touches | Tracked) -> list[str]:
    if isinstance(data, Tracked) or not fit.scale_source.startswith("prior"):
        return []
    if len(fit.point_labels) < 2:
        return [
            "Touch a second point at a distance that you know, and tell it as a known distance: "
            "touches of one point cannot tell an arm from a smaller one."
        ]
    first, second = (point_name(data, label) for label in fit.point_labels[:2])
    return [
        f"Measure one distance between touched points, say {first} to {second}, and tell it as a "
        "known distance: touches alone cannot tell an arm from a smaller one."
    ]


def _about_still_joints(arm: Arm, data: Touches | Tracked) -> list[str]:
    moved = np.ptp(data.q, axis=0)
    told = []
    for name, kind, much, way in zip(
        arm.joint_names, arm.joint_types, moved, arm.upper - arm.lower, strict=True
    ):
        if kind == "revolute" and much < _STILL:
            told.append(f"{name} moved over {math.degrees(much):.3g}°")
        elif kind == "prismatic" and math.isfinite(way) and much < _STILL_SHARE * way:
            told.append(f"{name} moved over {_mm(much)} of its {_mm(way)}")
    if not told:
        return []
    return [f"Spread the joints further: {', '.join(told)}."]


def _about_lost(fit: ArmFit, data: Touches | Tracked) -> list[str]:
    lost = [p for p in fit.parameters if p.status == "not_identifiable"]
    if not lost:
        return []
    names = ", ".join(p.name for p in lost)
    return [
        f"Nothing tells {names}: {_more(data)}, with every joint far from where it was, or tell "
        "the maker's tolerances as priors."
    ]


def _about_weak(fit: ArmFit) -> list[str]:
    told = [p for p in fit.parameters if p.status == "identified" and p.std > 0]
    if not told:
        return []
    median = float(np.median([p.std for p in told]))
    weak = [p.name for p in told if p.std > max(_WEAK, _WEAK_SHARE * median)]
    if not weak:
        return []
    return [
        f"The data hardly tell {', '.join(weak)} apart: joints turned further from where they "
        "were would, or the maker's tolerances as priors."
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
        f"The tip is least surely foretold, to {_mm(std[worst])}, near the pose ({pose}): "
        f"{_more(data)} about there{_planned(data)}."
    ]


def _planned(data: Touches | Tracked) -> str:
    return "" if isinstance(data, Tracked) else "; `bathyal touches plan` chooses such poses"


def _about_count(fit: ArmFit, data: Touches | Tracked) -> list[str]:
    if fit.degrees_of_freedom >= _FEW:
        return []
    return [
        f"{fit.degrees_of_freedom:.0f} degrees of freedom are left to tell the noise by, so that "
        f"every standard deviation is a guess: {_more(data)}."
    ]


def _looks(fit: ArmFit) -> tuple[Floats, Floats]:
    """Poses over the arm's limits, the same every time, and the foretold tip's std at each [m]."""
    lower, upper = np.maximum(fit.arm.lower, -np.pi), np.minimum(fit.arm.upper, np.pi)
    q = np.random.default_rng(0).uniform(lower, upper, (_LOOKS, fit.arm.size))
    return q, np.asarray(fit.tip_std(q))


def _more(data: Touches | Tracked) -> str:
    return "measure more poses" if isinstance(data, Tracked) else "touch more points, more often"


def _mm(metres: float) -> str:
    if metres >= 1.0:
        return f"{metres:.3g} m"
    return f"{1e3 * metres:.3g} mm"
