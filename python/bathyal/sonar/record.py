# SPDX-License-Identifier: BSD-3-Clause
"""What a sonar recorded, simulated or from a file."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Sonar
from bathyal.io.formats.zarr_arrays import StoredArray
from bathyal.sonar.navigation import Floats, Navigation

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True)
class RecordTruth:
    """What each sample came from, as `PingTruth`, and where the vehicle really was.

    Attributes
    ----------
    range
        (P, beams, samples) [m]
    incidence
        (P, beams, samples) [rad]
    material
        (P, beams, samples) row of the world's materials, −1 where nothing was hit.
    point
        (P, beams, samples, 3) in the world [m]
    pose
        (P, 4, 4) world_from_vehicle
    """

    range: Floats | StoredArray
    incidence: Floats | StoredArray
    material: NDArray[np.int32] | StoredArray
    point: Floats | StoredArray
    pose: Floats


@dataclass(frozen=True)
class SonarRecord:
    """Pings one after another.

    Attributes
    ----------
    time
        (P,) [s]
    intensity
        (P, beams, samples) power, linear; side-scan rows port, starboard, near to far. Of a survey
        in a folder, read when it is asked for.
    range
        (samples,) slant range of their middles [m]
    beam_names
        Of the rows.
    navigation
        What the vehicle reported.
    truth
        Of a simulated survey, where it was asked for.
    sonar
        The description; None of a file that has none.
    start
        Date and time of time 0 (UTC), where known.
    warnings
        Of the survey or the reader.
    sound_speed
        By which ranges were counted [m/s].
    """

    time: Floats
    intensity: NDArray[np.float32] | StoredArray
    range: Floats
    beam_names: tuple[str, ...]
    navigation: Navigation
    truth: RecordTruth | None = None
    sonar: Sonar | None = None
    start: np.datetime64 | None = None
    warnings: tuple[str, ...] = field(default=())
    sound_speed: float = 1500.0

    def __len__(self) -> int:
        return len(self.time)

    def distance(self) -> Floats:
        """(P,) along the track [m], by the positions, or by speed and time where there are none."""
        position = np.asarray(self.navigation.position)[:, :2]
        if np.isfinite(position).all() and len(position):
            moved = np.linalg.norm(np.diff(position, axis=0), axis=1)
        else:
            speed = np.nan_to_num(np.asarray(self.navigation.speed))
            moved = np.diff(self.time) * 0.5 * (speed[1:] + speed[:-1])
        return np.concatenate([[0.0], np.cumsum(np.nan_to_num(moved))])[: len(self.time)]

    def plot(self, *, altitude: bool = False) -> Figure:
        """The side-scan's waterfall: pings downwards, port on the left, metres on the axes.

        Parameters
        ----------
        altitude : bool
            Whether the reported altitude is drawn.

        Returns
        -------
        matplotlib.figure.Figure

        Raises
        ------
        ValueError
            For a record that is no side-scan's, or an empty one.
        """
        from bathyal.errors import argument_error
        from bathyal.view.waterfall import waterfall_figure

        if not set(self.beam_names) <= {"port", "starboard"} or len(self.time) == 0:
            raise argument_error("record", "pings of a side-scan", f"beams {self.beam_names}")
        return waterfall_figure(
            np.asarray(self.intensity), self.range, self.distance(),
            title=self.sonar.name if self.sonar else "",
            altitude=np.asarray(self.navigation.altitude) if altitude else None,
        )  # fmt: skip

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes the record: `.xtf`, a side-scan's rows in 16 bits of amplitude; `.zarr`, a folder
        with everything.

        Raises
        ------
        ValueError
            For another suffix, a sonar that the format does not hold, or a folder that is there.
        """
        from bathyal.sonar.files import write_sonar

        write_sonar(self, path)
