# SPDX-License-Identifier: BSD-3-Clause
"""Units of reference systems: one rule for all formats.

Clouds and meshes are in metres, and so is the reference system that they carry. Positions in
degrees are refused. Where a file's system is in another length, horizontally or vertically, `scale`
must say what becomes of it, and the system is not kept: the coordinates are no longer in it.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import NoReturn

from bathyal._core import Error
from bathyal.errors import argument_error
from bathyal.io.formats.epsg_units import DEGREES, HORIZONTAL, METRES, VERTICAL
from bathyal.io.formats.wkt import Node, parse_wkt

_WRAPPERS = {"COMPD_CS", "COMPOUNDCRS", "BOUNDCRS", "SOURCECRS", "COORDINATEMETADATA"}
_FLAT = {"PROJCS", "PROJCRS", "PROJECTEDCRS", "DERIVEDPROJCRS", "LOCAL_CS", "ENGCRS",
         "ENGINEERINGCRS"}  # fmt: skip
_UPRIGHT = {"VERT_CS", "VERTCS", "VERTCRS", "VERTICALCRS"}
_ROUND = {"GEOGCS", "GEOGCRS", "GEODCRS", "GEOGRAPHICCRS", "GEODETICCRS", "GEOCCS"}
_KEYWORD = re.compile(
    rf"\s*({'|'.join(sorted(_WRAPPERS | _FLAT | _UPRIGHT | _ROUND))})\s*[\[(]", re.I
)
_EPSG = re.compile(
    r"\s*(?:urn:ogc:def:crs:)?EPSG:(?:[\d.]*:)?(\d{1,9})(?:\+(?:EPSG:)?(\d{1,9}))?\s*", re.I
)
_PROJ_UNITS = {
    "m": 1.0, "km": 1e3, "cm": 0.01, "mm": 1e-3, "ft": 0.3048, "us-ft": 1200 / 3937, "yd": 0.9144,
    "fath": 1.8288,
}  # fmt: skip
_SAME = 1e-9  # of a metre: what texts round off


@dataclass(frozen=True)
class Unit:
    """A unit's name and its length [m], which is NaN where it is not known."""

    name: str
    metres: float

    @property
    def is_metre(self) -> bool:
        return abs(self.metres - 1.0) <= _SAME


@dataclass(frozen=True)
class Units:
    """Of positions and of heights; None where the reference system does not say them."""

    horizontal: Unit | None = None
    vertical: Unit | None = None

    @property
    def metric(self) -> bool:
        return all(unit is None or unit.is_metre for unit in (self.horizontal, self.vertical))


def units_of(crs: str, vertical_datum: str = "") -> Units:
    """The units of a reference system: WKT, ``EPSG:…`` or a PROJ string; of other texts none.

    `vertical_datum` is looked at where `crs` says nothing of heights.

    Raises
    ------
    Error
        Where its positions are longitude and latitude.
    """
    units = _units(crs)
    if units.vertical is None and vertical_datum:
        units = Units(units.horizontal, _units(vertical_datum).vertical)
    return units


def check_scale(units: Units, scale: object) -> None:
    """Raise `ValueError` where a reference system is not in metres and no `scale` is given."""
    if units.metric or scale is not None:
        return
    flat, upright = units.horizontal, units.vertical
    named = [f"positions in {flat.name}"] if flat is not None else []
    named += [f"heights in {upright.name}"] if upright is not None else []
    known = [math.nan if unit is None else unit.metres for unit in (flat, flat, upright)]
    if flat is None:
        known[:2] = [1.0, 1.0]
    hint = ""
    if not any(map(math.isnan, known)):
        hint = f", such as ({', '.join(f'{metres:.12g}' for metres in known)}) for x, y and z"
    raise argument_error(
        "scale",
        f"metres in one unit of the file, for its reference system has {' and '.join(named)}{hint}",
        scale,
    )


def check_metric(name: str, crs: str) -> None:
    """Raise `ValueError` where a system that is to be attached to metres is not in metres."""
    try:
        units = units_of(crs)
    except Error as error:
        raise argument_error(name, "a reference system in metres", f"{crs[:60]!r}") from error
    for unit in (units.horizontal, units.vertical):
        if unit is not None and not unit.is_metre:
            raise argument_error(name, "a reference system in metres", f"one in {unit.name}")


def refuse_degrees(crs: str) -> NoReturn:
    """Degrees are no metres, and which projection suits is the surveyor's to say."""
    raise Error(
        f"its positions are longitude and latitude ({crs[:60]}…): project them first, "
        "for instance to UTM"
    )


def vertical_datum_of_wkt(crs: str) -> str:
    """The name of the vertical part of a compound reference system, "" where it has none."""
    found = re.search(r'(?:VERT_CS|VERTCS|VERTCRS|VERTICALCRS)\s*\[\s*"([^"]*)"', crs, re.I)
    return found[1] if found else ""


def _units(crs: str) -> Units:
    if (code := _EPSG.fullmatch(crs)) is not None:
        return _units_of_codes(crs, [int(number) for number in code.groups() if number])
    if "+proj=" in crs:
        return _units_of_proj(crs)
    keyword = _KEYWORD.match(crs)
    if keyword is None:
        return Units()
    nodes = parse_wkt(crs)
    if nodes is None:
        if keyword[1].upper() in _ROUND:
            refuse_degrees(crs)
        return Units(Unit("units that are not readable (broken WKT)", math.nan))
    horizontal: Unit | None = None
    vertical: Unit | None = None
    for node in _systems(nodes):
        if node.keyword in _ROUND:
            refuse_degrees(crs)
        units = _units_of_node(node)
        if node.keyword in _FLAT:
            horizontal = horizontal or next(iter(units), None)
            units = units[2:]
        vertical = vertical or next(iter(units), None)
    return Units(horizontal, vertical)


def _systems(nodes: Iterable[Node]) -> Iterator[Node]:
    """The single systems that a text is made of."""
    for node in nodes:
        if node.keyword in _WRAPPERS:
            yield from _systems(node.children)
        elif node.keyword in _FLAT | _UPRIGHT | _ROUND:
            yield node


def _units_of_node(node: Node) -> list[Unit]:
    """One unit an axis: WKT 1 and some of WKT 2 name one for all, others name them in the axes.

    Where there is none, those of the system's EPSG code.
    """
    axes = [unit for axis in node.named("AXIS") for unit in axis.named("UNIT", "LENGTHUNIT")]
    shared = list(node.named("UNIT", "LENGTHUNIT"))
    if shared and not axes:
        sizes = [size for system in node.named("CS") for size in system.values[1:2]]
        axes = shared[:1] * (3 if sizes == ["3"] else 2 if node.keyword in _FLAT else 1)
    if axes:
        return [_unit(axis) for axis in axes]
    codes = [" ".join(name.values[:2]) for name in node.named("AUTHORITY", "ID")]
    code = re.fullmatch(r"EPSG (\d{1,9})", codes[0], re.I) if codes else None
    if code is None:
        return []
    units = _units_of_codes(codes[0], [int(code[1])])
    one = units.horizontal if node.keyword in _FLAT else units.vertical
    return [one] if one is not None else []


def _unit(node: Node) -> Unit:
    name, factor = [*node.values, "", ""][:2]
    return Unit(name or "a unit without a name", length(factor))


def length(text: str) -> float:
    """Metres from text; NaN for what is no length."""
    try:
        metres = float(text)
    except ValueError:
        return math.nan
    return metres if 0 < metres < math.inf else math.nan


def _units_of_codes(crs: str, codes: list[int]) -> Units:
    if any(_listed(code, DEGREES) for code in codes):
        refuse_degrees(crs)
    return Units(_unit_in(HORIZONTAL, codes), _unit_in(VERTICAL, codes))


def _unit_in(table: Mapping[str, str], codes: list[int]) -> Unit | None:
    found = (name for name, runs in table.items() if any(_listed(code, runs) for code in codes))
    return next((Unit(name, METRES[name]) for name in found), None)


def _listed(code: int, runs: str) -> bool:
    """Whether a code is in runs as ``2155 2225-2250``."""
    bounds = (run.partition("-") for run in runs.split())
    return any(int(first) <= code <= int(last or first) for first, _, last in bounds)


def _units_of_proj(crs: str) -> Units:
    words = dict(word.partition("=")[::2] for word in crs.replace("+", " ").split())
    if words.get("proj") in ("longlat", "latlong", "lonlat", "latlon", "geocent"):
        refuse_degrees(crs)
    found: list[Unit | None] = []
    for size, name in (("to_meter", "units"), ("vto_meter", "vunits")):
        if size in words:
            found.append(Unit(f"{words[size]} m", length(words[size])))
        elif name in words:
            found.append(Unit(words[name], _PROJ_UNITS.get(words[name], math.nan)))
        else:
            found.append(None)
    return Units(*found)
