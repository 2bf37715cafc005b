# SPDX-License-Identifier: BSD-3-Clause
"""Supervised underwater manipulation: soundings to seabed to tool path."""

from importlib.metadata import version as _version

from bathyal import arms, effects
from bathyal._core import (
    Arm,
    ArmFit,
    CleanReport,
    CleanResult,
    CorrectedArm,
    Diagnosis,
    Error,
    Hits,
    Hull,
    HullReport,
    InverseResult,
    KeepOut,
    Link,
    MeshReport,
    Nearest,
    Plane,
    PlaneFit,
    PointCloud,
    Polyline,
    RigidBody,
    Scene,
    Shape,
    SheetPatch,
    SheetReport,
    Targets,
    ToolPath,
    Touches,
    TouchForecast,
    TouchPlan,
    Tracked,
    TriangleMesh,
    Voxels,
    clean_cloud,
    cover_polygon,
    diagnose,
    find_sheets,
    find_targets,
    fit_plane,
    forecast_touches,
    generate_survey,
    identify_arm,
    intersect_moller_trumbore,
    mesh_report,
    plan_toolpath,
    plan_touches,
    set_simd_level,
    simd_level,
    survey_height,
)
from bathyal.arm import methods as _arm_methods  # noqa: F401
from bathyal.arm.files import read_arm
from bathyal.arm.mesh_paths import mesh_path
from bathyal.arm.support_warning import SupportWarning
from bathyal.diagnosis import methods as _diagnosis_methods  # noqa: F401
from bathyal.identify import methods as _identify_methods  # noqa: F401
from bathyal.identify.touch_files import read_touches, read_tracked
from bathyal.identify.verify import verify_arm
from bathyal.seabed import methods as _seabed_methods  # noqa: F401
from bathyal.seabed.clouds import read_cloud, write_cloud
from bathyal.seabed.meshes import read_mesh, write_mesh
from bathyal.seabed.triangulate import SheetWarning, triangulate
from bathyal.toolpath import methods as _toolpath_methods  # noqa: F401
from bathyal.toolpath.aims import read_aims

__version__ = _version("bathyal")

__all__ = [
    "Arm",
    "ArmFit",
    "CleanReport",
    "CleanResult",
    "CorrectedArm",
    "Diagnosis",
    "Error",
    "Hits",
    "Hull",
    "HullReport",
    "InverseResult",
    "KeepOut",
    "Link",
    "MeshReport",
    "Nearest",
    "Plane",
    "PlaneFit",
    "PointCloud",
    "Polyline",
    "RigidBody",
    "Scene",
    "Shape",
    "SheetPatch",
    "SheetReport",
    "SheetWarning",
    "SupportWarning",
    "Targets",
    "ToolPath",
    "TouchForecast",
    "TouchPlan",
    "Touches",
    "Tracked",
    "TriangleMesh",
    "Voxels",
    "arms",
    "clean_cloud",
    "cover_polygon",
    "diagnose",
    "effects",
    "find_sheets",
    "find_targets",
    "fit_plane",
    "forecast_touches",
    "generate_survey",
    "identify_arm",
    "intersect_moller_trumbore",
    "mesh_path",
    "mesh_report",
    "plan_toolpath",
    "plan_touches",
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
