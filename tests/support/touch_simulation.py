# SPDX-License-Identifier: BSD-3-Clause
"""Touches of an arm whose true geometry is known."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

import bathyal

Array = NDArray[np.float64]

POINTS = np.array([[-0.6, -0.2, 0.1], [-0.5, 0.4, 0.25], [0.3, -0.65, 0.4]])
"""Three touched points about a UR10e [m]."""

NOISE = 0.0925e-3
"""Scatter of a touch per axis [m]: over 3 points of 21 poses, with 20 parameters found, the sum
over pairs ends near the 28.7 mm² of Yukhimets and Gubankov (2023)."""


def identified_ur10e() -> bathyal.Arm:
    """The UR10e that Yukhimets and Gubankov (2023) found, with a probe."""
    nominal = bathyal.arms.ur10e()
    return bathyal.Arm.from_dh(
        theta=np.deg2rad([0, 0.0047, 0.0015, 0.0017, 0.0467, -0.0253]),
        a=np.array([0.0015, -612.7056, -571.3064, -0.0756, 0.1869, 0.0356]) / 1e3,
        d=np.array([180.7, -0.0002, -0.0002, 174.1, 120.2671, 115.8641]) / 1e3,
        alpha=np.deg2rad([90.0193, -0.0682, -0.2073, 89.9643, -90.0688, -0.0102]),
        lower=nominal.lower,
        upper=nominal.upper,
        tool=shift(0.01, -0.02, 0.15),
    )


def shift(x: float, y: float, z: float) -> Array:
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


def changed(arm: bathyal.Arm, changes: Mapping[str, float]) -> bathyal.Arm:
    """The arm with numbers of its rows, or of its tool's shift, changed: {"a_2": 1e-3, …}."""
    table = arm.to_dh()
    columns = {
        name: np.array(getattr(table, name)) for name in ("theta", "d", "a", "alpha", "beta")
    }
    tool = np.array(arm.tool)
    for name, change in changes.items():
        column, place = name.split("_")
        if column == "tool":
            tool["xyz".index(place), 3] += change
        else:
            columns[column][int(place) - 1] += change
    limits: dict[str, list[float]] = {"lower": [], "upper": []}
    for bound, values in limits.items():
        joints = iter(getattr(arm, bound))
        values += [0.0 if kind == "fixed" else next(joints) for kind in table.joint_types]
    return bathyal.Arm.from_dh(
        **columns,
        **limits,
        joint_types=list(table.joint_types),
        convention=table.convention,
        root=table.root,
        flange=table.flange,
        base=arm.base,
        tool=tool,
    )


def directions_in_cone(half_angle: float, count: int, random: np.random.Generator) -> Array:
    """(count, 3, 3) orientations of a tool whose axis points down, no further off than the angle
    [rad], and whose turn about it is any."""
    height = random.uniform(np.cos(half_angle), 1.0, count)
    across = np.sqrt(1.0 - height**2)
    bearing, turn = random.uniform(-np.pi, np.pi, (2, count))
    axis = np.column_stack([across * np.cos(bearing), across * np.sin(bearing), -height])
    first = np.cross(axis, [0.3, 1.0, 0.2])
    first /= np.linalg.norm(first, axis=1)[:, None]
    second = np.cross(axis, first)
    x = np.cos(turn)[:, None] * first + np.sin(turn)[:, None] * second
    return np.stack([x, np.cross(axis, x), axis], axis=2)


def touching(
    arm: bathyal.Arm, points: ArrayLike, count: int, *, cone_deg: float, seed: int
) -> tuple[Array, NDArray[np.int64]]:
    """Poses whose tip lies on the points, `count` each, and their labels."""
    random = np.random.default_rng(seed)
    poses = []
    for point in np.asarray(points):
        found = np.empty((0, arm.size))
        while len(found) < count:
            targets = np.tile(np.eye(4), (4 * count, 1, 1))
            targets[:, :3, :3] = directions_in_cone(np.deg2rad(cone_deg), 4 * count, random)
            targets[:, :3, 3] = point
            solution = arm.inverse(targets, max_starts=8, seed=int(random.integers(1 << 30)))
            found = np.vstack([found, solution.q[solution.status == "reached"]])
        poses.append(found[:count])
    labels = np.repeat(np.arange(len(poses)), count)
    return moved_to(arm, np.vstack(poses), np.asarray(points)[labels]), labels


def moved_to(arm: bathyal.Arm, q: Array, tips: Array) -> Array:
    """Joint values near `q` that bring the tip to `tips`, by the least motion: what an arm records
    whose tip does not lie quite where it should."""
    for _ in range(4):
        jacobian = arm.jacobian(q)[:, :3]
        miss = tips - arm.forward(q)[:, :3, 3]
        across = np.swapaxes(jacobian, 1, 2)
        q = q + (across @ np.linalg.solve(jacobian @ across, miss[..., None]))[..., 0]
    return q


def scattered(arm: bathyal.Arm, q: Array, noise: float, random: np.random.Generator) -> Array:
    """Joint values whose tip is off by normal noise, `noise` [m] per axis."""
    tips = arm.forward(q)[:, :3, 3]
    return moved_to(arm, q, tips + random.normal(0.0, noise, tips.shape))


def distances_of(
    points: ArrayLike, pairs: Sequence[tuple[int, int]]
) -> dict[tuple[int, int], float]:
    points = np.asarray(points)
    return {(i, j): float(np.linalg.norm(points[i] - points[j])) for i, j in pairs}
