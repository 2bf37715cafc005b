# SPDX-License-Identifier: BSD-3-Clause
"""Touches and tracked poses from files."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error, Touches, Tracked
from bathyal.errors import argument_error
from bathyal.tables import (
    ACCELERATIONS,
    ANGLES,
    LENGTHS,
    MASSES,
    TEMPERATURES,
    TIMES,
    Table,
    read_table,
)

PathLike = str | os.PathLike[str]

_JOINT = re.compile(r"^(?:q|j|joint|theta|axis)[ _]?(\d+)$")
_COVARIATES: dict[str, tuple[dict[str, float], str]] = {
    "temperature": (TEMPERATURES, "c"),
    "time": (TIMES, "s"),
    "payload": (MASSES, "kg"),
}
_GRAVITY = ("gravity_x", "gravity_y", "gravity_z")
_DIRECTION = re.compile(r"^direction[ _]?(\d+)$")
_QUATERNION = ("qx", "qy", "qz", "qw")


def read_touches(
    path: PathLike | Mapping[Any, PathLike],
    *,
    joints: Sequence[str] | None = None,
    unit: str | None = None,
    point: str = "point",
    planes: Sequence[str] = (),
    covariates: Mapping[str, str | Sequence[str]] | None = None,
    **touches: Any,
) -> Touches:
    """Read touches from a table of text, or from one table for each touched point.

    Parameters
    ----------
    path : path, or dict of label to path
        One file with a column that says which point each row touched, or a file a point. Columns
        are parted by semicolon, tab, comma or blanks; a decimal comma is understood; lines that
        begin with ``#`` are comments. Units stand in the header: ``q1_deg``, ``q2 [rad]``,
        ``lift_mm``. Columns ``temperature_C``, ``time_s``, ``payload_kg``, ``gravity_x`` …,
        ``direction_1`` … (one a joint), ``session``, ``tool``, ``station`` and ``weight`` ride
        along where they stand. A file without a header holds the joints alone.
    joints : sequence of str, optional
        Columns of the joints in the order of the arm, by name; otherwise ``q1 q2 …`` (or ``j1``,
        ``joint_1``, ``theta1``) by their numbers.
    unit : str, optional
        "rad" or "deg", of joints whose column names none.
    point : str
        Column of the touched point's label.
    planes : sequence of str
        Labels that stand for a plane touched in many places, not for a point.
    covariates : dict, optional
        Name to column, or to several: ``{"temperature": "T_arm", "direction": ["d1", "d2"]}``.
        A column of sessions may hold words; they are counted from 0 as they first appear.
    **touches
        What `Touches` takes beside. ``known_distances={("left", "right"): 0.05}`` and
        ``known_points={"left": (0.5, 0.2, 0.1)}`` by label.

    Returns
    -------
    Touches
        Whole numbers are kept as labels; other labels are numbered in the order they first appear,
        and ``.names`` keeps them.

    Raises
    ------
    Error
        For a file that cannot be understood; the text names the line or the column.

    Examples
    --------
    >>> import bathyal, pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = pathlib.Path(folder) / "touches.csv"
    ...     _ = file.write_text("point;q1_deg;q2_deg\\nleft;90,0;0\\nleft;90;45\\nright;-90;45\\n")
    ...     touches = bathyal.read_touches(file)
    >>> touches.q.round(3).tolist(), touches.point.tolist(), touches.names
    ([[1.571, 0.0], [1.571, 0.785], [-1.571, 0.785]], [0, 0, 1], {0: 'left', 1: 'right'})
    """
    if isinstance(path, Mapping):
        tables = [(label, read_table(file)) for label, file in path.items()]
        labels = [label for label, table in tables for _ in range(len(table))]
    else:
        table = read_table(path)
        tables = [("", table)]
        labels = list(table.text(point))
    if not tables:
        raise ValueError("`path`: expected a file or one a point, got an empty dict")
    numbers = _numbered(labels)
    rows = np.array([numbers[str(label).strip()] for label in labels], dtype=np.int32)
    columns = [_touch_columns(table, joints, unit, covariates or {}) for _, table in tables]
    return Touches(
        np.vstack([column.pop("q") for column in columns]),
        rows,
        **{
            "names": {number: text for text, number in numbers.items() if text != str(number)},
            **_joined([table for _, table in tables], columns),
            **touches,
            **_known(touches, numbers),
            **_planes(planes, numbers, rows),
        },
    )


def read_tracked(
    path: PathLike | Sequence[PathLike],
    *,
    joints: Sequence[str] | None = None,
    unit: str | None = None,
    position: Sequence[str] = ("x", "y", "z"),
    position_unit: str | None = None,
    orientation: Sequence[str] | None = None,
    orientation_unit: str | None = None,
    euler: str | None = None,
    covariates: Mapping[str, str | Sequence[str]] | None = None,
    **tracked: Any,
) -> Tracked:
    """Read poses that an instrument measured, with the joints they belong to.

    Parameters
    ----------
    path : path, or sequence of path
        A table as `read_touches` takes it, or one for each session: then sessions are counted from
        0 in the order of the files, and no column may tell them.
    joints, unit
        As in `read_touches`.
    position : sequence of str
        Columns of the measured position, in the instrument's frame.
    position_unit : str, optional
        "m", "mm", "cm", of a position whose columns name none.
    orientation : sequence of str, optional
        Four columns ``x y z w`` of a quaternion (``qx qy qz qw`` are found by themselves), or three
        angles, turned as `euler` says.
    orientation_unit : str, optional
        "rad" or "deg", of angles whose columns name none.
    euler : str, optional
        Three letters: "XYZ" turns about the frame's own axes one after the other, "xyz" about the
        fixed ones.
    covariates : dict, optional
        As in `read_touches`: ``{"temperature": "measurement_temperature"}``.
    **tracked
        What `Tracked` takes beside.

    Returns
    -------
    Tracked
        With the pose where orientations stand in the file, with the position otherwise.

    Raises
    ------
    Error
        For a file that cannot be understood; the text names the line or the column.

    Examples
    --------
    >>> import bathyal, pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = pathlib.Path(folder) / "tracked.csv"
    ...     _ = file.write_text("q1_deg,x_mm,y_mm,z_mm,temperature_C\\n"
    ...                         "90,0,1000,5,21.5\\n0,1000,0,5,21.5\\n")
    ...     tracked = bathyal.read_tracked(file)
    >>> tracked.position.tolist(), tracked.covariates["temperature"].tolist()
    ([[0.0, 1.0, 0.005], [1.0, 0.0, 0.005]], [21.5, 21.5])
    """
    files = [path] if isinstance(path, (str, os.PathLike)) else list(path)
    if not files:
        raise argument_error("path", "a file, or one a session", "none")
    _check_unit("position_unit", position_unit, LENGTHS)
    tables = [read_table(file) for file in files]
    columns = []
    for table in tables:
        if not table.has_header:
            raise Error(f"{table.file}: expected a header that names the columns, got numbers")
        columns.append(_tracked_columns(table, joints, unit, position, position_unit))
        columns[-1] |= _beside(table, covariates or {})
        turns = orientation
        if turns is None and all(table.find(name) is not None for name in _QUATERNION):
            turns = _QUATERNION
        if turns is not None:
            columns[-1]["orientation"] = _rotations(table, turns, orientation_unit, euler)
    settings = _joined(tables, columns)
    q, place, turned = (settings.pop(name, None) for name in ("q", "position", "orientation"))
    settings = {"covariates": {}, **settings}
    if len(files) > 1:
        if "session" in settings:
            raise argument_error("path", "one file where a column tells the sessions",
                                 f"{len(files)} files")  # fmt: skip
        settings["session"] = np.repeat(np.arange(len(files), dtype=np.int32), [*map(len, tables)])
    settings.update(tracked)
    if turned is None:
        return Tracked(q, position=place, **settings)
    pose = np.zeros((len(q), 4, 4))
    pose[:, :3, :3] = turned
    pose[:, :3, 3] = place
    pose[:, 3, 3] = 1.0
    return Tracked(q, pose=pose, **settings)


# Columns ------------------------------------------------------------------------------------------


Named = Mapping[str, str | Sequence[str]]


def _touch_columns(
    table: Table, joints: Sequence[str] | None, unit: str | None, named: Named
) -> dict[str, NDArray[Any]]:
    columns: dict[str, NDArray[Any]] = {"q": _joint_values(table, joints, unit)}
    columns |= _beside(table, named)
    for name in ("tool", "station"):
        if table.has_header and table.find(name) is not None:
            columns[name] = _whole(table, name)
    if table.has_header and table.find("weight") is not None:
        columns["weights"] = table.numbers("weight", {}, "")
    return columns


def _tracked_columns(
    table: Table,
    joints: Sequence[str] | None,
    unit: str | None,
    position: Sequence[str],
    position_unit: str | None,
) -> dict[str, NDArray[Any]]:
    place = [table.numbers(name, LENGTHS, position_unit) for name in position]
    return {"q": _joint_values(table, joints, unit), "position": np.column_stack(place)}


def _beside(table: Table, named: Named) -> dict[str, NDArray[Any]]:
    """What was recorded beside the joints, and the session."""
    columns: dict[str, NDArray[Any]] = {
        f"covariate {name}": values for name, values in _covariates(table, named).items()
    }
    if "session" in named or (table.has_header and table.find("session") is not None):
        columns["session"] = _sessions(table, _one(named.get("session", "session"), "session"))
    return columns


def _joined(tables: list[Table], columns: list[dict[str, NDArray[Any]]]) -> dict[str, Any]:
    """One array of each column; one that only some of the files hold is an error."""
    names = {name for column in columns for name in column}
    for table, column in zip(tables, columns, strict=True):
        for name in sorted(names - column.keys()):
            raise Error(f"{table.file}: expected a column `{name.removeprefix('covariate ')}` as "
                        "in the other files, got none")  # fmt: skip
    joined = {name: np.concatenate([column[name] for column in columns]) for name in names}
    covariates = {name.removeprefix("covariate "): joined.pop(name)
                  for name in sorted(names) if name.startswith("covariate ")}  # fmt: skip
    return {**joined, **({"covariates": covariates} if covariates else {})}


def _joint_values(
    table: Table, joints: Sequence[str] | None, unit: str | None
) -> NDArray[np.float64]:
    _check_unit("unit", unit, {**ANGLES, **LENGTHS})
    if joints is None:
        joints = table.titles if not table.has_header else _numbered_joints(table)
    try:
        return np.column_stack([table.numbers(n, {**ANGLES, **LENGTHS}, unit) for n in joints])
    except Error as error:
        if "expected a unit" in str(error):
            raise Error(f'{error}; unit="rad" or unit="deg" says it for all joints') from None
        raise


def _numbered_joints(table: Table) -> list[str]:
    found = _numbered_columns(table, _JOINT)
    if not found:
        raise Error(
            f"{table.file}: expected columns q1 q2 … (or their names as `joints`), "
            f"got {', '.join(table.titles)}"
        )
    return found


def _numbered_columns(table: Table, pattern: re.Pattern[str]) -> list[str]:
    """Titles of the columns whose names match, in the order of their numbers."""
    matches = [pattern.match(name) for name in table.names]
    found = {
        int(match[1]): title
        for match, title in zip(matches, table.titles, strict=True)
        if match is not None
    }
    return [found[number] for number in sorted(found)]


def _covariates(table: Table, named: Named) -> dict[str, NDArray[np.float64]]:
    found: dict[str, NDArray[np.float64]] = {}
    if named and not table.has_header:
        raise Error(f"{table.file}: expected a header that names the columns, got numbers")
    if not table.has_header:
        return found
    for name, (units, default) in _COVARIATES.items():
        if name not in named and table.find(name) is not None:
            found[name] = _finite(table, name, units, default)
    if "gravity" not in named and all(table.find(name) is not None for name in _GRAVITY):
        found["gravity"] = _together(table, _GRAVITY, ACCELERATIONS, "m/s2")
    directions = _numbered_columns(table, _DIRECTION)
    if "direction" not in named and directions:
        found["direction"] = _together(table, directions, {}, "")
    for name, column in named.items():
        if name == "session":
            continue
        units, default = _COVARIATES.get(name, ({}, ""))
        if name == "gravity":
            units, default = ACCELERATIONS, "m/s2"
        if isinstance(column, str) and name != "direction":
            found[name] = _finite(table, column, units, default)
        else:
            columns = [column] if isinstance(column, str) else column
            found[name] = _together(table, columns, units, default)
    return found


def _together(
    table: Table, columns: Sequence[str], units: dict[str, float], default: str
) -> NDArray[np.float64]:
    return np.column_stack([_finite(table, column, units, default) for column in columns])


def _finite(table: Table, name: str, units: dict[str, float], default: str) -> NDArray[np.float64]:
    """A column of which nothing is missing."""
    values = table.numbers(name, units, default)
    wrong = np.flatnonzero(~np.isfinite(values))
    if wrong.size:
        raise Error(f"{table.file}, line {table.lines[wrong[0]]}: `{name}`: expected a number in "
                    f"every row, got {values[wrong[0]]}")  # fmt: skip
    return values


def _sessions(table: Table, name: str) -> NDArray[np.int32]:
    """Whole numbers as they are; words by the order in which they first appear."""
    texts = [text.strip() for text in table.text(name)]
    empty = next((row for row, text in enumerate(texts) if not text), None)
    if empty is not None:
        raise Error(f"{table.file}, line {table.lines[empty]}: `{name}`: expected a session, got "
                    "nothing")  # fmt: skip
    try:
        [float(text.replace(",", ".")) for text in texts]
    except ValueError:
        numbers = {text: number for number, text in enumerate(dict.fromkeys(texts))}
        return np.array([numbers[text] for text in texts], dtype=np.int32)
    return _whole(table, name)


def _one(column: str | Sequence[str], name: str) -> str:
    if isinstance(column, str):
        return column
    raise argument_error("covariates", f"one column as {name}", repr(list(column)))


def _whole(table: Table, name: str) -> NDArray[np.int32]:
    values = table.numbers(name, {}, "")
    wrong = np.flatnonzero(~np.isfinite(values) | (values != np.floor(values)))
    if wrong.size:
        raise Error(f"{table.file}, line {table.lines[wrong[0]]}: `{name}`: expected a whole "
                    f"number, got {values[wrong[0]]:g}")  # fmt: skip
    return values.astype(np.int32)


def _check_unit(name: str, unit: str | None, units: dict[str, float]) -> None:
    if unit is not None and unit not in units:
        raise ValueError(f"`{name}`: expected one of {', '.join(units)}, got {unit!r}")


# Labels -------------------------------------------------------------------------------------------


def _numbered(labels: Sequence[Any]) -> dict[str, int]:
    """Label → number: itself for a whole number, its rank of appearance for all when one is not."""
    texts = list(dict.fromkeys(str(label).strip() for label in labels))
    if all(re.fullmatch(r"\d{1,9}", text) for text in texts):
        return {text: int(text) for text in texts}
    return {text: number for number, text in enumerate(texts)}


def _known(touches: Mapping[str, Any], numbers: Mapping[str, int]) -> dict[str, Any]:
    """Known distances and points by number in place of label."""
    known: dict[str, Any] = {}
    if touches.get("known_distances") is not None:
        name = "known_distances"
        known[name] = {
            (_number(name, numbers, a), _number(name, numbers, b)): metres
            for (a, b), metres in touches[name].items()
        }
    if touches.get("known_points") is not None:
        name = "known_points"
        known[name] = {_number(name, numbers, a): place for a, place in touches[name].items()}
    return known


def _planes(
    labels: Sequence[str], numbers: Mapping[str, int], rows: NDArray[np.int32]
) -> dict[str, Any]:
    found = {label: np.flatnonzero(rows == _number("planes", numbers, label)) for label in labels}
    return {"planes": found} if found else {}


def _number(name: str, numbers: Mapping[str, int], label: Any) -> int:
    text = str(label).strip()
    if text not in numbers:
        raise argument_error(name, f"labels among {', '.join(numbers)}", repr(label))
    return numbers[text]


# Orientations -------------------------------------------------------------------------------------


def _rotations(
    table: Table, columns: Sequence[str], unit: str | None, euler: str | None
) -> NDArray[np.float64]:
    """(N, 3, 3)"""
    if len(columns) == 4:
        return _from_quaternions(table, [table.numbers(name, {}, "") for name in columns])
    if len(columns) != 3:
        raise ValueError(f"`orientation`: expected three or four columns, got {len(columns)}")
    if euler is None or sorted(euler.lower()) not in (["x", "y", "z"],) or (
        euler not in (euler.lower(), euler.upper())
    ):  # fmt: skip
        raise ValueError(
            "`euler`: expected the order of three angles, such as 'XYZ' (about the frame's own "
            f"axes) or 'xyz' (about the fixed ones), got {euler!r}"
        )
    _check_unit("orientation_unit", unit, ANGLES)
    turns = [_about(axis, table.numbers(name, ANGLES, unit))
             for axis, name in zip(euler.lower(), columns, strict=True)]  # fmt: skip
    first, second, third = turns if euler.isupper() else reversed(turns)
    return np.asarray(first @ second @ third)


def _about(axis: str, angle: NDArray[np.float64]) -> NDArray[np.float64]:
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    rotation = np.broadcast_to(np.eye(3), (len(angle), 3, 3)).copy()
    rotation[:, i, i] = rotation[:, j, j] = np.cos(angle)
    rotation[:, j, i] = np.sin(angle)
    rotation[:, i, j] = -np.sin(angle)
    return rotation


def _from_quaternions(table: Table, columns: list[NDArray[np.float64]]) -> NDArray[np.float64]:
    q = np.column_stack(columns)
    length = np.linalg.norm(q, axis=1)
    wrong = np.flatnonzero(~(np.abs(length - 1.0) < 1e-2))
    if wrong.size:
        raise Error(f"{table.file}, line {table.lines[wrong[0]]}: expected a unit quaternion, got "
                    f"one of length {length[wrong[0]]:.3g}")  # fmt: skip
    x, y, z, w = (q / length[:, None]).T
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), 2, 0)
