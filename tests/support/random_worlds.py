# SPDX-License-Identifier: BSD-3-Clause
"""A Panda on a box hull among spheres and boxes, for plans and the benchmark of plans."""

from __future__ import annotations

import itertools

import numpy as np

import bathyal
from tests.support.vehicles import box_mesh

HULL = bathyal.Hull(box_mesh([-1.0, -0.3, -0.45], [0.2, 0.3, -0.05]))


def random_spheres(seed: int, count: int = 8) -> bathyal.Workspace:
    """Spheres of 5 to 20 cm at 0.35 to 0.8 m around the arm's axis."""
    rng = np.random.default_rng(seed)
    around, out = rng.uniform(-np.pi, np.pi, count), rng.uniform(0.35, 0.8, count)
    centers = np.column_stack(
        [out * np.cos(around), out * np.sin(around), rng.uniform(-0.1, 1, count)]
    )
    keepouts = [
        bathyal.KeepOut.sphere(r, c, name=f"ball {k}")
        for k, (r, c) in enumerate(zip(rng.uniform(0.05, 0.2, count), centers, strict=True))
    ]
    return bathyal.Workspace(bathyal.arms.panda(), hull=HULL, keepouts=keepouts)


def two_free_postures(ws: bathyal.Workspace, seed: int, clear: float = 0.01) -> np.ndarray:
    """(2, n) within the limits."""
    rng = np.random.default_rng([seed, 1])
    q = rng.uniform(ws.arm.lower, ws.arm.upper, (2000, len(ws.arm.lower)))
    near = ws.clearance(q)
    free = np.flatnonzero(np.minimum(near.distance, near.self_distance) > clear)
    return q[free[:2]]


def dense(path: np.ndarray, step: float) -> np.ndarray:
    """Rows on the straight lines between rows, no joint further apart than `step`."""
    rows = [path[:1]]
    for one, other in itertools.pairwise(path):
        count = max(1, int(np.ceil(np.abs(other - one).max() / step)))
        rows.append(one + np.linspace(0, 1, count + 1)[1:, None] * (other - one))
    return np.concatenate(rows)
