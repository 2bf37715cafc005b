# SPDX-License-Identifier: BSD-3-Clause
"""The body that a picture gives an arm: a capsule a link, a drum a joint, from its axes alone."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from bathyal._core import Arm, arm_parts
from bathyal.view.palette import DEPTH, SEGMENTS
from bathyal.view.solids import SIDES, Floats, Indices, capsule, prism

_LINK_COLOURS = (DEPTH[2], DEPTH[3])
_FOOT_COLOUR = "#7d8590"
_TURNING, _SLIDING = SEGMENTS[0], SEGMENTS[1]
_LINK_RADIUS = 0.017  # of the arm's length, as all of these
_DRUM_RADIUS, _DRUM_LENGTH = 0.028, 0.08
_SLIDER_RADIUS, _SLIDER_LENGTH = 0.045, 0.05  # so that a drum on the same axis stays in sight
_SHORTEST = 1e-9  # [m] of a link that is drawn


@dataclass(frozen=True)
class Part:
    """A closed mesh of one colour, and what it is."""

    name: str
    colour: str
    vertices: Floats
    triangles: Indices


@dataclass(frozen=True)
class Posture:
    """An arm's pose, in the world [m].

    `strokes` are polylines, one a link, the foot first; `axes` (m, 2, 3) a point on each moving
    joint's axis and its direction.
    """

    base: Floats
    tool: Floats
    strokes: list[Floats]
    axes: Floats
    joint_names: list[str]
    sliding: list[bool]


def resting_pose(arm: Arm) -> Floats:
    """Each coordinate at 0 or, where its limits leave 0 out, in the middle of them."""
    lower, upper = np.asarray(arm.lower), np.asarray(arm.upper)
    bounded = np.isfinite(lower) & np.isfinite(upper)
    middle = np.where(bounded, (np.where(bounded, lower, 0) + np.where(bounded, upper, 0)) / 2, 0)
    middle = np.where(bounded, middle, np.clip(0, lower, upper))
    return np.where((lower <= 0) & (upper >= 0), 0.0, middle)


def posture(arm: Arm, q: ArrayLike) -> Posture:
    """The arm at one pose `q` (n,).

    A link runs from its joint's axis to the next one's: along its own frames where those lie on
    the axes, as a URDF's do, else along the axis and the common normal, as the table's.
    """
    parts = arm_parts(arm)
    rows = np.stack([np.asarray(link["frame"]) for link in parts["links"]])
    links = np.asarray(arm.forward(q, links=True))
    before = links @ np.linalg.inv(rows)  # world_from_row
    tool = np.asarray(arm.forward(q))
    origin, direction = before[:-1, :3, 3], before[:-1, :3, 2]
    moving = [joint["type"] != "fixed" for joint in parts["joints"]]
    joint_at = _on_axes(links[1:, :3, 3], origin, direction)
    own_frames = np.allclose(joint_at, links[1:, :3, 3], rtol=0, atol=1e-9)
    flange = tool @ np.linalg.inv(np.asarray(arm.tool))
    ends = np.vstack([joint_at[1:], flange[None, :3, 3]])
    strokes = [np.vstack([np.asarray(arm.base)[:3, 3], joint_at[0]])]
    for k, end in enumerate(ends):
        knees = [joint_at[k], end] if own_frames else [joint_at[k], before[k + 1, :3, 3], end]
        strokes.append(np.array(knees))
    if not own_frames:
        strokes[0] = np.vstack([np.asarray(arm.base)[:3, 3], origin[0], joint_at[0]])
    strokes[-1] = np.vstack([strokes[-1], tool[:3, 3]])
    moving_joints = [joint for joint in parts["joints"] if joint["type"] != "fixed"]
    return Posture(
        base=np.asarray(arm.base),
        tool=tool,
        strokes=strokes,
        axes=np.stack([joint_at, direction], axis=1)[moving],
        joint_names=[joint["name"] for joint in moving_joints],
        sliding=[joint["type"] == "prismatic" for joint in moving_joints],
    )


def size_of(postures: list[Posture]) -> float:
    """What lengths of drums and arrows are shares of: the longest arm stretched out [m]."""
    lengths = [
        sum(float(np.linalg.norm(np.diff(stroke, axis=0), axis=1).sum()) for stroke in p.strokes)
        for p in postures
    ]
    return max([*lengths, 1e-3])


def solid(at: Posture, size: float) -> list[Part]:
    """The parts of an arm whose length is `size`."""
    parts = []
    for k, stroke in enumerate(at.strokes):
        colour = _LINK_COLOURS[k % 2] if k else _FOOT_COLOUR
        for start, end in pairwise(stroke):
            if np.linalg.norm(end - start) > _SHORTEST:
                mesh = capsule(start, end, _LINK_RADIUS * size)
                parts.append(Part(f"link {k}" if k else "foot", colour, *mesh))
    for name, (point, direction), slides in zip(at.joint_names, at.axes, at.sliding, strict=True):
        half = (_SLIDER_LENGTH if slides else _DRUM_LENGTH) * size / 2
        mesh = prism(
            point - half * direction,
            point + half * direction,
            (_SLIDER_RADIUS if slides else _DRUM_RADIUS) * size,
            4 if slides else SIDES,
        )
        parts.append(Part(name, _SLIDING if slides else _TURNING, *mesh))
    return parts


def _on_axes(points: Floats, origin: Floats, direction: Floats) -> Floats:
    """The nearest point of each axis."""
    along = np.sum((points - origin) * direction, axis=1, keepdims=True)
    return np.asarray(origin + along * direction)
