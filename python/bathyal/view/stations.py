# SPDX-License-Identifier: BSD-3-Clause
"""The tool path unrolled into a vertical section: what the profile of a plan is drawn from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from bathyal._core import ToolPath

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Stations:
    """Each point of a path, segment after segment, in the section's own plane.

    Distances run along the horizontal from target to target, so that the section of an overhang
    runs back under itself as it does on the ground, and angles in the plane stay true.

    bottom, tool : (M, 2) arrays
        Distance and height [m] of the surface point and of the tool centre point.
    approach : (M, 2) array
        a_j in the section's plane: its part along the section and its part upwards.
    start, along : (S, 3) arrays
        Where each segment begins [m] and its horizontal unit direction (zero for a segment that
        leads straight up or down).
    begin, end : (S,) arrays
        Distances at which each segment begins and ends [m]. Where a gap leads to the next segment
        that one begins further on.
    segments : (S,) array of int
        Their numbers in `path.segment`.
    """

    bottom: Floats
    tool: Floats
    approach: Floats
    start: Floats
    along: Floats
    begin: Floats
    end: Floats
    segments: NDArray[np.int32]

    def at_target(self, row: int) -> float:
        """The distance at which target `row` lies [m]: its segment's begin, or the end."""
        segment = int(np.searchsorted(self.segments, row))
        return float(self.begin[segment] if segment < len(self.begin) else self.end[-1])


def unroll(path: ToolPath) -> Stations:
    """The sections of all segments one after the other."""
    surface, segment = np.asarray(path.surface), np.asarray(path.segment)
    segments, first, counts = np.unique(segment, return_index=True, return_counts=True)
    last = first + counts - 1
    start, finish = surface[first], surface[last]
    joined = np.flatnonzero(~np.asarray(path.gap, bool)[last[:-1]])
    finish[joined] = start[joined + 1]  # the target between two segments is the next one's sample
    # What a rolling ball touches first and last lies next to the targets, not on them.
    targets = np.asarray(path.targets.point)
    for ends, rows in ((start, segments), (finish, segments + 1)):
        known = np.flatnonzero(rows < len(targets))
        known = known[np.isfinite(targets[rows[known]]).all(axis=1)]
        ends[known] = targets[rows[known]]
    span = (finish - start) * [1.0, 1.0, 0.0]
    length = np.linalg.norm(span, axis=1)
    along = np.divide(span, length[:, None], out=np.zeros_like(span), where=length[:, None] > 0)
    between = np.linalg.norm((start[1:] - finish[:-1])[:, :2], axis=1)
    begin = np.concatenate([[0.0], np.cumsum(length[:-1] + between)])

    of_point = np.searchsorted(segments, segment)
    direction, origin, offset = along[of_point], start[of_point], begin[of_point]

    def section(points: Floats) -> Floats:
        distance = offset + np.einsum("ij,ij->i", points - origin, direction)
        return np.column_stack([distance, points[:, 2]])

    approach = np.asarray(path.approach)
    return Stations(
        bottom=section(surface),
        tool=section(np.asarray(path.position)),
        approach=np.column_stack([np.einsum("ij,ij->i", approach, direction), approach[:, 2]]),
        start=start,
        along=along,
        begin=begin,
        end=begin + length,
        segments=segments.astype(np.int32),
    )


def runs(path: ToolPath) -> list[tuple[int, int]]:
    """First and last point of each stretch of one segment without a gap inside it.

    A stretch that goes over into the next segment without a gap ends on that segment's first
    point, so that drawn lines join.
    """
    gap, segment = np.asarray(path.gap, bool), np.asarray(path.segment)
    count = len(segment)
    if count == 0:
        return []
    new = np.flatnonzero(gap[:-1] | (np.diff(segment) != 0)) + 1
    begins = np.concatenate([[0], new])
    ends = np.concatenate([new - 1, [count - 1]])
    joined = np.append(~gap[ends[:-1]], False)
    return [
        (int(begin), int(end + join)) for begin, end, join in zip(begins, ends, joined, strict=True)
    ]


def spread(points: Floats, count: int) -> NDArray[np.int64]:
    """Rows of about `count` points, evenly spread along the polyline (M, k), ends included."""
    if len(points) == 0:
        return np.zeros(0, np.int64)
    step = np.linalg.norm(np.diff(points, axis=0), axis=1)
    travelled = np.concatenate([[0.0], np.cumsum(step)])
    wanted = np.linspace(0.0, travelled[-1], max(count, 1))
    rows: NDArray[np.int64] = np.searchsorted(travelled, wanted)
    return np.unique(np.clip(rows, 0, len(points) - 1)).astype(np.int64)


def axis_ends(aims: Floats, path: ToolPath) -> Floats:
    """Where camera axes (K, 6) are drawn to [m]: their targets, or for those without one as far as
    the others reach."""
    targets = path.targets
    hit = np.isfinite(targets.point).all(axis=1)
    reach = float(np.median(targets.range[hit])) if hit.any() else 1.0
    unit = aims[:, 3:] / np.linalg.norm(aims[:, 3:], axis=1, keepdims=True)
    return np.where(hit[:, None], targets.point, aims[:, :3] + reach * unit)
