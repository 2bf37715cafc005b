# SPDX-License-Identifier: BSD-3-Clause
"""GSF files of multibeam sonars, through gsfu."""

from __future__ import annotations

import contextlib
import io
import os
from collections import Counter
from dataclasses import dataclass
from datetime import datetime
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error, Profile
from bathyal.io.files import PathLike, need, opened, reading
from bathyal.io.formats.geotiff_image import to_utm
from bathyal.io.formats.points.soundings import Soundings

Floats = NDArray[np.float64]

_PING, _PROFILE = 2, 3  # types of records
_IGNORE = 1  # bit of a beam's flags: not a sounding
# what a file writes for a number that it does not know
_NOTHING = {
    "Latitude_deg": 91.0, "Longitude_deg": 181.0, "Heading_deg": 361.0, "Pitch_deg": 99.0,
    "Roll_deg": 99.0, "Heave_m": 99.0, "TideCorrector_m": 99.99, "DepthCorrector_m": 99.99,
}  # fmt: skip
_MOST_BEAMS = 100_000


@dataclass(frozen=True)
class MultibeamPings:
    """Pings of a multibeam sonar, NaN where the file says nothing; shorter pings end in NaN.

    Attributes
    ----------
    time
        (P,) since `start` [s]
    start
        Date and time of the first ping, UTC.
    latitude, longitude
        (P,) WGS 84 [rad]
    heading, pitch, roll
        (P,) clockwise from north, bow up, starboard down [rad]
    heave
        (P,) down [m], as the file has it
    tide, depth_corrector
        (P,) that the depths contain [m]
    depth
        (P, B) below the water level [m]
    across, along
        (P, B) from the ship's reference point, starboard and ahead [m]
    travel_time
        (P, B) there and back [s]
    beam_angle
        (P, B) from the vertical, as the file has it [rad]
    rejected
        (P, B) whether its flags say that it is no sounding, or it has no depth.
    profile
        The file's first profile of sound speed.
    version
        Of the format.
    records
        How many of each type.
    warnings
        What was broken or left out.
    """

    time: Floats
    start: np.datetime64
    latitude: Floats
    longitude: Floats
    heading: Floats
    pitch: Floats
    roll: Floats
    heave: Floats
    tide: Floats
    depth_corrector: Floats
    depth: Floats
    across: Floats
    along: Floats
    travel_time: Floats
    beam_angle: Floats
    rejected: NDArray[np.bool_]
    profile: Profile | None
    version: str
    records: dict[str, int]
    warnings: tuple[str, ...] = ()

    def __len__(self) -> int:
        return len(self.time)


def read_gsf(path: PathLike) -> MultibeamPings:
    """Reads the pings of a GSF file (Generic Sensor Format, Leidos).

    Parameters
    ----------
    path : path

    Returns
    -------
    MultibeamPings
        Of a file that breaks off, all whole records, with a warning.

    Raises
    ------
    OSError
        For a file that cannot be opened.
    bathyal.Error
        For a file of another format, one without pings, or where gsfu is not installed.
    """
    gsfu = need("GSFU.gsfu", "gsfu", "reading GSF", extra="gsf")
    with opened(path):
        pass  # a regular file of an allowed size
    pings: list[dict[str, Any]] = []
    profiles: list[dict[str, Any]] = []
    records: Counter[str] = Counter()
    warnings: list[str] = []
    talk = io.StringIO()  # the library prints what it leaves out
    with reading(path, "GSF"), contextlib.redirect_stdout(talk):
        file = gsfu.gsf(os.fspath(path))
        try:
            for kind, _, record in file.iter_records():
                records[gsfu.RecordType(kind).name.removeprefix("GSF_RECORD_").lower()] += 1
                if kind == _PING:
                    pings.append(record)
                    warnings += [f"ping {len(pings) - 1}: {note}" for note in record["Notes"]]
                elif kind == _PROFILE:
                    profiles.append(record)
        except gsfu.GSFError as error:
            if not pings:
                raise
            warnings.append(f"breaks off: {error}")
        finally:
            file.closeFile()
        warnings += [line.strip(" *!") for line in talk.getvalue().splitlines() if line.strip()]
        if not pings:
            raise Error("it has no pings")
        return _pings_of(pings, profiles, str(file.gsfVersion or ""), records, warnings)


def _pings_of(
    pings: list[dict[str, Any]],
    profiles: list[dict[str, Any]],
    version: str,
    records: Counter[str],
    warnings: list[str],
) -> MultibeamPings:
    times = [datetime.fromisoformat(ping["PingTime"]).replace(tzinfo=None) for ping in pings]  # UTC
    moments = np.array(times, "datetime64[us]")
    beams = max(ping["NumberBeams"] for ping in pings)
    if beams > _MOST_BEAMS:
        raise Error(f"a ping of {beams} beams")

    def column(name: str) -> Floats:
        values = np.array([ping[name] for ping in pings], float)
        values[values == _NOTHING.get(name)] = np.nan
        return values

    def table(name: str) -> Floats:
        values = np.full((len(pings), beams), np.nan)
        for row, ping in zip(values, pings, strict=True):
            given = ping["Beams"].get(name)
            if given is not None:
                row[: min(len(given), beams)] = given[:beams]
        return values

    depth = table("Depth_m")
    flags = np.nan_to_num(table("BeamFlags")).astype(int)
    profile = None
    if profiles:
        first = profiles[0]
        with contextlib.suppress(ValueError):
            profile = Profile(first["Depth_m"], sound_speed=first["SoundSpeed_mPerSec"])
        if profile is None:
            warnings.append("a profile of sound speed that is none")
    return MultibeamPings(
        (moments - moments[0]) / np.timedelta64(1, "s"), moments[0],
        np.radians(column("Latitude_deg")), np.radians(column("Longitude_deg")),
        np.radians(column("Heading_deg")), np.radians(column("Pitch_deg")),
        np.radians(column("Roll_deg")), column("Heave_m"), column("TideCorrector_m"),
        column("DepthCorrector_m"), depth, table("AcrossTrack_m"), table("AlongTrack_m"),
        table("TravelTime_s"), np.radians(table("BeamAngle_deg")),
        (flags & _IGNORE != 0) | ~np.isfinite(depth) | (depth == 0.0), profile,
        version, dict(records), tuple(warnings),
    )  # fmt: skip


def read_gsf_soundings(path: PathLike) -> Soundings:
    """Its soundings in UTM, those that are not rejected, heights negative."""
    pings = read_gsf(path)
    x, y, north, crs = to_utm(np.degrees(pings.longitude), np.degrees(pings.latitude))
    heading = pings.heading + north
    ahead = np.column_stack([np.sin(heading), np.cos(heading)])
    starboard = np.column_stack([np.cos(heading), -np.sin(heading)])
    points = np.stack(
        [
            place[:, None] + pings.along * ahead[:, axis, None]
            + pings.across * starboard[:, axis, None]
            for axis, place in enumerate((x, y))
        ] + [-pings.depth],
        axis=2,
    )  # fmt: skip
    kept = ~pings.rejected & np.isfinite(points).all(axis=2)
    ping, beam = np.nonzero(kept)
    return Soundings(
        points[kept], {"ping": ping.astype(np.int32), "beam": beam.astype(np.int32)}, crs
    )
