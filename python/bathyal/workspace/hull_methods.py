# SPDX-License-Identifier: BSD-3-Clause
"""What hulls and their voxels do in Python: figures. Attached when the package is imported."""

from __future__ import annotations

import os

from bathyal._core import Voxels
from bathyal.attach import methods_of


@methods_of(Voxels)
class _Voxels(Voxels):
    def plot(self, path: str | os.PathLike[str]) -> None:
        """Draw slices of the voxels, one across each axis, where most is inside.

        Parameters
        ----------
        path : path
            Of a PNG: see bathyal.view.voxels.voxels_figure.
        """
        from bathyal.view.figure import write_png
        from bathyal.view.voxels import voxels_figure

        write_png(voxels_figure(self), path)
