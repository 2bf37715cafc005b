# SPDX-License-Identifier: BSD-3-Clause
"""Where a vehicle says that it was."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Navigation:
    """What a vehicle reports at each ping; NaN where it does not.

    Angles are as a mariner reads them: heading clockwise from north (the world's y), pitch positive
    with the bow up, roll positive with starboard down.

    Attributes
    ----------
    time
        (P,) [s]
    position
        (P, 3) in the world [m]: east, north, up.
    heading
        (P,) [rad]
    pitch
        (P,) [rad]
    roll
        (P,) [rad]
    depth
        (P,) below the mean surface [m]
    altitude
        (P,) above the bottom [m]
    speed
        (P,) over ground [m/s]
    latitude, longitude
        (P,) [rad]; of files that have them.
    """

    time: Floats
    position: Floats
    heading: Floats
    pitch: Floats
    roll: Floats
    depth: Floats
    altitude: Floats
    speed: Floats
    latitude: Floats | None = None
    longitude: Floats | None = None
<<<<<<< HEAD
    """(P,) [rad]; of files that have it."""
=======


def mariners_angles(pose: Floats) -> tuple[Floats, Floats, Floats]:
    """Heading, pitch and roll (P,) [rad] of world_from_vehicle (P, 4, 4)."""
    forward, port = pose[:, :3, 0], pose[:, :3, 1]
    heading = np.mod(np.arctan2(forward[:, 0], forward[:, 1]), 2 * np.pi)
    pitch = np.arcsin(np.clip(forward[:, 2], -1, 1))
    roll = np.arctan2(port[:, 2], pose[:, 2, 2])
    return heading, pitch, roll


def true_navigation(
    time: Floats, pose: Floats, altitude: Floats, surface: float | None = None
) -> Navigation:
    """What a vehicle without errors reports, of (P,) times [s] and (P, 4, 4) world_from_vehicle."""
    heading, pitch, roll = mariners_angles(pose)
    position = pose[:, :3, 3].copy()
    depth = np.full(len(time), np.nan) if surface is None else surface - position[:, 2]
    if len(time) > 1:
        speed = np.linalg.norm(np.gradient(position, time, axis=0), axis=1)
    else:
        speed = np.zeros(len(time))
    return Navigation(time, position, heading, pitch, roll, depth, altitude, speed)
>>>>>>> engine
