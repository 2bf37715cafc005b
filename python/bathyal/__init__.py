# SPDX-License-Identifier: BSD-3-Clause
"""Supervised underwater manipulation: soundings to seabed to tool path."""

from bathyal._core import (
    CleanReport,
    CleanResult,
    Error,
    Plane,
    PointCloud,
    TriangleMesh,
    clean_cloud,
    generate_survey,
    survey_height,
)
from bathyal.clouds import read_cloud, write_cloud
from bathyal.meshes import read_mesh, write_mesh

__all__ = [
    "CleanReport",
    "CleanResult",
    "Error",
    "Plane",
    "PointCloud",
    "TriangleMesh",
    "clean_cloud",
    "generate_survey",
    "read_cloud",
    "read_mesh",
    "survey_height",
    "write_cloud",
    "write_mesh",
]
