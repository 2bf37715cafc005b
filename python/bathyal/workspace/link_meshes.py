# SPDX-License-Identifier: BSD-3-Clause
"""Corners of the meshes that an arm's links name, for capsules around them."""

from __future__ import annotations

import numpy as np

from bathyal._core import Error, Shape, read_mesh_with
from bathyal.arm.mesh_paths import mesh_path
from bathyal.seabed.meshes import read_mesh


def mesh_vertices(shape: Shape) -> np.ndarray | None:
    """(N, 3) corners of a shape's mesh along its scale [m]; None where it cannot be read.

    Only files in the folder of the URDF and below are opened: see bathyal.mesh_path.
    """
    try:
        corners = read_mesh(mesh_path(shape)).vertices
    except (OSError, ValueError, Error):
        return None
    return np.asarray(corners * shape.scale, dtype=float)


read_mesh_with(mesh_vertices)  # what Workspace fits capsules with
