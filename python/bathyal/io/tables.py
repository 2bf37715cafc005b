# SPDX-License-Identifier: BSD-3-Clause
"""Tables of text: columns with names and units, as spreadsheets and loggers write them."""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error
from bathyal.io.files import PathLike, read_document_text, replacing

LENGTHS = {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "km": 1e3, "um": 1e-6, "µm": 1e-6}
ANGLES = {"rad": 1.0, "deg": math.pi / 180.0, "°": math.pi / 180.0, "mrad": 1e-3}
TIMES = {"s": 1.0, "ms": 1e-3, "min": 60.0, "h": 3600.0}
MASSES = {"kg": 1.0, "g": 1e-3}
ACCELERATIONS = {"m/s2": 1.0, "m/s²": 1.0, "m/s^2": 1.0}
TEMPERATURES = {"c": 1.0, "degc": 1.0, "°c": 1.0}
_SUFFIXES = {"m", "mm", "cm", "km", "um", "rad", "deg", "mrad", "s", "ms", "min", "kg", "g", "degc",
             "c"}  # fmt: skip
_BRACKETED = re.compile(r"^(?P<name>.*?)\s*[\[(](?P<unit>[^\])]*)[\])]$")
# Apostrophes before it count as part: a text that has one already gets one more.
_FORMULA = re.compile(r"'*[=+\-@\t\r#]")
_NUMBER = re.compile(r"^[+-]?(\d+[.,]?\d*|[.,]\d+)([eE][+-]?\d+)?$|^[+-]?(nan|inf|infinity)$", re.I)


@dataclass(frozen=True)
class Table:
    """Cells of text under titles; numbers are made of a column when it is asked for.

    A title is a name and a unit: ``q1_deg``, ``q1 [deg]``, ``temperature (°C)``; case does not
    count. A file without a header has the titles ``1``, ``2``, … and no units.
    """

    file: Path
    titles: list[str]
    cells: list[list[str]]
    lines: list[int]
    has_header: bool

    @property
    def names(self) -> list[str]:
        """Titles without their units, in small letters."""
        return [split_unit(title)[0] for title in self.titles]

    def __len__(self) -> int:
        return len(self.cells)

    def find(self, name: str) -> int | None:
        """The place of a column by its whole title or its name; None where there is none."""
        wanted = name.strip().lower()
        titles = [title.lower() for title in self.titles]
        for known in (titles, self.names):
            if known.count(wanted) > 1:
                raise Error(f"{self.file}: `{name}`: expected one column of that name, got several")
            if wanted in known:
                return known.index(wanted)
        return None

    def place(self, name: str) -> int:
        """As `find`; a column that is not there is an error that names those that are."""
        place = self.find(name)
        if place is None:
            raise Error(f"{self.file}: `{name}`: expected a column of that name, got "
                        f"{', '.join(self.titles)}")  # fmt: skip
        return place

    def text(self, name: str) -> list[str]:
        """The cells of a column."""
        place = self.place(name)
        return [row[place] for row in self.cells]

    def numbers(
        self, name: str, units: dict[str, float], default: str | None, *, hint: str = ""
    ) -> NDArray[np.float64]:
        """A column in SI units.

        `units` are those that its title may name, with their factors; `default` is taken where
        none does, and None makes that an error, to which `hint` is added. Not-a-number cells are
        the caller's business.
        """
        place = self.place(name)
        title = self.titles[place]
        unit = split_unit(title)[1] or default
        if unit is None or (units and unit not in units):
            raise Error(
                f"{self.file}: `{title}`: expected a unit among {', '.join(units)} in the header, "
                f"such as {split_unit(title)[0]}_{next(iter(units))}, got {unit or 'none'}{hint}"
            )
        column = [row[place].replace(",", ".") for row in self.cells]
        try:
            values = np.array(column, dtype=float)
        except ValueError:
            row = next(i for i, cell in enumerate(column) if not _NUMBER.match(cell))
            raise Error(
                f"{self.file}, line {self.lines[row]}: `{title}`: expected a number, "
                f"got {self.cells[row][place] or 'nothing'}"
            ) from None
        return values * (units[unit] if units else 1.0)


def split_unit(title: str) -> tuple[str, str]:
    """Name and unit of a title, in small letters; the unit is empty where there is none."""
    title = title.strip().lower()
    if match := _BRACKETED.match(title):
        return match["name"], match["unit"].strip()
    name, _, suffix = title.rpartition("_")
    return (name, suffix) if name and suffix in _SUFFIXES else (title, "")


def read_table(path: PathLike) -> Table:
    """Read a table of text, with or without a header.

    Columns are parted by semicolon, tab, comma or blanks, whichever the first line shows in this
    order; a comma between digits is the decimal sign where something else parts the columns. Lines
    that begin with ``#`` are comments; lines of empty cells, as spreadsheets append them, are none.
    An apostrophe before what a spreadsheet would take for a formula (`write_table` puts it there)
    is taken away.

    Raises
    ------
    Error
        For a file that is no text, is empty, or has a row with more or fewer cells than the first.
    """
    file = Path(path)
    text = read_document_text(file)
    kept = [(number, line) for number, line in enumerate(text.splitlines(), 1)
            if line.strip(" \t;,") and not line.lstrip().startswith("#")]  # fmt: skip
    if not kept:
        raise Error(f"{file}: expected a table, got no line of it")
    rows = _split([line for _, line in kept])
    lines = [number for number, _ in kept]
    for number, row in zip(lines, rows, strict=True):
        if len(row) != len(rows[0]):
            raise Error(f"{file}, line {number}: expected {len(rows[0])} cells as in line "
                        f"{lines[0]}, got {len(row)}")  # fmt: skip
    if all(_NUMBER.match(cell) for cell in rows[0]):
        titles = [str(column + 1) for column in range(len(rows[0]))]
        return Table(file, titles, rows, lines, has_header=False)
    return Table(file, rows[0], rows[1:], lines[1:], has_header=True)


def _split(lines: list[str]) -> list[list[str]]:
    first = lines[0]
    delimiter = next((sign for sign in ";\t," if sign in first), " ")
    if delimiter == "," and len(words := first.split()) > 1 and all(map(_NUMBER.match, words)):
        delimiter = " "  # "0,1 0,2 0,3": the comma is the decimal sign
    if delimiter == " ":
        # "q1 [deg]" is one title
        return [re.sub(r"\s+([\[(])", r"\1", line).split() for line in lines]
    rows = csv.reader(io.StringIO("\n".join(lines), newline=""), delimiter=delimiter)
    return [[_plain_text(cell.strip()) for cell in row] for row in rows]


def write_table(
    path: PathLike,
    titles: Iterable[str],
    rows: Iterable[Sequence[Any]],
    comments: Sequence[str] = (),
) -> None:
    """Write a table as .csv; the file appears whole or not at all.

    A text that a spreadsheet would run as a formula (it begins with ``= + - @``, tab or carriage
    return), and one that `read_table` would take for a comment (``#``), gets an apostrophe before
    it, which `read_table` takes away. Numbers, also as text, are written as they are.
    """
    with replacing(path) as aside, open(aside, "w", encoding="utf-8", newline="") as stream:
        stream.writelines(f"# {line}\n" for line in comments)
        table = csv.writer(stream, lineterminator="\n")
        table.writerow([_harmless(title) for title in titles])
        table.writerows([_harmless(cell) for cell in row] for row in rows)


def _harmless(cell: Any) -> Any:
    if not isinstance(cell, str) or not _FORMULA.match(cell) or _NUMBER.match(cell):
        return cell
    return "'" + cell


def _plain_text(cell: str) -> str:
    """What `_harmless` made harmless, as it was."""
    return cell[1:] if cell.startswith("'") and _FORMULA.match(cell) else cell


def check_unit(name: str, unit: str | None, units: dict[str, float]) -> None:
    if unit is not None and unit not in units:
        raise ValueError(f"`{name}`: expected one of {', '.join(units)}, got {unit!r}")
