# SPDX-License-Identifier: BSD-3-Clause
"""Measured thrusters from tables of text."""

from __future__ import annotations

import csv
import os

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error, ThrusterTable
from bathyal.io.files import PathLike, read_document

KILOGRAM_FORCE = 9.80665  # [N]
COLUMNS = ("voltage", "pwm", "rpm", "power", "force")


def read_thruster_table(
    path: PathLike, *, neutral: float = 1500.0, span: float = 400.0
) -> ThrusterTable:
    """Read bollard tests of a thruster, as Blue Robotics publishes those of the T200.

    Parameters
    ----------
    path : path
        Text with commas and a header, which names the columns Voltage, PWM (µs), RPM, Power (W) and
        Force (kgf, or N where the title says so); others are passed over. UTF-8 or Latin-1. Each
        voltage has the same pulses. Speeds have no sign: it is that of the force, and without one
        that of the pulse.
    neutral, span : float
        The pulse that stops it, and how far from it full command is [µs].

    Returns
    -------
    ThrusterTable

    Raises
    ------
    OSError
        Where there is no such file, or it may not be read.
    Error
        By file and line: for columns that are missing, cells that are no numbers, and voltages that
        do not have the same pulses.
    ValueError
        For a span that is not above 0.
    """
    if not (np.isfinite(span) and span > 0 and np.isfinite(neutral)):
        raise ValueError(f"`span`: expected a finite number above 0, got {span}")
    file = os.fspath(path)
    values = _columns(path)
    order = np.lexsort((values["pwm"], values["voltage"]))
    voltage, pulse = values["voltage"][order], values["pwm"][order]
    voltages, pulses = np.unique(voltage), np.unique(pulse)
    shape = (voltages.size, pulses.size)
    if voltage.size != shape[0] * shape[1] or not np.array_equal(pulse, np.tile(pulses, shape[0])):
        raise Error(f"{file}: expected the same pulses at each voltage, each once, got others")
    thrust = values["force"][order]
    way = np.where(thrust != 0, np.sign(thrust), np.sign(pulse - neutral))
    try:
        return ThrusterTable(
            (pulses - neutral) / span,
            voltages,
            thrust=thrust.reshape(shape),
            power=values["power"][order].reshape(shape),
            speed=(way * np.abs(values["rpm"][order]) / 60.0).reshape(shape),
        )
    except ValueError as error:
        raise Error(f"{file}: {error}") from error


def _columns(path: PathLike) -> dict[str, NDArray[np.float64]]:
    """The numbers of a file by the column's name, forces in newtons."""
    file, raw = os.fspath(path), read_document(path)
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = raw.decode("latin-1")
    rows = [(line, cells) for line, cells in enumerate(csv.reader(text.splitlines()), 1) if cells]
    if len(rows) < 2:
        raise Error(f"{file}: expected a header and rows, got {len(rows)} lines")
    titles = [title.strip().lower() for title in rows[0][1]]
    places: dict[str, int] = {}
    for name in COLUMNS:
        found = [k for k, title in enumerate(titles) if title.startswith(name)]
        if not found:
            raise Error(f"{file}, line {rows[0][0]}: `{name}`: expected a column of that name, "
                        f"got {', '.join(titles)}")  # fmt: skip
        places[name] = found[0]
    numbers = np.empty((len(rows) - 1, len(COLUMNS)))
    for row, (line, cells) in enumerate(rows[1:]):
        for column, name in enumerate(COLUMNS):
            cell = cells[places[name]] if places[name] < len(cells) else ""
            try:
                numbers[row, column] = float(cell)
            except ValueError:
                raise Error(f"{file}, line {line}: `{name}`: expected a number, "
                            f"got {cell or 'nothing'}") from None  # fmt: skip
            if not np.isfinite(numbers[row, column]):
                raise Error(f"{file}, line {line}: `{name}`: expected a finite number, got {cell}")
    values = {name: numbers[:, column] for column, name in enumerate(COLUMNS)}
    if not titles[places["force"]].replace(" ", "").endswith(("(n)", "_n", "[n]")):
        values["force"] = KILOGRAM_FORCE * values["force"]
    return values
