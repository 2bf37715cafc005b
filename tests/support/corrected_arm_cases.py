# SPDX-License-Identifier: BSD-3-Clause
"""An arm with effects inside, and what its tests ask with."""

from typing import Any

import numpy as np

import bathyal
from bathyal.effects import FoundEffect

RNG = np.random.default_rng(11)
Q = RNG.uniform(-1, 1, (200, 6))
COVARIATES = {
    "temperature": RNG.uniform(10, 30, 200),
    "session": np.arange(200) // 100 + 1,
    "time": np.arange(200.0),
    "payload": RNG.uniform(0, 2, 200),
}
ALL = {"temperature": 25.0, "session": 2, "time": 150.0, "payload": 1.0}


def harmonic(joint: int = 2, order: float = 2.0) -> FoundEffect:
    return FoundEffect(
        "joint_harmonic", {"cos": 1e-3, "sin": 5e-4}, joint=joint, settings={"order": order}
    )


def effects() -> list[FoundEffect]:
    shift = dict(zip(("shift_x", "shift_y", "shift_z"), (1e-3, 2e-3, 3e-3), strict=True))
    axes = ["shift_x_2", "shift_y_2", "shift_z_2", "turn_x_2", "turn_y_2", "turn_z_2"]
    return [
        harmonic(),
        FoundEffect("thermal", {"expansion": 2e-5}, settings={"mean_temperature": 20.0}),
        FoundEffect("base_shift", dict.fromkeys(axes, 1e-3), settings={"from": 2.0}),
        FoundEffect("tool_slip", shift, settings={"moment": 101.0, "time": 100.5}),
    ]


def model(found: list[FoundEffect] | None = None) -> Any:
    arm = bathyal.arms.ur10e()
    arm.tool = [[1, 0, 0, 0.01], [0, 1, 0, 0], [0, 0, 1, 0.2], [0, 0, 0, 1]]
    data = bathyal.Tracked(Q, arm.forward(Q)[:, :3, 3], covariates=COVARIATES)
    return bathyal.CorrectedArm(arm, effects() if found is None else found, data)
