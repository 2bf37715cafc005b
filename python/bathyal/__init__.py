# SPDX-License-Identifier: BSD-3-Clause
"""Supervised underwater manipulation: soundings to seabed to tool path."""

from bathyal._core import Error, Plane, PointCloud, TriangleMesh
from bathyal.meshes import read_mesh, write_mesh

__all__ = ["Error", "Plane", "PointCloud", "TriangleMesh", "read_mesh", "write_mesh"]
