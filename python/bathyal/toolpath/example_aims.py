# SPDX-License-Identifier: BSD-3-Clause
"""Camera axes that go with a generated survey."""

from __future__ import annotations

import os

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bathyal._core import PointCloud
from bathyal.arrays import unmasked
from bathyal.io.files import replacing

# Where an operator might point, as shares of the survey's length and width: along the sand waves,
# through the trench and over the stripe that was lost; the last axis looks past the survey.
_PLACES = ((0.12, 0.25), (0.30, 0.38), (0.47, 0.30), (0.58, 0.62), (0.74, 0.70), (0.86, 0.45))
_PAST = (1.02, 0.45)
_ALTITUDE = 3.0  # of the camera above the highest sounding [m]
_FORWARD = 0.45  # of the axis, for each metre down


def aims_over(cloud: PointCloud) -> NDArray[np.float64]:
    """Camera axes (7, 6) over a survey, in its frame [m]; the last one misses it.

    Examples
    --------
    >>> import bathyal
    >>> aims_over(bathyal.generate_survey(seed=1)).shape
    (7, 6)
    """
    points = np.asarray(cloud.points)
    low, high = points.min(axis=0), points.max(axis=0)
    places = low[:2] + np.array([*_PLACES, _PAST]) * (high - low)[:2]
    height = np.full(len(places), high[2] + _ALTITUDE)
    direction = np.tile([_FORWARD, 0.0, -1.0], (len(places), 1))
    return np.round(np.column_stack([places, height, direction]), 3)


def write_aims(aims: ArrayLike, path: str | os.PathLike[str]) -> None:
    """Write camera axes (K, 6) as text that `read_aims` reads back, number for number."""
    with replacing(path) as aside, open(aside, "w", encoding="utf-8") as stream:
        stream.write("# camera axes in the survey's frame: a point and a direction each\n")
        stream.write("px_m,py_m,pz_m,dx,dy,dz\n")
        for row in unmasked("aims", aims).astype(float).tolist():
            stream.write(",".join(map(repr, row)) + "\n")
