# SPDX-License-Identifier: BSD-3-Clause
"""Tracks of a vehicle from tables."""

from __future__ import annotations

import csv
import io

import numpy as np

from bathyal._core import Error, Trajectory
from bathyal.errors import argument_error
from bathyal.io.files import PathLike, opened
from bathyal.sonar.navigation import Floats, Navigation

_NEEDED = ("x", "y", "z")
_ANGLES = ("heading_deg", "pitch_deg", "roll_deg")
_MOST_ROWS = 1_000_000


def read_track(path: PathLike, *, speed: float | None = None) -> Trajectory:
    """A track from a table: world_from_vehicle over time.

    Parameters
    ----------
    path : path
        ``.csv`` with a header: x, y, z [m] and any of time [s], heading_deg (clockwise from y),
        pitch_deg (bow up), roll_deg (starboard down). Without headings the bow points to the next
        point.
    speed : float, optional
        [m/s]; where the table has no time.

    Returns
    -------
    Trajectory

    Raises
    ------
    OSError
        Where there is no such file, or it may not be read.
    Error
        For a table without these columns, a value that is no number, fewer than two rows.
    ValueError
        Without time and speed, or with both.
    """
    rows = _rows(path)
    points = np.column_stack([rows[name] for name in _NEEDED])
    if ("time" in rows) == (speed is not None):
        raise argument_error("speed", "a speed where the table has no time", f"{speed}")
    moved = np.linalg.norm(np.diff(points, axis=0), axis=1)
    if speed is None:
        time = rows["time"]
    elif speed > 0 and np.isfinite(speed):
        time = np.concatenate([[0.0], np.cumsum(moved / speed)])
    else:
        raise argument_error("speed", "a finite number above 0", f"{speed}")
    angles = [np.radians(rows.get(name, np.zeros(len(points)))) for name in _ANGLES]
    if "heading_deg" not in rows:
        angles[0] = _headings(points)
    return Trajectory(time, poses_of(points, *angles))


def poses_of(position: Floats, heading: Floats, pitch: Floats, roll: Floats) -> Floats:
    """(K, 4, 4) world_from_vehicle of positions [m] and a mariner's angles [rad]: heading clockwise
    from y, pitch with the bow up, roll with starboard down."""
    yaw = np.pi / 2 - heading
    cy, sy = np.cos(yaw), np.sin(yaw)
    cp, sp = np.cos(-pitch), np.sin(-pitch)
    cr, sr = np.cos(roll), np.sin(roll)
    pose = np.zeros((len(position), 4, 4))
    pose[:, 0, :3] = np.column_stack([cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr])
    pose[:, 1, :3] = np.column_stack([sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr])
    pose[:, 2, :3] = np.column_stack([-sp, cp * sr, cp * cr])
    pose[:, :3, 3] = position
    pose[:, 3, 3] = 1.0
    return pose


def places_of(navigation: Navigation) -> tuple[Floats, str | None]:
    """(P, 3) x, y [m] and the heading clockwise from grid north [rad], and the reference system; in
    UTM where there are longitudes.

    Raises
    ------
    bathyal.Error
        Where longitudes are to be projected and rasterio is not installed.
    """
    heading = np.asarray(navigation.heading, float)
    if navigation.longitude is None or navigation.latitude is None:
        return np.column_stack([np.asarray(navigation.position)[:, :2], heading]), None
    from bathyal.io.formats.geotiff_image import to_utm

    x, y, north, crs = to_utm(np.degrees(navigation.longitude), np.degrees(navigation.latitude))
    return np.column_stack([x, y, heading + north]), crs


def reported_trajectory(time: Floats, navigation: Navigation) -> Trajectory:
    """`SonarRecord.trajectory`."""
    place, _ = places_of(navigation)
    height = np.asarray(navigation.position, float)[:, 2]
    height = np.where(np.isfinite(height), height, -np.asarray(navigation.depth, float))
    parts = np.column_stack([time, place, height, navigation.pitch, navigation.roll])
    known = np.isfinite(parts).all(axis=1)
    known[1:] &= np.diff(np.fmax.accumulate(time)) > 0.0  # the clock did not run
    if known.sum() < 2:
        raise Error(f"expected two pings or more with a place and a pose, got {known.sum()}")
    parts = parts[known]
    new = np.ones(len(parts), bool)  # a vehicle may report less often than its sonar pings
    new[1:-1] = (np.diff(parts[:-1, 1:], axis=0) != 0.0).any(axis=1)
    parts = parts[new]
    position = np.column_stack([parts[:, 1:3], parts[:, 4]])
    return Trajectory(parts[:, 0], poses_of(position, parts[:, 3], parts[:, 5], parts[:, 6]))


def _headings(points: Floats) -> Floats:
    """To the next point, at the last as before it."""
    ahead = np.diff(points[:, :2], axis=0)
    heading = np.arctan2(ahead[:, 0], ahead[:, 1])
    return np.concatenate([heading, heading[-1:]])


def _rows(path: PathLike) -> dict[str, Floats]:
    with opened(path) as (stream, _):
        text = io.TextIOWrapper(stream, encoding="utf-8", errors="replace", newline="")
        reader = csv.DictReader(text)
        names = [name.strip() for name in reader.fieldnames or []]
        missing = [name for name in _NEEDED if name not in names]
        if missing:
            raise Error(f"{path}: expected the columns x, y, z, without {', '.join(missing)}")
        values: dict[str, list[float]] = {name: [] for name in names}
        for number, row in enumerate(reader, 2):
            if number > _MOST_ROWS:
                raise Error(f"{path}: more than {_MOST_ROWS:,} rows")
            for name, value in zip(names, row.values(), strict=False):
                try:
                    values[name].append(float(value))
                except (TypeError, ValueError):
                    raise Error(f"{path}:{number}: {name}: no number: {value!r:.60}") from None
    if len(values["x"]) < 2:
        raise Error(f"{path}: expected two rows or more, got {len(values['x'])}")
    return {name: np.array(column) for name, column in values.items()}
