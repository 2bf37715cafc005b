# SPDX-License-Identifier: BSD-3-Clause
"""A record as columns, one row a ping: in memory and on disk they are the same."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Ping, Sonar
from bathyal.io.formats.zarr_arrays import StoredArray
from bathyal.sonar.navigation import Floats, Navigation
from bathyal.sonar.record import RecordTruth, SonarRecord

Columns = Mapping[str, NDArray[Any] | StoredArray]
_MOST_WARNINGS = 20


@dataclass(frozen=True)
class Column:
    """One of a record's."""

    dtype: str
    axes: tuple[str, ...]
    """After that of pings."""
    units: str
    note: str
    fill: float | int = np.nan
    """Of pings that are not there."""
    deflated: bool = False


_SAMPLES = ("beam", "sample")
COLUMNS = {
    "time": Column("<f8", (), "s", "of the ping"),
    "intensity": Column("<f4", _SAMPLES, "1", "received power over transmitted at 1 m"),
    "sound_speed": Column("<f8", (), "m/s", "by which ranges are counted"),
    "clipped": Column("<i4", (), "1", "samples at full scale", -1),
    "warning": Column("|S240", (), "", "of the ping", 0, deflated=True),
    "position": Column("<f8", ("axis",), "m", "reported, in the world"),
    "heading": Column("<f8", (), "rad", "reported, clockwise from y"),
    "pitch": Column("<f8", (), "rad", "reported, bow up"),
    "roll": Column("<f8", (), "rad", "reported, starboard down"),
    "depth": Column("<f8", (), "m", "reported, below the mean surface"),
    "altitude": Column("<f8", (), "m", "reported, above the bottom"),
    "speed": Column("<f8", (), "m/s", "reported, over ground"),
    "latitude": Column("<f8", (), "rad", "reported"),
    "longitude": Column("<f8", (), "rad", "reported"),
    "truth_range": Column("<f8", _SAMPLES, "m", "one-way from the sonar", deflated=True),
    "truth_incidence": Column("<f8", _SAMPLES, "rad", "from the normal", deflated=True),
    "truth_material": Column("<i4", _SAMPLES, "1", "row of the world's", -1, deflated=True),
    "truth_point": Column("<f8", (*_SAMPLES, "axis"), "m", "in the world", deflated=True),
    "truth_pose": Column("<f8", ("row", "column"), "1", "world_from_vehicle"),
}
TRUTH = ("range", "incidence", "material", "point")
REPORTED = ("position", "heading", "pitch", "roll", "depth", "speed")
PLACES = ("latitude", "longitude")
_EXTENTS = {"axis": 3, "row": 4, "column": 4}


def tail_of(column: Column, beams: int, samples: int) -> tuple[int, ...]:
    """Shape of a column's row."""
    extents = {"beam": beams, "sample": samples, **_EXTENTS}
    return tuple(extents[axis] for axis in column.axes)


def names_of_survey(truth: bool) -> list[str]:
    """The columns of a simulated survey."""
    return [
        name for name in COLUMNS if name not in PLACES and (truth or not name.startswith("truth_"))
    ]


def fill_row(rows: Mapping[str, NDArray[Any]], at: int, ping: Ping, pose: Floats) -> None:
    """What a ping brings to a row: all but its time, by which it is there, and what is reported."""
    rows["intensity"][at] = ping.intensity
    rows["sound_speed"][at] = ping.sound_speed
    rows["clipped"][at] = ping.clipped
    texts = [*ping.warnings, *(["dropped out"] if ping.dropped else [])]
    rows["warning"][at] = "; ".join(texts).encode()[:240]
    if "truth_pose" in rows:
        rows["truth_pose"][at] = pose
        for name in TRUTH:
            rows[f"truth_{name}"][at] = getattr(ping.truth, name)


def record_of_columns(
    columns: Columns,
    spacing: float,
    beam_names: tuple[str, ...],
    *,
    sonar: Sonar | None = None,
    start: np.datetime64 | None = None,
    warnings: tuple[str, ...] = (),
) -> SonarRecord:
    """The record; what is long stays as it is, on disk where it lies there."""
    short = {
        name: np.asarray(columns[name])
        for name in ("time", "sound_speed", "altitude", *REPORTED, *PLACES)
        if name in columns
    }
    navigation = Navigation(
        short["time"],
        altitude=short["altitude"],
        **{name: short[name] for name in REPORTED},
        latitude=short.get("latitude"),
        longitude=short.get("longitude"),
    )
    truth = None
    if "truth_pose" in columns:
        truth = RecordTruth(
            **{name: columns[f"truth_{name}"] for name in TRUTH},
            pose=np.asarray(columns["truth_pose"]),
        )
    intensity = columns["intensity"]
    middles = (np.arange(intensity.shape[2], dtype=np.float64) + 0.5) * spacing
    speeds = short["sound_speed"][np.isfinite(short["sound_speed"])]
    return SonarRecord(
        short["time"], intensity, middles, beam_names,
        navigation, truth, sonar, start, (*warnings, *_warnings(columns)),
        float(speeds[-1]) if len(speeds) else 1500.0,
    )  # fmt: skip


def _warnings(columns: Columns) -> list[str]:
    """What pings said, each text once, and how many samples were clipped."""
    if "warning" not in columns:
        return []
    said: dict[str, list[int]] = {}
    for number, text in enumerate(np.asarray(columns["warning"])):
        if text:
            said.setdefault(bytes(text).decode("utf-8", "ignore"), []).append(number)
    found = [
        f"ping {pings[0]}: {text}"
        if len(pings) == 1
        else f"{len(pings):,} pings from {pings[0]} on: {text}"
        for text, pings in list(said.items())[:_MOST_WARNINGS]
    ]
    if len(said) > _MOST_WARNINGS:
        found.append(f"{len(said) - _MOST_WARNINGS:,} more")
    clipped = np.asarray(columns["clipped"])
    if clipped.sum() > 0:
        found.append(
            f"{clipped.sum():,} samples of {np.count_nonzero(clipped):,} pings are at full scale"
        )
    return found


def columns_of_record(record: SonarRecord) -> Columns:
    """The columns of a record, those it has not left out."""
    navigation, truth = record.navigation, record.truth
    columns: dict[str, NDArray[Any] | StoredArray] = {
        "time": record.time,
        "intensity": record.intensity,
        "sound_speed": np.full(len(record), record.sound_speed),
        "altitude": navigation.altitude,
    }
    for name in (*REPORTED, *PLACES):
        if getattr(navigation, name) is not None:
            columns[name] = getattr(navigation, name)
    if truth is not None:
        columns |= {f"truth_{name}": getattr(truth, name) for name in (*TRUTH, "pose")}
    return columns
