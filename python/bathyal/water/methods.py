# SPDX-License-Identifier: BSD-3-Clause
"""What a cast does in Python: figures. Attached when the package is imported."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from bathyal._core import Profile
from bathyal.attach import methods_of

if TYPE_CHECKING:
    import matplotlib.figure


@methods_of(Profile)
class _Profile(Profile):
    def plot(self, path: str | os.PathLike[str] | None = None) -> matplotlib.figure.Figure:
        """A figure: sound speed by depth, with temperature and salinity where they are known.

        Parameters
        ----------
        path : path, optional
            A picture of it, replaced as a whole: ``.png``, ``.pdf``, ``.svg``.

        Returns
        -------
        matplotlib.figure.Figure
        """
        from bathyal.view.casts import cast_figure, write_figure

        figure = cast_figure(self)
        if path is not None:
            write_figure(figure, path)
        return figure
