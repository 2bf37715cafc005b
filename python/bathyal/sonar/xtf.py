# SPDX-License-Identifier: BSD-3-Clause
"""Records from XTF files, and XTF files of records."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bathyal._core import XtfFile, make_xtf, parse_xtf
from bathyal.errors import argument_error
from bathyal.sonar.navigation import Navigation
from bathyal.sonar.record import SonarRecord

_EPOCH = np.datetime64("1970-01-01T00:00:00.000")


def is_xtf(head: bytes) -> bool:
    """Whether a file may be an XTF by its first bytes."""
    return head[:1] == b"{" and len(head) >= 2 and head[1] in range(0, 10)


def record_of_xtf(data: bytes) -> SonarRecord:
    """The side-scan pings of an XTF file: intensity is the square of the stored amplitude.

    Raises
    ------
    bathyal.Error
        For what is no XTF file, or one without side-scan channels.
    """
    file = parse_xtf(data)
    pings = file.sidescan()
    column = {name: np.asarray(values) for name, values in pings.column.items()}
    time = column["time"]
    known = time[np.isfinite(time)]
    start = np.floor(known.min()) if len(known) else 0.0
    nowhere = np.full((len(time), 3), np.nan)
    position = np.column_stack([column["x"], column["y"], -column["depth"]])
    navigation = Navigation(
        time - start,
        nowhere if pings.geographic else position,
        column["heading"], column["pitch"], column["roll"], column["depth"], column["altitude"],
        column["speed"],
        column["y"] if pings.geographic else None,
        column["x"] if pings.geographic else None,
    )  # fmt: skip
    samples = pings.amplitude.shape[2]
    reach, lengths = np.asarray(pings.slant_range), _lengths(np.asarray(pings.amplitude))
    range_end = float(np.nanmax(reach)) if np.isfinite(reach).any() else float(samples)
    farthest = lengths[(reach == range_end) & (lengths > 0)]
    usual = _commonest(farthest) if len(farthest) else max(samples, 1)
    step: float = range_end / usual
    centres: NDArray[np.float64] = (np.arange(samples, dtype=np.float64) + 0.5) * step
    speed = column["sound_speed"]
    speed = speed[np.isfinite(speed) & (speed > 0.0)]
    return SonarRecord(
        time - start, np.square(pings.amplitude), centres,
        tuple(pings.beam_names), navigation, None, None,
        _EPOCH + np.timedelta64(round(1000 * start), "ms"), tuple(_warnings(file, reach, lengths)),
        sound_speed=float(np.median(speed)) if len(speed) else 1500.0,
    )  # fmt: skip


def _lengths(amplitude: NDArray[np.float32]) -> NDArray[np.int64]:
    """(pings, beams) samples of each row: what it lacks is NaN at its end."""
    there = ~np.isnan(amplitude[..., ::-1])
    last = np.argmax(there, axis=2) if amplitude.shape[2] else 0
    return np.where(there.any(axis=2), amplitude.shape[2] - last, 0)


def _commonest(lengths: NDArray[np.int64]) -> int:
    values, counts = np.unique(lengths, return_counts=True)
    return int(values[np.argmax(counts)])


def _warnings(file: XtfFile, reach: NDArray[np.float64], lengths: NDArray[np.int64]) -> list[str]:
    found = []
    if file.damaged or file.lost_bytes:
        found.append(f"{file.damaged} damaged packets, {file.lost_bytes} bytes left out")
    if file.other_packets:
        counts = ", ".join(f"{n} of type {kind}" for kind, n in file.other_packets.items())
        found.append(f"packets that are no sonar pings: {counts}")
    known = reach[np.isfinite(reach)]
    if len(known) and np.ptp(known) > 1e-3 * known.max():
        found.append(f"slant range varies from {known.min():g} to {known.max():g} m")
    if lengths.size:
        usual = _commonest(lengths)
        other = np.argwhere(lengths != usual)
        if len(other):
            ping, beam = other[0]
            found.append(
                f"{len(other)} of {lengths.size} rows have other than {usual} samples, "
                f"the first in ping {ping} with {lengths[ping, beam]}"
            )
    return found


def xtf_of_record(record: SonarRecord) -> bytes:
    """An XTF file of a side-scan record, 16 bits a sample.

    Raises
    ------
    ValueError
        For a record that is no side-scan's.
    """
    if not set(record.beam_names) <= {"port", "starboard"}:
        raise argument_error("path", "a format for this sonar: XTF holds side-scan rows", ".xtf")
    nav = record.navigation
    start = record.start if record.start is not None else _EPOCH
    origin = float((start - _EPOCH) / np.timedelta64(1, "s"))
    sound_speed = np.full(len(record.time), record.sound_speed)
    columns: dict[str, ArrayLike] = {
        "time": record.time + origin,
        "x": nav.position[:, 0] if nav.longitude is None else nav.longitude,
        "y": nav.position[:, 1] if nav.latitude is None else nav.latitude,
        "depth": nav.depth, "altitude": nav.altitude, "heading": nav.heading, "pitch": nav.pitch,
        "roll": nav.roll, "speed": nav.speed, "sound_speed": sound_speed,
    }  # fmt: skip
    spacing = 2 * record.range[0]
    file = make_xtf(
        np.sqrt(record.intensity), list(record.beam_names), columns,
        slant_range=spacing * len(record.range),
        frequency=record.sonar.frequency if record.sonar else 0.0,
        geographic=nav.longitude is not None,
        sonar_name=record.sonar.name if record.sonar else "bathyal",
    )  # fmt: skip
    return file.to_bytes()
