# SPDX-License-Identifier: BSD-3-Clause
"""What a mission's file describes, in words and drawn over the bottom."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from bathyal.mission.picture import draw_earlier

if TYPE_CHECKING:
    import matplotlib.figure

    from bathyal.mission.files import Mission


def describe_mission(mission: Mission) -> dict[str, str]:
    """Short facts by name."""
    sections = mission.sections
    commands = [command["name"] for command in mission.commands]
    points = planned_points(mission)
    length = float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
    return {
        "mission": mission.name,
        "vehicle": sections.vehicle.name or sections.vehicle.preset or "its own",
        "commands": ", ".join(commands),
        "planned way": f"{length:.0f} m",
        "guards": ", ".join(guard.name for guard in sections.always) or "none",
        "faults": ", ".join(f"{fault.device} {fault.kind}" for fault in sections.faults) or "none",
        "signals": ", ".join(mission.plan.signals),
    }


def planned_points(mission: Mission) -> Any:
    """(K, 2) from the start through all points of the commands, in the order of the file [m]."""
    rows = [mission.sections.start.position[:2]]
    for command in mission.commands:
        rows += [tuple(point) for point in command.get("points", [])]
    return np.array(rows, dtype=np.float64)


def mission_figure(mission: Mission, earlier: Sequence[Any] = ()) -> matplotlib.figure.Figure:
    """The planned way over the world, from above.

    Parameters
    ----------
    mission : Mission
    earlier : sequence of (K, 2) array
        Ways of earlier runs [m].

    Returns
    -------
    matplotlib.figure.Figure
    """
    if mission.world.objects:
        from bathyal.view.world_map import world_figure

        figure = world_figure(mission.world, 0.0)
        axes = figure.axes[0]
    else:
        from matplotlib.figure import Figure

        figure = Figure(figsize=(8, 6))
        axes = figure.add_subplot()
        axes.set_aspect("equal", adjustable="datalim")
    draw_earlier(axes, earlier)
    points = planned_points(mission)
    axes.plot(points[:, 0], points[:, 1], "-", color="tab:red", lw=1.2)
    axes.plot(points[0, 0], points[0, 1], "^", color="tab:red", ms=8)
    axes.set_title(mission.name)
    return figure
