# SPDX-License-Identifier: BSD-3-Clause
"""Draws a vehicle that its moving arm swings: measured and simulated.

Run as ``python docs/arm_on_vehicle_picture.py docs/images``, in the project's folder next to the
shared data: arm_on_vehicle.png.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from small_png import save_png

from bathyal.view.palette import AFTER, INK

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from tests.support import uvms_runs
from tests.support.uvms_runs import about_mean


def main(folder: str) -> None:
    names = [n for n in uvms_runs.names() if n not in uvms_runs.FITTED and n.startswith("traj")]
    shown = names[1::5]
    figure = Figure(figsize=(10, 4.5), layout="constrained")
    FigureCanvasAgg(figure)
    rows = figure.subplots(2, len(shown), sharey=True)
    for column, name in enumerate(shown):
        run = uvms_runs.run(name)
        roll, pitch = uvms_runs.simulated(name, uvms_runs.NUMBERS)
        pairs = (("pitch", run.pitch, pitch), ("roll", run.roll, roll))
        for row, (axis, measured, simulated) in enumerate(pairs):
            axes, since = rows[row, column], run.time - run.time[0]
            axes.plot(since, np.degrees(about_mean(measured)), color=INK, lw=1, label="measured")
            axes.plot(
                since, np.degrees(about_mean(simulated)), color=AFTER, lw=1.5, label="simulated"
            )
            axes.set(ylabel=f"{axis} [deg]" if column == 0 else None)
        rows[0, column].set(title=name)
        rows[1, column].set(xlabel="time [s]")
    rows[0, 0].legend(frameon=False)
    save_png(figure, Path(folder) / "arm_on_vehicle.png", dpi=80)


if __name__ == "__main__":
    main(*sys.argv[1:])
