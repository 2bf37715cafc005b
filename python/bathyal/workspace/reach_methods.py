# SPDX-License-Identifier: BSD-3-Clause
"""What reach maps do in Python: files and figures. Attached when the package is imported."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from bathyal._core import ReachMap
from bathyal.attach import methods_of

if TYPE_CHECKING:
    import plotly.graph_objects  # type: ignore[import-untyped]


@methods_of(ReachMap)
class _ReachMap(ReachMap):
    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the map; `bathyal.read_reach_map` reads it.

        Parameters
        ----------
        path : path
            ``.npz``: see bathyal.workspace.reach_files.write_reach_map.
        """
        from bathyal.workspace.reach_files import write_reach_map

        write_reach_map(self, path)

    def plot(self, path: str | os.PathLike[str]) -> None:
        """Draw slices of the map, one across each axis, where most is reached.

        Parameters
        ----------
        path : path
            Of a PNG: see bathyal.view.reach.reach_figure.
        """
        from bathyal.view.figure import write_png
        from bathyal.view.reach import reach_figure

        write_png(reach_figure(self), path)

    def show(self) -> plotly.graph_objects.Figure:
        """An interactive figure: the voxels as a cloud, coloured by directions.

        See bathyal.view.reach_cloud.show_reach.
        """
        from bathyal.view.reach_cloud import show_reach

        return show_reach(self)
