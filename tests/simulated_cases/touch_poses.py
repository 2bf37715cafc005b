# SPDX-License-Identifier: BSD-3-Clause
"""Poses whose tip lies on points, by an inverse kinematics of their own."""

from __future__ import annotations

from typing import Any

import numpy as np

from tests.simulated_cases.arms import Array, SimArm
from tests.simulated_cases.scenario import Scene


def touching(random: np.random.Generator, scene: Scene) -> tuple[Array, Array] | None:
    """Poses whose tip lies on a few points, and the points' labels."""
    arm, rows = scene.true, scene.plan.rows
    count = int(random.integers(3, 7))
    each = rows // count
    anywhere = random.uniform(arm.lower, arm.upper, (count, arm.size))
    points = arm.walk(0.6 * anywhere + 0.2 * (arm.lower + arm.upper)).tip
    found, labels = [], []
    for label, point in enumerate(points):
        start = random.uniform(arm.lower, arm.upper, (8 * each, arm.size))
        q = brought(arm, start, np.tile(point, (len(start), 1)), steps=40)
        miss = np.linalg.norm(arm.walk(q).tip - point, axis=1)
        within = np.all((q > arm.lower - 0.2) & (q < arm.upper + 0.2), axis=1)
        q = q[(miss < 1e-9) & within][:each]
        if len(q) < each:
            return None
        found.append(q)
        labels += [label] * each
    mixed = random.permutation(len(labels))
    scene.covariates = {k: v[: len(labels)] for k, v in scene.covariates.items()}
    scene.time = scene.time[: len(labels)]
    return np.vstack(found)[mixed], np.array(labels, float)[mixed]


def brought(
    arm: SimArm,
    q: Array,
    goal: Array,
    steps: int,
    added: Any = 0.0,
    twists: Any = None,
    stretch: Any = 0.0,
) -> Array:
    """Joint values near q that bring the tip to `goal`, by least motion."""
    for _ in range(steps):
        frames = arm.walk(q + added, twists, stretch)
        jacobian = np.empty((len(q), 3, arm.size))
        for j in range(arm.size):
            axis = frames.rotation[j][:, :, 2]
            arm_to_tip = frames.tip - frames.origin[j]
            jacobian[:, :, j] = axis if arm.sliding[j] else np.cross(axis, arm_to_tip)
        square = jacobian @ np.swapaxes(jacobian, 1, 2) + 1e-9 * np.eye(3)
        miss = (goal - frames.tip)[..., None]
        step = (np.swapaxes(jacobian, 1, 2) @ np.linalg.solve(square, miss))[..., 0]
        most = np.linalg.norm(step, axis=1, keepdims=True)
        q = q + step * np.minimum(1.0, 0.4 / np.maximum(most, 1e-12))
    return q
