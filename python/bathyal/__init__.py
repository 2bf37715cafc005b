# SPDX-License-Identifier: BSD-3-Clause
"""Supervised underwater manipulation: soundings to seabed to tool path."""

from bathyal._core import (
    Error,
    Hits,
    MeshReport,
    Nearest,
    Plane,
    PlaneFit,
    PointCloud,
    Polyline,
    Scene,
    SheetPatch,
    SheetReport,
    TriangleMesh,
    find_sheets,
    fit_plane,
    intersect_moller_trumbore,
    mesh_report,
)
from bathyal.terrain import SheetWarning, triangulate

__all__ = [
    "Error",
    "Hits",
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
    "TriangleMesh",
    "find_sheets",
    "fit_plane",
    "intersect_moller_trumbore",
    "mesh_report",
    "triangulate",
]
