# SPDX-License-Identifier: BSD-3-Clause
"""Noise that grows with the range is one question, not one of many terms."""

from __future__ import annotations

import numpy as np
import pytest

import bathyal


@pytest.mark.parametrize("seed", [2, 5, 12, 16])
def test_noise_that_half_grows_with_the_range_is_named(seed: int) -> None:
    arm = bathyal.arms.ur10()
    rng = np.random.default_rng(seed)
    q = rng.uniform(-1.5, 1.5, (200, 6))
    tips = arm.forward(q)[:, :3, 3]
    noise = 1e-4 * np.hypot(1.0, 0.55 * np.sum(tips**2, axis=1))
    report = bathyal.diagnose(
        arm, bathyal.Tracked(q, tips + noise[:, None] * rng.normal(0, 1, tips.shape))
    )
    assert [effect.name for effect in report.effects] == ["range_noise"]
