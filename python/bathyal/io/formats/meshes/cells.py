# SPDX-License-Identifier: BSD-3-Clause
"""Lists of point indices: the lines, polygons and faces of a file."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error
from bathyal.errors import argument_error

Integers = NDArray[np.int64]


@dataclass(frozen=True)
class Cells:
    """Lists of point indices, one after the other.

    `connectivity` holds all indices; `ends[i]` is where list i ends in it.
    """

    connectivity: Integers = field(default_factory=lambda: np.empty(0, np.int64))
    ends: Integers = field(default_factory=lambda: np.empty(0, np.int64))

    def __len__(self) -> int:
        return len(self.ends)

    @property
    def starts(self) -> Integers:
        """Where each list starts in `connectivity`."""
        return self.ends - self.sizes

    @property
    def sizes(self) -> Integers:
        """How many indices each list has."""
        return np.diff(self.ends, prepend=0)

    def lists(self) -> list[Integers]:
        """One array of indices a cell."""
        return np.split(self.connectivity, self.ends[:-1]) if len(self) else []

    def check(self, point_count: int) -> None:
        """Raise `Error` where an end runs back or past the indices, or an index names no point."""
        if np.any(self.sizes < 0) or (self.ends[-1] if len(self) else 0) != len(self.connectivity):
            raise Error("the ends of the cells do not fit their indices")
        if len(self.connectivity) == 0:
            return
        low, high = int(self.connectivity.min()), int(self.connectivity.max())
        if low < 0 or high >= point_count:
            wrong = low if low < 0 else high
            raise Error(f"index {wrong} names no point, there are {point_count}")


def cells_of(lists: Any) -> Cells:
    """Cells from an (n, k) array of indices, (n,) for cells of one point, or lists of any lengths.

    Raises
    ------
    ValueError, TypeError
        For indices that are not whole numbers.
    """
    if isinstance(lists, Cells):
        return lists
    try:
        table = np.asarray(lists)
    except ValueError:  # lists of several lengths
        table = np.empty(0, object)
    if table.dtype != object and table.ndim == 2:
        sizes = np.full(len(table), table.shape[1], np.int64)
        flat = table.reshape(-1)
    elif table.dtype != object and table.ndim == 1:
        sizes, flat = np.ones(len(table), np.int64), table
    else:
        rows = [np.asarray(row) for row in lists]
        sizes = np.array([len(row) for row in rows], np.int64)
        flat = np.concatenate(rows)
    if flat.size and flat.dtype.kind not in "iu":
        raise argument_error("cells", "whole numbers", f"dtype {flat.dtype}")
    return Cells(np.ascontiguousarray(flat, np.int64), np.cumsum(sizes))
