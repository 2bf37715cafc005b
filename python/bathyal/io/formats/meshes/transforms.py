# SPDX-License-Identifier: BSD-3-Clause
"""The transforms of a COLLADA node, each a 4×4 matrix parent_from_node."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error

Matrix = NDArray[np.float64]


def _matrix(numbers: Matrix) -> Matrix:
    return _counted(numbers, 16).reshape(4, 4)


def _translate(numbers: Matrix) -> Matrix:
    matrix = np.eye(4)
    matrix[:3, 3] = _counted(numbers, 3)
    return matrix


def _scale(numbers: Matrix) -> Matrix:
    return np.diag([*_counted(numbers, 3), 1.0])


def _rotate(numbers: Matrix) -> Matrix:
    """Axis and angle [deg], by Rodrigues' formula."""
    x, y, z, angle = _counted(numbers, 4)
    axis = _unit(np.array([x, y, z]))
    cross = np.cross(np.eye(3), axis)  # cross @ v = axis × v
    matrix = np.eye(4)
    sine, cosine = np.sin(np.radians(angle)), np.cos(np.radians(angle))
    matrix[:3, :3] += sine * cross + (1 - cosine) * cross @ cross
    return matrix


def _look_at(numbers: Matrix) -> Matrix:
    """Eye, point of interest and up: the node looks along its −z."""
    eye, interest, up = _counted(numbers, 9).reshape(3, 3)
    back = _unit(eye - interest)
    right = _unit(np.cross(up, back))
    matrix = np.eye(4)
    matrix[:3] = np.column_stack([right, np.cross(back, right), back, eye])
    return matrix


def _skew(numbers: Matrix) -> Matrix:
    raise Error("its scene has a skew transform, which is not read")


def _counted(numbers: Matrix, count: int) -> Matrix:
    if len(numbers) != count or not np.all(np.isfinite(numbers)):
        raise Error(f"a transform of {count} finite numbers has {len(numbers)}")
    return numbers


def _unit(vector: Matrix) -> Matrix:
    length = np.linalg.norm(vector)
    if length == 0:
        raise Error("a transform has an axis of no length")
    return np.asarray(vector / length)


TRANSFORMS: dict[str, Callable[[Matrix], Matrix]] = {
    "matrix": _matrix,
    "translate": _translate,
    "scale": _scale,
    "rotate": _rotate,
    "lookat": _look_at,
    "skew": _skew,
}
