# SPDX-License-Identifier: BSD-3-Clause
"""Latitudes and longitudes as metres about a place."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

_EQUATOR = 6378137.0  # WGS 84 [m]
_FLATTENING = 1 / 298.257223563


def local_position(
    latitude_deg: Floats, longitude_deg: Floats
) -> tuple[Floats, tuple[float, float]]:
    """(N, 2) east and north of the first place [m], and that place's latitude and longitude [rad].

    In the plane that touches the ellipsoid (WGS 84) there.
    """
    latitude, longitude = np.radians(latitude_deg), np.radians(longitude_deg)
    square = _FLATTENING * (2.0 - _FLATTENING)
    prime = _EQUATOR / np.sqrt(1.0 - square * np.sin(latitude) ** 2)
    ring = prime * np.cos(latitude)
    axis = prime * (1.0 - square) * np.sin(latitude)
    turn = longitude - longitude[0]
    across = ring * np.cos(turn) - ring[0]
    north = -np.sin(latitude[0]) * across + np.cos(latitude[0]) * (axis - axis[0])
    origin = (float(latitude[0]), float(longitude[0]))
    return np.column_stack([ring * np.sin(turn), north]), origin


def local_place(east: float, north: float, origin: tuple[float, float]) -> tuple[float, float]:
    """Latitude and longitude [rad] of a place `east` and `north` of an origin [m].

    The inverse of `local_position`, by Newton's steps.
    """
    square = _FLATTENING * (2.0 - _FLATTENING)
    latitude, longitude = origin
    root = 1.0 - square * math.sin(latitude) ** 2
    along = _EQUATOR * (1.0 - square) / root**1.5
    across = _EQUATOR / math.sqrt(root) * math.cos(latitude)
    for _ in range(5):
        places = np.degrees([[origin[0], latitude], [origin[1], longitude]])
        (_, found), _ = local_position(*places)
        latitude += (north - found[1]) / along
        longitude += (east - found[0]) / across
    return latitude, longitude
