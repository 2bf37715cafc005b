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

__all__ = [
    "CleanReport",
    "CleanResult",
    "Error",
    "Plane",
    "PointCloud",
    "TriangleMesh",
    "clean_cloud",
    "generate_survey",
    "survey_height",
]
