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
from bathyal.identify.orientation_columns import QUATERNION, rotations
from bathyal.identify.touch_columns import beside, joined, touch_columns, tracked_columns
from bathyal.io.tables import LENGTHS, check_unit, read_table

PathLike = str | os.PathLike[str]


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
        begin with ``#`` are comments. Units are given in the header: ``q1_deg``, ``q2 [rad]``,
        ``lift_mm``. Columns ``temperature_C``, ``time_s``, ``payload_kg``, ``gravity_x`` …,
        ``direction_1`` … (one a joint), ``session``, ``tool``, ``station`` and ``weight`` are
        read where they are present. A file without a header holds the joints alone.
    joints : sequence of str, optional
        Columns of the joints in the order of the arm, by name; otherwise ``q1 q2 …`` (or ``j1``,
        ``joint_1``, ``theta1``) by their numbers.
    unit : str, optional
        "rad" or "deg", of joints whose column names none.
    point : str
        Column of the touched point's label.
    planes : sequence of str
        Labels of a plane touched in many places, not for a point.
    covariates : dict, optional
        Name to column, or to several: ``{"temperature": "T_arm", "direction": ["d1", "d2"]}``.
        A column of sessions may hold text; sessions are counted from 0 as they first appear.
    **touches
        Further arguments of `Touches`. ``known_distances={("left", "right"): 0.05}`` and
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
    rows = np.array([numbers[_label_text(label)] for label in labels], dtype=np.int32)
    columns = [touch_columns(table, joints, unit, covariates or {}) for _, table in tables]
    return Touches(
        np.vstack([column.pop("q") for column in columns]),
        rows,
        **{
            "names": {number: text for text, number in numbers.items() if text != str(number)},
            **joined([table for _, table in tables], columns),
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
        0 in the order of the files, and no column may give them.
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
        Further arguments of `Tracked`.

    Returns
    -------
    Tracked
        With the pose where the file holds orientations, with the position otherwise.

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
    check_unit("position_unit", position_unit, LENGTHS)
    tables = [read_table(file) for file in files]
    columns = []
    for table in tables:
        if not table.has_header:
            raise Error(f"{table.file}: expected a header that names the columns, got numbers")
        columns.append(tracked_columns(table, joints, unit, position, position_unit))
        columns[-1] |= beside(table, covariates or {})
        turns = orientation
        if turns is None and all(table.find(name) is not None for name in QUATERNION):
            turns = QUATERNION
        if turns is not None:
            columns[-1]["orientation"] = rotations(table, turns, orientation_unit, euler)
    settings = joined(tables, columns)
    q, place, turned = (settings.pop(name, None) for name in ("q", "position", "orientation"))
    settings = {"covariates": {}, **settings}
    if len(files) > 1:
        if "session" in settings:
            raise argument_error("path", "one file where a column gives the sessions",
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


def _numbered(labels: Sequence[Any]) -> dict[str, int]:
    """Label → number: itself for a whole number, its rank of appearance for all when one is not."""
    texts = list(dict.fromkeys(_label_text(label) for label in labels))
    if all(re.fullmatch(r"\d{1,9}", text) for text in texts):
        return {text: int(text) for text in texts}
    return {text: number for number, text in enumerate(texts)}


def _label_text(label: Any) -> str:
    """Blanks around it do not count; a tab is part of a name that was written with it."""
    return str(label).strip(" ")


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
    text = _label_text(label)
    if text not in numbers:
        raise argument_error(name, f"labels among {', '.join(numbers)}", repr(label))
    return numbers[text]
