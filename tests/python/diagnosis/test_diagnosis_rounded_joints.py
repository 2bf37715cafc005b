# SPDX-License-Identifier: BSD-3-Clause
"""Joint values that were logged in steps: what is noise in addition to them, and what is not."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

import bathyal

Array = NDArray[np.float64]


def _names(arm: bathyal.Arm, logged: Array, tips: Array) -> list[str]:
    report = bathyal.diagnose(arm, bathyal.Tracked(logged, tips))
    assert report.verdict == "named"
    return [effect.name for effect in report.effects]


@pytest.mark.parametrize("noise", [4e-5, 4e-4])
@pytest.mark.parametrize("seed", [0, 1])
def test_rounding_is_no_noise_that_grows_with_the_range(seed: int, noise: float) -> None:
    """Long arms are moved more by a step of their joints."""
    arm = bathyal.arms.ur10()
    rng = np.random.default_rng(seed)
    q = rng.uniform(-1.5, 1.5, (300, 6))
    tips = arm.forward(q)[:, :3, 3] + rng.normal(0, noise, (300, 3))
    assert _names(arm, np.round(q / 2e-3) * 2e-3, tips) == ["quantisation"]


def test_noise_that_grows_with_the_range_is_found_with_rounding() -> None:
    arm = bathyal.arms.ur10()
    rng = np.random.default_rng(0)
    q = rng.uniform(-1.5, 1.5, (300, 6))
    tips = arm.forward(q)[:, :3, 3].copy()
    tips += 1e-3 * np.linalg.norm(tips, axis=1)[:, None] ** 2 * rng.normal(0, 1, tips.shape)
    assert sorted(_names(arm, np.round(q / 2e-3) * 2e-3, tips)) == ["quantisation", "range_noise"]


def test_a_step_of_angles_is_none_of_sliding_joints() -> None:
    """A column that slides and three joints that turn, logged in steps: a metre is no radian."""
    arm = bathyal.Arm.from_dh(
        a=[0.2, 0.0, 0.5, 0.4],
        alpha=[0.0, np.pi / 2, 0.0, 0.0],
        d=[0.0, 0.3, 0.0, 0.0],
        theta=np.zeros(4),
        joint_types=["prismatic", "revolute", "revolute", "revolute"],
    )
    rng = np.random.default_rng(0)
    q = rng.uniform(-1.0, 1.0, (300, 4))
    tips = arm.forward(q)[:, :3, 3] + rng.normal(0, 3e-4, (300, 3))
    logged = np.column_stack([q[:, 0], np.round(q[:, 1:] / 1e-3) * 1e-3])
    report = bathyal.diagnose(arm, bathyal.Tracked(logged, tips))
    # In the turning joints alone: a share of their mean square.
    jacobian = arm.jacobian(q)[:, :3, 1:]
    rounding = 1e-3 * np.sqrt(np.sum(jacobian**2) / 300 / 3 / 12)
    [effect] = report.effects
    assert effect.name == "quantisation"
    assert effect.size == pytest.approx(rounding, rel=0.15)


@pytest.mark.parametrize("seed", range(4))
def test_repeats_that_were_rounded_alike_are_no_structure(seed: int) -> None:
    """Poses that are visited again have the rounding of the first time, and scatter about it by the
    noise of the instrument alone: that is no lack of fit."""
    arm = bathyal.arms.ur10()
    rng = np.random.default_rng(seed)
    q = np.repeat(rng.uniform(-1.5, 1.5, (60, 6)), 4, axis=0)
    tips = arm.forward(q)[:, :3, 3] + rng.normal(0, 1e-4, (240, 3))
    assert _names(arm, np.round(q / 2e-3) * 2e-3, tips) == ["quantisation"]


def test_structure_is_seen_in_repeats_that_were_rounded_alike() -> None:
    arm = bathyal.arms.ur10()
    rng = np.random.default_rng(0)
    q = np.repeat(rng.uniform(-1.5, 1.5, (120, 6)), 2, axis=0)
    bent = 2e-3 * np.sin(5 * q[:, [0]]) * np.cos(4 * q[:, [2]]) * np.ones(3)
    tips = arm.forward(q)[:, :3, 3] + bent + rng.normal(0, 1e-4, (240, 3))
    report = bathyal.diagnose(arm, bathyal.Tracked(np.round(q / 2e-3) * 2e-3, tips))
    assert report.verdict == "unknown"
