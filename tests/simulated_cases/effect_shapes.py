# SPDX-License-Identifier: BSD-3-Clause
"""What each effect of the library moves, in plain NumPy: for making data, and for an oracle.

A parameter acts on a joint (added to what was recorded), on a frame (a shift and a turn put in
behind it) or on the lengths; what it does to measured tips follows from the frames alone.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from tests.simulated_cases.arms import Array, Frames, SimArm

GRAVITY = np.array([0.0, 0.0, -9.80665])


@dataclass(frozen=True)
class Poses:
    """What was recorded, and what an effect may look at."""

    arm: SimArm
    q: Array  # (N, n)
    covariates: dict[str, Array]
    order: Array  # (N,) rows as they were taken
    frames: Frames
    speed: Array | None = None  # (N, n) along a trajectory
    pose: bool = False
    point: Array | None = None  # (N,) labels where points were touched
    stiff: float = 1.0  # noise of a rotation per noise of a position [rad/m]

    @property
    def sessions(self) -> Array:
        return self.covariates.get("session", np.zeros(len(self.q)))

    @property
    def rank(self) -> Array:
        """(N,) place of each row in the order of time."""
        out = np.empty(len(self.q))
        out[self.order.astype(int)] = np.arange(len(self.q))
        return out


@dataclass(frozen=True)
class Action:
    """A parameter moves `site` by itself times `values`: site "joint" j (N,); "frame" k (N, 6);
    "length" (N,)."""

    site: str
    index: int
    values: Array


@dataclass
class Shape:
    """One form of an effect: its parameters, by name, and what each of them does."""

    name: str
    joint: int | None
    actions: dict[str, list[Action]]
    settings: dict[str, float] = field(default_factory=dict)
    cause: tuple[Any, ...] = ()

    def __post_init__(self) -> None:
        self.cause = self.cause or cause_of(self.name, self.joint)


def cause_of(name: str, joint: int | None) -> tuple[Any, ...]:
    """Names that are words for one thing share a cause."""
    if name in ("joint_harmonic", "joint_map"):
        return ("curve", joint)
    if name in ("base_compliance", "link_compliance"):
        # A column that bends turns all that is on it, as its base does.
        return ("bending", joint or 0)
    return (name, joint)


# --- what actions do -----------------------------------------------------------------------------


def moved(poses: Poses, action: Action) -> Array:
    """(N, 3) movement of the tip per unit of a parameter, or (N, 6) with its turn."""
    frames, v = poses.frames, action.values
    if action.site == "length":
        shift = np.zeros((len(v), 3))
        for k in range(poses.arm.size):
            shift += poses.arm.d[k] * frames.rotation[k][:, :, 2]
            shift += poses.arm.a[k] * _x_of_row(poses, k)
        shift = shift * v[:, None]
        turn = np.zeros_like(shift)
    elif action.site == "joint":
        axis = frames.rotation[action.index][:, :, 2] * v[:, None]
        if poses.arm.sliding[action.index]:
            shift, turn = axis, np.zeros_like(axis)
        else:
            shift, turn = np.cross(axis, frames.tip - frames.origin[action.index]), axis
    else:
        k = min(action.index, poses.arm.size)
        rotation = frames.rotation[k]
        turn = np.einsum("nij,nj->ni", rotation, v[:, 3:])
        shift = np.einsum("nij,nj->ni", rotation, v[:, :3])
        shift = shift + np.cross(turn, frames.tip - frames.origin[k])
    return np.hstack([shift, turn]) if poses.pose else shift


def column(poses: Poses, moves: Array) -> Array:
    """(M,) what is seen of movements (N, 3 or 6): of touches only what differs within a point; of
    turns as many noises as of shifts."""
    moves = np.array(moves, float)
    if poses.pose:
        moves[:, 3:] /= poses.stiff
    if poses.point is not None:
        for label in np.unique(poses.point):
            at = poses.point == label
            moves[at] -= moves[at].mean(axis=0)
    return moves.ravel()


def columns(poses: Poses, shape: Shape) -> Array:
    """(M, p) of a shape."""
    return np.column_stack(
        [column(poses, sum(moved(poses, a) for a in acts)) for acts in shape.actions.values()]
    )


def base_columns(poses: Poses) -> Array:
    """All that geometry, base and tool can do: any small shift and turn of any frame."""
    ones = np.ones(len(poses.q))
    out = []
    for k in range(poses.arm.size + 2):
        for axis in range(6):
            if k == poses.arm.size + 1 and axis > 2 and not poses.pose:
                continue
            values = np.zeros((len(ones), 6))
            values[:, axis] = 1.0
            out.append(column(poses, moved(poses, Action("frame", k, values))))
    return np.column_stack(out)


def basis(matrix: Array) -> Array:
    """Orthonormal columns that span what `matrix` does."""
    size = np.linalg.norm(matrix, axis=0)
    left, values, _ = np.linalg.svd(matrix / np.where(size > 0, size, 1.0), full_matrices=False)
    return np.asarray(left[:, values > 1e-7 * max(values[0], 1e-300)])


def project_out(known: Array, matrix: Array) -> Array:
    """Columns projected off an orthonormal basis."""
    return np.asarray(matrix - known @ (known.T @ matrix))


def _x_of_row(poses: Poses, k: int) -> Array:
    """The x axis of row k: behind its joint, before its twist."""
    behind = poses.frames.rotation[k + 1]
    cb, sb = np.cos(poses.arm.beta[k]), np.sin(poses.arm.beta[k])
    return np.asarray(cb * behind[:, :, 0] + sb * behind[:, :, 2])


# --- loads ---------------------------------------------------------------------------------------


def gravity_of(poses: Poses) -> Array:
    given = poses.covariates.get("gravity")
    return np.tile(GRAVITY, (len(poses.q), 1)) if given is None else np.asarray(given)


def weight_behind(poses: Poses, k: int) -> tuple[Array, Array]:
    """Of all that hangs behind frame k, payload too: mass (N,) and mass times place (N, 3)."""
    payload = np.asarray(poses.covariates.get("payload", np.zeros(len(poses.q))))
    mass = payload.copy()
    moment = payload[:, None] * poses.frames.tip
    for link in range(k, poses.arm.size + 1):
        place = poses.frames.origin[link] + np.einsum(
            "nij,j->ni", poses.frames.rotation[link], poses.arm.centers[link]
        )
        mass = mass + poses.arm.masses[link]
        moment = moment + poses.arm.masses[link] * place
    return mass, moment


def torque(poses: Poses, joint: int, only_tip: bool = False) -> Array:
    """(N,) what gravity exerts along a joint: force on, or moment about, its axis."""
    if only_tip:
        mass, moment = np.ones(len(poses.q)), poses.frames.tip
    else:
        mass, moment = weight_behind(poses, joint + 1)
    g, axis = gravity_of(poses), poses.frames.rotation[joint][:, :, 2]
    if poses.arm.sliding[joint]:
        return np.asarray(mass * np.sum(axis * g, axis=1))
    lever = moment - mass[:, None] * poses.frames.origin[joint]
    return np.asarray(np.sum(axis * np.cross(lever, g), axis=1))


def cantilever(poses: Poses, row: int) -> Array:
    """(N, 6) shift and turn at the end of a beam along row `row`, for 1/(E I) = 1, given in the
    frame behind it: an end load and an end moment (any table of beams)."""
    frames, end = poses.frames, row + 1
    into = np.swapaxes(frames.rotation[end], 1, 2)
    mass, moment = weight_behind(poses, end + 1)
    g = gravity_of(poses)
    force = np.einsum("nij,nj->ni", into, mass[:, None] * g)
    about = np.cross(moment - mass[:, None] * frames.origin[end], g)
    about = np.einsum("nij,nj->ni", into, about)
    beam = np.einsum("nij,nj->ni", into, frames.origin[end] - frames.origin[row])
    length = np.linalg.norm(beam, axis=1, keepdims=True)
    along = beam / np.where(length > 0, length, 1.0)
    about = about - along * np.sum(along * about, axis=1, keepdims=True)
    across = np.cross(beam, force)
    turn = length * (about + across / 2)
    shift = length * (np.cross(about, beam) / 2 + np.cross(across, beam) / 3)
    return np.hstack([shift, turn])


def base_moment(poses: Poses) -> Array:
    """(N, 3) moment of the arm's weight, its foot too, about the base's origin."""
    _, moment = weight_behind(poses, 0)
    return np.asarray(np.cross(moment, gravity_of(poses)))
