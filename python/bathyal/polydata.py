# SPDX-License-Identifier: BSD-3-Clause
"""Points and the cells over them, as polygon files hold them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error

Integers = NDArray[np.int64]
Arrays = dict[str, NDArray[Any]]


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
        raise ValueError(f"cells: expected whole numbers, got dtype {flat.dtype}")
    return Cells(np.ascontiguousarray(flat, np.int64), np.cumsum(sizes))


@dataclass(frozen=True)
class PolyData:
    """What a polygon file holds.

    `cell_data` has one row a cell, in the order vertices, lines, strips, polygons. Texts are numpy
    arrays of str.
    """

    points: NDArray[np.float64]
    vertices: Cells = field(default_factory=Cells)
    lines: Cells = field(default_factory=Cells)
    strips: Cells = field(default_factory=Cells)
    polygons: Cells = field(default_factory=Cells)
    point_data: Arrays = field(default_factory=dict)
    cell_data: Arrays = field(default_factory=dict)
    field_data: Arrays = field(default_factory=dict)

    def triangles(self) -> Integers:
        """(T, 3) point indices of all strips and polygons, polygons cut into triangles."""
        return np.concatenate(
            [triangles_of_strips(self.strips), triangles_of_polygons(self.polygons)]
        )


def triangles_of_polygons(polygons: Cells) -> Integers:
    """(T, 3): each polygon as a fan about its first corner, which suits the convex ones.

    Raises
    ------
    Error
        For a polygon of fewer than three corners.
    """
    _check_corners("polygon", polygons)
    if np.all(polygons.sizes == 3):
        return polygons.connectivity.reshape(-1, 3)
    first, step = _windows(polygons)
    corners = np.column_stack([first, first + step + 1, first + step + 2])
    return np.take(polygons.connectivity, corners)


def triangles_of_strips(strips: Cells) -> Integers:
    """(T, 3): every second triangle of a strip is turned round, so that all face one way."""
    _check_corners("strip", strips)
    first, step = _windows(strips)
    odd = step % 2
    corners = np.column_stack([first + step, first + step + 1 + odd, first + step + 2 - odd])
    return np.take(strips.connectivity, corners)


def _check_corners(name: str, cells: Cells) -> None:
    short = np.flatnonzero(cells.sizes < 3)
    if len(short):
        size = int(cells.sizes[short[0]])
        raise Error(f"{name} {int(short[0])} has {size} corners, at least 3 are needed")


def _windows(cells: Cells) -> tuple[Integers, Integers]:
    """For each triangle: where its cell starts, and the triangle's number in the cell."""
    counts = cells.sizes - 2
    first = np.repeat(cells.starts, counts)
    step = np.arange(len(first)) - np.repeat(np.cumsum(counts) - counts, counts)
    return first, step
