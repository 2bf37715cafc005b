# SPDX-License-Identifier: BSD-3-Clause
"""Casts in sections under titles in brackets: AML's two formats and Valeport's."""

from __future__ import annotations

import re
from collections.abc import Sequence

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

_AML_NAMES = {
    "Cond": "conductivity",
    "TempCT": "temperature",
    "Temp": "temperature",
    "SV": "sound_speed",
    "CalcSV": "sound_speed",
    "Pressure": "pressure",
    "Salinity": "salinity",
    "Depth": "depth",
}
_VALEPORT_NAMES = {
    "Depth": "depth",
    "Sound Velocity": "sound_speed",
    "Pressure": "pressure",
    "Temperature": "temperature",
    "Salinity": "salinity",
    "Conductivity": "conductivity",
}
# What the sensors of a Base.X or Minos.X write, by the last word of their name.
_XCHANGE = {
    "SV.X": [("sound_speed", "m/s")],
    "P.X": [("pressure", "dbar")],
    "T.X": [("temperature", "c")],
    "C.X": [("conductivity", "ms/cm")],
    "CT.X": [("conductivity", "ms/cm"), ("temperature", "c")],
}
_TIMES = ("%Y-%m-%d %H:%M:%S", "%Y-%m-%d %H:%M:%S.%f")


def _section(lines: Sequence[str], title: str) -> list[tuple[int, str]]:
    """Numbered lines of a section that are not empty."""
    wanted = f"[{title}]"
    found: list[tuple[int, str]] = []
    inside = False
    for number, line in enumerate(lines, 1):
        text = line.strip()
        if text.startswith("["):
            inside = text.lower() == wanted.lower()
        elif inside and text:
            found.append((number, line.rstrip("\r\n")))
    return found


def read_aml(text: str, source: str) -> Profile:
    """AML-3 and AML-6 (``.aml``): columns and units are listed before the rows."""
    lines = text.splitlines()
    said = settings(lines)
    columns = settings([line for _, line in _section(lines, "MeasurementMetadata")])
    if "Columns" not in columns or "Units" not in columns:
        raise Error("[MeasurementMetadata]: expected Columns= and Units=, got neither or one")
    names, units = columns["Columns"].split(","), columns["Units"].split(",")
    if len(names) != len(units):
        raise Error(f"expected a unit a column, got {len(units)} of {len(names)}")
    rows = table_of(_section(lines, "MeasurementData"), len(names), ",")
    cast = Cast(instrument=f"AML {said.get('Model', '')} {said.get('SerialNumber', '')}".strip())
    cast.position = position_of(said.get("GPSLatitude"), said.get("GPSLongitude")) or position_of(
        said.get("Latitude"), said.get("Longitude")
    )
    header = settings([line for _, line in _section(lines, "Header")])
    cast.time = utc(f"{header.get('Date')} {header.get('Time')}", _TIMES)
    for place, (name, unit) in enumerate(zip(names, units, strict=True)):
        if name.strip() in _AML_NAMES:
            quantity = _AML_NAMES[name.strip()]
            # The measured sound speed counts before the one that is computed from the others.
            if name.strip() == "CalcSV" and "SV" in names:
                continue
            cast.add(quantity, column_of(rows, place), unit)
    return finish(cast, source)


def read_aml_csv(text: str, source: str) -> Profile:
    """AML Base.X2 (``[cast header]`` … ``[data]``): the sensors in its slots say the columns."""
    lines = text.splitlines()
    said = settings(lines)
    quantities: list[tuple[str, str]] = []
    for name in re.findall(r"^SensorName=.*\.Xchange (\S+)", text, re.M):
        if name not in _XCHANGE:
            raise Error(f"sensor {name}: expected one of {', '.join(_XCHANGE)}")
        quantities += _XCHANGE[name]
    if not quantities:
        raise Error("expected sensors in slots (SensorName=), got none")
    width = 2 + len(quantities) + (said.get("DisplayBattery") == "yes")
    rows = table_of(_section(lines, "data"), width, ",")
    cast = Cast(instrument=f"AML {said.get('Type', '')} {said.get('SN', '')}".strip())
    cast.position = position_of(said.get("Latitude"), said.get("Longitude"))
    cast.time = utc(f"{rows[0][0]} {rows[0][1]}", _TIMES)
    for place, (quantity, unit) in enumerate(quantities, 2):
        cast.add(quantity, column_of(rows, place), unit)
    return finish(cast, source)


def read_valeport(text: str, source: str) -> Profile:
    """Valeport DataLog X2 (``.vpd``, ``.vp2``): tabs, a line of names and one of units."""
    lines = text.splitlines()
    said = settings(lines)
    section = _section(lines, "Data")
    if len(section) < 3:
        raise Error("[Data]: expected names, units and rows, got fewer lines")
    names = [name.strip() for name in section[0][1].split("\t")]
    units = section[1][1].split("\t")
    rows = table_of(section[2:], len(names), "\t")
    cast = Cast(instrument=f"Valeport {said.get('Instrument', '')} {said.get('Serial_Number', '')}")
    cast.position = position_of(said.get("Latitude"), said.get("Longitude"))
    cast.time = utc(
        said.get("Time_Stamp", rows[0][0]), ("%Y/%m/%d %H:%M:%S.%f", "%Y/%m/%d %H:%M:%S")
    )
    for place, name in enumerate(names):
        if name in _VALEPORT_NAMES:
            unit = units[place] if place < len(units) else ""
            cast.add(_VALEPORT_NAMES[name], column_of(rows, place), unit)
    return finish(cast, source)
