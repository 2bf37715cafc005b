# SPDX-License-Identifier: BSD-3-Clause
"""URDFs to read: made ones, small enough to see through, and the real ones next to the project."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import bathyal
from bathyal._core import arm_parts

DATA = Path(__file__).parents[3] / "shared" / "data"

# The arms of the shared data that Pinocchio reads too: file and tip.
REAL = {
    "panda": ("arms/mukca/urdf/panda.urdf", "ball_link"),
    "panda_plus_bota": ("arms/mukca/urdf/panda_plus_bota.urdf", "ball_link"),
    "gen3lite": ("arms/mukca/urdf/gen3lite.urdf", "ball_link"),
    "iiwa14": ("arms/mukca/urdf/iiwa14.urdf", None),
    "iiwa14_epfl": ("arms/mukca/urdf/iiwa14_epfl.urdf", "ball_link"),
    "vx300s": ("arms/mukca/urdf/vx300s.urdf", "ball_link"),
    "trailblazer": ("arms/hilti-jaibot/trailblazer.urdf", "prism"),
    "alpha_seabotix": ("uvms/urdf/alpha_seabotix.urdf", "r5m_jaw"),
}

LIMIT = '<limit lower="-2" upper="2" velocity="1" effort="10"/>'


def joint(
    name: str,
    parent: str,
    child: str,
    *,
    kind: str = "revolute",
    xyz: str = "0 0 0.5",
    rpy: str = "0 0 0",
    more: str = '<axis xyz="0 1 0"/>' + LIMIT,
) -> str:
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{xyz}" rpy="{rpy}"/>{more}</joint>'
    )


def links(*names: str) -> str:
    return "".join(f'<link name="{name}"/>' for name in names)


def robot(*parts: str, name: str = "made") -> str:
    return f'<?xml version="1.0"?>\n<robot name="{name}">{"".join(parts)}</robot>\n'


def two_joints(*more: str) -> str:
    """foot, upper and lower arm: a plane arm about y."""
    return robot(
        links("foot", "upper", "lower"),
        joint("shoulder", "foot", "upper"),
        joint("elbow", "upper", "lower"),
        *more,
    )


def written(folder: Path, text: str | bytes, name: str = "arm.urdf") -> Path:
    path = folder / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def read_text(folder: Path, text: str | bytes, **options: Any) -> bathyal.Arm:
    return bathyal.Arm.from_urdf(written(folder, text), **options)


def joint_values(arm: bathyal.Arm, q: NDArray[np.float64]) -> dict[str, float]:
    """The value of every moving joint of the arm, by its name."""
    return {
        joint["name"]: joint["multiplier"] * q[joint["coordinate"]] + joint["offset"]
        for joint in arm_parts(arm)["joints"]
        if joint["type"] != "fixed"
    }
