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
