# SPDX-License-Identifier: BSD-3-Clause
"""Draws an effect of the library: which joint, which setting, which way its parameters point."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from tests.simulated_cases import effect_library as lib
from tests.simulated_cases.arms import Array
from tests.simulated_cases.effect_shapes import Poses, Shape

Drawn = tuple[Shape, Array]
MM, MRAD = 1e-3, 1e-3

# Sizes beyond which nobody would believe a value, by parameter's first word.
PLAUSIBLE = {
    "cos": 0.02,
    "sin": 0.02,
    "scale": 0.02,
    "ratio": 0.02,
    "gap": 0.02,
    "compliance": 1e-3,
    "flexibility": 1e-3,
    "mass_compliance": 5e-3,
    "shift": 0.02,
    "turn": 0.02,
    "expansion": 3e-4,
    "rate": 1e-3,
    "turn_rate": 1e-3,
    "delay": 0.2,
}


def plausible(shape: Shape, values: Array) -> bool:
    for name, value in zip(shape.actions, values, strict=True):
        word = next(w for w in sorted(PLAUSIBLE, key=len, reverse=True) if name.startswith(w))
        if abs(value) > PLAUSIBLE[word]:
            return False
    return True


def _joint(random: np.random.Generator, poses: Poses) -> int:
    return int(random.integers(poses.arm.size))


def _harmonic(random: np.random.Generator, poses: Poses) -> Drawn:
    joint = _joint(random, poses)
    orders = lib.orders_of(poses, joint)
    order = float(random.choice(orders))
    if random.random() < 0.3:
        order = random.uniform(orders[0], orders[-1])
    return lib.harmonic(poses, joint, order), random.normal(size=2)


def _curve(random: np.random.Generator, poses: Poses) -> Drawn:
    terms = int(random.integers(2, 5))
    fall = np.repeat(1.0 / np.arange(1, terms + 1), 2)
    return lib.curve(poses, _joint(random, poses), terms), fall * random.normal(size=2 * terms)


def _scale(random: np.random.Generator, poses: Poses) -> Drawn:
    return lib.scale(poses, _joint(random, poses)), _sign(random)


def _coupling(random: np.random.Generator, poses: Poses) -> Drawn:
    joint, by = random.choice(poses.arm.size, 2, replace=False)
    return lib.coupling(poses, int(joint), int(by)), _sign(random)


def _backlash(random: np.random.Generator, poses: Poses) -> Drawn:
    return lib.backlash(poses, _joint(random, poses)), np.ones(1)


def _joint_compliance(random: np.random.Generator, poses: Poses) -> Drawn:
    return lib.joint_compliance(poses, _joint(random, poses)), np.ones(1)


def _link_compliance(random: np.random.Generator, poses: Poses) -> Drawn:
    return lib.link_compliance(poses, int(random.integers(poses.arm.size - 1))), np.ones(1)


def _base_compliance(random: np.random.Generator, poses: Poses) -> Drawn:
    return lib.base_compliance(poses), random.uniform(0.3, 1.0, 2)


def _payload(random: np.random.Generator, poses: Poses) -> Drawn:
    shape = lib.payload(poses)
    return shape, np.exp(random.normal(0, 0.4, len(shape.actions)))


def _twist(random: np.random.Generator, shape: Shape) -> Drawn:
    return shape, random.normal(size=len(shape.actions))


def _base_shift(random: np.random.Generator, poses: Poses) -> Drawn:
    count = len(np.unique(poses.sessions))
    since = int(random.integers(1, count)) if count > 2 and random.random() < 0.5 else None
    return _twist(random, lib.base_shift(poses, since))


def _tool_change(random: np.random.Generator, poses: Poses) -> Drawn:
    return _twist(random, lib.tool_change(poses))


def _tool_slip(random: np.random.Generator, poses: Poses) -> Drawn:
    rows = len(poses.q)
    return _twist(random, lib.tool_slip(poses, int(rows * random.uniform(0.2, 0.8))))


def _drift(random: np.random.Generator, poses: Poses) -> Drawn:
    return _twist(random, lib.drift(poses))


def _thermal(random: np.random.Generator, poses: Poses) -> Drawn:
    return lib.thermal(poses), np.ones(1)


def _clock_shift(random: np.random.Generator, poses: Poses) -> Drawn:
    return lib.clock_shift(poses), _sign(random)


def _sign(random: np.random.Generator) -> Array:
    return np.asarray(random.choice([-1.0, 1.0], 1))


# How often each is drawn, what it needs, and its maker.
LIBRARY: dict[str, tuple[float, list[str], Callable[[np.random.Generator, Poses], Drawn]]] = {
    "joint_harmonic": (3.0, [], _harmonic),
    "joint_map": (1.5, [], _curve),
    "joint_scale": (1.0, [], _scale),
    "joint_coupling": (1.0, [], _coupling),
    "backlash": (1.5, ["direction"], _backlash),
    "joint_compliance": (1.5, ["masses"], _joint_compliance),
    "link_compliance": (1.0, ["masses"], _link_compliance),
    "base_compliance": (0.7, ["masses"], _base_compliance),
    "payload": (0.7, [], _payload),
    "base_shift": (1.0, ["session"], _base_shift),
    "tool_change": (1.0, ["session"], _tool_change),
    "tool_slip": (1.0, [], _tool_slip),
    "thermal": (1.0, ["temperature"], _thermal),
    "drift": (1.0, ["time"], _drift),
    "clock_shift": (1.0, ["time", "motion"], _clock_shift),
    "outliers": (0.8, ["positions"], _thermal),
    "range_noise": (0.6, ["positions"], _thermal),
    "quantisation": (0.6, ["positions", "turning"], _thermal),
}

# These are no shapes: rows that are off, noise that grows, values that were rounded.
BY_VARIANCE = ("outliers", "range_noise", "quantisation")


def draw_effect(random: np.random.Generator, poses: Poses, name: str) -> Drawn:
    return LIBRARY[name][2](random, poses)


def draw_names(random: np.random.Generator, count: int) -> list[str]:
    weight = np.array([LIBRARY[n][0] for n in LIBRARY])
    return [
        str(n) for n in random.choice(list(LIBRARY), count, replace=False, p=weight / weight.sum())
    ]
