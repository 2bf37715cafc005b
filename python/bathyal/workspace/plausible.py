# SPDX-License-Identifier: BSD-3-Clause
"""Sizes that no vehicle has: millimetres taken for metres, coordinates of another frame."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

LARGEST = 50.0  # [m], of a hull's longest side
SMALLEST = 0.05
FARTHEST = 100.0  # [m] of a hull from the origin of its own frame


def size_warnings(low: Array, high: Array, what: str) -> list[str]:
    """What is not plausible about a body's box, (3,) corners [m] in the vehicle's frame.

    Examples
    --------
    >>> size_warnings(np.array([-300.0, -200, -100]), np.array([300.0, 200, 100]), "the hull")
    ['the hull is 600 m long: millimetres taken for metres? Then give scale: 0.001']
    """
    longest = float(np.max(high - low))
    lines = []
    if longest > LARGEST:
        remedy = "millimetres taken for metres? Then give scale: 0.001"
        lines.append(f"{what} is {longest:,.4g} m long: {remedy}")
    elif longest < SMALLEST:
        remedy = "metres taken for millimetres? Then give scale: 1000"
        lines.append(f"{what} is {longest:.3g} m long: {remedy}")
    nearest = np.clip(0.0, low, high)
    away = float(np.linalg.norm(nearest))
    if away > max(FARTHEST, 2 * longest):
        lines.append(
            f"{what} lies {away:,.4g} m from the origin of the vehicle's frame: it is to be given "
            "in that frame, not in the world's"
        )
    return lines
