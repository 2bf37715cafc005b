# SPDX-License-Identifier: BSD-3-Clause
"""Supervised underwater manipulation: soundings to seabed to tool path."""

from bathyal._core import (
    Error,
    MeshReport,
    Plane,
    PlaneFit,
    PointCloud,
    SheetPatch,
    SheetReport,
    TriangleMesh,
    find_sheets,
    fit_plane,
    mesh_report,
)
from bathyal.terrain import SheetWarning, triangulate

__all__ = [
    "Error",
    "MeshReport",
    "Plane",
    "PlaneFit",
    "PointCloud",
    "SheetPatch",
    "SheetReport",
    "SheetWarning",
    "TriangleMesh",
    "find_sheets",
    "fit_plane",
    "mesh_report",
    "triangulate",
]
