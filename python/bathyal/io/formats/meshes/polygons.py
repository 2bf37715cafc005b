# SPDX-License-Identifier: BSD-3-Clause
"""Polygons and strips cut into triangles."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error
from bathyal.io.formats.meshes.cells import Cells, Integers

_MOST_CONCAVE_CORNERS = 1000  # cutting ears takes up to the cube of them


def triangles_of_polygons(polygons: Cells, points: NDArray[np.float64]) -> Integers:
    """(T, 3): convex polygons as a fan about their first corner, the others by cutting ears.

    Corners keep their direction round. A polygon that crosses itself has no right answer and
    becomes a fan too.

    Raises
    ------
    Error
        For a polygon of fewer than three corners, and a concave one of more than 1000.
    """
    _check_corners("polygon", polygons)
    if np.all(polygons.sizes == 3):
        return polygons.connectivity.reshape(-1, 3)
    first, step = _windows(polygons)
    corners = np.column_stack([first, first + step + 1, first + step + 2])
    triangles = np.take(polygons.connectivity, corners)
    row = np.cumsum(polygons.sizes - 2)
    for i in np.flatnonzero(_concave(polygons, points)).tolist():
        indices = polygons.connectivity[polygons.starts[i] : polygons.ends[i]]
        if len(indices) > _MOST_CONCAVE_CORNERS:
            raise Error(
                f"polygon {i} is concave and has {len(indices)} corners, the most is "
                f"{_MOST_CONCAVE_CORNERS}"
            )
        ears = _ears(points[indices])
        if ears is not None:
            triangles[row[i] - len(ears) : row[i]] = indices[ears]
    return triangles


def _concave(polygons: Cells, points: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Which polygons turn against their own normal at a corner."""
    corners = points[polygons.connectivity]
    start = np.repeat(polygons.starts, polygons.sizes)
    end = np.repeat(polygons.ends, polygons.sizes)
    here = np.arange(len(corners))
    after = np.where(here + 1 == end, start, here + 1)
    before = np.where(here == start, end - 1, here - 1)
    turn = np.cross(corners - corners[before], corners[after] - corners)
    from_first = corners - corners[start]
    areas = np.cross(from_first, from_first[after])
    normal = np.add.reduceat(areas, polygons.starts)
    against = np.einsum("ij,ij->i", turn, np.repeat(normal, polygons.sizes, axis=0)) < 0
    return np.asarray(np.logical_or.reduceat(against, polygons.starts))


def _ears(corners: NDArray[np.float64]) -> Integers | None:
    """(n - 2, 3) corners of the triangles cut off one by one; None where there is no ear left."""
    flat = _projected(corners)
    left = list(range(len(flat)))
    ears = []
    while len(left) > 3:
        found = next((i for i in range(len(left)) if _is_ear(flat[left], i)), None)
        if found is None:
            return None
        ears.append([left[found - 1], left[found], left[(found + 1) % len(left)]])
        del left[found]
    return np.array([*ears, left])


def _projected(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """(n, 2) along the axis the polygon faces most, its direction round made positive."""
    local = corners - corners[0]
    normal = np.cross(local, np.roll(local, -1, axis=0)).sum(axis=0)
    axis = int(np.argmax(np.abs(normal)))
    kept = [(axis + 1) % 3, (axis + 2) % 3]
    return np.take(local, kept if normal[axis] >= 0 else kept[::-1], axis=1)


def _is_ear(flat: NDArray[np.float64], i: int) -> bool:
    """Does the corner turn left, with no other corner in or on the triangle it would cut off?"""
    a, b, c = flat[i - 1], flat[i], flat[(i + 1) % len(flat)]
    if not _side(a, b, c[None])[0] > 0:
        return False
    others = flat[np.any(flat != a, axis=1) & np.any(flat != b, axis=1) & np.any(flat != c, axis=1)]
    inside = (_side(a, b, others) >= 0) & (_side(b, c, others) >= 0) & (_side(c, a, others) >= 0)
    return not np.any(inside)


def _side(
    a: NDArray[np.float64], b: NDArray[np.float64], points: NDArray[np.float64]
) -> NDArray[np.float64]:
    across = (b[0] - a[0]) * (points[:, 1] - a[1]) - (b[1] - a[1]) * (points[:, 0] - a[0])
    return np.asarray(across)


def triangles_of_strips(strips: Cells) -> Integers:
    """(T, 3): every second triangle of a strip is turned round, so that all face one way."""
    _check_corners("strip", strips)
    first, step = _windows(strips)
    parity = step % 2
    corners = np.column_stack([first + step, first + step + 1 + parity, first + step + 2 - parity])
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
