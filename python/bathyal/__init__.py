# SPDX-License-Identifier: BSD-3-Clause
"""Supervised underwater manipulation: soundings to seabed to tool path."""

from bathyal._core import (
    CleanReport,
    CleanResult,
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
    clean_cloud,
    find_sheets,
    fit_plane,
    generate_survey,
    intersect_moller_trumbore,
    mesh_report,
    survey_height,
)
from bathyal.clouds import read_cloud, write_cloud
from bathyal.meshes import read_mesh, write_mesh
from bathyal.terrain import SheetWarning, triangulate

__all__ = [
    "CleanReport",
    "CleanResult",
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
    "clean_cloud",
    "find_sheets",
    "fit_plane",
    "generate_survey",
    "intersect_moller_trumbore",
    "mesh_report",
    "read_cloud",
    "read_mesh",
    "survey_height",
    "triangulate",
    "write_cloud",
    "write_mesh",
]
