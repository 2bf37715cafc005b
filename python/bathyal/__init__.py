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
    generate_survey,
    mesh_report,
    plan_toolpath,
    survey_height,
)
from bathyal.aims import read_aims
from bathyal.clouds import read_cloud, write_cloud
from bathyal.meshes import read_mesh, write_mesh
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
    "generate_survey",
    "mesh_report",
    "plan_toolpath",
    "read_aims",
    "read_cloud",
    "read_mesh",
    "survey_height",
    "triangulate",
    "write_cloud",
    "write_mesh",
]
