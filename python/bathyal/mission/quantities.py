# SPDX-License-Identifier: BSD-3-Clause
"""Numbers with units, as missions are written: ``5 m``, ``0.5 m/s``, ``7 min``, ``20 deg``."""

from __future__ import annotations

import math
import re
from typing import Annotated, Any

from pydantic import BeforeValidator, Field

from bathyal.io.yaml_sections import Number

_UNITS: dict[str, dict[str, float]] = {
    "m": {"m": 1.0, "cm": 0.01, "km": 1000.0},
    "s": {"s": 1.0, "min": 60.0, "h": 3600.0},
    "m/s": {"m/s": 1.0, "cm/s": 0.01, "kn": 1852.0 / 3600.0},
    "rad": {"rad": 1.0, "deg": math.pi / 180.0},
    "1/h": {"1/h": 1.0, "/h": 1.0, "per hour": 1.0},
}
_QUANTITY = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([^\d\s].*?)\s*")


def parsed(value: Any, dimension: str) -> Any:
    """A number in SI units: as it is, or from a text with a unit.

    Raises
    ------
    ValueError
        For a text that is no number, or a unit of another dimension.

    Examples
    --------
    >>> parsed("7 min", "s"), parsed(3, "m")
    (420.0, 3)
    """
    if not isinstance(value, str):
        return value
    units = _UNITS[dimension]
    found = _QUANTITY.fullmatch(value)
    if found is None or found[2] not in units:
        raise ValueError(f"expected a number and one of {', '.join(units)}, got {value!r:.60}")
    return float(found[1]) * units[found[2]]


Metres = Annotated[Number, BeforeValidator(lambda value: parsed(value, "m"))]
NotNegativeMetres = Annotated[
    Number, Field(ge=0, le=1e6), BeforeValidator(lambda value: parsed(value, "m"))
]
PositiveMetres = Annotated[
    Number, Field(gt=0, le=1e6), BeforeValidator(lambda value: parsed(value, "m"))
]
Seconds = Annotated[Number, Field(ge=0, le=1e8), BeforeValidator(lambda value: parsed(value, "s"))]
PositiveSeconds = Annotated[
    Number, Field(gt=0, le=1e8), BeforeValidator(lambda value: parsed(value, "s"))
]
Speed = Annotated[Number, Field(gt=0, le=20), BeforeValidator(lambda value: parsed(value, "m/s"))]
Angle = Annotated[Number, BeforeValidator(lambda value: parsed(value, "rad"))]
Rate = Annotated[Number, Field(ge=0, le=1e6), BeforeValidator(lambda value: parsed(value, "1/h"))]
