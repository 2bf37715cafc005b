# SPDX-License-Identifier: BSD-3-Clause
"""Supervised underwater manipulation: soundings to seabed to tool path."""

from bathyal._core import Error, Nearest, Plane, PointCloud, Polyline, Scene, TriangleMesh

__all__ = ["Error", "Nearest", "Plane", "PointCloud", "Polyline", "Scene", "TriangleMesh"]
