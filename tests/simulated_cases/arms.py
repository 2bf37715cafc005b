# SPDX-License-Identifier: BSD-3-Clause
"""Arms for hidden effects: their own forward kinematics in NumPy, from numbers that are drawn."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import bathyal

Array = NDArray[np.float64]

COLUMNS = ("theta", "d", "a", "alpha", "beta")


def turned(vectors: Array) -> Array:
    """(N, 3, 3) rotations by rotation vectors (N, 3), by Rodrigues' formula."""
    angle = np.linalg.norm(vectors, axis=1)
    axis = vectors / np.where(angle == 0, 1.0, angle)[:, None]
    cross = np.zeros((len(vectors), 3, 3))
    cross[:, 0, 1], cross[:, 0, 2], cross[:, 1, 2] = -axis[:, 2], axis[:, 1], -axis[:, 0]
    cross -= np.swapaxes(cross, 1, 2)
    sine, cosine = np.sin(angle)[:, None, None], np.cos(angle)[:, None, None]
    return np.asarray(np.eye(3) + sine * cross + (1 - cosine) * cross @ cross)


def pose(shift: Array, turn: Array) -> Array:
    matrix = np.eye(4)
    matrix[:3, :3] = turned(np.asarray(turn, float)[None])[0]
    matrix[:3, 3] = shift
    return matrix


@dataclass(frozen=True)
class Frames:
    """An arm's frames, one a pose: [k] before row k, [n] behind the last."""

    rotation: list[Array]  # (N, 3, 3)
    origin: list[Array]  # (N, 3)
    tip: Array  # (N, 3)
    tool: Array  # (N, 3, 3)


@dataclass(frozen=True)
class SimArm:
    """A row is Rz(theta) Tz(d) Tx(a) Rx(alpha) Ry(beta); q adds to theta, or to d where it slides.

    Link k hangs behind row k - 1; `centers` are given in the frame behind that row; 0 is the foot.
    """

    theta: Array
    d: Array
    a: Array
    alpha: Array
    beta: Array
    sliding: NDArray[np.bool_]
    lower: Array
    upper: Array
    masses: Array  # (n + 1,) [kg]; all zero: not known
    centers: Array  # (n + 1, 3) [m]
    tool: Array  # (4, 4)
    urdf: bool = False

    @property
    def size(self) -> int:
        return len(self.theta)

    @property
    def weighed(self) -> bool:
        return bool(self.masses.any())

    @property
    def reach(self) -> float:
        return float(np.sum(np.hypot(self.a, self.d)) + np.linalg.norm(self.tool[:3, 3]))

    def walk(self, q: Array, twists: dict[int, Array] | None = None, stretch: Any = 0.0) -> Frames:
        """Frames at q (N, n). `twists[k]` (N, 6): a shift, then a turn, put in behind frame k
        (n + 1: before the tool). `stretch` (N,): by what share a and d are longer."""
        twists = twists or {}
        rotation = np.tile(np.eye(3), (len(q), 1, 1))
        origin = np.zeros((len(q), 3))
        longer = 1.0 + np.broadcast_to(stretch, len(q))
        rotations, origins = [], []
        for k in range(self.size + 1):
            if k in twists:
                origin = origin + _apply(rotation, twists[k][:, :3])
                rotation = rotation @ turned(twists[k][:, 3:])
            rotations.append(rotation)
            origins.append(origin)
            if k == self.size:
                break
            turn = self.theta[k] + (0.0 if self.sliding[k] else q[:, k])
            slide = self.d[k] * longer + (q[:, k] if self.sliding[k] else 0.0)
            turn = np.broadcast_to(turn, len(q))
            origin = origin + slide[:, None] * rotation[:, :, 2]
            rotation = rotation @ _about(2, turn)
            origin = origin + (self.a[k] * longer)[:, None] * rotation[:, :, 0]
            fixed = _about(0, self.alpha[k : k + 1]) @ _about(1, self.beta[k : k + 1])
            rotation = rotation @ fixed
        if self.size + 1 in twists:
            last = twists[self.size + 1]
            origin = origin + _apply(rotation, last[:, :3])
            rotation = rotation @ turned(last[:, 3:])
        tip = origin + rotation @ self.tool[:3, 3]
        return Frames(rotations, origins, tip, rotation @ self.tool[:3, :3])

    def built(self, random: np.random.Generator, length: float, angle: float) -> SimArm:
        """The arm as it came out of the shop: every number off by normal errors."""
        off = {c: getattr(self, c) + length * random.normal(size=self.size) for c in ("d", "a")}
        for c in ("theta", "alpha", "beta"):
            off[c] = getattr(self, c) + angle * random.normal(size=self.size)
        return replace(self, **off)

    def arm(self, folder: Path | None = None) -> bathyal.Arm:
        """What is handed to the diagnosis. Base and tool are not given."""
        if self.urdf:
            return _arm_from_urdf(self, folder)
        links = [
            bathyal.Link(f"link_{k}", mass=float(m), center_of_mass=tuple(c))
            for k, (m, c) in enumerate(zip(self.masses, self.centers, strict=True))
        ]
        return bathyal.Arm.from_dh(
            **{c: getattr(self, c) for c in COLUMNS},
            joint_types=["prismatic" if s else "revolute" for s in self.sliding],
            lower=self.lower,
            upper=self.upper,
            **({"links": links} if self.weighed else {}),
        )

    def urdf_text(self) -> str:
        """The same arm as a URDF: a joint's origin is what the row before it ends with, and what
        its own row begins with."""
        parts = ['<?xml version="1.0"?>', '<robot name="hidden">']
        before = np.eye(4)
        for k in range(self.size + 1):
            mass, center = self.masses[k], self.centers[k]
            if k > 0:
                behind = _ending(self.a[k - 1], self.alpha[k - 1])
                center = behind[:3, :3] @ center + behind[:3, 3]
            parts.append(f'<link name="link_{k}">')
            if self.weighed:
                parts.append(
                    f'<inertial><origin xyz="{_words(center)}"/><mass value="{mass:.17g}"/>'
                    '<inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>'
                )
            parts.append("</link>")
            own = np.eye(4)
            if k < self.size:
                own[:3, :3] = _about(2, self.theta[k : k + 1])[0]
                own[2, 3] = self.d[k]
            at = before @ own
            kind = "fixed" if k == self.size else "prismatic" if self.sliding[k] else "revolute"
            child = "tip" if k == self.size else f"link_{k + 1}"
            parts.append(
                f'<joint name="joint_{k + 1}" type="{kind}"><parent link="link_{k}"/>'
                f'<child link="{child}"/><origin xyz="{_words(at[:3, 3])}" rpy="{_rpy(at)}"/>'
            )
            if k < self.size:
                parts.append(
                    f'<axis xyz="0 0 1"/><limit lower="{self.lower[k]:.17g}" '
                    f'upper="{self.upper[k]:.17g}" velocity="1" effort="100"/>'
                )
                before = _ending(self.a[k], self.alpha[k])
            parts.append("</joint>")
        return "\n".join([*parts, '<link name="tip"/>', "</robot>"])


def _arm_from_urdf(arm: SimArm, folder: Path | None) -> bathyal.Arm:
    with tempfile.TemporaryDirectory() as made:
        path = Path(folder or made) / "arm.urdf"
        path.write_text(arm.urdf_text())
        return bathyal.Arm.from_urdf(path, tip="tip")


def _apply(rotation: Array, vectors: Array) -> Array:
    return np.asarray(np.einsum("nij,nj->ni", rotation, vectors))


def _about(axis: int, angle: Array) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    out = np.zeros((len(angle), 3, 3))
    out[:, axis, axis] = 1.0
    out[:, i, i], out[:, i, j], out[:, j, i], out[:, j, j] = c, -s, s, c
    return out


def _ending(a: float, alpha: float) -> Array:
    out = np.eye(4)
    out[0, 3] = a
    out[:3, :3] = _about(0, np.array([alpha]))[0]
    return out


def _words(vector: Array) -> str:
    return " ".join(f"{v:.17g}" for v in vector)


def _rpy(matrix: Array) -> str:
    roll = np.arctan2(matrix[2, 1], matrix[2, 2])
    pitch = np.arctan2(-matrix[2, 0], np.hypot(matrix[0, 0], matrix[1, 0]))
    yaw = np.arctan2(matrix[1, 0], matrix[0, 0])
    return _words(np.array([roll, pitch, yaw]))
