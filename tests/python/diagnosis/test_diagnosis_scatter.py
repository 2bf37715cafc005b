# SPDX-License-Identifier: BSD-3-Clause
"""What changes from pose to pose with something that was not recorded is no noise."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

import bathyal

Array = NDArray[np.float64]

_NOISE = 5e-5  # [m]


def _poses(seed: int) -> tuple[bathyal.Arm, Array, np.random.Generator]:
    rng = np.random.default_rng(seed)
    return bathyal.arms.ur10(), rng.uniform(-1.5, 1.5, (200, 6)), rng


def _diagnosis(arm: bathyal.Arm, q: Array, tips: Array) -> bathyal.Diagnosis:
    return bathyal.diagnose(arm, bathyal.Tracked(q, tips))


@pytest.mark.parametrize("seed", [0, 1])
def test_a_joint_that_scatters_is_unknown(seed: int) -> None:
    arm, q, rng = _poses(seed)
    there = q.copy()
    there[:, 2] += rng.normal(0, 2e-4, 200)
    tips = arm.forward(there)[:, :3, 3] + rng.normal(0, _NOISE, (200, 3))
    report = _diagnosis(arm, q, tips)
    assert report.verdict == "unknown"
    assert report.leftover.joint == 2
    assert "scatter of joint 3" in str(report.leftover.words)


def test_a_base_that_sways_is_unknown() -> None:
    arm, q, rng = _poses(0)
    tips = arm.forward(q)[:, :3, 3]
    tips = tips + np.cross(rng.normal(0, 2e-4, (200, 3)), tips) + rng.normal(0, _NOISE, (200, 3))
    report = _diagnosis(arm, q, tips)
    assert report.verdict == "unknown"


def test_even_noise_is_no_scatter() -> None:
    arm, q, rng = _poses(0)
    report = _diagnosis(arm, q, arm.forward(q)[:, :3, 3] + rng.normal(0, _NOISE, (200, 3)))
    assert report.verdict == "clean"
