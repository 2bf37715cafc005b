# SPDX-License-Identifier: BSD-3-Clause
"""Records in folders: a column an array of Zarr, filled ping after ping by one process or several.

A ping is there when its time is: of each chunk the times are put in place last. What an interrupted
survey or a full disk leaves is read like a whole one, and can be continued.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error, Sonar
from bathyal.errors import argument_error
from bathyal.io.asides import aside_in, locked
from bathyal.io.files import PathLike, reading, shown
from bathyal.io.formats.zarr_arrays import (
    ArrayLayout,
    StoredArray,
    read_chunk,
    read_json,
    read_layout,
    write_chunk,
    write_group,
)
from bathyal.sonar.columns import COLUMNS, columns_of_record, record_of_columns, tail_of
from bathyal.sonar.record import SonarRecord

_FORMAT = "bathyal sonar record"
_VERSION = 1
_CHUNK_BYTES = 4 << 20  # of intensity
_MOST_ROWS = 1024


def is_record(folder: Path) -> bool:
    """Whether a folder is one that is kept here."""
    try:
        return read_json(folder / ".zattrs").get("format") == _FORMAT
    except (OSError, Error):
        return False


def plain(value: Any) -> Any:
    """As JSON gives it back."""
    return json.loads(json.dumps(value, default=lambda array: np.asarray(array).tolist()))


class RecordStore:
    """A folder of a record's columns."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        if not (folder / ".zattrs").is_file():
            raise Error(f"{shown(folder)}: a folder that is no sonar record")
        self.notes = read_json(folder / ".zattrs")
        if (self.notes.get("format"), self.notes.get("version")) != (_FORMAT, _VERSION):
            raise Error(f"{shown(folder)}: not a sonar record of version {_VERSION}")
        self.layouts = {
            name: read_layout(folder / name) for name in COLUMNS if (folder / name).is_dir()
        }
        with reading(folder, "sonar record"):
            self._check()

    @classmethod
    def make(
        cls, folder: Path, notes: Mapping[str, Any], names: list[str], shape: tuple[int, int, int]
    ) -> RecordStore:
        """A folder for a record of (pings, beams, samples), or the one that is there of the same.

        Raises
        ------
        ValueError
            For a folder of anything else.
        OSError
            Where it cannot be written.
        """
        wanted = plain({"format": _FORMAT, "version": _VERSION, **notes})
        if not folder.exists() or not any(folder.iterdir()):
            _lay_out(folder, wanted, names, shape)
        if not (folder / ".zattrs").is_file():
            raise argument_error("out", "a new folder, or that of this survey", shown(folder))
        store = cls(folder)
        if store.notes != wanted:
            differing = ", ".join(_differences(wanted, store.notes))
            raise argument_error(
                "out", "a new folder, or that of this survey",
                f"{shown(folder)}, of a survey that differs in {differing}",
            )  # fmt: skip
        return store

    @property
    def chunk(self) -> int:
        """Pings of a chunk."""
        return self.layouts["time"].chunk

    @property
    def pings(self) -> int:
        """Those that it has room for."""
        return self.layouts["time"].shape[0]

    def present(self) -> NDArray[np.bool_]:
        """(pings,) which are there; those of a broken chunk are not. A record that was written as a
        whole has all."""
        if "survey" not in self.notes:
            return np.ones(self.pings, bool)
        layout = self.layouts["time"]
        found = np.zeros(layout.chunks * layout.chunk, bool)
        for chunk in range(layout.chunks):
            try:
                times = read_chunk(self.folder / "time", layout, chunk)
            except Error:
                continue
            found[chunk * layout.chunk : (chunk + 1) * layout.chunk] = np.isfinite(times)
        return found[: self.pings]

    def missing(self, first: int, end: int) -> Iterator[tuple[int, int]]:
        """Runs of pings of [first, end) that are not there: each a first one and an end, within
        one chunk."""
        there = self.present()
        number = first
        while number < end:
            if there[number]:
                number += 1
                continue
            stop = min(end, (number // self.chunk + 1) * self.chunk)
            here = np.flatnonzero(there[number:stop])
            stop = number + int(here[0]) if len(here) else stop
            yield number, stop
            number = stop

    def put(self, first: int, rows: Mapping[str, NDArray[Any]]) -> None:
        """Rows of one chunk, of all columns, from a ping on.

        Raises
        ------
        OSError
            Where the disk is full: what was there before stays.
        """
        chunk, at = divmod(first, self.chunk)
        count = len(rows["time"])
        with locked(self.folder):
            for name in sorted(self.layouts, key=lambda name: name == "time"):
                layout = self.layouts[name]
                if count == layout.chunk:
                    whole = rows[name]
                else:
                    whole = self._kept(name, chunk)
                    whole[at : at + count] = rows[name]
                write_chunk(self.folder / name, layout, chunk, whole)

    def record(self) -> SonarRecord:
        """What is there, its samples read when they are asked for."""
        there = np.flatnonzero(self.present())
        warnings = []
        if len(there) < self.pings:
            warnings.append(f"of {self.pings:,} pings {len(there):,} are there")
        warnings += self._missing(there)
        columns = {name: StoredArray(self.folder / name, there) for name in self.layouts}
        notes = self.notes
        with reading(self.folder, "sonar record"):
            sonar = Sonar.from_dict(notes["sonar"]) if notes["sonar"] else None
            start = np.datetime64(notes["start"]) if notes["start"] else None
            return record_of_columns(
                columns, float(notes["spacing"]), tuple(map(str, notes["beam_names"])),
                sonar=sonar, start=start, warnings=tuple(warnings + notes["warnings"]),
            )  # fmt: skip

    def _missing(self, there: NDArray[np.int64]) -> list[str]:
        """Columns of which chunks are lost that were written once: their rows are NaN or 0."""
        lost = []
        for name, layout in self.layouts.items():
            chunks = np.unique(there // layout.chunk)
            count = sum(not (self.folder / name / layout.name(int(one))).exists() for one in chunks)
            if count:
                lost.append(f"{name}: {count} of {len(chunks)} chunks are missing")
        return lost

    def _kept(self, name: str, chunk: int) -> NDArray[Any]:
        try:
            return read_chunk(self.folder / name, self.layouts[name], chunk).copy()
        except Error:
            return self.layouts[name].empty(self.chunk)

    def _check(self) -> None:
        """Whether the columns are of one record."""
        missing = [name for name in ("time", "intensity", "sound_speed", "position", "altitude")
                   if name not in self.layouts]  # fmt: skip
        if missing:
            raise Error(f"it has no {', '.join(missing)}")
        _, beams, samples = self.layouts["intensity"].shape
        for name, layout in self.layouts.items():
            column = COLUMNS[name]
            expected = (self.pings, *tail_of(column, beams, samples))
            if (layout.shape, layout.dtype.str) != (expected, column.dtype):
                raise Error(
                    f"{name}: expected {expected} of {column.dtype}, got {layout.shape} of "
                    f"{layout.dtype.str}"
                )
            if layout.chunk != self.chunk:
                raise Error(f"{name}: expected chunks of {self.chunk}, got {layout.chunk}")
        if len(self.notes["beam_names"]) != beams:
            raise Error(f"expected names of {beams} beams, got {len(self.notes['beam_names'])}")


def write_store(record: SonarRecord, path: PathLike) -> None:
    """A record as a folder.

    Raises
    ------
    ValueError
        Where there is one.
    """
    folder = Path(path)
    if folder.exists():
        raise argument_error("path", "a folder that is not there yet", shown(folder))
    columns = columns_of_record(record)
    intensity = columns["intensity"]
    notes = {
        "sonar": record.sonar.to_dict() if record.sonar else None,
        "beam_names": list(record.beam_names),
        "spacing": float(2 * record.range[0]),
        "start": str(record.start) if record.start is not None else None,
        "warnings": list(record.warnings),
    }
    pings, beams, samples = intensity.shape
    folder.parent.mkdir(parents=True, exist_ok=True)
    with aside_in(folder.parent) as aside:
        store = RecordStore.make(aside / folder.name, notes, list(columns), (pings, beams, samples))
        for first in range(0, pings, store.chunk):
            some = slice(first, first + store.chunk)
            store.put(first, {name: np.asarray(values[some]) for name, values in columns.items()})
        os.rename(store.folder, folder)


def _lay_out(
    folder: Path, notes: Mapping[str, Any], names: list[str], shape: tuple[int, int, int]
) -> None:
    """The metadata, put in place in one step."""
    pings, beams, samples = shape
    chunk = max(1, min(_MOST_ROWS, _CHUNK_BYTES // max(4 * beams * samples, 1)))
    arrays = {}
    for name in names:
        column = COLUMNS[name]
        layout = ArrayLayout(
            (pings, *tail_of(column, beams, samples)), chunk, np.dtype(column.dtype), column.fill,
            column.deflated,
        )  # fmt: skip
        axes = ["ping", *column.axes]
        arrays[name] = (
            layout,
            {"_ARRAY_DIMENSIONS": axes, "units": column.units, "long_name": column.note},
        )
    folder.parent.mkdir(parents=True, exist_ok=True)
    with aside_in(folder.parent) as aside:
        made = aside / folder.name
        made.mkdir()
        write_group(made, notes, arrays)
        try:
            os.rename(made, folder)  # over an empty folder too
        except OSError:
            if not (folder / ".zattrs").is_file():  # else another process was first
                raise


def _differences(one: Mapping[str, Any], other: Mapping[str, Any]) -> list[str]:
    """Names of what differs, with those inside of it."""
    found = []
    for name in sorted({*one, *other}):
        a, b = one.get(name), other.get(name)
        if a == b:
            continue
        if isinstance(a, dict) and isinstance(b, dict):
            found += [f"{name}.{inner}" for inner in _differences(a, b)]
        else:
            found.append(name)
    return found
