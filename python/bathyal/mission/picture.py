# SPDX-License-Identifier: BSD-3-Clause
"""A run in four views."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure

    from bathyal.mission.run import RunResult

Array = NDArray[np.float64]

_MARKED = {"fault": "tab:red", "report": "tab:orange", "guard": "tab:purple", "mark": "tab:green"}


def run_figure(run: RunResult, earlier: Sequence[Array] = ()) -> matplotlib.figure.Figure:
    """The way from above, heights, thrusters, supply and errors over time.

    Parameters
    ----------
    run : RunResult
    earlier : sequence of (K, 2) array
        Ways of earlier runs, under this one's [m].

    Returns
    -------
    matplotlib.figure.Figure
    """
    from matplotlib.figure import Figure

    truth, estimate = run.log.messages("/truth"), run.log.messages("/estimate")
    state, thrusters = run.log.messages("/state"), run.log.messages("/thrusters")
    figure = Figure(figsize=(12, 8), layout="constrained")
    (above, heights), (turning, supply) = figure.subplots(2, 2)
    draw_earlier(above, earlier)
    _draw_above(above, run, truth, estimate)
    _draw_heights(heights, run, truth, state)
    turning.plot(thrusters["time"], thrusters["command"], lw=0.7)
    turning.set(xlabel="time [s]", ylabel="command", ylim=(-1.05, 1.05), title="thrusters")
    _draw_supply(supply, truth, estimate, state)
    figure.suptitle(f"{run.name}, seed {run.seed}: {run.status}")
    return figure


def draw_earlier(axes: matplotlib.axes.Axes, earlier: Sequence[Array]) -> None:
    """Ways of earlier runs, thin and grey."""
    for row, way in enumerate(earlier):
        label = "earlier" if row == 0 else None
        axes.plot(way[:, 0], way[:, 1], lw=0.6, color="0.65", zorder=1, label=label)


def _draw_above(axes: matplotlib.axes.Axes, run: RunResult, truth: Any, estimate: Any) -> None:
    x, y = truth["pose.position.x"], truth["pose.position.y"]
    axes.plot(x, y, lw=1.2, label="true")
    axes.plot(
        estimate["pose.position.x"], estimate["pose.position.y"], lw=0.8, ls="--", label="estimated"
    )
    for event in run.events:
        if event.kind in _MARKED:
            at = int(np.searchsorted(truth["time"], event.time).clip(0, len(x) - 1))
            axes.plot(x[at], y[at], "o", ms=5, color=_MARKED[event.kind])
            axes.annotate(event.text, (x[at], y[at]), fontsize=7, rotation=15)
    axes.plot(x[0], y[0], "k^", ms=6)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set(xlabel="x [m]", ylabel="y [m]", title="from above")
    axes.legend(fontsize=8)


def _draw_heights(axes: matplotlib.axes.Axes, run: RunResult, truth: Any, state: Any) -> None:
    z = truth["pose.position.z"]
    axes.plot(truth["time"], z, label="vehicle")
    axes.plot(state["time"], z - state["altitude"], color="tab:brown", label="bottom")
    axes.plot(state["time"], state["target_z"], lw=0.7, ls="--", label="asked for")
    for event in run.events:
        if event.kind in _MARKED:
            axes.axvline(event.time, color=_MARKED[event.kind], lw=0.8)
    axes.set(xlabel="time [s]", ylabel="z [m]", title="heights")
    axes.legend(fontsize=8)


def _draw_supply(axes: matplotlib.axes.Axes, truth: Any, estimate: Any, state: Any) -> None:
    error = np.hypot(
        estimate["pose.position.x"] - truth["pose.position.x"],
        estimate["pose.position.y"] - truth["pose.position.y"],
    )
    axes.plot(truth["time"], error, label="position error [m]")
    axes.plot(state["time"], state["position_std"], lw=0.8, ls="--", label="its estimate [m]")
    axes.set(xlabel="time [s]", ylabel="[m]", title="navigation and supply")
    volts = axes.twinx()
    volts.plot(state["time"], state["voltage"], color="tab:gray", lw=0.7)
    volts.set_ylabel("supply [V]")
    axes.legend(fontsize=8)
