# SPDX-License-Identifier: BSD-3-Clause
"""What a reader of points hands on: columns in the file's units, and what the file says of them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error, check_bytes
from bathyal.io.formats.crs import Units

_METRES = {"m", "metre", "metres", "meter", "meters"}


@dataclass(frozen=True)
class Soundings:
    """Points as a file has them.

    `depth` is how the file calls its third coordinate where it calls it a depth; `unit` is the unit
    it names for a column or band where that is not the metre; `units` are those of its reference
    system, where more is known of them than `crs` and `vertical_datum` hold.
    """

    points: NDArray[np.float64]
    attributes: dict[str, NDArray[Any]] = field(default_factory=dict)
    crs: str = ""
    vertical_datum: str = ""
    depth: str = ""
    unit: str = ""
    units: Units | None = None


def is_metre(unit: str) -> bool:
    return unit.strip().lower() in _METRES


def check_cells(cells: int, width: int, size: int, most_per_byte: int) -> None:
    """Refuse a grid before memory is taken for it: one that a file of `size` bytes cannot hold, or
    whose cells of `width` bytes are more than one file may take."""
    if cells > size * most_per_byte:
        raise Error(f"its header announces {cells} cells, too many for {size} bytes")
    check_bytes(f"its grid of {cells} cells", cells * width)


def joined_rows(blocks: Iterable[NDArray[np.float64]], width: int) -> NDArray[np.float64]:
    """Tables of `width` columns one below the other, their sum checked as they come."""
    kept = [np.empty((0, width))]
    taken = 0
    for block in blocks:
        taken += block.nbytes
        check_bytes("its cells with a value", taken)
        kept.append(block)
    return np.concatenate(kept)
