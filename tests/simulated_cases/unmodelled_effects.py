# SPDX-License-Identifier: BSD-3-Clause
"""Effects that no entry of the library can express.

Each gives what it adds to the joints (N, n), and what it adds to the measured tip (N, 3) in the
frame of the arm's base, for an amplitude of 1. Those that go with time need a motion in time.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from tests.simulated_cases.arms import Array
from tests.simulated_cases.effect_shapes import Poses

Moves = tuple[Array, Array]
Draw = Callable[[np.random.Generator, Poses], Moves]


def cable(random: np.random.Generator, poses: Poses) -> Moves:
    """A cable pulls at one joint by the positions of two together."""
    joint = int(random.integers(poses.arm.size))
    a, b = random.choice(poses.arm.size, 2, replace=False)
    wave = [
        np.sin(random.uniform(1.0, 2.5) * _unit(poses, j) + random.uniform(0, 2 * np.pi))
        for j in (a, b)
    ]
    return _joint(poses, joint, wave[0] * wave[1])


def bent_field(random: np.random.Generator, poses: Poses) -> Moves:
    """The tracker's space is bent: a smooth field over where the tip is."""
    place = (poses.frames.tip - poses.frames.tip.mean(axis=0)) / np.std(poses.frames.tip)
    square = np.column_stack(
        [place[:, [0]] * place, place[:, 1:2] * place[:, 1:], place[:, 2] ** 2]
    )
    cubic = np.column_stack([square * place[:, [i]] for i in range(3)])
    terms = np.hstack([square, 0.5 * cubic])
    return _tip(poses, terms @ random.normal(size=(terms.shape[1], 3)))


def bump(random: np.random.Generator, poses: Poses) -> Moves:
    """Something near one place (iron, a mirror) pulls what is measured there."""
    tip = poses.frames.tip
    center = tip[int(random.integers(len(tip)))]
    width = random.uniform(0.9, 1.5) * np.sqrt(np.mean(np.var(tip, axis=0)))
    near = np.exp(-np.sum((tip - center) ** 2, axis=1) / (2 * width**2))
    return _tip(poses, near[:, None] * random.normal(size=3))


def vibration(random: np.random.Generator, poses: Poses) -> Moves:
    """The support swings with a period."""
    return _tip(poses, _swing(random, poses)[:, None] * random.normal(size=3))


def joint_vibration(random: np.random.Generator, poses: Poses) -> Moves:
    """A servo hunts with a period."""
    return _joint(poses, int(random.integers(poses.arm.size)), _swing(random, poses))


def hysteresis(random: np.random.Generator, poses: Poses) -> Moves:
    """A joint lags by how it was last moved, and nobody wrote down how."""
    joint = int(random.integers(poses.arm.size))
    q = poses.q[poses.order.astype(int), joint]
    half = random.uniform(0.02, 0.15) * np.std(q)
    held = np.empty_like(q)
    at = q[0]
    for i, value in enumerate(q):
        at = min(max(at, value - half), value + half)
        held[i] = (at - value) / half
    values = np.empty_like(held)
    values[poses.order.astype(int)] = held
    return _joint(poses, joint, values)


def wandering_zero(random: np.random.Generator, poses: Poses) -> Moves:
    """The zero of one joint wanders slowly."""
    rows = len(poses.q)
    keep = 1 - 1 / random.uniform(0.03 * rows, 0.1 * rows)
    kicks = random.normal(size=rows)
    walk = np.zeros(rows)
    for i in range(1, rows):
        walk[i] = keep * walk[i - 1] + kicks[i]
    values = np.empty(rows)
    values[poses.order.astype(int)] = walk
    return _joint(poses, int(random.integers(poses.arm.size)), values)


def warm_zero(random: np.random.Generator, poses: Poses) -> Moves:
    """The zero of one joint goes with the temperature."""
    warm = poses.covariates["temperature"]
    return _joint(poses, int(random.integers(poses.arm.size)), warm - warm.mean())


def warm_support(random: np.random.Generator, poses: Poses) -> Moves:
    """The tracker's support leans with the temperature."""
    warm = poses.covariates["temperature"]
    shift, turn = random.normal(size=3), random.normal(size=3)
    lean = shift + np.cross(turn, poses.frames.tip)
    return _tip(poses, (warm - warm.mean())[:, None] * lean)


def heavy_flange(random: np.random.Generator, poses: Poses) -> Moves:
    """A gripper gives way by what it carries, the same way in its own frame."""
    shift = np.einsum("nij,j->ni", poses.frames.rotation[-1], random.normal(size=3))
    return _tip(poses, poses.covariates["payload"][:, None] * shift)


ANY: dict[str, Draw] = {"cable": cable, "bent_field": bent_field, "bump": bump}
IN_TIME: dict[str, Draw] = {
    "vibration": vibration,
    "joint_vibration": joint_vibration,
    "hysteresis": hysteresis,
    "wandering_zero": wandering_zero,
}
WITH: dict[str, tuple[str, Draw]] = {
    "warm_zero": ("temperature", warm_zero),
    "warm_support": ("temperature", warm_support),
    "heavy_flange": ("payload", heavy_flange),
}


def needs(name: str) -> list[str]:
    """Covariates that an effect goes with."""
    if name in IN_TIME:
        return ["time"]
    return [WITH[name][0]] if name in WITH else []


def draw_outside(random: np.random.Generator, poses: Poses, name: str) -> Moves:
    draw = ANY.get(name) or IN_TIME.get(name) or WITH[name][1]
    return draw(random, poses)


NAMES = [*ANY, *IN_TIME, *WITH]


def _unit(poses: Poses, joint: int) -> Array:
    """A joint's values as if it turned by half a turn to either side."""
    q = poses.q[:, joint]
    return np.asarray((q - q.mean()) * 2.0 * np.pi / np.ptp(q) / 1.5)


def _swing(random: np.random.Generator, poses: Poses) -> Array:
    time = poses.covariates["time"]
    step = np.median(np.diff(np.sort(time)))
    period = random.uniform(6.0, 40.0) * step
    return np.asarray(np.sin(2 * np.pi * time / period + random.uniform(0, 2 * np.pi)))


def _joint(poses: Poses, joint: int, values: Array) -> Moves:
    q = np.zeros_like(poses.q)
    q[:, joint] = values
    return q, np.zeros((len(q), 3))


def _tip(poses: Poses, values: Array) -> Moves:
    return np.zeros_like(poses.q), values
