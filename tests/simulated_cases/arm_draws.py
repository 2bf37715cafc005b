# SPDX-License-Identifier: BSD-3-Clause
"""Draws arms as their makers draw them: after tables of makers, and any."""

from __future__ import annotations

from typing import Any

import numpy as np

from tests.simulated_cases.arms import SimArm, pose

# Tables after the makers' sheets, rounded [m, rad]: d, a, alpha, theta; a sliding row is marked.
CATALOGUE: dict[str, list[tuple[float, float, float, float, bool]]] = {
    "elbow of six": [
        (0.16, 0.0, np.pi / 2, 0.0, False),
        (0.0, -0.43, 0.0, 0.0, False),
        (0.0, -0.39, 0.0, 0.0, False),
        (0.13, 0.0, np.pi / 2, 0.0, False),
        (0.10, 0.0, -np.pi / 2, 0.0, False),
        (0.10, 0.0, 0.0, 0.0, False),
    ],
    "puma": [
        (0.67, 0.0, -np.pi / 2, 0.0, False),
        (0.15, 0.43, 0.0, 0.0, False),
        (0.0, -0.02, np.pi / 2, 0.0, False),
        (0.43, 0.0, -np.pi / 2, 0.0, False),
        (0.0, 0.0, np.pi / 2, 0.0, False),
        (0.06, 0.0, 0.0, 0.0, False),
    ],
    "seven": [
        (0.34, 0.0, -np.pi / 2, 0.0, False),
        (0.0, 0.0, np.pi / 2, 0.0, False),
        (0.40, 0.0, np.pi / 2, 0.0, False),
        (0.0, 0.0, -np.pi / 2, 0.0, False),
        (0.40, 0.0, -np.pi / 2, 0.0, False),
        (0.0, 0.0, np.pi / 2, 0.0, False),
        (0.13, 0.0, 0.0, 0.0, False),
    ],
    "welder": [
        (0.50, 0.16, -np.pi / 2, 0.0, False),
        (0.0, 0.60, 0.0, -np.pi / 2, False),
        (0.0, 0.14, -np.pi / 2, 0.0, False),
        (0.64, 0.0, np.pi / 2, 0.0, False),
        (0.0, 0.0, -np.pi / 2, 0.0, False),
        (0.12, 0.0, 0.0, 0.0, False),
    ],
    "small underwater": [
        (0.05, 0.02, np.pi / 2, 0.0, False),
        (0.0, 0.15, 0.0, 1.3, False),
        (0.0, 0.02, -np.pi / 2, -1.3, False),
        (0.18, 0.0, np.pi / 2, 0.0, False),
        (0.0, 0.09, 0.0, 0.0, False),
    ],
    "on a column": [
        (0.80, 0.10, -np.pi / 2, 0.0, True),
        (0.20, 0.0, np.pi / 2, 0.0, False),
        (0.15, 0.45, 0.0, 0.0, False),
        (0.0, 0.0, np.pi / 2, np.pi / 2, False),
        (0.40, 0.0, -np.pi / 2, 0.0, False),
        (0.0, 0.08, np.pi / 2, 0.0, False),
    ],
}


def draw_arm(random: np.random.Generator) -> SimArm:
    """An arm as its maker draws it, 3 to 7 joints."""
    if random.random() < 0.5:
        table = CATALOGUE[str(random.choice(sorted(CATALOGUE)))]
        d, a, alpha, theta, sliding = (np.array(c) for c in zip(*table, strict=True))
    else:
        d, a, alpha, theta, sliding = _drawn_table(random)
    count = len(d)
    half = random.uniform(1.4, 2.9, count)
    middle = random.uniform(-0.5, 0.5, count)
    span = random.uniform(0.3, 0.8, count)
    sliding = np.asarray(sliding, bool)
    lower = np.where(sliding, 0.0, middle - half)
    upper = np.where(sliding, span, middle + half)
    urdf = random.random() < 0.3
    if urdf:  # what lies behind the last joint is read as a flange: the tool has it anyway
        a, alpha = np.array(a, float), np.array(alpha, float)
        a[-1] = alpha[-1] = 0.0
    known = random.random() < 0.7
    masses = np.concatenate([[20.0], random.uniform(8.0, 14.0) * 0.7 ** np.arange(count)])
    masses *= random.uniform(0.7, 1.3, count + 1)
    # Half way back along the link, and a little off it.
    centers = np.zeros((count + 1, 3))
    centers[1:, 0] = -0.5 * np.asarray(a, float)
    centers += random.uniform(-0.05, 0.05, centers.shape)
    tool = pose(random.uniform([-0.05, -0.05, 0.05], [0.05, 0.05, 0.2]), random.normal(0, 0.5, 3))
    return SimArm(
        *(np.asarray(c, float) for c in (theta, d, a, alpha, np.zeros(count))),
        sliding,
        lower,
        upper,
        masses if known else np.zeros(count + 1),
        centers,
        tool,
        urdf=urdf,
    )


def _drawn_table(random: np.random.Generator) -> tuple[Any, ...]:
    count = int(random.integers(3, 8))
    d = np.where(random.random(count) < 0.5, random.uniform(0.05, 0.45, count), 0.0)
    a = np.where(random.random(count) < 0.5, random.uniform(0.1, 0.5, count), 0.0)
    short = (d == 0) & (a == 0)
    d[short] = random.uniform(0.1, 0.4, short.sum())
    alpha = random.choice([-np.pi / 2, np.pi / 2, 0.0, 0.7], count, p=[0.35, 0.35, 0.2, 0.1])
    alpha[0] = np.pi / 2
    if count > 3:  # three parallel axes in a row leave too little to an arm
        alpha[2] = -np.pi / 2
    theta = np.zeros(count)
    sliding = np.zeros(count, bool)
    if random.random() < 0.3:
        sliding[int(random.integers(0, min(count, 3)))] = True
    return d, a, alpha, theta, sliding
