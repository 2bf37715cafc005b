# SPDX-License-Identifier: BSD-3-Clause
"""Columns of a table of touches or tracked poses: joints, positions, and covariates."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error
from bathyal.errors import argument_error
from bathyal.io.tables import (
    ACCELERATIONS,
    ANGLES,
    LENGTHS,
    MASSES,
    TEMPERATURES,
    TIMES,
    Table,
    check_unit,
)

_JOINT = re.compile(r"^(?:q|j|joint|theta|axis)[ _]?(\d+)$")
_COVARIATES: dict[str, tuple[dict[str, float], str]] = {
    "temperature": (TEMPERATURES, "c"),
    "time": (TIMES, "s"),
    "payload": (MASSES, "kg"),
}
_GRAVITY = ("gravity_x", "gravity_y", "gravity_z")
_DIRECTION = re.compile(r"^direction[ _]?(\d+)$")

Named = Mapping[str, str | Sequence[str]]


def touch_columns(
    table: Table, joints: Sequence[str] | None, unit: str | None, named: Named
) -> dict[str, NDArray[Any]]:
    columns: dict[str, NDArray[Any]] = {"q": _joint_values(table, joints, unit)}
    columns |= beside(table, named)
    for name in ("tool", "station"):
        if table.has_header and table.find(name) is not None:
            columns[name] = _whole(table, name)
    if table.has_header and table.find("weight") is not None:
        columns["weights"] = table.numbers("weight", {}, "")
    return columns


def tracked_columns(
    table: Table,
    joints: Sequence[str] | None,
    unit: str | None,
    position: Sequence[str],
    position_unit: str | None,
) -> dict[str, NDArray[Any]]:
    place = [table.numbers(name, LENGTHS, position_unit) for name in position]
    return {"q": _joint_values(table, joints, unit), "position": np.column_stack(place)}


def beside(table: Table, named: Named) -> dict[str, NDArray[Any]]:
    """Covariates, and the session."""
    columns: dict[str, NDArray[Any]] = {
        f"covariate {name}": values for name, values in _covariates(table, named).items()
    }
    if "session" in named or (table.has_header and table.find("session") is not None):
        columns["session"] = _sessions(table, _one(named.get("session", "session"), "session"))
    return columns


def joined(tables: list[Table], columns: list[dict[str, NDArray[Any]]]) -> dict[str, Any]:
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
    check_unit("unit", unit, {**ANGLES, **LENGTHS})
    if joints is None:
        joints = table.titles if not table.has_header else _numbered_joints(table)
    units = {**ANGLES, **LENGTHS}
    hint = '; unit="rad" or unit="deg" says it for all joints'
    return np.column_stack([table.numbers(n, units, unit, hint=hint) for n in joints])


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
