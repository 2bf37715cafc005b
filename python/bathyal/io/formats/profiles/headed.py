# SPDX-License-Identifier: BSD-3-Clause
"""Casts under a header of comment lines: CastAway, Sea-Bird, Oceanscience, Sippican."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from bathyal._core import Error, Profile
from bathyal.io.formats.profiles.cast import (
    Cast,
    column_of,
    finish,
    position_of,
    settings,
    table_of,
    utc,
)

_CASTAWAY_NAMES = {
    "pressure": "pressure",
    "depth": "depth",
    "temperature": "temperature",
    "conductivity": "conductivity",
    "salinity": "salinity",
    "sound velocity": "sound_speed",
}
# Sea-Bird's short names, without the number of the sensor.
_SEABIRD = (
    (re.compile(r"dep(S|F)?M$"), "depth"),
    (re.compile(r"(pr|prM|prDM|prdM|prSM|ptempM?)$"), "pressure"),
    (re.compile(r"t(v)?\d?\d?(90|68)C?$|t0?90C?$"), "temperature"),
    (re.compile(r"(c\d|cond\d?)(u|m)?S/(m|cm)$"), "conductivity"),
    (re.compile(r"sal\d\d$"), "salinity"),
    (re.compile(r"sv(C|D|W)?M\d?$"), "sound_speed"),
)
_SEABIRD_UNIT = re.compile(r"\[([^\]]*)\]")


def _body(lines: Sequence[str], mark: str) -> list[tuple[int, str]]:
    """Numbered lines that are not empty and do not begin with the mark of a comment."""
    return [
        (number, line)
        for number, line in enumerate(lines, 1)
        if line.strip() and not line.startswith(mark)
    ]


def read_castaway(text: str, source: str) -> Profile:
    """YSI/SonTek CastAway (``.csv``): ``% key,value`` lines, then a header with units."""
    lines = text.splitlines()
    said = settings([line[1:] for line in lines if line.startswith("%")], ",")
    body = _body(lines, "%")
    if not body:
        raise Error("expected a header of columns, got the end of the file")
    titles = [title.strip() for title in body[0][1].split(",")]
    rows = table_of(body[1:], len(titles), ",")
    cast = Cast(instrument=f"CastAway {said.get('Device', '')}")
    cast.position = position_of(said.get("Start latitude"), said.get("Start longitude"))
    cast.time = utc(said.get("Cast time (UTC)", ""), ("%Y-%m-%d %H:%M:%S",))
    for place, title in enumerate(titles):
        match = re.fullmatch(r"(.*?)\s*\((.*)\)", title)
        name = match[1].lower() if match else ""
        if match and name in _CASTAWAY_NAMES:
            cast.add(_CASTAWAY_NAMES[name], column_of(rows, place), match[2])
    return finish(cast, source)


def read_seabird(text: str, source: str) -> Profile:
    """Sea-Bird's converted data (``.cnv``): ``# name i = …`` lines, rows after ``*END*``."""
    lines = text.splitlines()
    end = next((i for i, line in enumerate(lines) if line.strip() == "*END*"), None)
    if end is None:
        raise Error("expected *END* before the rows, got the end of the file")
    head = lines[:end]
    said = settings([line.lstrip("#* ") for line in head])
    names = re.findall(r"^# name (\d+) = (.*?):(.*)$", "\n".join(head), re.M)
    if not names:
        raise Error("expected names of its columns (# name 0 = …), got none")
    body = [(end + 2 + i, line) for i, line in enumerate(lines[end + 1 :]) if line.strip()]
    rows = table_of(body, len(names))
    cast = Cast(
        instrument=lines[0].lstrip("* ").removesuffix(":").removesuffix(" Data File").strip()
    )
    if said.get("nvalues", "").isdecimal() and len(rows) != int(said["nvalues"]):
        cast.notes.append(f"{len(rows)} rows of the {int(said['nvalues'])} that its header says")
    cast.position = position_of(
        _seabird_angle(said.get("NMEA Latitude", "")),
        _seabird_angle(said.get("NMEA Longitude", "")),
    )
    start = said.get("start_time", said.get("System UpLoad Time", "")).split("[")[0]
    cast.time = utc(start, ("%b %d %Y %H:%M:%S",))
    bad = float(said.get("bad_flag", "nan"))
    for place, (_, code, long_name) in enumerate(names):
        for pattern, quantity in _SEABIRD:
            if not pattern.match(code.strip()):
                continue
            unit = _SEABIRD_UNIT.search(long_name)
            values = column_of(rows, place)
            cast.add(
                quantity,
                np.where(values == bad, np.nan, values),
                unit[1].split(",")[-1] if unit else "",
            )
            break
    return finish(cast, source)


def _seabird_angle(text: str) -> str | None:
    """ "43 04.50 N" in degrees."""
    match = re.fullmatch(r"(\d+)\s+([\d.]+)\s*([NSEW])", text.strip())
    if match is None:
        return None
    value = float(match[1]) + float(match[2]) / 60.0
    return str(-value if match[3] in "SW" else value)


def read_oceanscience(text: str, source: str) -> Profile:
    """Oceanscience UnderwayCTD (``.asc``): lines of ``*``, the last names the columns."""
    lines = text.splitlines()
    head = [line[1:] for line in lines if line.startswith("*")]
    titles = re.findall(r"(\S+?)(?:\[([^\]]*)\]|#)", head[-1])
    rows = table_of(_body(lines, "*"), len(titles))
    cast = Cast(instrument="Oceanscience UCTD")
    said = {line.split(" ", 1)[0]: line.split(" ", 1)[-1] for line in head}
    settings_said = settings(head)
    if "SerialNumber" in settings_said:
        cast.instrument += (
            f" {next(v for v in head if v.startswith('SerialNumber=')).split('=')[1]}"
        )
    cast.position = position_of(said.get("Lat"), said.get("Lon"))
    match = re.match(r"\d+ (\d+ \w+ \d+ [\d:]+)", said.get("Cast", ""))
    cast.time = utc(match[1], ("%d %b %Y %H:%M:%S",)) if match else None
    quantities = {"C": "conductivity", "T": "temperature", "P": "pressure", "S": "salinity"}
    for place, (name, unit) in enumerate(titles):
        if name in quantities:
            cast.add(quantities[name], column_of(rows, place), unit)
    return finish(cast, source)


def read_sippican(text: str, source: str) -> Profile:
    """Lockheed Martin Sippican MK21 (``.EDF``): expendable probes."""
    lines = text.splitlines()
    start = next((i for i, line in enumerate(lines) if line.startswith("Depth (")), None)
    if start is None:
        raise Error("expected a line that names its columns (Depth (m) - …), got none")
    said = settings(lines[:start], ":")
    titles = re.findall(r"([A-Z][A-Za-z ]*?) \(([^)]*)\)", lines[start])
    rows = table_of([(n, x) for n, x in enumerate(lines, 1) if n > start + 1 and x.strip()],
                    len(titles))  # fmt: skip
    cast = Cast(instrument=f"Sippican {said.get('Probe Type', '')}".strip())
    cast.position = position_of(
        _minutes(said.get("Latitude", "")), _minutes(said.get("Longitude", ""))
    )
    cast.time = utc(
        f"{said.get('Date of Launch', '')} {said.get('Time of Launch', '')}",
        ("%m/%d/%Y %H:%M:%S",),
    )
    names = {"Depth": "depth", "Temperature": "temperature", "Sound Velocity": "sound_speed",
             "Salinity": "salinity"}  # fmt: skip
    for place, (name, unit) in enumerate(titles):
        if name in names:
            cast.add(names[name], column_of(rows, place), unit)
    assumed = re.search(r"assumed salinity:\s*([\d.]+) ppt", text)
    if assumed and "salinity" not in cast.columns:
        cast.add("salinity", np.full(len(rows), float(assumed[1])), "ppt")
        cast.notes.append(f"salinity {assumed[1]} assumed by the instrument")
    return finish(cast, source)


def _minutes(text: str) -> str | None:
    """ "22 59.62451N" in degrees."""
    match = re.fullmatch(r"(\d+) ([\d.]+)([NSEW])", text.strip())
    if match is None:
        return None
    value = float(match[1]) + float(match[2]) / 60.0
    return str(-value if match[3] in "SW" else value)
