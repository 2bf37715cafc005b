# SPDX-License-Identifier: BSD-3-Clause
"""Draws the track of a real vehicle: logged, reckoned and smoothed.

Run as ``python docs/navigation_picture.py ../shared/data/auvlogs docs/images``: navigation.png.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from small_png import save_png

import bathyal
from bathyal.view.palette import AFTER, BEFORE, INK


def main(logs: str, folder: str) -> None:
    log = bathyal.read_navigation_log(Path(logs) / "20230517_0_0.csv")
    rows = [*np.searchsorted(log.time, np.arange(0.0, log.time[-1], 60.0)), len(log.time) - 1]
    smoothed = log.smooth(log.time[rows], log.position[rows]).fix_point
    figure = Figure(figsize=(8, 5), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots()
    axes.plot(*log.position.T, color=INK, lw=1, label="logged position")
    axes.plot(*log.dead_reckon().T, color=BEFORE, lw=1, label="dead reckoning")
    axes.plot(*smoothed[:, :2].T, color=AFTER, lw=1.5, label="smoothed through the fixes")
    axes.plot(*log.position[rows].T, "o", color=INK, ms=5, label="fixes, one a minute")
    axes.set(xlabel="east [m]", ylabel="north [m]", aspect="equal")
    axes.legend(frameon=False)
    save_png(figure, Path(folder) / "navigation.png", dpi=80)


if __name__ == "__main__":
    main(*sys.argv[1:])
