# SPDX-License-Identifier: BSD-3-Clause
"""What a sonar recorded, simulated or from a file."""

from __future__ import annotations

import os
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Sonar
from bathyal.sonar.navigation import Floats, Navigation


@dataclass(frozen=True)
class RecordTruth:
    """What each sample came from, as `PingTruth`, and where the vehicle really was."""

    range: Floats
    """(P, beams, samples) [m]"""
    incidence: Floats
    """(P, beams, samples) [rad]"""
    material: NDArray[np.int32]
    """(P, beams, samples) row of the world's materials, −1 where nothing was hit."""
    point: Floats
    """(P, beams, samples, 3) in the world [m]"""
    pose: Floats
    """(P, 4, 4) world_from_vehicle"""


@dataclass(frozen=True)
class SonarRecord:
    """Pings one after another."""

    time: Floats
    """(P,) [s]"""
    intensity: NDArray[np.float32]
    """(P, beams, samples) power, linear; side-scan rows port, starboard, near to far."""
    range: Floats
    """(samples,) slant range of their middles [m]"""
    beam_names: tuple[str, ...]
    """Of the rows."""
    navigation: Navigation
    """What the vehicle reported."""
    truth: RecordTruth | None = None
    """Of a simulated survey, where it was asked for."""
    sonar: Sonar | None = None
    """The description; None of a file that has none."""
    start: np.datetime64 | None = None
    """Date and time of time 0 (UTC), where known."""
    warnings: tuple[str, ...] = field(default=())
    """Of the survey or the reader."""
    sound_speed: float = 1500.0
    """By which ranges were counted [m/s]."""

    def __len__(self) -> int:
        return len(self.time)

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes the record: `.xtf`, a side-scan's rows in 16 bits of amplitude.

        Raises
        ------
        ValueError
            For another suffix, or a sonar that the format does not hold.
        """
        from bathyal.sonar.files import write_sonar

        write_sonar(self, path)
