# SPDX-License-Identifier: BSD-3-Clause
"""Poses for hidden effects, and the covariates recorded with them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tests.simulated_cases.arms import Array, SimArm


@dataclass(frozen=True)
class Motion:
    """A smooth way through joint space: sums of sines, within the limits."""

    middle: Array  # (n,)
    swing: Array  # (3, n)
    rate: Array  # (3, n) [rad/s]
    phase: Array  # (3, n)

    @staticmethod
    def draw(random: np.random.Generator, arm: SimArm) -> Motion:
        share = random.dirichlet([2.0, 2.0, 2.0], arm.size).T
        half = (arm.upper - arm.lower) / 2
        period = random.uniform(12.0, 50.0, (3, arm.size))
        phase = random.uniform(0, 2 * np.pi, (3, arm.size))
        return Motion((arm.upper + arm.lower) / 2, share * half, 2 * np.pi / period, phase)

    def at(self, time: Array) -> Array:
        angle = self.rate * time[:, None, None] + self.phase
        return np.asarray(self.middle + np.sum(self.swing * np.sin(angle), axis=1))

    def speed(self, time: Array) -> Array:
        angle = self.rate * time[:, None, None] + self.phase
        return np.asarray(np.sum(self.swing * self.rate * np.cos(angle), axis=1))


def independent_poses(random: np.random.Generator, arm: SimArm, rows: int) -> Array:
    return np.asarray(random.uniform(arm.lower, arm.upper, (rows, arm.size)))


def sessions(random: np.random.Generator, rows: int, count: int) -> Array:
    """One after another, none shorter than a third of an equal share."""
    share = random.dirichlet(np.full(count, 3.0))
    share = (share + 0.5 / count) / 1.5
    cuts = np.round(np.cumsum(share)[:-1] * rows).astype(int)
    return np.searchsorted(cuts, np.arange(rows), side="right").astype(float)


def temperature(random: np.random.Generator, progress: Array) -> Array:
    """Rooms warm up and cool down in waves; progress runs from 0 to 1 [°C]."""
    waves = random.uniform(0.7, 2.5)
    warm = 4.0 * np.sin(2 * np.pi * (waves * progress + random.random()))
    return np.asarray(20.0 + random.uniform(0.6, 2.0) * warm + random.normal(0, 0.2, len(progress)))


def approach(random: np.random.Generator, rows: int, count: int) -> Array:
    """From which side each joint was moved to its place."""
    return np.asarray(random.choice([-1.0, 1.0], (rows, count)))


def payloads(random: np.random.Generator, rows: int) -> Array:
    """One of a few weights at the tool [kg], changed now and then."""
    levels = np.array([0.0, *random.uniform(1.0, 6.0, 2)])
    runs = np.repeat(random.integers(0, 3, rows), random.integers(3, 20))
    return np.asarray(levels[runs[:rows]])


def tilts(random: np.random.Generator, rows: int) -> Array:
    """Gravity in the base's frame of an arm on a vehicle that leans one way, then another."""
    lean = np.repeat(random.normal(0, 0.25, (rows, 2)), random.integers(1, 12), axis=0)[:rows]
    down = np.column_stack([np.sin(lean[:, 0]), np.sin(lean[:, 1]), np.full(rows, -1.0)])
    return np.asarray(9.80665 * down / np.linalg.norm(down, axis=1, keepdims=True))
