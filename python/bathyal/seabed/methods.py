# SPDX-License-Identifier: BSD-3-Clause
"""What clouds and meshes do in Python: files and figures. Attached when the package is imported."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from bathyal._core import PointCloud, TriangleMesh
from bathyal.attach import methods_of

if TYPE_CHECKING:
    import plotly.graph_objects  # type: ignore[import-untyped]


@methods_of(PointCloud)
class _PointCloud(PointCloud):
    def write(self, path: str | os.PathLike[str]) -> None:
        """Write a file of the format its suffix names.

        Parameters
        ----------
        path : path
            ``.ply``, ``.vtp``, ``.xyz``, ``.txt`` or ``.csv``: see bathyal.write_cloud.
        """
        from bathyal.seabed.clouds import write_cloud

        write_cloud(self, path)

    def show(self) -> plotly.graph_objects.Figure:
        """An interactive figure: the soundings, coloured by height.

        See bathyal.view.scene3d.show_cloud.
        """
        from bathyal.view.scene3d import show_cloud

        return show_cloud(self)


@methods_of(TriangleMesh)
class _TriangleMesh(TriangleMesh):
    def write(self, path: str | os.PathLike[str]) -> None:
        """Write a file of the format its suffix names.

        Parameters
        ----------
        path : path
            ``.vtp``, ``.ply``, ``.obj`` or ``.stl``: see bathyal.write_mesh.
        """
        from bathyal.seabed.meshes import write_mesh

        write_mesh(self, path)

    def show(self) -> plotly.graph_objects.Figure:
        """An interactive figure: the mesh, coloured by height.

        See bathyal.view.scene3d.show_mesh.
        """
        from bathyal.view.scene3d import show_mesh

        return show_mesh(self)
