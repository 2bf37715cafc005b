# SPDX-License-Identifier: BSD-3-Clause
"""What a workspace does in Python: pages that play a motion. Attached when the package is
imported."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy.typing

from bathyal._core import Workspace
from bathyal.attach import methods_of

if TYPE_CHECKING:
    import bathyal.view.motion_page


@methods_of(Workspace)
class _Workspace(Workspace):
    def show(
        self,
        q: numpy.typing.ArrayLike,
        time: numpy.typing.ArrayLike | None = None,
        *,
        target: numpy.typing.ArrayLike | None = None,
    ) -> bathyal.view.motion_page.MotionPage:
        """A page that plays a motion: hull, arm, bottom, keep-outs, clearance.

        Parameters
        ----------
        q : (K, n) array
            Joint values [rad] or [m]; one posture (n,) is drawn at rest.
        time : (K,) array, optional
            Of each row [s], rising; 0.1 s from row to row unless given.
        target : (3,) array, optional
            In the world [m].

        Returns
        -------
        bathyal.view.motion_page.MotionPage
            Shown by Jupyter; ``.write("motion.html")`` writes it to a file that needs no network.

        Raises
        ------
        ValueError
            For rows that are not as many as times, or none.
        """
        from bathyal.view.motion_page import MotionPage
        from bathyal.workspace.motion import evenly_timed, motion_of

        return MotionPage(motion_of(self, *evenly_timed(q, time), target=target))
