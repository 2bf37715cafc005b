# SPDX-License-Identifier: BSD-3-Clause
"""Rotations from columns of a table: quaternions, or three angles."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error
from bathyal.io.tables import ANGLES, Table, check_unit

QUATERNION = ("qx", "qy", "qz", "qw")


def rotations(
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
    check_unit("orientation_unit", unit, ANGLES)
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
