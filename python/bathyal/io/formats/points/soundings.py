# SPDX-License-Identifier: BSD-3-Clause
"""What a reader of points hands on: columns in the file's units, and what the file says of them."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error

_METRES = {"m", "metre", "metres", "meter", "meters"}


@dataclass(frozen=True)
class Soundings:
    """Points as a file has them.

    `depth` is how the file calls its third coordinate where it calls it a depth; `unit` is the unit
    it names where that is not the metre.
    """

    points: NDArray[np.float64]
    attributes: dict[str, NDArray[Any]] = field(default_factory=dict)
    crs: str = ""
    vertical_datum: str = ""
    depth: str = ""
    unit: str = ""


def is_metre(unit: str) -> bool:
    return unit.strip().lower() in _METRES


def check_projected(crs: str) -> None:
    """Degrees are no metres, and which projection suits is the surveyor's to say."""
    if re.match(r"\s*(GEOGCS|GEOGCRS|GEODCRS|GEOGRAPHICCRS|GEODETICCRS|GEOCCS)\b", crs, re.I):
        raise Error(
            f"its positions are longitude and latitude ({crs[:60]}…): project them first, "
            "for instance to UTM"
        )


def vertical_datum_of_wkt(crs: str) -> str:
    """The name of the vertical part of a compound reference system, "" where it has none."""
    found = re.search(r'(?:VERT_CS|VERTCS|VERTCRS|VERTICALCRS)\s*\[\s*"([^"]*)"', crs, re.I)
    return found[1] if found else ""


def check_cells(cells: int, size: int, most_per_byte: int) -> None:
    """Refuse a grid that a file of `size` bytes cannot hold, before memory is taken for it."""
    if cells > size * most_per_byte:
        raise Error(f"its header announces {cells} cells, too many for {size} bytes")
