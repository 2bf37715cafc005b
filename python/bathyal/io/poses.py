# SPDX-License-Identifier: BSD-3-Clause
"""Poses as files and the command line write them: a place, and three turns."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def rotation_of(rpy: ArrayLike) -> Array:
    """(3, 3) rotation by roll, pitch, yaw [rad]: turns about the fixed x, y, z in this order,
    Rz(yaw) Ry(pitch) Rx(roll).

    Examples
    --------
    >>> rotation_of([0, 0, np.pi / 2]).round(3) @ [1, 0, 0]
    array([0., 1., 0.])
    """
    (sr, sp, sy), (cr, cp, cy) = np.sin(rpy), np.cos(rpy)
    return np.array(
        [
            [cp * cy, sp * (sr * cy) - cr * sy, sp * (cr * cy) + sr * sy],
            [cp * sy, sp * (sr * sy) + cr * cy, sp * (cr * sy) - sr * cy],
            [-sp, cp * sr, cp * cr],
        ]
    )


def pose_of(position: ArrayLike, rpy: ArrayLike) -> Array:
    """(4, 4) pose from a place [m] and `rotation_of` three turns [rad]."""
    pose = np.eye(4)
    pose[:3, :3] = rotation_of(rpy)
    pose[:3, 3] = position
    return pose
