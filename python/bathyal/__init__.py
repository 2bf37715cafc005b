# SPDX-License-Identifier: BSD-3-Clause
"""Supervised underwater manipulation: soundings to seabed to tool path."""

from bathyal._core import (
    Error,
    Plane,
    PointCloud,
    TriangleMesh,
    generate_survey,
    survey_height,
)

__all__ = [
    "Error",
    "Plane",
    "PointCloud",
    "TriangleMesh",
    "generate_survey",
    "survey_height",
]
