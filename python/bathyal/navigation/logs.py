# SPDX-License-Identifier: BSD-3-Clause
"""Navigation logs of vehicles from tables."""

from __future__ import annotations

import warnings
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error, NavigationTrack, dead_reckon, smooth
from bathyal.errors import argument_error
from bathyal.io.files import PathLike
from bathyal.io.tables import Table, read_table
from bathyal.navigation.local_frame import local_position

Floats = NDArray[np.float64]

_VELOCITY = ("vf", "vl", "vu")
_ACCELERATION = ("af", "al", "au")
_RATE = ("wx", "wy", "wz")
_FASTEST = 20.0  # [m/s]; what a log says beyond it is a mark, not a speed
_SAME = 0.9997  # correlation from which on accelerations are differences of the velocities


class NavigationLogWarning(UserWarning):
    """Parts of a navigation log are no measurements."""


@dataclass(frozen=True)
class NavigationLog:
    """What a vehicle recorded of its motion, one row a time.

    Attributes
    ----------
    time
        (N,) rising [s].
    position
        (N, 2) east and north of the first row that has one [m]; NaN where there is none.
    origin
        Latitude and longitude there [rad].
    attitude
        (N, 3) roll, pitch, yaw [rad]: yaw counterclockwise from east, pitch positive bow down.
    velocity
        (N, 3) of the velocity log: forward, to port, up [m/s]; NaN where the log marks it invalid.
    rate
        (N, 3) of turn [rad/s]; NaN where the table has none.
    acceleration
        (N, 3) forward, to port, up [m/s²]; NaN where the table has none.
    fresh
        (N,) of bool: the velocity is not that of the row before.
    marked
        Rows whose velocity is a mark of an invalid one.
    accelerations_are_differences
        Whether the accelerations are differences of the velocities, and so measure nothing.
    """

    time: Floats
    position: Floats
    origin: tuple[float, float]
    attitude: Floats
    velocity: Floats
    rate: Floats
    acceleration: Floats
    fresh: NDArray[np.bool_]
    marked: int
    accelerations_are_differences: bool

    def dead_reckon(self) -> Floats:
        """Position from yaw and log alone, in the horizontal plane.

        Returns
        -------
        (N, 2) array
            East and north of where it begins [m].

        Raises
        ------
        bathyal.Error
            Where a velocity is marked invalid.
        """
        return np.asarray(dead_reckon(self.time, self.attitude[:, 2], self._level()))[:, :2]

    def smooth(
        self, fix_time: Floats, fix_position: Floats, *, fix_noise: float = 0.1, **options: float
    ) -> NavigationTrack:
        """The track through fixes of the position, by yaw and log: `bathyal.smooth`.

        The log's own positions are not used.

        Parameters
        ----------
        fix_time : (F,) array
            Rising, within the log's times [s].
        fix_position : (F, 2) array
            East and north [m].
        fix_noise : float
            Standard deviation [m].
        **options : float
            As of `bathyal.smooth`.

        Returns
        -------
        NavigationTrack

        Raises
        ------
        ValueError
            As `bathyal.smooth`.
        bathyal.Error
            Where a velocity is marked invalid.
        """
        fixes = np.asarray(fix_position, float)
        if fixes.ndim != 2 or fixes.shape[1] != 2:
            raise argument_error("fix_position", "shape (F, 2)", f"shape {fixes.shape}")
        fixes = np.column_stack([fixes, np.zeros(len(fixes))])
        return smooth(self.time, self.attitude[:, 2], self._level(), fix_time, fixes,
                      fix_noise=fix_noise, **options)  # fmt: skip

    def _level(self) -> Floats:
        """Velocities in the horizontal plane, all of them measured."""
        if self.marked:
            raise Error(f"expected a velocity in every row, got {self.marked} marked invalid of "
                        f"{len(self.time)}")  # fmt: skip
        return np.column_stack([self.velocity[:, :2], np.zeros(len(self.time))])


def read_navigation_log(path: PathLike) -> NavigationLog:
    """A vehicle's log of its motion, as tables of AUV trials have it.

    Parameters
    ----------
    path : path
        ``.csv`` with a header: time [s], lat and lon [deg], roll, pitch, yaw [rad], vf, vl, vu
        (velocity log: forward, to port, up [m/s]) and any of af, al, au [m/s²], wx, wy, wz [rad/s].

    Returns
    -------
    NavigationLog

    Warns
    -----
    NavigationLogWarning
        For velocities that are marks of invalid ones (they are masked), and for accelerations that
        are differences of the velocities.

    Raises
    ------
    OSError
        Where there is no such file, or it may not be read.
    bathyal.Error
        For a table without these columns, a value that is no number, times that do not rise, fewer
        than two rows.
    """
    table = read_table(path)
    time = _column(table, "time")
    if len(time) < 2 or not np.all(np.diff(time) > 0.0):
        raise Error(f"{table.file}: `time`: expected two rows or more whose times rise")
    position, origin = local_position(_column(table, "lat"), _column(table, "lon"))
    velocity = np.column_stack([_column(table, name) for name in _VELOCITY])
    acceleration = _optional(table, _ACCELERATION)
    fresh = np.concatenate([[True], (np.diff(velocity, axis=0) != 0.0).any(axis=1)])
    marked = (np.abs(velocity) > _FASTEST).any(axis=1)
    differences = _are_differences(time, velocity, acceleration)
    velocity[marked] = np.nan
    if marked.any():
        _warn(f"{table.file}: {marked.sum():,} of {len(time):,} velocities are marks of invalid "
              "ones and are masked")  # fmt: skip
    if differences:
        _warn(f"{table.file}: the accelerations are differences of the velocities: they measure "
              "nothing")  # fmt: skip
    return NavigationLog(
        time, position, origin,
        np.column_stack([_column(table, name) for name in ("roll", "pitch", "yaw")]),
        velocity, _optional(table, _RATE), acceleration, fresh, int(marked.sum()), differences,
    )  # fmt: skip


def _column(table: Table, name: str) -> Floats:
    values = table.numbers(name, {}, "")
    if not np.isfinite(values).all():
        row = int(np.flatnonzero(~np.isfinite(values))[0])
        raise Error(f"{table.file}, line {table.lines[row]}: `{name}`: expected a finite number")
    return values


def _optional(table: Table, names: tuple[str, ...]) -> Floats:
    rows = len(table)
    missing = np.full(rows, np.nan)
    return np.column_stack([missing if table.find(n) is None else _column(table, n) for n in names])


def _are_differences(time: Floats, velocity: Floats, acceleration: Floats) -> bool:
    """Of the forward axis, whose speeds change the most."""
    given = acceleration[1:, 0]
    made = np.diff(velocity[:, 0]) / np.diff(time)
    if not np.isfinite(given).all() or np.std(given) == 0.0 or np.std(made) == 0.0:
        return False
    return bool(np.corrcoef(made, given)[0, 1] >= _SAME)


def _warn(text: str) -> None:
    warnings.warn(text, NavigationLogWarning, stacklevel=3)
