# SPDX-License-Identifier: BSD-3-Clause
"""Where on Earth and when: positions and headings as instruments tell them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from datetime import datetime, timedelta
from functools import cached_property

from bathyal.navigation.local_frame import local_place


@dataclass(frozen=True)
class EarthFrame:
    """The world's origin on Earth; x is east, y north.

    Attributes
    ----------
    latitude, longitude : float
        Of the origin [deg].
    """

    latitude: float
    longitude: float

    @cached_property
    def _origin(self) -> tuple[float, float]:
        return math.radians(self.latitude), math.radians(self.longitude)

    def place(self, x: float, y: float) -> tuple[float, float]:
        """Latitude and longitude of a point of the world [deg]."""
        latitude, longitude = local_place(x, y, self._origin)
        return math.degrees(latitude), math.degrees(longitude)


def date_and_time(start: datetime, time: float) -> tuple[tuple[int, int, int], float]:
    """(year, month, day), and the seconds of that day."""
    now = start + timedelta(seconds=time)
    midnight = now.replace(hour=0, minute=0, second=0, microsecond=0)
    return (now.year, now.month, now.day), (now - midnight).total_seconds()


def compass_degrees(yaw: float) -> float:
    """From north to east [deg], 0 to 360, of a yaw from x to y [rad]."""
    return math.fmod(450.0 - math.degrees(math.remainder(yaw, math.tau)), 360.0)
