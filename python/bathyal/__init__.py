# SPDX-License-Identifier: BSD-3-Clause
"""Supervised underwater manipulation: soundings to seabed to tool path."""

from bathyal._core import (
    Error,
    MeshReport,
    Nearest,
    Plane,
    PlaneFit,
    PointCloud,
    Polyline,
    Scene,
    SheetPatch,
    SheetReport,
    Targets,
    ToolPath,
    TriangleMesh,
    cover_polygon,
    find_sheets,
    find_targets,
    fit_plane,
    mesh_report,
    plan_toolpath,
)
from bathyal.aims import read_aims
from bathyal.terrain import SheetWarning, triangulate

__all__ = [
    "Error",
    "MeshReport",
    "Nearest",
    "Plane",
    "PlaneFit",
    "PointCloud",
    "Polyline",
    "Scene",
    "SheetPatch",
    "SheetReport",
    "SheetWarning",
    "Targets",
    "ToolPath",
    "TriangleMesh",
    "cover_polygon",
    "find_sheets",
    "find_targets",
    "fit_plane",
    "mesh_report",
    "plan_toolpath",
    "read_aims",
    "triangulate",
]
