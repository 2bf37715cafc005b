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
    """

    time: Floats
    """(P,) [s]"""
    position: Floats
    """(P, 3) in the world [m]: east, north, up."""
    heading: Floats
    """(P,) [rad]"""
    pitch: Floats
    """(P,) [rad]"""
    roll: Floats
    """(P,) [rad]"""
    depth: Floats
    """(P,) below the mean surface [m]"""
    altitude: Floats
    """(P,) above the bottom [m]"""
    speed: Floats
    """(P,) over ground [m/s]"""
    latitude: Floats | None = None
    """(P,) [rad]; of files that have it."""
    longitude: Floats | None = None
    """(P,) [rad]; of files that have it."""
