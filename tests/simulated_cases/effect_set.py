# SPDX-License-Identifier: BSD-3-Clause
"""Effects of the library in sizes that are asked for, which their data can tell from all others."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from tests.simulated_cases import effect_library as lib
from tests.simulated_cases.arms import Array
from tests.simulated_cases.effect_draws import BY_VARIANCE, draw_effect, plausible
from tests.simulated_cases.effect_shapes import (
    Action,
    Poses,
    Shape,
    base_columns,
    basis,
    columns,
    project_out,
)
from tests.simulated_cases.oracle import Oracle
from tests.simulated_cases.scenario import Plan, Scene

LEAST_LEFT = 0.05  # of an effect, beyond what geometry and the others can do
LEAST_LEAD = 12.0  # in squared noises, over what any other cause explains of it


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
            left = project_out(known, raw)
            if np.linalg.norm(left) < LEAST_LEFT * np.linalg.norm(raw):
                return None
            out.values[i] = out.values[i] * size / np.sqrt(np.mean(left**2))
            if not plausible(shape, out.values[i]):
                return None
            given = dict(zip(shape.actions, out.values[i].tolist(), strict=True))
            out.facts.append(fact_of(shape.name, shape.joint, given, plan, shape.settings))
        oracle.add(poses, alternatives_of(poses))
        return out if _is_determined(out, oracle, poses, plan.noise, plan.alternatives) else None

    def joints(self, scene: Scene, poses: Poses) -> Array:
        """(N, n) by how much joints are elsewhere than recorded."""
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


def alternatives_of(poses: Poses) -> list[Shape]:
    """All that may be mistaken for the truth: a slip at each session's start, too."""
    starts = np.flatnonzero(np.diff(poses.sessions)) + 1
    return lib.library(poses) + [lib.tool_slip(poses, int(s)) for s in starts]


def _is_determined(
    effects: Effects, oracle: Oracle, poses: Poses, noise: float, alternatives: list[str]
) -> bool:
    """Whether each effect explains clearly more than chance, and than any other cause would."""
    true = list(range(len(effects.shapes)))
    seen = sum(
        columns(poses, s) @ v / noise for s, v in zip(effects.shapes, effects.values, strict=True)
    )
    seen = project_out(oracle.known, np.asarray(seen))
    cost = np.array([oracle.penalty(i) for i in range(len(oracle.shapes))])
    for i in true:
        shape = effects.shapes[i]
        gains = oracle.gains(seen, [k for k in true if k != i])
        if gains[i] < 1.3 * cost[i] + 8.0:
            return False
        for k, other in enumerate(oracle.shapes):
            same = other.cause == shape.cause or other.name in alternatives
            # A scale is a curve, too: the simpler word is the right one.
            curve = shape.name == "joint_scale" and other.cause == ("curve", shape.joint)
            if k in true or same or curve:
                continue
            lead = float(gains[i] - gains[k])
            net = lead - cost[i] + cost[k]
            if lead < effects.facts[i].get("lead", np.inf):
                effects.facts[i] |= {"lead": lead, "rival": f"{other.name} {other.joint}"}
            if lead < max(LEAST_LEFT * gains[i], LEAST_LEAD) or net < LEAST_LEAD:
                return False
    return True


def fact_of(
    name: str,
    joint: int | None,
    parameters: dict[str, float],
    plan: Plan,
    settings: dict[str, float],
) -> dict[str, Any]:
    """What the answer tells of an effect."""
    return {
        "name": name,
        "joint": joint,
        "size": plan.size_of(name),
        "parameters": parameters,
        "settings": settings,
    }
