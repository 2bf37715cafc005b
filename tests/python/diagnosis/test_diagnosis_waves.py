# SPDX-License-Identifier: BSD-3-Clause
"""A wave of any order is named as one, and not as a whole curve along its joint."""

from __future__ import annotations

import numpy as np
import pytest

import bathyal


@pytest.mark.parametrize(
    ("seed", "order", "size"),
    [(0, 2.80, 1.9e-3), (1, 4.35, 1.8e-3), (2, 2.82, 2.2e-3), (3, 4.37, 1.1e-3), (4, 2.45, 2.4e-3)],
)
def test_a_wave_between_the_orders_that_are_scanned_is_no_curve(
    seed: int, order: float, size: float
) -> None:
    arm = bathyal.arms.ur10()
    rng = np.random.default_rng(seed)
    q = rng.uniform(-1.5, 1.5, (150, 6))
    there = q.copy()
    there[:, 3] += size * np.cos(order * q[:, 3] + 1.0)
    tips = arm.forward(there)[:, :3, 3] + rng.normal(0, 5e-5, (150, 3))
    report = bathyal.diagnose(arm, bathyal.Tracked(q, tips))
    assert [(effect.name, effect.joint) for effect in report.effects] == [("joint_harmonic", 3)]
