# SPDX-License-Identifier: BSD-3-Clause
"""What every reader of a cast does: columns by name and unit, and what follows from them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime, timezone

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error, Profile, depth_from_pressure, practical_salinity

Floats = NDArray[np.float64]

# Quantity → the units that are read, in small letters without blanks, and their factors.
UNITS: dict[str, dict[str, float]] = {
    "depth": {"m": 1.0, "meter": 1.0, "meters": 1.0, "metre": 1.0},
    "temperature": dict.fromkeys(("c", "°c", "degc", "deg c", "celsius", "m-0c"), 1.0),
    "salinity": dict.fromkeys(("psu", "ppt", "pss-78", "practical salinity scale", ""), 1.0),
    "sound_speed": {"m/s": 1.0, "m/sec": 1.0, "meters per second": 1.0},
    "pressure": {"dbar": 1.0, "db": 1.0, "decibar": 1.0, "bar": 10.0},
    "conductivity": {"s/m": 1.0, "ms/cm": 0.1, "microsiemens per centimeter": 1e-4, "us/cm": 1e-4},
}


@dataclass
class Cast:
    """Columns as a file gives them, in the file's order, and what it says of itself.

    Attributes
    ----------
    columns : dict of arrays
        Quantity of `UNITS` → (K,) in SI units (pressure in dbar).
    position : (latitude, longitude) or None
        [deg]
    time : float or None
        Since 1970-01-01 UTC [s].
    instrument : str
    notes : list of str
        What was derived, or assumed.
    """

    columns: dict[str, Floats] = field(default_factory=dict)
    position: tuple[float, float] | None = None
    time: float | None = None
    instrument: str = ""
    notes: list[str] = field(default_factory=list)

    def add(self, quantity: str, values: Floats, unit: str) -> None:
        """A column in its own unit; a second one of a quantity does not count."""
        factors = UNITS[quantity]
        known = unit.strip().lower()
        if known not in factors:
            raise Error(
                f"{quantity}: expected a unit among {', '.join(filter(None, factors))}, "
                f"got {unit.strip() or 'none'}"
            )
        self.columns.setdefault(quantity, values * factors[known])


def table_of(
    lines: Sequence[tuple[int, str]], width: int, separator: str | None = None
) -> list[list[str]]:
    """Cells of numbered lines; a row of another width is an error that names its line."""
    rows = []
    for number, line in lines:
        cells = [cell.strip() for cell in line.split(separator)]
        if len(cells) != width:
            raise Error(f"line {number}: expected {width} values, got {len(cells)}")
        rows.append(cells)
    if not rows:
        raise Error("expected rows of a cast, got none")
    return rows


def column_of(rows: Sequence[Sequence[str]], place: int, first_line: int = 1) -> Floats:
    """A column of numbers; an empty cell is NaN."""
    cells = [row[place] for row in rows]
    try:
        return np.array([cell or "nan" for cell in cells], dtype=float)
    except ValueError:
        bad = next(cell for cell in cells if not _is_number(cell))
        raise Error(f"row {cells.index(bad) + 1}: expected a number, got {bad[:40]!r}") from None


def _is_number(cell: str) -> bool:
    try:
        float(cell or "nan")
    except ValueError:
        return False
    return True


def finish(cast: Cast, source: str) -> Profile:
    """The profile of a cast: depth from pressure, salinity from conductivity where they miss."""
    columns = cast.columns
    if "sound_speed" in columns:  # an instrument in air gives 0
        speed = columns["sound_speed"]
        columns["sound_speed"] = np.where(speed > 0.0, speed, np.nan)
    if "depth" not in columns:
        if "pressure" not in columns:
            raise Error("expected a column of depths or pressures, got neither")
        columns["depth"] = _depth(cast, columns["pressure"])
    if "salinity" not in columns and {"conductivity", "temperature"} <= columns.keys():
        pressure = columns.get("pressure", columns["depth"])
        columns["salinity"] = np.asarray(
            practical_salinity(columns["conductivity"], columns["temperature"], pressure)
        )
        cast.notes.append("salinity from conductivity (PSS-78)")
    if not {"temperature", "sound_speed"} & columns.keys():
        raise Error("expected a column of temperatures or sound speeds, got neither")
    kept = {name: columns[name] for name in columns if name != "conductivity"}
    return Profile(
        kept.pop("depth"),
        **kept,
        position=cast.position,
        time=cast.time,
        instrument=cast.instrument,
        source="; ".join([source, *cast.notes]),
    )


def _depth(cast: Cast, pressure: Floats) -> Floats:
    known = np.isfinite(pressure)
    depth = np.full(len(pressure), np.nan)
    if cast.position is None:
        depth[known] = depth_from_pressure(pressure[known])
        cast.notes.append("depth from pressure (TEOS-10, the latitude is not known)")
    else:
        depth[known] = depth_from_pressure(pressure[known], cast.position[0])
        cast.notes.append("depth from pressure (TEOS-10)")
    return depth


def utc(text: str, formats: Iterable[str]) -> float | None:
    """Seconds since 1970 of the first format that fits; None where none does."""
    for one in formats:
        try:
            return datetime.strptime(text.strip(), one).replace(tzinfo=timezone.utc).timestamp()
        except ValueError:
            continue
    return None


def position_of(latitude: str | None, longitude: str | None) -> tuple[float, float] | None:
    """Two texts in degrees as a position; None where one is missing, or both are 0 (not set)."""
    try:
        place = (float(latitude or ""), float(longitude or ""))
    except ValueError:
        return None
    usable = math.isfinite(place[0]) and math.isfinite(place[1]) and place != (0.0, 0.0)
    return place if usable and abs(place[0]) <= 90.0 and -180.0 <= place[1] <= 360.0 else None


def settings(lines: Iterable[str], separator: str = "=") -> Mapping[str, str]:
    """``key=value`` lines by their keys; the last of several counts, empty ones do not."""
    found: dict[str, str] = {}
    for line in lines:
        key, sign, value = line.partition(separator)
        if sign and value.strip():
            found[key.strip()] = value.strip()
    return found
