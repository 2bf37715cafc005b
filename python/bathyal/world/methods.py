# SPDX-License-Identifier: BSD-3-Clause
"""What a world does in Python: its picture. Attached when the package is imported."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bathyal._core import World
from bathyal.attach import methods_of

if TYPE_CHECKING:
    import matplotlib.figure


@methods_of(World)
class _World(World):
    def show(self, time: float = 0.0) -> matplotlib.figure.Figure:
        """The world from above, shaded: in a notebook a picture, else `.savefig(path)`.

        Parameters
        ----------
        time : float
            At which it is drawn [s].

        Returns
        -------
        matplotlib.figure.Figure
        """
        from bathyal.view.world_map import world_figure

        return world_figure(self, time)
