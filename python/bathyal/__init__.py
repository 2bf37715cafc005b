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
    Targets,
    ToolPath,
    TriangleMesh,
    cover_polygon,
    find_targets,
    intersect_moller_trumbore,
    plan_toolpath,
)
from bathyal.aims import read_aims

__all__ = [
    "Error",
    "Hits",
    "Nearest",
    "Plane",
    "PointCloud",
    "Polyline",
    "Scene",
    "Targets",
    "ToolPath",
    "TriangleMesh",
    "cover_polygon",
    "find_targets",
    "intersect_moller_trumbore",
    "plan_toolpath",
    "read_aims",
]
