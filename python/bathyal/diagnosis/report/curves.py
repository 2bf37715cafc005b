# SPDX-License-Identifier: BSD-3-Clause
"""The curve that an effect adds to its joint, with its band."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from bathyal.arm.joint_values import joint_values
from bathyal.diagnosis.report.quantities import joint_label

if TYPE_CHECKING:
    from bathyal._core import Diagnosis

Floats = NDArray[np.float64]

_CURVE = 241
_INTERVAL = 1.96


@dataclass(frozen=True)
class JointCurve:
    """What an effect adds to a joint, over the range that was measured; in shown units.

    `middle`, `low`, `high` (K,): the curve and its 95 % band, from the parameters' own standard
    deviations taken as independent of one another.
    """

    title: str
    across: str
    up: str
    place: Floats
    middle: Floats
    low: Floats
    high: Floats
    seen: Floats


def joint_curve(report: Diagnosis, effect: Any) -> JointCurve | None:
    """The curve of an effect along one joint; None for effects that have none."""
    if effect.joint is None or effect.name not in _TERMS:
        return None
    arm, data = report.fit.arm, report.data
    slides = arm.joint_types[effect.joint] == "prismatic"
    along = effect.joint
    if effect.name == "joint_coupling":
        along = round(float(effect.parameters["by"].value))
    q = np.asarray(data.q)[:, along]
    place = np.linspace(q.min(), q.max(), _CURVE)
    terms = _TERMS[effect.name](effect, place)
    if terms is None:
        return None
    middle = sum((float(p.value) * basis for p, basis in terms), np.zeros(_CURVE))
    variance = sum(((float(p.std) * basis) ** 2 for p, basis in terms), np.zeros(_CURVE))
    half = _INTERVAL * np.sqrt(variance)
    across = joint_values(arm, data)[along]
    shown = 1e3 if slides else math.degrees(1.0)
    scale = 1e3 if across.unit == "mm" else math.degrees(1.0)
    return JointCurve(
        title=str(effect.words),
        across=f"{joint_label(along + 1, across.name)} [{across.unit}]",
        up=f"joint {effect.joint + 1} off by [{'mm' if slides else '°'}]",
        place=scale * place,
        middle=shown * middle,
        low=shown * (middle - half),
        high=shown * (middle + half),
        seen=across.values,
    )


Terms = list[tuple[Any, Floats]]


def _harmonic(effect: Any, q: Floats) -> Terms | None:
    numbers = effect.parameters
    if not {"order", "cos", "sin"} <= numbers.keys():
        return None
    phase = float(numbers["order"].value) * q
    return [(numbers["cos"], np.cos(phase)), (numbers["sin"], np.sin(phase))]


def _map(effect: Any, q: Floats) -> Terms | None:
    if "wave" not in effect.parameters:
        return None
    base = float(effect.parameters["wave"].value)
    terms = []
    for name, number in effect.parameters.items():
        kind, _, order = name.partition("_")
        if kind in ("cos", "sin") and order.isdigit():
            phase = int(order) * base * q
            terms.append((number, np.cos(phase) if kind == "cos" else np.sin(phase)))
    return terms or None


def _scale(effect: Any, q: Floats) -> Terms | None:
    return [(effect.parameters["scale"], q)] if "scale" in effect.parameters else None


def _coupling(effect: Any, q: Floats) -> Terms | None:
    return [(effect.parameters["ratio"], q)] if "ratio" in effect.parameters else None


_TERMS = {
    "joint_harmonic": _harmonic,
    "joint_map": _map,
    "joint_scale": _scale,
    "joint_coupling": _coupling,
}
