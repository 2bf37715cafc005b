# SPDX-License-Identifier: BSD-3-Clause
"""What a sonar recorded, simulated or from a file."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Sonar, Trajectory
from bathyal.io.formats.zarr_arrays import StoredArray
from bathyal.sonar.navigation import Floats, Navigation
from bathyal.sonar.sidescan import (
    BottomTrack,
    GroundRows,
    Mosaic,
    check_sidescan,
    mosaic_of,
    to_ground,
    track_bottom,
)
from bathyal.sonar.statistics import SidescanStatistics, statistics_of
from bathyal.sonar.tracks import reported_trajectory

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


@dataclass(frozen=True, repr=False)
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

    def __repr__(self) -> str:
        pings, beams, samples = self.intensity.shape
        seconds = float(np.ptp(self.time)) if pings else 0.0
        size = f"{pings:,} pings × {beams} beams × {samples:,} samples"
        return f"SonarRecord({size}, {seconds:.1f} s)"

    def distance(self) -> Floats:
        """(P,) along the track [m], by the positions, or by speed and time where there are none."""
        position = np.asarray(self.navigation.position)[:, :2]
        if np.isfinite(position).all() and len(position):
            moved = np.linalg.norm(np.diff(position, axis=0), axis=1)
        else:
            speed = np.nan_to_num(np.asarray(self.navigation.speed))
            moved = np.diff(self.time) * 0.5 * (speed[1:] + speed[:-1])
        return np.concatenate([[0.0], np.cumsum(np.nan_to_num(moved))])[: len(self.time)]

    def plot(self, *, altitude: bool = False, bottom: BottomTrack | None = None) -> Figure:
        """The side-scan's waterfall: pings downwards, port on the left, metres on the axes.

        Parameters
        ----------
        altitude : bool
            Whether the reported altitude is drawn.
        bottom : BottomTrack, optional
            First returns, drawn where they are given.

        Returns
        -------
        matplotlib.figure.Figure

        Raises
        ------
        ValueError
            For a record that is no side-scan's, or an empty one.
        """
        from bathyal.view.waterfall import waterfall_figure

        check_sidescan(self)
        lines = {}
        if altitude:
            reported = np.asarray(self.navigation.altitude)
            lines["reported altitude"] = np.column_stack([reported, reported])
        if bottom is not None:
            lines["first return"] = bottom.range
        return waterfall_figure(
            np.asarray(self.intensity), self.range, self.distance(),
            title=self.sonar.name if self.sonar else "", lines=lines,
        )  # fmt: skip

    def track_bottom(
        self,
        *,
        method: str = "likelihood",
        nearest: float | None = None,
        threshold_db: float = 6.0,
    ) -> BottomTrack:
        """The bottom's first return in each row of a side-scan.

        Parameters
        ----------
        method : str
            "likelihood": where the power changes most likely, compared in windows of 24 samples
            before and 8 after, on the path over the pings that is most likely as a whole and moves
            at most 8 samples from ping to ping. "threshold": where the logarithm of the power,
            averaged over three pings and three samples, exceeds that of the sixty samples before by
            `threshold_db` for eight samples; then a median of five pings.
        nearest : float, optional
            Nothing nearer is taken for the bottom [m]; 2 % of the range unless given.
        threshold_db : float

        Returns
        -------
        BottomTrack

        Raises
        ------
        ValueError
            For a record that is no side-scan's, or an empty one.
        """
        return track_bottom(self, method=method, nearest=nearest, threshold_db=threshold_db)

    def to_ground(
        self, *, bottom: BottomTrack | None = None, spacing: float | None = None
    ) -> GroundRows:
        """Rows with their slant range corrected, the bottom taken as level across the track.

        First returns that were not found are interpolated over the pings.

        Parameters
        ----------
        bottom : BottomTrack, optional
            First returns; found by `track_bottom` unless given.
        spacing : float, optional
            Of the bins on the ground [m]; as of the samples unless given.

        Returns
        -------
        GroundRows

        Raises
        ------
        ValueError
            For a record that is no side-scan's, or an empty one.
        """
        return to_ground(self, bottom or self.track_bottom(), spacing)

    def mosaic(
        self, *, spacing: float = 0.1, bottom: BottomTrack | None = None, gap: float = 1.0
    ) -> Mosaic:
        """The image of the bottom from above.

        Each cell is the mean power of what came from it, of all lines; cells between neighbouring
        pings that nothing came from are interpolated. Longitudes are projected to UTM.

        Parameters
        ----------
        spacing : float
            Of the cells [m].
        bottom : BottomTrack, optional
            First returns; found by `track_bottom` unless given.
        gap : float
            The widest between neighbouring pings that is filled [m].

        Returns
        -------
        Mosaic

        Raises
        ------
        ValueError
            For a record that is no side-scan's, an empty one, or more than 4·10⁸ cells.
        bathyal.Error
            Where no ping has a place, or longitudes are to be projected without rasterio.
        """
        return mosaic_of(self, bottom or self.track_bottom(), spacing, gap)

    def statistics(
        self, *, bottom: BottomTrack | None = None, angle_step: float = np.radians(5.0)
    ) -> SidescanStatistics:
        """What a side-scan's samples say as a whole: to compare a measured record with a simulated
        one.

        Parameters
        ----------
        bottom : BottomTrack, optional
            First returns; found by `track_bottom` unless given.
        angle_step : float
            Of the bins of incidence [rad].

        Returns
        -------
        SidescanStatistics

        Raises
        ------
        ValueError
            For a record that is no side-scan's, an empty one, or a step out of 0 to π/4.
        """
        return statistics_of(self, bottom or self.track_bottom(), angle_step=angle_step)

    def trajectory(self) -> Trajectory:
        """The reported track, to fly a sonar along it again.

        Pings without a place are left out, and those that repeat the report before: where a vehicle
        reports less often than its sonar pings, it moves evenly from report to report.

        Returns
        -------
        Trajectory
            world_from_vehicle at the pings' times; longitudes projected to UTM, z = −depth where
            the positions have no height.

        Raises
        ------
        bathyal.Error
            Where fewer than two pings have position, depth, heading, pitch and roll, or longitudes
            are to be projected without rasterio.
        """
        return reported_trajectory(self.time, self.navigation)

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
