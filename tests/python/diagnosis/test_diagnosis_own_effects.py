# SPDX-License-Identifier: BSD-3-Clause
"""Effects of one's own are found as those of the library are, whatever their unit."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import bathyal
from bathyal.effects import Effect, library_effects

TRUTH = 1e-3  # [rad]


def _pull(q: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.sin(2 * q[:, 1]) * np.sin(2 * q[:, 2])


@pytest.mark.parametrize("unit_of_pull", [1.0, 1e-9, 1e6])
def test_a_users_effect_is_named_with_its_value(unit_of_pull: float) -> None:
    rng = np.random.default_rng(3)
    arm = bathyal.arms.ur10()
    q = rng.uniform(-1.5, 1.5, (200, 6))
    true = q.copy()
    true[:, 2] += TRUTH * _pull(q)
    position = arm.forward(true)[:, :3, 3] + rng.normal(0, 1e-4, (200, 3))

    def cable(data: Any, _: int) -> NDArray[np.float64]:
        return unit_of_pull * _pull(data.q)

    own = Effect("cable", cable, parameters={"pull": "rad"}, joints=[2])
    report = bathyal.diagnose(arm, bathyal.Tracked(q, position), effects=[*library_effects(), own])
    assert report.verdict == "named"
    [found] = report.effects
    assert (found.name, found.joint) == ("cable", 2)
    low, high = found.parameters["pull"].interval
    assert low < TRUTH / unit_of_pull < high
    assert high - low < 0.2 * TRUTH / unit_of_pull
