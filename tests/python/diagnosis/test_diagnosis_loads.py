# SPDX-License-Identifier: BSD-3-Clause
"""What a diagnosis says of loads and times follows from what was recorded."""

from __future__ import annotations

import numpy as np
import pytest

import bathyal
from bathyal import Arm, CorrectedArm, Link, Tracked
from bathyal.effects import FoundEffect
from tests.support.elbow_table import ELBOW

_MASSES = (30, 10, 4, 3, 3, 3, 6)
_NOISE = 4e-5


def _heavy() -> Arm:
    return Arm.from_dh(**ELBOW, links=[Link(mass=mass) for mass in _MASSES])


@pytest.mark.parametrize("seed", [0, 1])
def test_a_load_that_is_missing_from_one_that_changes_is_named(seed: int) -> None:
    rng = np.random.default_rng(seed)
    recorded = rng.choice([0.0, 2.0, 5.0], 200)
    q = rng.uniform(-1.5, 1.5, (200, 6))
    found = [
        FoundEffect("joint_compliance", {"compliance": compliance}, joint=joint)
        for joint, compliance in ((1, 8e-6), (2, 2e-5))
    ]
    known = Tracked(q, np.zeros((200, 3)), covariates={"payload": recorded + 4.0})
    truth = CorrectedArm(_heavy(), found, known)
    tips = truth.forward(q, covariates={"payload": recorded + 4.0})[:, :3, 3]
    data = Tracked(q, tips + rng.normal(0, _NOISE, (200, 3)), covariates={"payload": recorded})
    report = bathyal.diagnose(_heavy(), data)
    names = sorted(e.name for e in report.effects)
    assert names == ["joint_compliance", "joint_compliance", "payload"]
    [payload] = [e for e in report.effects if e.name == "payload"]
    for name, compliance in (("mass_compliance_2", 8e-6), ("mass_compliance_3", 2e-5)):
        found_value = payload.parameters[name]
        assert abs(found_value.value - 4.0 * compliance) < 4 * found_value.std


@pytest.mark.parametrize("timed", [True, False])
def test_time_is_spoken_of_where_it_was_recorded(timed: bool) -> None:
    rng = np.random.default_rng(2)
    arm = bathyal.arms.ur10()
    q = rng.uniform(-1.5, 1.5, (150, 6))
    pose = arm.forward(q)
    tips = pose[:, :3, 3] + (np.arange(150) >= 61)[:, None] * pose[:, :3, 0] * 1e-3
    covariates = {"time": np.arange(150.0)} if timed else {}
    data = Tracked(q, tips + rng.normal(0, _NOISE, tips.shape), covariates=covariates)
    report = bathyal.diagnose(arm, data)
    [effect] = report.effects
    assert effect.words == "the tool slipping after row 61" + (" in time" if timed else "")
