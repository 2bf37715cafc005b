# SPDX-License-Identifier: BSD-3-Clause
"""What a tool path does in Python: files and figures. Attached when the package is imported."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from bathyal._core import ToolPath
from bathyal.attach import methods_of

if TYPE_CHECKING:
    import plotly.graph_objects  # type: ignore[import-untyped]


@methods_of(ToolPath)
class _ToolPath(ToolPath):
    def write(self, path: str | os.PathLike[str]) -> None:
        """Write the path; every number keeps its full double precision.

        Parameters
        ----------
        path : path
            ``.csv``, ``.json`` or ``.vtp``: see bathyal.toolpath.paths.write_path.
        """
        from bathyal.toolpath.paths import write_path

        write_path(self, path)

    def show(self) -> plotly.graph_objects.Figure:
        """An interactive figure: the path, its targets and its approach arrows.

        See bathyal.view.scene3d.show_path.
        """
        from bathyal.view.scene3d import show_path

        return show_path(self)
