# SPDX-License-Identifier: BSD-3-Clause
"""Gives a scene its effects, in sizes that are asked for, and measures it."""

from __future__ import annotations

import numpy as np

from tests.simulated_cases.arms import Array
from tests.simulated_cases.effect_set import LEAST_LEFT, Effects, alternatives_of, fact_of
from tests.simulated_cases.effect_shapes import (
    Action,
    Poses,
    base_columns,
    basis,
    column,
    moved,
    project_out,
)
from tests.simulated_cases.measurement import Sealed, measure
from tests.simulated_cases.oracle import Oracle
from tests.simulated_cases.scenario import Scene
from tests.simulated_cases.touch_poses import touching
from tests.simulated_cases.unmodelled_effects import draw_outside

OUTSIDE_LEFT = 0.8  # of what is not in the library, beyond the best four that are


def seal(random: np.random.Generator, scene: Scene) -> Sealed | None:
    """None where what was drawn cannot be, or cannot be distinguished from what it is not."""
    plan = scene.plan
    q, point = (scene.q, None)
    if plan.form == "touches":
        touched = touching(random, scene)
        if touched is None:
            return None
        q, point = touched
    step = 0.0
    if "quantisation" in plan.names:
        step = _step(random, scene)
        q = np.round(q / step) * step
    poses = _poses(scene, q, point)
    rounded = scene.q - q if step else np.zeros_like(q)
    added = rounded
    effects = Effects.draw(random, scene, poses)
    if effects is None:
        return None
    if step:
        effects.facts.append(fact_of("quantisation", None, {"step": step}, plan, {}))
    tips = np.zeros((len(q), 3))
    if plan.outside:
        beyond = _outside(random, scene, poses)
        if beyond is None:
            return None
        added, tips, effects.outside_size, effects.unexplained = beyond
    added = added + effects.joints(scene, poses)
    return measure(random, scene, poses, effects, added, tips, rounded)


def _outside(
    random: np.random.Generator, scene: Scene, poses: Poses
) -> tuple[Array, Array, float, float] | None:
    plan = scene.plan
    joints, tips = draw_outside(random, poses, plan.outside)
    moves = np.zeros((len(tips), 6 if poses.pose else 3))
    moves[:, :3] = tips
    for j in np.flatnonzero(joints.any(axis=0)):
        moves += moved(poses, Action("joint", int(j), joints[:, j]))
    raw = column(poses, moves) / plan.noise
    oracle = Oracle.of(poses, alternatives_of(poses))
    left = project_out(oracle.known, raw)
    if np.linalg.norm(left) < LEAST_LEFT * np.linalg.norm(raw):
        return None
    factor = plan.outside_size / np.sqrt(np.mean(left**2))
    if factor * np.sqrt(np.mean(moves[:, :3] ** 2)) > 0.02:
        return None
    chosen = oracle.find(raw, most=4, free=True)
    share = 1.0 - oracle.explained(left, chosen) / float(np.sum(left**2))
    unexplained = float(np.sqrt(max(share, 0.0)))
    if unexplained < OUTSIDE_LEFT:
        return None
    return factor * joints, factor * tips, plan.outside_size, unexplained


def _poses(scene: Scene, q: Array, point: Array | None) -> Poses:
    time = scene.covariates.get("time")
    order = np.arange(len(q)) if time is None else np.argsort(time, kind="stable")
    speed = scene.motion.speed(scene.time) if scene.motion else None
    return Poses(
        scene.true,
        q,
        scene.covariates,
        order,
        scene.true.walk(q),
        speed,
        scene.plan.form == "pose",
        point,
        stiff=2.0,
    )


def _step(random: np.random.Generator, scene: Scene) -> float:
    """The step whose rounding errors have the size that is asked for."""
    poses = _poses(scene, scene.q, None)
    error = random.uniform(-0.5, 0.5, scene.q.shape)
    moves = sum(moved(poses, Action("joint", j, error[:, j])) for j in range(scene.q.shape[1]))
    left = project_out(basis(base_columns(poses)), column(poses, np.asarray(moves)))
    size = scene.plan.size_of("quantisation")
    return float(size * scene.plan.noise / np.sqrt(np.mean(left**2)))
