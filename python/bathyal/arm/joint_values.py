# SPDX-License-Identifier: BSD-3-Clause
"""The coordinates of an arm's joints, in the units that people read."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Arm, Touches, Tracked

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class JointValues:
    """A joint's values as people read them."""

    name: str
    unit: str
    values: Floats


def joint_values(arm: Arm, data: Touches | Tracked) -> list[JointValues]:
    """Each coordinate in degrees or millimetres."""
    return [
        JointValues(name, "mm", 1e3 * values)
        if kind == "prismatic"
        else JointValues(name, "°", np.degrees(values))
        for name, kind, values in zip(arm.joint_names, arm.joint_types, data.q.T, strict=True)
    ]
