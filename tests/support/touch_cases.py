# SPDX-License-Identifier: BSD-3-Clause
"""Touches of a made arm: a UR10e that differs from its drawing, points, a probe, noise by hand."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import bathyal

DATA = Path(__file__).parents[3] / "shared" / "data" / "arms"
PROBE = (0.01, -0.02, 0.15)  # of the tool centre point, in the flange [m]
POINTS = np.array([[-0.7, -0.35, 0.2], [-0.55, 0.45, 0.35], [-0.85, 0.1, 0.6]])  # world [m]


def drawn() -> bathyal.Arm:
    """The arm as its maker draws it; nobody knows the probe."""
    return bathyal.arms.ur10e()


def built(seed: int = 0, off: float = 5e-4) -> bathyal.Arm:
    """The arm as it came out: every length [m] and angle [rad] off by so much, rms."""
    random = np.random.default_rng([seed, 1])
    nominal = drawn().to_dh()
    rows = {
        name: np.asarray(getattr(nominal, name)) + random.normal(0, off, 6)
        for name in ("a", "alpha", "d", "theta")
    }
    tool = np.eye(4)
    tool[:3, 3] = PROBE
    return bathyal.Arm.from_dh(**rows, tool=tool)


def rotations(count: int, lean: float, random: np.random.Generator) -> NDArray[np.float64]:
    """The tool's z within `lean` of straight down [rad], turned about itself by as much."""
    out = np.empty((count, 3, 3))
    for i in range(count):
        way = random.uniform(-np.pi, np.pi)
        angle = lean * np.sqrt(random.uniform())
        spin = random.uniform(-lean, lean)
        x, y = np.cos(way) * np.sin(angle), np.sin(way) * np.sin(angle)
        z = np.array([x, y, -np.cos(angle)])
        side = np.cross(z, [np.cos(spin), np.sin(spin), 0.0])
        side /= np.linalg.norm(side)
        out[i] = np.column_stack([np.cross(side, z), side, z])
    return out


@dataclass(frozen=True)
class Touched:
    """What was recorded, row by row."""

    q: NDArray[np.float64]
    point: NDArray[np.int_]

    def touches(self, **more: Any) -> bathyal.Touches:
        return bathyal.Touches(self.q, self.point, **more)


@cache
def poses(
    points: int = 3, each: int = 21, lean: float = 1.0, seed: int = 0
) -> tuple[NDArray[np.float64], NDArray[np.int_]]:
    """Exact joint values (N, 6) of the arm `built(seed)` at each point, and its label."""
    random = np.random.default_rng([seed, 2])
    arm = built(seed)
    q = np.empty((0, 6))
    label = np.empty(0, dtype=int)
    for p in range(points):
        found = np.empty((0, 6))
        while len(found) < each:
            goal = np.tile(np.eye(4), (2 * each, 1, 1))
            goal[:, :3, :3] = rotations(2 * each, lean, random)
            goal[:, :3, 3] = POINTS[p]
            result = arm.inverse(goal, [0.3, -1.4, 1.8, -1.9, -1.5, 0.2], seed=p)
            found = np.vstack([found, result.q[np.asarray(result.status) == "reached"]])
        q = np.vstack([q, found[:each]])
        label = np.concatenate([label, np.full(each, p)])
    return q, label


def touched(
    points: int = 3,
    each: int = 21,
    *,
    noise: float = 1e-4,
    lean: float = 1.0,
    seed: int = 0,
    draw: int = 0,
    off: dict[int, float] | None = None,
) -> Touched:
    """Touches whose tip misses its point by `noise` along each axis [m], and by `off` [m] in a
    drawn direction in single rows."""
    q, label = poses(points, each, lean, seed)
    random = np.random.default_rng([seed, draw, 3])
    miss = random.normal(0, noise, (len(q), 3))
    for row, distance in (off or {}).items():
        way = random.normal(0, 1, 3)
        miss[row] += distance * way / np.linalg.norm(way)
    return Touched(moved(built(seed), q, miss), label)


def moved(
    arm: bathyal.Arm, q: NDArray[np.float64], miss: NDArray[np.float64]
) -> NDArray[np.float64]:
    """The joint values nearest to `q` whose tip lies `miss` (N, 3) off that of `q`."""
    goal = arm.forward(q)[:, :3, 3] + miss
    q = q.copy()
    for _ in range(5):
        left = goal - arm.forward(q)[:, :3, 3]
        jacobian = arm.jacobian(q)[:, :3]
        q += np.einsum(
            "nji,nj->ni",
            jacobian,
            np.linalg.solve(jacobian @ jacobian.transpose(0, 2, 1), left[:, :, None])[:, :, 0],
        )
    return q


def distances(*pairs: tuple[int, int]) -> dict[tuple[int, int], float]:
    """As a calliper would tell them."""
    return {(a, b): float(np.linalg.norm(POINTS[a] - POINTS[b])) for a, b in pairs}
