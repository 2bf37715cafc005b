# SPDX-License-Identifier: BSD-3-Clause
"""Measures a scene with its effects: what was recorded, and what only the answer knows."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from tests.simulated_cases.arms import Array, turned
from tests.simulated_cases.effect_set import Effects, fact_of
from tests.simulated_cases.effect_shapes import Poses, Shape, base_columns, basis, columns
from tests.simulated_cases.scenario import Scene
from tests.simulated_cases.touch_poses import brought

LEAST_LIKELIHOOD = 12.0  # what knowing how noise grows adds to its logarithm
LEAST_OUTLIER = 80.0  # of all outliers together, in squared noises


@dataclass
class Sealed:
    """What was measured, and what is true."""

    q: Array  # (N, n) as recorded
    pose: Array  # (N, 4, 4) as measured, in the frame of the instrument
    covariates: dict[str, Array]
    point: Array | None
    distances: Array | None  # (P, 3) label, label, length
    # (N, 3) of the measurement, and what the rounding of recorded joints moves the tip by [m], in
    # the frame that `residuals` are given in: nobody who has the record can know them
    errors: Array
    spin: Array  # (N, 3) of the measured rotations [rad]
    frame: Array  # (3, 3) from the frame of the base to that of the errors
    poses: Poses
    shapes: list[Shape] = field(default_factory=list)  # of the effects that are shapes
    effects: list[dict[str, Any]] = field(default_factory=list)
    outside_size: float = 0.0
    unexplained: float = 0.0

    def refit_error(self) -> Array:
        """(N, 3) the tips' errors after a refit that is given the causes, to first order; in the
        frame of the base."""
        shapes = [columns(self.poses, s) for s in self.shapes]
        span = basis(np.hstack([base_columns(self.poses), *shapes]))
        seen = self.errors @ self.frame
        if self.poses.pose:
            seen = np.hstack([seen, self.spin @ self.frame / self.poses.stiff])
        fitted = span @ (span.T @ seen.ravel())
        return np.asarray(fitted.reshape(len(seen), -1)[:, :3])


def measure(
    random: np.random.Generator,
    scene: Scene,
    poses: Poses,
    effects: Effects,
    added: Array,
    tips: Array,
    rounded: Array,
) -> Sealed | None:
    """`added` (N, n) is by how much joints are elsewhere than recorded, `rounded` (N, n) how much
    of that is rounding, `tips` (N, 3) by how much the tip does, base's frame. None where noise or
    outliers could not be recognised."""
    plan, rows = scene.plan, len(poses.q)
    twists, stretch = effects.twists()
    frames = scene.true.walk(poses.q + added, twists, stretch)
    turn, place = scene.base[:3, :3], scene.base[:3, 3]
    position = (frames.tip + tips) @ turn.T + place
    std = _deviation(scene, effects, position)
    gross = _gross(random, scene, effects, rows)
    if std is None or gross is None:
        return None
    errors = std[:, None] * random.normal(size=(rows, 3))
    q, distances = poses.q, None
    if poses.point is not None:
        labels = poses.point.astype(int)
        clean = scene.true.walk(poses.q).tip
        points = np.array([clean[labels == k].mean(axis=0) for k in np.unique(labels)])
        q = brought(scene.true, q, points[labels] + errors, 6, added, twists, stretch)
        distances = _distances(random, points) if random.random() < 0.6 else None
    unrounded = scene.true.walk(poses.q + added - rounded, twists, stretch)
    unknown = (frames.tip - unrounded.tip) @ turn.T
    pose = np.tile(np.eye(4), (rows, 1, 1))
    pose[:, :3, 3] = position + errors + gross
    spin = poses.stiff * plan.noise * random.normal(size=(rows, 3))
    pose[:, :3, :3] = turned(spin) @ turn @ frames.tool
    return Sealed(
        q,
        pose,
        scene.covariates,
        poses.point,
        distances,
        errors + unknown,
        spin,
        turn if poses.point is None else np.eye(3),
        poses,
        effects.shapes,
        effects.facts,
        effects.outside_size,
        effects.unexplained,
    )


def _deviation(scene: Scene, effects: Effects, position: Array) -> Array | None:
    """(N,) standard deviation of each row."""
    plan = scene.plan
    std = np.full(len(position), plan.noise)
    if "range_noise" not in plan.names:
        return std
    away = np.linalg.norm(position, axis=1)
    rate = plan.size_of("range_noise") * plan.noise / np.sqrt(np.mean(away**2))
    std = np.sqrt(std**2 + (rate * away) ** 2)
    lead = 1.5 * len(std) * (np.log(np.mean(std**2)) - np.mean(np.log(std**2)))
    effects.facts.append(fact_of("range_noise", None, {"rate": rate}, plan, {}))
    return std if lead >= LEAST_LIKELIHOOD else None


def _gross(random: np.random.Generator, scene: Scene, effects: Effects, rows: int) -> Array | None:
    """(N, 3) what outliers are off by: few, and each far out."""
    plan = scene.plan
    gross = np.zeros((rows, 3))
    if "outliers" not in plan.names:
        return gross
    total = 3 * rows * plan.size_of("outliers") ** 2
    number = max(1, round(total / random.uniform(120, 400)))
    if total < LEAST_OUTLIER or number > 0.08 * rows:
        return None
    off = random.choice(rows, number, replace=False)
    way = random.normal(size=(number, 3))
    far = plan.noise * np.sqrt(total / number)
    gross[off] = far * way / np.linalg.norm(way, axis=1, keepdims=True)
    fact = fact_of("outliers", None, {}, plan, {})
    effects.facts.append(fact | {"rows": sorted(int(r) for r in off)})
    return gross


def _distances(random: np.random.Generator, points: Array) -> Array:
    """(P, 3) labels and length of each pair of points, as a calliper tells it."""
    pairs = [(i, j) for j in range(len(points)) for i in range(j)]
    far = [np.linalg.norm(points[i] - points[j]) for i, j in pairs]
    return np.column_stack(
        [np.array(pairs, float), np.array(far) + random.normal(0, 5e-5, len(far))]
    )
