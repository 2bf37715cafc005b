# SPDX-License-Identifier: BSD-3-Clause
"""Gives a scene its effects, in sizes that are asked for, and measures it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

import hidden_library as lib
from hidden_arms import Array, turned
from hidden_draws import BY_VARIANCE, draw_effect, plausible
from hidden_oracle import Oracle
from hidden_outside import draw_outside
from hidden_scene import Scene
from hidden_shapes import Action, Poses, Shape, base_columns, basis, beside, column, columns, moved

LEAST_LEFT = 0.05  # of an effect, beside what geometry and the others can do
LEAST_LEAD = 12.0  # in squared noises, over what any other cause explains of it
OUTSIDE_LEFT = 0.8  # of what is not in the library, beside the best four that are


@dataclass
class Sealed:
    """What was measured, and what is true."""

    q: Array  # (N, n) as recorded
    pose: Array  # (N, 4, 4) as measured, in the frame of the instrument
    covariates: dict[str, Array]
    point: Array | None
    distances: Array | None  # (P, 3) label, label, length
    errors: Array  # (N, 3) of the measurement alone [m]
    poses: Poses
    shapes: list[Shape] = field(default_factory=list)  # of the effects that are shapes
    effects: list[dict[str, Any]] = field(default_factory=list)
    outside_size: float = 0.0
    unexplained: float = 0.0

    def told_error(self) -> Array:
        """(N, 3) what errors a refit leaves in its tips that is told the causes, to first order."""
        shapes = [columns(self.poses, s) for s in self.shapes]
        span = basis(np.hstack([base_columns(self.poses), *shapes]))
        wide = 6 if self.poses.pose else 3
        seen = np.zeros((len(self.q), wide))
        seen[:, :3] = self.errors
        return (span @ (span.T @ seen.ravel())).reshape(-1, wide)[:, :3]


def seal(random: np.random.Generator, scene: Scene) -> Sealed | None:
    """None where what was drawn cannot be, or cannot be told from what it is not."""
    plan = scene.plan
    q, point = (scene.q, None)
    if plan.form == "touches":
        touched = _touching(random, scene)
        if touched is None:
            return None
        q, point = touched
    step = 0.0
    if "quantisation" in plan.names:
        step = _step(random, scene)
        q = np.round(q / step) * step
    poses = _poses(scene, q, point)
    added = scene.q - q if step else np.zeros_like(q)
    effects = Effects.draw(random, scene, poses)
    if effects is None:
        return None
    if step:
        effects.facts.append(_fact("quantisation", None, {"step": step}, plan, {}))
    tips = np.zeros((len(q), 3))
    if plan.outside:
        beyond = _outside(random, scene, poses)
        if beyond is None:
            return None
        added, tips, effects.outside_size, effects.unexplained = beyond
    added = added + effects.joints(scene, poses)
    return _measure(random, scene, poses, effects, added, tips)


# --- effects -------------------------------------------------------------------------------------


@dataclass
class Effects:
    """Of the library, with values that give them their sizes."""

    shapes: list[Shape] = field(default_factory=list)
    values: list[Array] = field(default_factory=list)
    facts: list[dict[str, Any]] = field(default_factory=list)
    outside_size: float = 0.0
    unexplained: float = 0.0

    @staticmethod
    def draw(random: np.random.Generator, scene: Scene, poses: Poses) -> Effects | None:
        plan = scene.plan
        out = Effects()
        sizes = []
        for name, size in zip(plan.names, plan.sizes, strict=True):
            if name in BY_VARIANCE:
                continue
            shape, values = _drawn(random, scene, poses, name)
            if shape.cause in [s.cause for s in out.shapes] or _overlap(shape, out.shapes):
                return None
            out.shapes.append(shape)
            out.values.append(values)
            sizes.append(size)
        if not out.shapes:
            return out
        oracle = Oracle.of(poses, out.shapes)
        if len(oracle.shapes) < len(out.shapes):
            return None
        for i, (shape, size) in enumerate(zip(out.shapes, sizes, strict=True)):
            others = [o for k, o in enumerate(out.shapes) if k != i]
            known = basis(np.hstack([base_columns(poses), *(columns(poses, o) for o in others)]))
            raw = columns(poses, shape) @ out.values[i] / plan.noise
            left = beside(known, raw)
            if np.linalg.norm(left) < LEAST_LEFT * np.linalg.norm(raw):
                return None
            out.values[i] = out.values[i] * size / np.sqrt(np.mean(left**2))
            if not plausible(shape, out.values[i]):
                return None
            given = dict(zip(shape.actions, out.values[i].tolist(), strict=True))
            out.facts.append(_fact(shape.name, shape.joint, given, plan, shape.settings))
        oracle.add(poses, rivals_of(poses))
        return out if _can_be_told(out, oracle, poses, plan.noise, plan.rivals) else None

    def joints(self, scene: Scene, poses: Poses) -> Array:
        """(N, n) by how much joints stand elsewhere than recorded."""
        out = np.zeros_like(poses.q)
        for shape, values in zip(self.shapes, self.values, strict=True):
            if shape.name == "clock_shift":
                assert scene.motion is not None
                out += scene.motion.at(scene.time + values[0]) - scene.motion.at(scene.time)
                continue
            for action, value in _pairs(shape, values):
                if action.site == "joint":
                    out[:, action.index] += value * action.values
        return out

    def twists(self) -> tuple[dict[int, Array], Any]:
        """What frames are moved by, and what lengths are stretched by."""
        frames: dict[int, Array] = {}
        stretch: Any = 0.0
        for shape, values in zip(self.shapes, self.values, strict=True):
            for action, value in _pairs(shape, values):
                if action.site == "frame":
                    frames[action.index] = frames.get(action.index, 0.0) + value * action.values
                elif action.site == "length":
                    stretch = stretch + value * action.values
        return frames, stretch


def _pairs(shape: Shape, values: Array) -> list[tuple[Action, float]]:
    return [
        (action, float(value))
        for actions, value in zip(shape.actions.values(), values, strict=True)
        for action in actions
    ]


def _drawn(
    random: np.random.Generator, scene: Scene, poses: Poses, name: str
) -> tuple[Shape, Array]:
    if scene.plan.confounded == "slip":
        starts = np.flatnonzero(np.diff(poses.sessions)) + 1
        shape = lib.tool_slip(poses, int(random.choice(starts)))
        return shape, random.normal(size=len(shape.actions))
    if scene.plan.confounded == "days":
        shape = lib.base_shift(poses)
        return shape, random.normal(size=len(shape.actions))
    return draw_effect(random, poses, name)


def _overlap(shape: Shape, others: list[Shape]) -> bool:
    """A joint has one curve, or one scale, not both; and only one thing bends."""
    curves = {"joint_harmonic", "joint_map", "joint_scale"}
    return any(
        (o.joint == shape.joint and {o.name, shape.name} <= curves)
        or o.cause[0] == shape.cause[0] == "bending"
        for o in others
    )


def rivals_of(poses: Poses) -> list[Shape]:
    """All that may be mistaken for the truth: a slip at each session's start, too."""
    starts = np.flatnonzero(np.diff(poses.sessions)) + 1
    return lib.library(poses) + [lib.tool_slip(poses, int(s)) for s in starts]


def _can_be_told(
    effects: Effects, oracle: Oracle, poses: Poses, noise: float, rivals: list[str]
) -> bool:
    """Whether each effect explains clearly more than chance, and than any other cause would."""
    true = list(range(len(effects.shapes)))
    seen = sum(
        columns(poses, s) @ v / noise for s, v in zip(effects.shapes, effects.values, strict=True)
    )
    seen = beside(oracle.known, np.asarray(seen))
    cost = np.array([oracle.penalty(i) for i in range(len(oracle.shapes))])
    for i in true:
        shape = effects.shapes[i]
        gains = oracle.gains(seen, [k for k in true if k != i])
        if gains[i] < 1.3 * cost[i] + 8.0:
            return False
        for k, other in enumerate(oracle.shapes):
            same = other.cause == shape.cause or other.name in rivals
            # A scale is a curve, too: the simpler word is the right one.
            curve = shape.name == "joint_scale" and other.cause == ("curve", shape.joint)
            if k in true or same or curve:
                continue
            lead = gains[i] - gains[k]
            net = lead - cost[i] + cost[k]
            if lead < max(LEAST_LEFT * gains[i], LEAST_LEAD) or net < LEAST_LEAD:
                return False
    return True


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
    oracle = Oracle.of(poses, rivals_of(poses))
    left = beside(oracle.known, raw)
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


def _fact(
    name: str,
    joint: int | None,
    parameters: dict[str, float],
    plan: Any,
    settings: dict[str, float],
) -> dict[str, Any]:
    return {
        "name": name,
        "joint": joint,
        "size": plan.sizes[plan.names.index(name)],
        "parameters": parameters,
        "settings": settings,
    }


# --- poses and measurements ----------------------------------------------------------------------


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
    left = beside(basis(base_columns(poses)), column(poses, np.asarray(moves)))
    size = scene.plan.sizes[scene.plan.names.index("quantisation")]
    return float(size * scene.plan.noise / np.sqrt(np.mean(left**2)))


def _touching(random: np.random.Generator, scene: Scene) -> tuple[Array, Array] | None:
    """Poses whose tip lies on a few points, and the points' labels."""
    arm, rows = scene.true, scene.plan.rows
    count = int(random.integers(3, 7))
    each = rows // count
    anywhere = random.uniform(arm.lower, arm.upper, (count, arm.size))
    points = arm.walk(0.6 * anywhere + 0.2 * (arm.lower + arm.upper)).tip
    found, labels = [], []
    for label, point in enumerate(points):
        start = random.uniform(arm.lower, arm.upper, (8 * each, arm.size))
        q = _brought(scene, start, np.tile(point, (len(start), 1)), steps=40)
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


def _brought(
    scene: Scene,
    q: Array,
    goal: Array,
    steps: int,
    added: Any = 0.0,
    twists: Any = None,
    stretch: Any = 0.0,
) -> Array:
    """Joint values near q that bring the tip to `goal`, by least motion."""
    arm = scene.true
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


def _measure(
    random: np.random.Generator,
    scene: Scene,
    poses: Poses,
    effects: Effects,
    added: Array,
    tips: Array,
) -> Sealed | None:
    plan, rows = scene.plan, len(poses.q)
    twists, stretch = effects.twists()
    frames = scene.true.walk(poses.q + added, twists, stretch)
    turn, place = scene.base[:3, :3], scene.base[:3, 3]
    position = (frames.tip + tips) @ turn.T + place
    std = np.full(rows, plan.noise)
    if "range_noise" in plan.names:
        size = plan.sizes[plan.names.index("range_noise")]
        away = np.linalg.norm(position, axis=1)
        rate = size * plan.noise / np.sqrt(np.mean(away**2))
        std = np.sqrt(std**2 + (rate * away) ** 2)
        # What the likelihood gains by knowing how noise grows.
        if 1.5 * rows * (np.log(np.mean(std**2)) - np.mean(np.log(std**2))) < 12.0:
            return None
        effects.facts.append(_fact("range_noise", None, {"rate": rate}, plan, {}))
    errors = std[:, None] * random.normal(size=(rows, 3))
    gross = np.zeros((rows, 3))
    if "outliers" in plan.names:
        size = plan.sizes[plan.names.index("outliers")]
        total = 3 * rows * size**2
        number = max(1, round(total / random.uniform(120, 400)))
        if total < 80.0 or number > 0.08 * rows:
            return None
        off = random.choice(rows, number, replace=False)
        way = random.normal(size=(number, 3))
        far = plan.noise * np.sqrt(total / number)
        gross[off] = far * way / np.linalg.norm(way, axis=1, keepdims=True)
        fact = _fact("outliers", None, {}, plan, {})
        effects.facts.append(fact | {"rows": sorted(int(r) for r in off)})
    q, distances = poses.q, None
    if poses.point is not None:
        labels = poses.point.astype(int)
        clean = scene.true.walk(poses.q).tip
        points = np.array([clean[labels == k].mean(axis=0) for k in np.unique(labels)])
        q = _brought(scene, q, points[labels] + errors, 6, added, twists, stretch)
        if random.random() < 0.6:
            pairs = [(i, j) for j in range(len(points)) for i in range(j)]
            far = [np.linalg.norm(points[i] - points[j]) for i, j in pairs]
            told = np.array(far) + 5e-5 * random.normal(size=len(pairs))
            distances = np.column_stack([np.array(pairs, float), told])
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
        errors,
        poses,
        effects.shapes,
        effects.facts,
        effects.outside_size,
        effects.unexplained,
    )
