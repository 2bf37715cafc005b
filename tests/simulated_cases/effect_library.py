# SPDX-License-Identifier: BSD-3-Clause
"""The forms of the library's effects that an oracle looks through, and that are hidden."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

from tests.simulated_cases.arms import Array
from tests.simulated_cases.effect_shapes import (
    Action,
    Poses,
    Shape,
    base_moment,
    cantilever,
    torque,
)

AXES = "xyz"


def harmonic(poses: Poses, joint: int, order: float) -> Shape:
    angle = order * poses.q[:, joint]
    return Shape(
        "joint_harmonic",
        joint,
        {
            "cos": [Action("joint", joint, np.cos(angle))],
            "sin": [Action("joint", joint, np.sin(angle))],
        },
        {"order": float(order)},
    )


def curve(poses: Poses, joint: int, terms: int = 3) -> Shape:
    """Period 2 pi of turning joints, 1.5 times the span of sliding ones."""
    q = poses.q[:, joint]
    w = 2 * np.pi / (1.5 * np.ptp(q)) if poses.arm.sliding[joint] else 1.0
    actions = {}
    for i in range(1, terms + 1):
        actions[f"cos_{i}"] = [Action("joint", joint, np.cos(i * w * q))]
        actions[f"sin_{i}"] = [Action("joint", joint, np.sin(i * w * q))]
    return Shape("joint_map", joint, actions, {"terms": float(terms)})


def scale(poses: Poses, joint: int) -> Shape:
    return Shape("joint_scale", joint, {"scale": [Action("joint", joint, poses.q[:, joint])]})


def coupling(poses: Poses, joint: int, by: int) -> Shape:
    return Shape(
        "joint_coupling",
        joint,
        {"ratio": [Action("joint", joint, poses.q[:, by])]},
        {"by": float(by)},
        cause=("joint_coupling", joint, by),
    )


def backlash(poses: Poses, joint: int) -> Shape:
    side = poses.covariates["direction"][:, joint]
    return Shape("backlash", joint, {"gap": [Action("joint", joint, -0.5 * side)]})


def joint_compliance(poses: Poses, joint: int) -> Shape:
    values = torque(poses, joint)
    return Shape("joint_compliance", joint, {"compliance": [Action("joint", joint, values)]})


def link_compliance(poses: Poses, row: int) -> Shape:
    return Shape(
        "link_compliance", row, {"flexibility": [Action("frame", row + 1, cantilever(poses, row))]}
    )


def base_compliance(poses: Poses) -> Shape:
    moment = base_moment(poses)
    actions = {}
    for axis in (0, 1):
        values = np.zeros((len(moment), 6))
        values[:, 3 + axis] = moment[:, axis]
        actions[f"compliance_{AXES[axis]}"] = [Action("frame", 0, values)]
    return Shape("base_compliance", None, actions)


def payload(poses: Poses) -> Shape:
    return Shape(
        "payload",
        None,
        {
            f"mass_compliance_{j + 1}": [Action("joint", j, torque(poses, j, only_tip=True))]
            for j in range(poses.arm.size)
            if not poses.arm.sliding[j]
        },
    )


def twists(
    poses: Poses, frame: int, marks: dict[int, Array], full: bool
) -> dict[str, list[Action]]:
    """A twist of a frame of its own for each mark (N,): of tools without turns that nobody sees."""
    actions = {}
    for label, mark in marks.items():
        for axis in range(6 if full else 3):
            values = np.zeros((len(mark), 6))
            values[:, axis] = mark
            kind = "shift" if axis < 3 else "turn"
            actions[f"{kind}_{AXES[axis % 3]}_{label}"] = [Action("frame", frame, values)]
    return actions


def session_marks(poses: Poses, since: int | None) -> dict[int, Array]:
    """Of each later session, or of all from session `since` (counted from 0) on."""
    labels = np.unique(poses.sessions)
    if since is None:
        return {
            s + 1: (poses.sessions == label).astype(float)
            for s, label in enumerate(labels)
            if s > 0
        }
    return {since + 1: (poses.sessions >= labels[since]).astype(float)}


def base_shift(poses: Poses, since: int | None = None) -> Shape:
    return Shape(
        "base_shift",
        None,
        twists(poses, 0, session_marks(poses, since), True),
        {} if since is None else {"since": float(since)},
    )


def tool_change(poses: Poses, since: int | None = None) -> Shape:
    return Shape(
        "tool_change",
        None,
        twists(poses, poses.arm.size + 1, session_marks(poses, since), poses.pose),
        {} if since is None else {"since": float(since)},
    )


def tool_slip(poses: Poses, moment: int) -> Shape:
    marks = {1: (poses.rank >= moment).astype(float)}
    actions = twists(poses, poses.arm.size + 1, marks, poses.pose)
    return Shape(
        "tool_slip", None, {n[:-2]: a for n, a in actions.items()}, {"moment": float(moment)}
    )


def thermal(poses: Poses) -> Shape:
    warm = poses.covariates["temperature"]
    return Shape("thermal", None, {"expansion": [Action("length", 0, warm - warm.mean())]})


def drift(poses: Poses) -> Shape:
    time = poses.covariates["time"]
    actions = twists(poses, 0, {0: time - time.min()}, True)
    names = {"shift": "rate", "turn": "turn_rate"}
    return Shape(
        "drift",
        None,
        {f"{names[n.split('_')[0]]}_{n.split('_')[1]}": a for n, a in actions.items()},
    )


def clock_shift(poses: Poses) -> Shape:
    assert poses.speed is not None
    acts = [Action("joint", j, poses.speed[:, j]) for j in range(poses.arm.size)]
    return Shape("clock_shift", None, {"delay": acts})


def _turning(poses: Poses) -> list[int]:
    return [j for j in range(poses.arm.size) if not poses.arm.sliding[j]]


def orders_of(poses: Poses, joint: int) -> list[float]:
    if poses.arm.sliding[joint]:
        return [2 * np.pi / p for p in (0.6, 0.3, 0.2, 0.1)]
    return [0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0]


def library(poses: Poses) -> list[Shape]:
    """All forms that these poses allow."""
    makers: list[Callable[[], Shape | None]] = []
    joints = range(poses.arm.size)

    def add(make: Callable[..., Shape], choices: Iterable[tuple[object, ...]]) -> None:
        makers.extend(lambda c=c: make(poses, *c) for c in choices)  # type: ignore[misc]

    add(harmonic, [(j, k) for j in joints for k in orders_of(poses, j)])
    add(curve, [(j,) for j in joints])
    add(scale, [(j,) for j in joints])
    add(coupling, [(j, i) for j in joints for i in joints if i != j])
    if "direction" in poses.covariates:
        add(backlash, [(j,) for j in joints])
    if poses.arm.weighed:
        add(joint_compliance, [(j,) for j in joints])
        add(link_compliance, [(j,) for j in list(joints)[:-1]])
        add(base_compliance, [()])
    add(payload, [()])
    count = len(np.unique(poses.sessions))
    if count > 1:
        since: list[tuple[object, ...]] = [(s,) for s in range(1, count)] if count > 2 else []
        add(base_shift, [(), *since])
        add(tool_change, [(), *since])
    rows = len(poses.q)
    add(tool_slip, [(int(m),) for m in np.linspace(0.05 * rows, 0.95 * rows, 19)])
    if "temperature" in poses.covariates:
        add(thermal, [()])
    if "time" in poses.covariates:
        add(drift, [()])
        if poses.speed is not None:
            add(clock_shift, [()])
    return [shape for make in makers if (shape := make()) is not None]
