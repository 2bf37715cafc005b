# SPDX-License-Identifier: BSD-3-Clause
"""Points and the cells over them, as polygon files hold them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal.io.formats.meshes.cells import Cells
from bathyal.io.formats.meshes.polygons import triangles_of_polygons, triangles_of_strips

Integers = NDArray[np.int64]
Arrays = dict[str, NDArray[Any]]


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
        strips = triangles_of_strips(self.strips)
        return np.concatenate([strips, triangles_of_polygons(self.polygons, self.points)])
