# SPDX-License-Identifier: BSD-3-Clause
"""What an identification and a plan of touches do in Python: text, table, picture. Attached
when the package is imported."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from bathyal._core import ArmFit, TouchPlan
from bathyal.attach import methods_of

if TYPE_CHECKING:
    import matplotlib.figure


@methods_of(ArmFit)
class _ArmFit(ArmFit):
    def __str__(self) -> str:
        """Verdict, numbers with units and the next step, in a few lines."""
        from bathyal.identify.report.brief import brief_of

        return str(brief_of(self))


@methods_of(TouchPlan)
class _TouchPlan(TouchPlan):
    def write(self, path: str | os.PathLike[str]) -> None:
        """Write a table to touch by.

        Parameters
        ----------
        path : path
            ``.csv``, for bathyal.read_touches: see bathyal.identify.touch_plans.write_plan.
        """
        from bathyal.identify.touch_plans import write_plan

        write_plan(self, path)

    def plot(self, path: str | os.PathLike[str] | None = None) -> matplotlib.figure.Figure:
        """A picture: the arm in its poses, the points, the tool's directions at each.

        Parameters
        ----------
        path : path, optional
            ``.png``, ``.pdf`` or ``.svg`` to write it to, too: see
            bathyal.identify.touch_plans.plot_plan.
        """
        from bathyal.identify.touch_plans import plot_plan

        return plot_plan(self, path)
