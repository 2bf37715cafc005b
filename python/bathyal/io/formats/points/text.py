# SPDX-License-Identifier: BSD-3-Clause
"""Points in columns of text: which column is what, and the comments that say more."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any
from urllib.parse import quote, unquote

import numpy as np

from bathyal import _core
from bathyal._core import Error, PointCloud
from bathyal.errors import argument_error
from bathyal.io.files import PathLike, opened, replacing
from bathyal.io.formats.points.soundings import Soundings, is_metre

Columns = Sequence[int | str] | Mapping[str, int | str]

_HEAD = 1 << 16  # bytes looked at for names and notes
_COMMENT = re.compile(r"\s*(?:#|//|%|!|;)\s*(.*)")
_NOTES = ("crs", "vertical_datum")
_AXES = {
    "x": "x", "easting": "x", "eastings": "x", "east": "x", "e": "x", "utm_x": "x",
    "y": "y", "northing": "y", "northings": "y", "north": "y", "n": "y", "utm_y": "y",
    "z": "z", "elevation": "z", "elev": "z", "height": "z", "altitude": "z",
    "depth": "depth", "water_depth": "depth", "waterdepth": "depth", "sounding": "depth",
    "lon": "lon", "long": "lon", "longitude": "lon",
    "lat": "lat", "latitude": "lat",
}  # fmt: skip


@dataclass
class _Head:
    """What the top of a file says: a name a column, or none, and the notes in its comments."""

    names: list[str] = field(default_factory=list)
    notes: dict[str, str] = field(default_factory=dict)
    grid: bool = False


def read_text(path: PathLike, columns: Columns | None, options: Mapping[str, Any]) -> Soundings:
    """Read columns of numbers, or an ESRI ASCII grid.

    `columns` names x, y, z and what follows as attributes; None finds them by their names, or takes
    the first three where there are no names. `options` go to the reader in the engine.
    """
    head = _head(path, options.get("separator"), options.get("skip_lines", 0))
    if head.grid:
        grid = _core.read_text_table(path, leading=3, **options)
        return Soundings(
            grid.table,
            crs=head.notes.get("crs", ""),
            vertical_datum=head.notes.get("vertical_datum", ""),
        )
    wanted = _chosen(columns, head.names) if columns is not None else _found(head.names, path)
    table = _core.read_text_table(
        path, columns=tuple(wanted.values()), leading=3 if wanted else 0, **options
    )
    if table.table.shape[1] < 3:
        raise Error(
            f"{os.fspath(path)}: expected at least three columns, got {table.table.shape[1]}"
        )
    if wanted:
        names = list(wanted)[3:]
        extra = dict(zip(names, table.extra, strict=True))
        points = table.table
    else:
        extra = {
            f"column_{i}": np.ascontiguousarray(table.table[:, i])
            for i in range(3, table.table.shape[1])
        }
        points = np.ascontiguousarray(table.table[:, :3])
    third = _name_of(list(wanted.values())[2], head.names) if wanted else ""
    units = [_unit(_name_of(column, head.names)) for column in list(wanted.values())[:3]]
    return Soundings(
        points,
        extra,
        head.notes.get("crs", ""),
        head.notes.get("vertical_datum", ""),
        depth=third if _axis(third) == "depth" else "",
        unit=next((unit for unit in units if unit and not is_metre(unit)), ""),
    )


def _head(path: PathLike, separator: str | None, skip_lines: int) -> _Head:
    """Look at the comments and the first line; what cannot be understood is left to the engine."""
    with opened(path) as (stream, _):
        text = stream.read(_HEAD).decode("utf-8-sig", "replace")
    head = _Head()
    comment: list[str] = []
    title: list[str] = []
    for line in text.splitlines()[skip_lines:] if "\0" not in text else []:
        if (found := _COMMENT.fullmatch(line)) is not None:
            words = found[1].split(None, 1)
            if len(words) == 2 and words[0].rstrip(":") in _NOTES:
                head.notes[words[0].rstrip(":")] = words[1].strip()
            comment = _fields(found[1], separator)
            continue
        fields = _fields(line, separator)
        if not any(fields):
            continue
        if fields[0].lower() == "ncols":
            head.grid = True
            break
        if any(map(_is_number, fields)):
            head.names = [unquote(name) for name in _names(title, comment, len(fields))]
            break
        title = fields
    return head


def _names(title: list[str], comment: list[str], count: int) -> list[str]:
    """The last line above the numbers, or a comment that speaks of x and y, if it fits them."""
    if len(title) == count:
        return title
    if len(comment) == count and {"x", "y"} <= {_axis(unquote(name)) for name in comment}:
        return comment
    return []


def _fields(line: str, separator: str | None) -> list[str]:
    if separator is None:
        separator = next((c for c in ";\t," if c in line.strip()), " ")
    parts = line.split() if separator == " " else line.strip("\r\n").split(separator)
    return [part.strip().strip('"').strip() for part in parts]


def _is_number(text: str) -> bool:
    return re.fullmatch(r"[+-]?(\d+[.,]?\d*|[.,]\d+)([eE][+-]?\d+)?|nan|[+-]?inf", text) is not None


def _axis(name: str) -> str:
    """x, y, z, depth, lon, lat, or "" for what is none of them; units and case do not matter."""
    bare = re.sub(r"[\[(].*?[\])]", "", name).strip().lower()
    bare = re.sub(r"_(m|metres?|meters?)$", "", re.sub(r"[\s.-]+", "_", bare))
    return _AXES.get(bare, "")


def _unit(name: str) -> str:
    found = re.search(r"[\[(](.*?)[\])]", name)
    return found[1].strip() if found else ""


def _name_of(column: int | str, names: list[str]) -> str:
    if isinstance(column, str):
        return column
    return names[column] if 0 <= column < len(names) else ""


def _found(names: list[str], path: PathLike) -> dict[str, int | str]:
    """Names of x, y, z and attributes with their columns; empty where the file has no names."""
    if not names:
        return {}
    axes = [_axis(name) for name in names]
    third = "z" if "z" in axes else "depth"
    if "x" not in axes and "y" not in axes and "lon" in axes and "lat" in axes:
        raise Error(
            f"{os.fspath(path)}: its positions are longitude and latitude in degrees: "
            "project them first, for instance to UTM"
        )
    missing = [axis for axis in ("x", "y", third) if axis not in axes]
    if missing:
        raise Error(
            f"{os.fspath(path)}: no column is called {' or '.join(missing)} among "
            f"{', '.join(names)}: say columns="
        )
    found: dict[str, int | str] = {axis: axes.index(axis) for axis in ("x", "y", third)}
    taken = set(found.values())
    for i, name in enumerate(names):
        if i not in taken:
            found[name if name and name not in found else f"column_{i}"] = i
    return found


def _chosen(columns: Columns, names: list[str]) -> dict[str, int | str]:
    """The columns that the caller names, as name → column, x, y, z first."""
    if isinstance(columns, Mapping):
        if not {"x", "y", "z"} <= set(columns):
            raise argument_error("columns", "x, y and z among the names", list(columns))
        axes: dict[str, int | str] = {axis: columns[axis] for axis in "xyz"}
        return {**axes, **{name: c for name, c in columns.items() if name not in axes}}
    if isinstance(columns, str) or len(columns) < 3:
        raise argument_error("columns", "at least three, x, y and z", repr(columns))
    extra = {_name_of(c, names) or f"column_{c}": c for c in columns[3:]}
    if len(extra) != len(columns) - 3:
        raise argument_error("columns", "every attribute once", repr(columns))
    return {"x": columns[0], "y": columns[1], "z": columns[2], **extra}


def write_text(
    path: PathLike, cloud: PointCloud, *, separator: str, notes: Mapping[str, str]
) -> None:
    """Write points and all attributes, each number as the shortest text that reads back equal.

    Comments at the top hold the notes and, where `separator` is a blank, the names of the columns;
    else the names are a line of their own.
    """
    if clash := {"x", "y", "z"} & set(cloud.attributes):
        name = min(clash)
        raise argument_error("attributes", "names other than those of coordinates", repr(name))
    names = ["x", "y", "z", *map(_title, cloud.attributes)]
    lines = ["# metres, z up", *(f"# {k} {' '.join(text.split())}" for k, text in notes.items())]
    lines.append(("# " if separator == " " else "") + separator.join(names))
    preamble = "\n".join([*lines, ""])
    with replacing(path) as aside:
        _core.write_xyz(
            aside, cloud, separator=separator, preamble=preamble, attributes=list(cloud.attributes)
        )


def _title(name: str) -> str:
    """A name as the header can hold it, percent-encoded where need be; never one that a spreadsheet
    would run as a formula."""
    title = quote(name, safe="/()[]+:")
    return f"%{ord(title[0]):02X}{title[1:]}" if title.startswith(("+", "-")) else title
