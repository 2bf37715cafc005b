# SPDX-License-Identifier: BSD-3-Clause
"""Groups that a user gives are held out whole, and what physics says holds there."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from numpy.typing import NDArray

import bathyal
from bathyal import Arm, CorrectedArm, Link, Tracked
from bathyal.effects import FoundEffect
from tests.support.diagnosis_record import ARM, N, P, Q, diagnosed, is_right
from tests.support.elbow_table import ELBOW
from tests.support.real_arms import placements, sockets

Array = NDArray[np.float64]
REGION = np.array(["left", "middle", "right"])[np.digitize(Q[:, 0], [-0.7, 0.7])]


def _rms(errors: Array) -> float:
    return float(np.sqrt((errors**2).sum(axis=1).mean()))


def test_each_group_is_predicted_from_the_others() -> None:
    report = diagnosed(options={"groups": REGION})
    is_right(report)
    held = report.held_out
    assert held.blocks == 3
    assert held.how == "3 given groups were held out in turn"
    named = [part for part in held.parts if part.name.startswith("group ")]
    assert {part.name[6:]: part.rows for part in named} == {
        name: int(np.sum(name == REGION)) for name in dict.fromkeys(REGION)
    }
    for name in np.unique(REGION):
        own = name == REGION
        others = bathyal.identify_arm(ARM, Tracked(Q[~own], P[~own])).arm
        error = others.forward(Q[own])[:, :3, 3] - P[own]
        assert _rms(error) == pytest.approx(np.sqrt(np.mean(held.before[own] ** 2)), rel=0.02)


def test_groups_may_be_numbers_or_text_and_two_are_enough() -> None:
    by_number = diagnosed(options={"groups": (Q[:, 0] > 0).astype(float)})
    by_text = diagnosed(options={"groups": np.where(Q[:, 0] > 0, "1", "0").tolist()})
    assert by_number.held_out.blocks == 2
    assert np.array_equal(by_number.held_out.after, by_text.held_out.after)
    assert {part.name for part in by_number.held_out.parts} >= {"group 0", "group 1"}
    is_right(by_number)


def test_more_than_fifty_groups_are_joined() -> None:
    report = diagnosed(options={"groups": np.arange(N)})
    assert report.held_out.blocks == 50
    assert "90 given groups were held out in 50 sets of whole groups" in report.held_out.how


def test_copies_of_rows_take_their_groups_along() -> None:
    twice, where = np.vstack([Q, Q[:5]]), np.vstack([P, P[:5]])
    report = diagnosed(twice, where, options={"groups": [*REGION, *REGION[:5]]})
    once = diagnosed(options={"groups": REGION})
    assert np.array_equal(report.held_out.after[:N], once.held_out.after)
    assert np.array_equal(report.held_out.after[N:], once.held_out.after[:5])


def test_sockets_are_held_out_by_placement() -> None:
    data = sockets("panda_3")
    names = placements("panda_3")
    where = [names[point // 2] for point in data.point]
    report = bathyal.diagnose(bathyal.arms.panda(), data, groups=where)
    assert report.held_out.blocks == len(names)
    assert {part.name for part in report.held_out.parts} >= {f"group {name}" for name in names}


def test_weight_of_known_masses_is_predicted_at_another_placement() -> None:
    """Held as in the nearest row it left 0.7 mm of 1.8."""
    arm = Arm.from_dh(**ELBOW, links=[Link(mass=m) for m in (30, 28, 22, 8, 9, 2, 1)])
    rng = np.random.default_rng(5)
    low, high = np.full(6, -1.5), np.full(6, 1.5)
    high[1], high[2] = 0.1, 0.1
    q = rng.uniform(low, high, (250, 6))
    far = q.copy()
    far[:, 1:3] = rng.uniform(0.7, 1.5, (250, 2))
    every = Tracked(np.vstack([q, far]), np.zeros((500, 3)))
    truth = CorrectedArm(
        arm,
        [
            FoundEffect("joint_compliance", {"compliance": 4e-6}, joint=1),
            FoundEffect("joint_compliance", {"compliance": 1e-5}, joint=2),
        ],
        every,
    )
    p, beyond = (truth.forward(at)[:, :3, 3] + rng.normal(0, 2e-5, (250, 3)) for at in (q, far))
    report = bathyal.diagnose(arm, Tracked(q, p))
    assert {(e.name, e.joint) for e in report.effects} == {
        ("joint_compliance", 1),
        ("joint_compliance", 2),
    }
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", bathyal.SupportWarning)
        error = report.model.forward(far)[:, :3, 3] - beyond
    rigid = report.fit.arm.forward(far)[:, :3, 3] - beyond
    assert not report.model.in_support(far).any()
    assert _rms(error) < 0.3 * _rms(rigid)
