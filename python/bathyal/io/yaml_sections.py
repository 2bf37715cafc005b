# SPDX-License-Identifier: BSD-3-Clause
"""What the sections of all YAML files are made of: numbers, names, poses.

Lengths are in metres, angles in radians, or in degrees where the key ends in ``_deg``.
"""

from __future__ import annotations

import math
from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field, model_validator

from bathyal.io.poses import pose_of

Array = NDArray[np.float64]

Number = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Positive = Annotated[Number, Field(gt=0)]
NotNegative = Annotated[Number, Field(ge=0)]
Whole = Annotated[int, Field(strict=True, ge=0)]
Vector = tuple[Number, Number, Number]
Spread = tuple[NotNegative, NotNegative, NotNegative]
Name = Annotated[str, Field(min_length=1, max_length=200)]
FileName = Annotated[str, Field(min_length=1, max_length=1000)]

ORIGIN = (0.0, 0.0, 0.0)


class Section(BaseModel):
    """Keys that are not known are refused."""

    model_config = ConfigDict(extra="forbid", frozen=True, hide_input_in_errors=False)


def one_of(section: BaseModel, *names: str, needed: bool = False) -> str | None:
    """The one of these keys that is given."""
    given = [name for name in names if getattr(section, name) is not None]
    if len(given) > 1:
        raise ValueError(f"expected one of {', '.join(names)}, got {' and '.join(given)}")
    if needed and not given:
        raise ValueError(f"expected one of {', '.join(names)}, got none")
    return given[0] if given else None


def radians(section: BaseModel, name: str) -> tuple[float, ...] | None:
    """The value of `name`, or of `name`_deg."""
    value = getattr(section, name)
    if value is not None:
        return tuple(value)
    degrees = getattr(section, f"{name}_deg")
    return None if degrees is None else tuple(math.radians(angle) for angle in degrees)


class PoseSection(Section):
    """A place and three turns: roll about x, then pitch about y, then yaw about z, all fixed axes.
    In the vehicle's frame (x forward, y port, z up) a positive pitch is nose down."""

    position: Vector = ORIGIN
    rpy: Vector | None = None
    rpy_deg: Vector | None = None

    @model_validator(mode="after")
    def _one_unit(self) -> PoseSection:
        one_of(self, "rpy", "rpy_deg")
        return self

    def matrix(self) -> Array:
        """(4, 4)."""
        return pose_of(self.position, radians(self, "rpy") or ORIGIN)
