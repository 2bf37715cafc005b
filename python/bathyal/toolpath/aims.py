# SPDX-License-Identifier: BSD-3-Clause
"""Camera axes from files."""

from __future__ import annotations

import csv
import io
import json
import math
import os
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bathyal._core import Error
from bathyal.errors import argument_error
from bathyal.io.files import PathLike, read_document_text
from bathyal.io.formats.numbers import refuse_truth_values

_LENGTHS = {"m": 1.0, "cm": 0.01, "mm": 0.001, "km": 1000.0}
_ANGLES = {"deg": math.pi / 180.0, "rad": 1.0}
_POINT = ("px", "py", "pz")
_DIRECTION = ("dx", "dy", "dz")
_PAN_TILT = ("pan", "tilt")
_COLUMN = re.compile(r"^(?P<name>[a-z]+?)\s*(?:_(?P<a>\w+)|\[(?P<b>\w*)\]|\((?P<c>\w*)\))?$")


def read_aims(
    path: PathLike, *, world_from_vehicle: ArrayLike | None = None
) -> NDArray[np.float64]:
    """Read camera axes from a .csv (.txt, .tsv) or .json file.

    Parameters
    ----------
    path : path
        Text: a header with the columns ``px py pz`` and ``dx dy dz``, or ``pan tilt`` in place of
        the direction, in any order; other columns are left alone. Units are given in the header:
        ``px_m``, ``px_mm``, ``px [cm]``, ``pan_deg``, ``tilt (rad)``. A length without a unit is
        in metres, an angle must have one. Pan turns from x towards y, tilt rises above the x-y
        plane: −90° looks straight down. Columns are parted by comma, semicolon, tab or spaces;
        lines that begin with ``#`` are comments.

        JSON: a list of rows ``[px, py, pz, dx, dy, dz]`` or of
        ``{"point": [x, y, z], "direction": [x, y, z]}``, or an object that holds such a list as
        ``aims`` and, optionally, ``unit`` ("m", "cm", "mm", "km"), ``frame`` ("world" or
        "vehicle") and ``world_from_vehicle`` (four rows of four, [m]).
    world_from_vehicle : (4, 4) array, optional
        Pose of the vehicle [m]. Text aims are in the vehicle's frame when it is given and in the
        world's otherwise; it takes the place of a pose in a JSON file. Aims whose file says
        ``"frame": "world"`` are not moved.

    Returns
    -------
    (K, 6) array
        ``px py pz dx dy dz`` in the world frame [m]: hand them to `plan_toolpath` as they are.

    Raises
    ------
    Error
        For a file that cannot be understood; the text names the line.
    ValueError
        For a suffix that is not known or a pose that is not a rigid motion.

    Examples
    --------
    >>> import bathyal, pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = pathlib.Path(folder) / "aims.csv"
    ...     _ = file.write_text("px_m,py_m,pz_mm,pan_deg,tilt_deg\\n1,2,-500,0,-90\\n")
    ...     bathyal.read_aims(file).round(6).tolist()
    [[1.0, 2.0, -0.5, 0.0, 0.0, -1.0]]
    """
    return read_axes(path, world_from_vehicle=world_from_vehicle).axes


@dataclass(frozen=True)
class Axes:
    """Camera axes (K, 6) in the world frame [m], and the vehicle's pose (4, 4) where it is known:
    as given, else as the file says."""

    axes: NDArray[np.float64]
    world_from_vehicle: NDArray[np.float64] | None


def read_axes(path: PathLike, *, world_from_vehicle: ArrayLike | None = None) -> Axes:
    """As `read_aims`, with the pose next to the axes."""
    file = Path(path)
    pose = None if world_from_vehicle is None else _pose("world_from_vehicle", world_from_vehicle)
    if file.suffix.lower() not in {".csv", ".txt", ".tsv", ".json"}:
        raise argument_error("path", "a .csv, .txt, .tsv or .json file", repr(os.fspath(path)))
    text = read_document_text(file)
    if file.suffix.lower() == ".json":
        return _from_json(file, text, pose)
    aims = _from_text(file, text)
    return Axes(aims if pose is None else _moved(aims, pose), pose)


# Text ---------------------------------------------------------------------------------------------


def _rows(file: Path, text: str) -> Iterator[tuple[int, list[str]]]:
    """Line numbers and fields; comments and blank lines left out."""
    lines = text.splitlines()
    first = next((line for line in lines if line.strip() and not line.startswith("#")), "")
    delimiter = max(",;\t", key=first.count)
    if first.count(delimiter) == 0:
        for number, line in enumerate(lines, 1):
            if line.strip() and not line.startswith("#"):
                # "px [m]" is one name
                yield number, re.sub(r"\s+([\[(])", r"\1", line).split()
        return
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=delimiter)
    try:
        for fields in reader:
            if any(field.strip() for field in fields) and not fields[0].startswith("#"):
                yield reader.line_num, [field.strip() for field in fields]
    except csv.Error as error:
        raise Error(f"{file}, line {reader.line_num}: {error}") from error


def _columns(file: Path, number: int, header: list[str]) -> dict[str, tuple[int, float]]:
    """Name of a column → its place and what its numbers are multiplied with."""
    columns: dict[str, tuple[int, float]] = {}
    for place, title in enumerate(header):
        match = _COLUMN.match(title.lower())
        name = match["name"] if match else ""
        if match is None or name not in _POINT + _DIRECTION + _PAN_TILT:
            continue
        unit = match["a"] or match["b"] or match["c"] or ""
        where = f"{file}, line {number}: `{title}`"
        if name in columns:
            raise Error(f"{where}: expected each column once, got `{name}` twice")
        units = {**_LENGTHS, "": 1.0} if name in _POINT else _ANGLES
        if name in _DIRECTION:
            units = {"": 1.0}
        if unit not in units:
            expected = ", ".join(u for u in units if u) or "no unit"
            raise Error(f"{where}: expected a unit among {expected}, got {unit or 'none'}")
        columns[name] = (place, units[unit])
    missing = [name for name in _POINT if name not in columns]
    if not all(name in columns for name in _PAN_TILT):
        missing += [name for name in _DIRECTION if name not in columns]
    if missing:
        raise Error(
            f"{file}, line {number}: expected a header with px py pz and dx dy dz (or pan tilt), "
            f"got none for {' '.join(missing)} in {header}"
        )
    return columns


def _from_text(file: Path, text: str) -> NDArray[np.float64]:
    rows = _rows(file, text)
    number, header = next(rows, (1, []))
    columns = _columns(file, number, header)
    pan_tilt = not all(name in columns for name in _DIRECTION)
    names = _POINT + (_PAN_TILT if pan_tilt else _DIRECTION)
    values: list[list[float]] = []
    numbers: list[int] = []
    for number, fields in rows:
        row = []
        for name in names:
            place, factor = columns[name]
            field = fields[place] if place < len(fields) else "nothing"
            try:
                row.append(float(field) * factor)
            except ValueError:
                raise Error(
                    f"{file}, line {number}: `{header[place]}`: expected a number, got {field}"
                ) from None
        values.append(row)
        numbers.append(number)
    table = np.array(values, dtype=float).reshape(-1, len(names))
    if pan_tilt:
        pan, tilt = table[:, 3], table[:, 4]
        direction = [np.cos(tilt) * np.cos(pan), np.cos(tilt) * np.sin(pan), np.sin(tilt)]
        table = np.column_stack([table[:, :3], *direction])
    return _checked(table, lambda row: f"{file}, line {numbers[row]}")


# JSON ---------------------------------------------------------------------------------------------


def _from_json(file: Path, text: str, pose: NDArray[np.float64] | None) -> Axes:
    try:
        content: Any = json.loads(text)
    except (ValueError, RecursionError) as error:
        line = f", line {error.lineno}" if isinstance(error, json.JSONDecodeError) else ""
        raise Error(f"{file}{line}: not JSON: {error}") from error
    settings: dict[str, Any] = content if isinstance(content, dict) else {"aims": content}
    unit = settings.get("unit", "m")
    if not isinstance(unit, str) or unit not in _LENGTHS:
        raise Error(f"{file}: `unit`: expected one of {', '.join(_LENGTHS)}, got {unit!r}")
    if pose is None and "world_from_vehicle" in settings:
        try:
            refuse_truth_values(settings["world_from_vehicle"], "world_from_vehicle")
            pose = _pose("world_from_vehicle", settings["world_from_vehicle"])
        except (Error, ValueError) as error:
            raise Error(f"{file}: {error}") from error
    frame = settings.get("frame", "world" if pose is None else "vehicle")
    if frame not in ("world", "vehicle"):
        raise Error(f'{file}: `frame`: expected "world" or "vehicle", got {frame!r}')
    if frame == "vehicle" and pose is None:
        raise Error(
            f'{file}: `world_from_vehicle`: expected the vehicle\'s pose with "frame": '
            '"vehicle", got none'
        )
    rows = settings.get("aims")
    if not isinstance(rows, list):
        raise Error(f"{file}: `aims`: expected a list, got {type(rows).__name__}")
    try:
        refuse_truth_values(rows, "aims")
    except Error as error:
        raise Error(f"{file}: {error}") from None
    table = np.array([_json_row(file, i, row) for i, row in enumerate(rows)], dtype=float)
    table = table.reshape(-1, 6)
    table[:, :3] *= _LENGTHS[unit]
    aims = _checked(table, lambda row: f"{file}, aim {row}")
    return Axes(aims if frame == "world" or pose is None else _moved(aims, pose), pose)


def _json_row(file: Path, index: int, row: Any) -> list[float]:
    if isinstance(row, dict):
        parts = [row.get("point"), row.get("direction")]
        if all(isinstance(part, list) and len(part) == 3 for part in parts):
            row = [*row["point"], *row["direction"]]
    numbers = isinstance(row, list) and len(row) == 6
    if not numbers or not all(isinstance(value, int | float) for value in row):
        raise Error(
            f"{file}, aim {index}: expected six numbers, or a point and a direction of three "
            f"each, got {json.dumps(row)[:80]}"
        )
    try:
        return [float(value) for value in row]
    except OverflowError:
        raise Error(f"{file}, aim {index}: expected finite numbers, got {row}") from None


# Both ---------------------------------------------------------------------------------------------


def _checked(aims: NDArray[np.float64], where: Callable[[int], str]) -> NDArray[np.float64]:
    bad = np.flatnonzero(~np.isfinite(aims).all(axis=1))
    if bad.size:
        raise Error(f"{where(int(bad[0]))}: expected finite numbers, got {aims[bad[0]].tolist()}")
    still = np.flatnonzero(~aims[:, 3:].any(axis=1))
    if still.size:
        raise Error(f"{where(int(still[0]))}: expected a direction, got 0 0 0")
    return aims


def _pose(name: str, value: Any) -> NDArray[np.float64]:
    try:
        pose = np.asarray(value, dtype=float)
    except (TypeError, ValueError, OverflowError):
        raise argument_error(name, "a (4, 4) array", repr(value)) from None
    if pose.shape != (4, 4):
        raise argument_error(name, "shape (4, 4)", f"shape {pose.shape}")
    rotation = pose[:3, :3]
    rigid = (
        np.isfinite(pose).all()
        and np.allclose(rotation @ rotation.T, np.eye(3), atol=1e-6)
        and np.linalg.det(rotation) > 0
        and (pose[3] == [0, 0, 0, 1]).all()
    )
    if not rigid:
        raise argument_error(
            name, "a rigid motion (right-handed rotation, last row 0 0 0 1)", pose.tolist()
        )
    return pose


def _moved(aims: NDArray[np.float64], pose: NDArray[np.float64]) -> NDArray[np.float64]:
    rotation = pose[:3, :3]
    return np.hstack([aims[:, :3] @ rotation.T + pose[:3, 3], aims[:, 3:] @ rotation.T])
