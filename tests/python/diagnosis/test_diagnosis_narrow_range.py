# SPDX-License-Identifier: BSD-3-Clause
"""Where a joint hardly moves, a scale and a wave have one shape: both are listed."""

from __future__ import annotations

import numpy as np
import pytest

import bathyal

JOINT = 2


def diagnosed(half_range: float, hidden: str, seed: int, size: float = 2e-3) -> bathyal.Diagnosis:
    arm = bathyal.arms.ur10()
    random = np.random.default_rng(seed)
    q = random.uniform(-1.5, 1.5, (150, 6))
    q[:, JOINT] = 0.9 + random.uniform(-half_range, half_range, 150)
    there = q.copy()
    there[:, JOINT] += size * (np.sin(q[:, JOINT] - 0.9) if hidden == "wave" else q[:, JOINT])
    tips = arm.forward(there)[:, :3, 3] + random.normal(0, 5e-5, (150, 3))
    return bathyal.diagnose(arm, bathyal.Tracked(q, tips))


@pytest.mark.parametrize("hidden", ["scale", "wave"])
@pytest.mark.parametrize("seed", range(2))
def test_in_a_narrow_range_a_scale_may_be_a_wave(hidden: str, seed: int) -> None:
    report = diagnosed(0.2, hidden, seed)
    assert report.verdict == "ambiguous"
    causes = {(cause.name, cause.joint) for cause in report.ambiguous}
    assert causes >= {("joint_scale", JOINT), ("joint_harmonic", JOINT)}


@pytest.mark.parametrize("hidden", ["scale", "wave"])
def test_in_a_wide_range_the_data_separate_them(hidden: str) -> None:
    report = diagnosed(2.0, hidden, 0)
    assert report.verdict == "named"
    name = {"scale": "joint_scale", "wave": "joint_harmonic"}[hidden]
    assert [(effect.name, effect.joint) for effect in report.effects] == [(name, JOINT)]


@pytest.mark.parametrize("seed", range(2))
def test_a_scale_of_another_shape_is_named_though_few_data_would_fit_a_wave(seed: int) -> None:
    report = diagnosed(0.8, "scale", seed, 3e-4)
    assert report.verdict == "named"
    assert [(effect.name, effect.joint) for effect in report.effects] == [("joint_scale", JOINT)]
