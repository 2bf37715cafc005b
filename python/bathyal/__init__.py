# SPDX-License-Identifier: BSD-3-Clause
"""Supervised underwater manipulation: soundings to seabed to tool path."""

from bathyal._core import (
    Error,
    Hits,
    Nearest,
    Plane,
    PointCloud,
    Polyline,
    Scene,
    TriangleMesh,
    intersect_moller_trumbore,
)

__all__ = [
    "Error",
    "Hits",
    "Nearest",
    "Plane",
    "PointCloud",
    "Polyline",
    "Scene",
    "TriangleMesh",
    "intersect_moller_trumbore",
]
