# SPDX-License-Identifier: BSD-3-Clause
"""A map of the reach against inverse kinematics."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import bathyal


@dataclass(frozen=True)
class Differences:
    """Of each voxel drawn, whether the two differ: in any orientation, and along a direction."""

    reached: np.ndarray
    along: np.ndarray
    missed: np.ndarray  # the map has it not reached, inverse kinematics has
    inside: np.ndarray  # the map has the voxel reached


def poses_of(middle: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """(N, 4, 4) with the origin in `middle` and the z axis along `direction`."""
    other = np.where(np.abs(direction[:, :1]) < 0.9, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
    x = np.cross(other, direction)
    x /= np.linalg.norm(x, axis=1)[:, None]
    poses = np.tile(np.eye(4), (len(middle), 1, 1))
    poses[:, :3, :3] = np.stack([x, np.cross(direction, x), direction], axis=2)
    poses[:, :3, 3] = middle
    return poses


def differences(reach: bathyal.ReachMap, arm: bathyal.Arm, count: int, *, seed: int) -> Differences:
    """Of `count` voxels drawn over the whole box, a direction drawn for each; `arm` at its base."""
    random = np.random.default_rng(seed)
    cells = np.stack([random.integers(0, n, count) for n in reach.reached.shape], axis=1)
    which = random.integers(0, len(reach.approach), count)
    middle = reach.origin + reach.voxel * (cells + 0.5)
    poses = poses_of(middle, reach.approach[which])
    at_all = arm.inverse(poses, task="position").status == "reached"
    along = arm.inverse(poses, task="position_axis").status == "reached"
    of_map = reach.reached[tuple(cells.T)]
    along_map = reach.reached_along[(*cells.T, which)]
    return Differences(at_all != of_map, along != along_map, at_all & ~of_map, of_map)
