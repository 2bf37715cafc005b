# SPDX-License-Identifier: BSD-3-Clause
"""Effects of one's own are found as those of the library are, whatever their unit."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import bathyal
from bathyal.effects import Effect, FoundEffect, library_effects

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


def _sag_of(arm: bathyal.Arm, joint: int) -> Effect:
    """A link whose frame turns about its own x, and moves along its own y, with another joint."""

    def sag(data: Any, at: int) -> NDArray[np.float64]:
        assert at == joint
        twist = np.zeros((len(data), 6))
        twist[:, 1] = 0.2 * np.sin(2 * data.q[:, 3])
        twist[:, 3] = np.sin(2 * data.q[:, 3])
        return twist

    return Effect("sag", sag, parameters={"size": "rad"}, site="link", joints=[joint])


@pytest.mark.parametrize("joint", [1, 3])
def test_an_effect_of_ones_own_acts_at_any_link(joint: int, tmp_path: Path) -> None:
    rng = np.random.default_rng(4)
    file = tmp_path / "arm.urdf"
    bathyal.arms.ur10().to_urdf(file)
    arm = bathyal.Arm.from_urdf(file)  # its links have frames of their own
    q = rng.uniform(-1.5, 1.5, (200, 6))
    link = arm.forward(q, links=True)[:, joint + 1]
    size = np.sin(2 * q[:, 3]) * TRUTH
    turn = link[:, :3, 0] * size[:, None]
    shift = link[:, :3, 1] * (0.2 * size)[:, None]
    tip = arm.forward(q)[:, :3, 3]
    tip = tip + shift + np.cross(turn, tip - link[:, :3, 3])
    own = _sag_of(arm, joint)
    data = bathyal.Tracked(q, tip)
    model = bathyal.CorrectedArm(arm, [FoundEffect(own, {"size": TRUTH}, joint=joint)], data)
    assert np.abs(model.forward(q)[:, :3, 3] - tip).max() < 5e-6  # of second order
    noisy = bathyal.Tracked(q, tip + rng.normal(0, 5e-5, (200, 3)))
    report = bathyal.diagnose(arm, noisy, effects=[*library_effects(), own])
    assert report.verdict == "named"
    assert [(e.name, e.joint) for e in report.effects] == [("sag", joint)]
    size = report.effects[0].parameters["size"]
    assert abs(size.value - TRUTH) < 4 * size.std
    assert size.std < 0.2 * TRUTH


def test_an_effect_at_a_link_names_joints() -> None:
    with pytest.raises(ValueError, match='`joints` where its site is "joint" or "link"'):
        Effect("sag", lambda data, at: data.q[:, at], parameters={"size": "rad"}, site="link")
