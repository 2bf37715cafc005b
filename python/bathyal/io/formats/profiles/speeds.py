# SPDX-License-Identifier: BSD-3-Clause
"""Casts of depth and sound speed under one line, and plain tables: Hypack, Kongsberg, CSV."""

from __future__ import annotations

from pathlib import Path

from bathyal._core import Error, Profile
from bathyal.io.formats.profiles.cast import (
    UNITS,
    Cast,
    column_of,
    finish,
    position_of,
    table_of,
    utc,
)
from bathyal.io.tables import read_table, split_unit

_SYNONYMS = {
    "depth": "depth",
    "temperature": "temperature",
    "temp": "temperature",
    "salinity": "salinity",
    "sal": "salinity",
    "sound_speed": "sound_speed",
    "sound speed": "sound_speed",
    "sound velocity": "sound_speed",
    "speed": "sound_speed",
    "svp": "sound_speed",
    "sv": "sound_speed",
    "c": "sound_speed",
    "pressure": "pressure",
    "conductivity": "conductivity",
}
_DEFAULT_UNIT = {"depth": "m", "temperature": "c", "salinity": "", "sound_speed": "m/s",
                 "pressure": "dbar"}  # fmt: skip


def _pairs(text: str, cast: Cast) -> int:
    """Rows of depth and speed after the first line."""
    lines = [(n, line) for n, line in enumerate(text.splitlines(), 1) if n > 1 and line.strip()]
    rows = table_of(lines, 2)
    cast.add("depth", column_of(rows, 0), "m")
    cast.add("sound_speed", column_of(rows, 1), "m/s")
    return len(rows)


def read_hypack(text: str, source: str) -> Profile:
    """Hypack (``.vel``): ``FTP NEW 3 latitude longitude HH:MM MM/DD/YYYY``, then pairs."""
    words = text.splitlines()[0].split()
    cast = Cast(instrument="Hypack")
    if len(words) >= 7:
        cast.position = position_of(words[3], words[4])
        cast.time = utc(f"{words[6]} {words[5]}", ("%m/%d/%Y %H:%M",))
    _pairs(text, cast)
    return finish(cast, source)


def read_asvp(text: str, source: str) -> Profile:
    """Kongsberg (``.asvp``): ``( SoundVelocity 1.0 … count )``, then pairs."""
    words = text.splitlines()[0].strip("() \r\n").split()
    if len(words) != 12 or not words[-1].isdecimal():
        raise Error(f"line 1: expected twelve words, the last a count, got {len(words)}")
    cast = Cast(instrument="Kongsberg asvp")
    cast.time = utc(words[3], ("%Y%m%d%H%M", "%Y%m%d%H%M%S"))
    cast.position = position_of(words[4], words[5])
    count = _pairs(text, cast)
    if count != int(words[-1]):
        raise Error(f"expected {int(words[-1])} rows as its first line says, got {count}")
    return finish(cast, source)


def read_plain(path: Path, source: str) -> Profile:
    """A table whose header names its columns, or two columns of depth and sound speed."""
    table = read_table(path)
    cast = Cast(instrument="")
    if not table.has_header:
        if len(table.titles) != 2:
            raise Error(
                "expected a format that is known, a header that names columns (depth, temperature, "
                "salinity, sound_speed, pressure), or two columns of depth and sound speed"
            )
        cast.add("depth", column_of(table.cells, 0), "m")
        cast.add("sound_speed", column_of(table.cells, 1), "m/s")
        return finish(cast, source)
    for place, title in enumerate(table.titles):
        name, unit = _split(title)
        if name in _SYNONYMS:
            quantity = _SYNONYMS[name]
            cast.add(
                quantity, column_of(table.cells, place), unit or _DEFAULT_UNIT.get(quantity, "")
            )
    return finish(cast, source)


def _split(title: str) -> tuple[str, str]:
    """Name and unit; ``sound_speed`` is a name of two words, ``depth_m`` has a unit."""
    plain = title.strip().lower()
    if plain in _SYNONYMS:
        return plain, ""
    name, unit = split_unit(plain)
    if not unit and "_" in plain:
        head, _, tail = plain.rpartition("_")
        if head in _SYNONYMS and tail in UNITS[_SYNONYMS[head]]:
            return head, tail
    return name, unit
