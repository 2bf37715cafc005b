# SPDX-License-Identifier: BSD-3-Clause
"""Supervised underwater manipulation: soundings to seabed to tool path."""

from bathyal._core import (
    Error,
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
    plan_toolpath,
)
from bathyal.aims import read_aims

__all__ = [
    "Error",
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
    "plan_toolpath",
    "read_aims",
]
