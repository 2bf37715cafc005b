# SPDX-License-Identifier: BSD-3-Clause
"""Effects hidden in simulated touches: what geometry cannot represent, with a size and a joint that
are known, so that a diagnosis can be tried."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Arm, CorrectedArm, Error, FoundEffect, Support, arm_from_parts, arm_parts
from bathyal.effects import get
from bathyal.errors import argument_error

Floats = NDArray[np.float64]

_ROUND = 60.0  # seconds between touches
_COLDEST, _WARMEST = 10.0, 20.0  # °C over the touches
_LINK_MASS = 6.0  # of each link of an arm whose masses are unknown [kg]
_TILT = 3.0  # rad/m: turns of a base or tool that go with its shifts
_FRAME = {"x": 1.0, "y": -0.6, "z": 0.4}  # shares of the axes


@dataclass(frozen=True)
class _Shape:
    """How an effect is written: parameters as shares of its size, and what it goes with."""

    parameters: Mapping[str, float]
    settings: Mapping[str, float] = field(default_factory=dict)
    joint: int | None = None  # the default, from 0; None: it sits in no joint
    covariates: tuple[str, ...] = ()
    weight: bool = False  # whether it acts through the arm's weight
    size: float = 1e-3  # unless given [m]


def _frame(shift: str, turn: str = "") -> dict[str, float]:
    shares = {shift.format(axis): share for axis, share in _FRAME.items()}
    if turn:
        shares |= {turn.format(axis): _TILT * share for axis, share in _FRAME.items()}
    return shares


_SHAPES = {
    "joint_harmonic": _Shape({"cos": 0.6, "sin": 0.8}, {"order": 1.0}, joint=2),
    "joint_scale": _Shape({"scale": 1.0}, joint=2),
    "joint_coupling": _Shape({"ratio": 1.0}, joint=2),
    "backlash": _Shape({"gap": 1.0}, joint=1, covariates=("direction",)),
    "joint_compliance": _Shape({"compliance": 1.0}, joint=1, weight=True),
    "base_shift": _Shape(_frame("shift_{}_2", "turn_{}_2"), {"session_2": 2.0},
                         covariates=("session",)),
    "tool_change": _Shape(_frame("shift_{}_2"), {"session_2": 2.0}, covariates=("session",)),
    "tool_slip": _Shape(_frame("shift_{}"), covariates=("time",)),
    "thermal": _Shape({"expansion": 1.0}, covariates=("temperature",), size=3e-4),
    "drift": _Shape(_frame("rate_{}", "turn_rate_{}"), covariates=("time",)),
}  # fmt: skip
HIDEABLE = tuple(_SHAPES)
"""Names of the effects that `simulate_touches` can hide."""
_SPELLED = re.compile(r"(?P<name>[^@=]+)(@(?P<joint>\d+))?")


@dataclass(frozen=True)
class HiddenEffect:
    """An effect that simulated touches contain.

    Attributes
    ----------
    name : str
        Of the library.
    joint : int or None
        From 0.
    size : float
        By how much it moves the tip, 3-D rms over the touches, before geometry is fitted [m].
    parameters : dict of str to float
        Its values, SI units.
    """

    name: str
    joint: int | None
    size: float
    parameters: dict[str, float]

    def __str__(self) -> str:
        where = "" if self.joint is None else f" of joint {self.joint + 1}"
        return f"{self.name}{where}, {1e3 * self.size:.3g} mm rms at the tip"


def hide_effect(
    name: str, true: Arm, q: Floats, size: float | None, rng: np.random.Generator
) -> tuple[Floats, dict[str, Floats], HiddenEffect]:
    """Joint values that bring the tip to the same places in the presence of an effect.

    Parameters
    ----------
    name : str
        As `simulate_touches` takes it.
    true : Arm
        Without the effect.
    q : (N, n) array
        Joint values without the effect, in the order of touching [rad].
    size : float or None
        3-D rms at the tip [m].
    rng : numpy.random.Generator

    Returns
    -------
    (N, n) array, covariates, HiddenEffect

    Raises
    ------
    ValueError
        For no such effect or joint, or a bad size.
    Error
        Where a place is not reached.
    """
    shape, name, joint = _find(name, true)
    size = shape.size if size is None else size
    if not 0 < size < math.inf:
        raise argument_error("hide_size", "a length above 0", size)
    arm = _weighed(true) if shape.weight else true
    recorded = {key: _COVARIATES[key](len(q), true.size, rng) for key in shape.covariates}
    settings = dict(shape.settings)
    if name == "joint_coupling":
        settings["by"] = float(joint - 1 if joint else 1)
    if name == "tool_slip":
        settings |= {"moment": float(len(q) // 2), "time": (len(q) // 2 - 0.5) * _ROUND}
    if name == "drift":
        settings["first_time"] = 0.0
    if name == "thermal":
        settings["mean_temperature"] = float(recorded["temperature"].mean())

    def bent(scale: float) -> CorrectedArm:
        values = {key: scale * share for key, share in shape.parameters.items()}
        found = FoundEffect(get(name), values, joint=joint, settings=settings)
        return CorrectedArm(arm, [found], _everywhere(arm, recorded))

    tip = true.forward(q)[:, :3, 3]
    little = 1e-6
    moved = bent(little).forward(q, covariates={**recorded})[:, :3, 3] - tip
    rms = float(np.sqrt(np.mean(np.sum(moved**2, axis=1))))
    if rms <= 0:
        raise argument_error("hide", "an effect that moves this arm's tip", repr(name))
    scale = little * size / rms  # an effect is linear in its parameters, nearly so at the tip
    reached = bent(scale).inverse(tip, q, covariates={**recorded}, task="position", max_starts=1)
    if not all(status == "reached" for status in reached.status):
        raise Error(f"`{name}`: expected a size that keeps all points within reach, got "
                    f"{1e3 * size:.3g} mm")  # fmt: skip
    values = {key: scale * share for key, share in shape.parameters.items()}
    return np.asarray(reached.q), recorded, HiddenEffect(name, joint, size, values)


def _find(text: str, arm: Arm) -> tuple[_Shape, str, int | None]:
    """The effect and the joint of "NAME" or "NAME@JOINT"."""
    spelled = _SPELLED.fullmatch(text.strip())
    name = spelled["name"] if spelled else text
    if spelled is None or name not in _SHAPES:
        raise argument_error("hide", f"one of {', '.join(_SHAPES)}", repr(text))
    shape = _SHAPES[name]
    if spelled["joint"] is None:
        return shape, name, shape.joint
    if shape.joint is None:
        raise argument_error("hide", f"{name} without a joint, in which it does not sit",
                             repr(text))  # fmt: skip
    joint = int(spelled["joint"])
    if not 1 <= joint <= arm.size:
        raise argument_error("hide", f"a joint from 1 to {arm.size}", repr(text))
    return shape, name, joint - 1


def _everywhere(arm: Arm, covariates: Mapping[str, Floats]) -> Support:
    """A support without bounds that touches could meet."""
    sessions = covariates.get("session")
    ranges = {
        key: np.vstack([values.min(axis=0), values.max(axis=0)]).reshape(2, -1)
        for key, values in covariates.items()
        if key != "session"
    }
    return Support(
        np.tile([[-100.0], [100.0]], (1, arm.size)),
        covariates=ranges,
        sessions=None if sessions is None else np.unique(sessions),
    )


def _weighed(arm: Arm) -> Arm:
    """The arm with masses: its own, or where none is known one of each link, half way along it."""
    parts = arm_parts(arm)
    if any(link["mass"] for link in parts["links"]):
        return arm
    for link, row in zip(parts["links"][1:], parts["joints"], strict=False):
        link["mass"] = _LINK_MASS
        link["center_of_mass"] = np.array([-row["a"] / 2, 0.0, 0.0])
    return arm_from_parts(parts)


def _time(count: int, joints: int, rng: np.random.Generator) -> Floats:
    return _ROUND * np.arange(count, dtype=float)


def _session(count: int, joints: int, rng: np.random.Generator) -> Floats:
    return np.asarray(1.0 + (4 * np.arange(count) // count) % 2)


def _temperature(count: int, joints: int, rng: np.random.Generator) -> Floats:
    phase = np.linspace(0, 3 * np.pi, count)
    return np.asarray(np.round(_COLDEST + (_WARMEST - _COLDEST) * (1 - np.cos(phase)) / 2, 2))


def _direction(count: int, joints: int, rng: np.random.Generator) -> Floats:
    return np.asarray(rng.choice([-1.0, 1.0], (count, joints)))


_COVARIATES = {
    "time": _time, "session": _session, "temperature": _temperature, "direction": _direction,
}  # fmt: skip
