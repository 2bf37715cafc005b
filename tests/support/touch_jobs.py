# SPDX-License-Identifier: BSD-3-Clause
"""Tables of touches that the tests of identification begin with."""

from __future__ import annotations

import pathlib

import bathyal
from bathyal.identify.simulate import SimulatedTouches, simulate_touches, write_touches

FILES = [
    "arm.json", "arm.urdf", "fit.json", "parameters.csv", "report.html", "report.png",
    "residuals.csv",
]  # fmt: skip
MUKCA = pathlib.Path(__file__).parents[2] / "../shared/data/arms/mukca"


def simulated(**options: object) -> SimulatedTouches:
    return simulate_touches(bathyal.arms.ur10e(), **options)


def table(folder: pathlib.Path, made: SimulatedTouches) -> pathlib.Path:
    path = folder / "touches.csv"
    write_touches(made.touches, path)
    return path


def with_distance(made: SimulatedTouches) -> bathyal.Touches:
    touches = made.touches
    return bathyal.Touches(
        touches.q, touches.point, names=touches.names, known_distances={(0, 1): made.apart}
    )
