# SPDX-License-Identifier: BSD-3-Clause
"""What a person reads of a model is physical: nothing runs off along what the data do not show."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import bathyal
from bathyal.effects import Effect, library_effects

Array = NDArray[np.float64]

_ARM = bathyal.arms.ur10()


def _elastic(data: Any, joint: int) -> Array:
    """Two numbers for a joint, of which one is nothing but rounding; so are both of joint 1."""
    pull = np.cos(data.q[:, 1]) + 0.5 * np.cos(data.q[:, 1] + data.q[:, 2])
    rounding = 1e-16 * np.sin(7.3 * data.q[:, 3] + data.q[:, 0])
    return np.column_stack([pull if joint else rounding, rounding])


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_columns_that_are_nothing_get_no_values(seed: int) -> None:
    rng = np.random.default_rng(seed)
    q = rng.uniform(-1.5, 1.5, (150, 6))
    turned = q.copy()
    turned[:, 2] += 4e-4 * (np.cos(q[:, 1]) + 0.5 * np.cos(q[:, 1] + q[:, 2]))
    turned[:, 0] += 2e-4 * np.sin(7.3 * q[:, 3] + q[:, 0])  # what the rounding looks like
    tips = _ARM.forward(turned)[:, :3, 3] + rng.normal(0, 3e-5, (150, 3))
    own = Effect(
        "elastic",
        _elastic,
        parameters={"pull": "rad/(N m)", "idle": "rad/(N m)"},
        joints=[0, 2],
    )
    report = bathyal.diagnose(_ARM, bathyal.Tracked(q, tips), effects=[*library_effects(), own])
    elastic = [effect for effect in report.effects if effect.name == "elastic"]
    assert [effect.joint for effect in elastic] == [2]
    assert float(elastic[0].parameters["pull"]) == pytest.approx(4e-4, rel=0.2)
    assert float(elastic[0].parameters["idle"]) == 0.0
    assert report.held_out.rms_after <= report.held_out.rms_before


def test_a_tool_that_left_the_room_is_reported() -> None:
    rng = np.random.default_rng(0)
    q = rng.uniform(-1.5, 1.5, (100, 6))
    far = _ARM.copy()
    far.tool = np.block([[np.eye(3), np.array([[0.0], [0.0], [40.0]])], [np.zeros(3), 1.0]])
    tips = far.forward(q)[:, :3, 3] + rng.normal(0, 1e-4, (100, 3))
    report = bathyal.diagnose(_ARM, bathyal.Tracked(q, tips))
    [warning] = [text for text in report.warnings if "The tool came out" in text]
    assert warning.startswith("The tool came out 40 m from the flange, farther than the arm of")
    near = bathyal.diagnose(
        _ARM, bathyal.Tracked(q, _ARM.forward(q)[:, :3, 3] + tips - tips.round(3))
    )
    assert not any("came out" in text for text in near.warnings)
