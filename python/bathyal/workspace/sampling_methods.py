# SPDX-License-Identifier: BSD-3-Clause
"""What a sampling plan does in Python: pages that play it, and files. Attached when the package is
imported."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from bathyal._core import SamplingPlan, Workspace
from bathyal.attach import methods_of

if TYPE_CHECKING:
    import bathyal.view.motion_page


@methods_of(SamplingPlan)
class _SamplingPlan(SamplingPlan):
    def show(self, ws: Workspace) -> bathyal.view.motion_page.MotionPage:
        """A page that plays the plan: hull, arm, bottom, keep-outs, clearance, wrench.

        Parameters
        ----------
        ws : Workspace
            That it was planned in.

        Returns
        -------
        bathyal.view.motion_page.MotionPage
            Shown by Jupyter; ``.write("motion.html")`` writes it to a file that needs no network.

        Raises
        ------
        ValueError
            For a plan without phases.
        """
        from bathyal.view.motion_page import MotionPage
        from bathyal.workspace.sample_job import motion_of_plan

        return MotionPage(motion_of_plan(ws, self))

    def write(self, path: str | os.PathLike[str], ws: Workspace) -> None:
        """Write the plan; the file appears whole or not at all.

        Parameters
        ----------
        path : path
            ``.html``: the page of `show`. ``.png``: a sheet with six moments and the curves.
            ``.csv``: joints, tip, wrench and clearance over time. ``.yaml`` or ``.json``: ROS'
            trajectory_msgs/JointTrajectory.
        ws : Workspace
            That it was planned in.

        Raises
        ------
        ValueError
            For another suffix, or a plan without phases.
        OSError
            Where the file cannot be written.
        """
        from bathyal.workspace.sample_job import write_plan

        write_plan(ws, self, path)
