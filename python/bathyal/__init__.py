# SPDX-License-Identifier: BSD-3-Clause
"""Supervised underwater manipulation: soundings to seabed to tool path."""

from importlib.metadata import version as _version

from bathyal import arms
from bathyal._core import (
    Arm,
    ArmFit,
    CleanReport,
    CleanResult,
    Error,
    Hits,
    InverseResult,
    Link,
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
    Touches,
    Tracked,
    TriangleMesh,
    clean_cloud,
    cover_polygon,
    find_sheets,
    find_targets,
    fit_plane,
    generate_survey,
    identify_arm,
    intersect_moller_trumbore,
    mesh_report,
    plan_toolpath,
    set_simd_level,
    simd_level,
    survey_height,
)
from bathyal.aims import read_aims
from bathyal.arm_files import read_arm
from bathyal.clouds import read_cloud, write_cloud
from bathyal.meshes import read_mesh, write_mesh
from bathyal.terrain import SheetWarning, triangulate
from bathyal.touch_files import read_touches, read_tracked
from bathyal.verification import verify_arm

__version__ = _version("bathyal")

__all__ = [
    "Arm",
    "ArmFit",
    "CleanReport",
    "CleanResult",
    "Error",
    "Hits",
    "InverseResult",
    "Link",
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
    "Touches",
    "Tracked",
    "TriangleMesh",
    "arms",
    "clean_cloud",
    "cover_polygon",
    "find_sheets",
    "find_targets",
    "fit_plane",
    "generate_survey",
    "identify_arm",
    "intersect_moller_trumbore",
    "mesh_report",
    "plan_toolpath",
    "read_aims",
    "read_arm",
    "read_cloud",
    "read_mesh",
    "read_touches",
    "read_tracked",
    "set_simd_level",
    "simd_level",
    "survey_height",
    "triangulate",
    "verify_arm",
    "write_cloud",
    "write_mesh",
]
