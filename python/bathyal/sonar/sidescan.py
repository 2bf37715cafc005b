# SPDX-License-Identifier: BSD-3-Clause
"""What is made of a side-scan's rows: the bottom's first return, rows on the ground, a mosaic."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bathyal._core import sidescan_bottom, sidescan_ground, sidescan_mosaic
from bathyal.errors import argument_error
from bathyal.io.files import PathLike
from bathyal.sonar.navigation import Floats
from bathyal.sonar.tracks import places_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from bathyal.sonar.record import SonarRecord

_NEAREST_PART = 0.02  # of the range: the transmission is over by then


@dataclass(frozen=True)
class BottomTrack:
    """First returns of the bottom.

    Attributes
    ----------
    range
        (P, beams) slant range at which the first return begins [m]; NaN where none was found.
    method
        By which they were found.
    """

    range: Floats
    method: str

    @property
    def altitude(self) -> Floats:
        """(P,) the nearer of port and starboard [m]: the height over a level bottom where the beams
        reach straight down.
        """
        nearest: Floats = np.fmin.reduce(self.range, axis=1)
        return nearest


def filled(ranges: Floats) -> Floats:
    """(P, beams) first returns, those that were not found interpolated over the pings of their
    beam; a beam without any stays NaN."""
    made = ranges.copy()
    rows = np.arange(len(made))
    for column in made.T:
        known = np.isfinite(column)
        if known.any():
            column[~known] = np.interp(rows[~known], rows[known], column[known])
    return made


@dataclass(frozen=True)
class GroundRows:
    """Rows of a side-scan laid on a level bottom.

    Attributes
    ----------
    intensity
        (P, beams, bins) mean power of what came from each bin, near to far; NaN where nothing is
        known.
    range
        (bins,) ground range of their middles [m]
    distance
        (P,) along the track [m]
    beam_names
        Of the rows.
    title
        Of the picture.
    """

    intensity: NDArray[np.float32]
    range: Floats
    distance: Floats
    beam_names: tuple[str, ...]
    title: str = ""

    def plot(self) -> Figure:
        """The waterfall, metres of ground on its axis."""
        from bathyal.view.waterfall import waterfall_figure

        return waterfall_figure(
            self.intensity, self.range, self.distance, title=self.title, axis="ground range [m]"
        )


@dataclass(frozen=True)
class Mosaic:
    """A side-scan's image of the bottom from above, north up.

    Attributes
    ----------
    intensity
        (rows, columns) mean power, north to south; NaN where nothing was heard from.
    west, north
        Outer corner of the first cell [m]
    spacing
        Of the cells [m]
    crs
        Reference system of the coordinates, as "EPSG:32619"; None in a world's own.
    left_out
        Pings without a position or heading, or of a record without any first return.
    """

    intensity: NDArray[np.float32]
    west: float
    north: float
    spacing: float
    crs: str | None = None
    left_out: int = 0

    @property
    def x(self) -> Floats:
        """(columns,) of the cells' middles, east [m]"""
        return self.west + self.spacing * (np.arange(self.intensity.shape[1], dtype=float) + 0.5)

    @property
    def y(self) -> Floats:
        """(rows,) of the cells' middles, north [m], descending"""
        return self.north - self.spacing * (np.arange(self.intensity.shape[0], dtype=float) + 0.5)

    def plot(self) -> Figure:
        """The image with metres on its axes."""
        from bathyal.view.mosaic import mosaic_figure

        return mosaic_figure(self.intensity, self.x, self.y, crs=self.crs)

    def write(self, path: PathLike) -> None:
        """Writes a GeoTIFF: one band of float32, the intensity in decibel; cells without any are
        NaN, its mark of no data.

        Raises
        ------
        ValueError
            For a name that does not end in `.tif` or `.tiff`.
        bathyal.Error
            Where rasterio is not installed.
        """
        from bathyal.io.formats.geotiff_image import write_geotiff

        if Path(path).suffix.lower() not in (".tif", ".tiff"):
            raise argument_error("path", "a name that ends in .tif or .tiff", str(path))
        with np.errstate(divide="ignore"):
            level = 10.0 * np.log10(self.intensity)
        level[~np.isfinite(level)] = np.nan
        write_geotiff(
            path, level, west=self.west, north=self.north, spacing=self.spacing, crs=self.crs,
            description="backscatter intensity [dB]",
        )  # fmt: skip


def check_sidescan(record: SonarRecord) -> None:
    """Refuses a record that is no side-scan's, or an empty one, with a ValueError."""
    if not set(record.beam_names) <= {"port", "starboard"} or len(record.time) == 0:
        raise argument_error("record", "pings of a side-scan", f"beams {record.beam_names}")


def track_bottom(
    record: SonarRecord, *, method: str, nearest: float | None, threshold_db: float
) -> BottomTrack:
    """`SonarRecord.track_bottom`."""
    check_sidescan(record)
    spacing = 2.0 * float(record.range[0])
    if nearest is None:
        nearest = _NEAREST_PART * spacing * len(record.range)
    elif not nearest >= 0.0:
        raise argument_error("nearest", "a range of 0 m or more", nearest)
    first = min(int(np.ceil(nearest / spacing)), len(record.range))
    samples = sidescan_bottom(
        np.asarray(record.intensity), method=method, first_sample=first, threshold_db=threshold_db
    )
    return BottomTrack(np.where(samples < 0, np.nan, samples * spacing), method)


def to_ground(record: SonarRecord, bottom: BottomTrack, spacing: float | None) -> GroundRows:
    """`SonarRecord.to_ground`."""
    check_sidescan(record)
    length = 2.0 * float(record.range[0])
    step = length if spacing is None else spacing
    power = sidescan_ground(
        np.asarray(record.intensity), sample_length=length, first=filled(bottom.range), spacing=step
    )
    middles = (np.arange(power.shape[2]) + 0.5) * np.float64(step)
    return GroundRows(
        power, middles, record.distance(), record.beam_names,
        record.sonar.name if record.sonar else "",
    )  # fmt: skip


def mosaic_of(record: SonarRecord, bottom: BottomTrack, spacing: float, gap: float) -> Mosaic:
    """`SonarRecord.mosaic`."""
    ground = to_ground(record, bottom, spacing)
    place, crs = places_of(record.navigation)
    lift = np.nan_to_num(record.navigation.pitch)
    nearest = np.fmin.reduce(filled(bottom.range), axis=1)
    ahead = nearest * np.sin(lift)  # with the bow down the fan meets the bottom astern
    place = place + np.column_stack(
        [ahead * np.sin(place[:, 2]), ahead * np.cos(place[:, 2]), np.zeros(len(ahead))]
    )
    power, west, north, left_out = sidescan_mosaic(
        ground.intensity, bin_length=spacing, sides=list(ground.beam_names), place=place,
        spacing=spacing, gap=gap,
    )  # fmt: skip
    return Mosaic(power, west, north, spacing, crs, left_out)
