# SPDX-License-Identifier: BSD-3-Clause
"""What diagnosis finds in recordings of real arms."""

from __future__ import annotations

import warnings
from functools import cache

import numpy as np
import pytest

import bathyal
from tests.support.real_arms import Array, hilti, sockets, trailblazer, ur10


def _rms(errors: Array) -> float:
    return float(np.sqrt((errors**2).sum(axis=1).mean()))


@cache
def _report_of_ur10() -> bathyal.Diagnosis:
    every = ur10("C")
    return bathyal.diagnose(bathyal.arms.ur10(), bathyal.Tracked(every.q[::8], every.position[::8]))


@cache
def _report_of_another_session() -> bathyal.Diagnosis:
    every = ur10("A")
    return bathyal.diagnose(
        bathyal.arms.ur10(), bathyal.Tracked(every.q[::20], every.position[::20])
    )


def test_gears_of_the_ur10_are_found() -> None:
    report = _report_of_ur10()
    assert report.verdict in ("named", "ambiguous")
    assert report.held_out.rms_before > 0.40e-3
    assert report.held_out.rms_after < 0.13e-3
    assert report.held_out.p_value < 0.01
    joints = {e.joint for e in report.effects if e.name in ("joint_harmonic", "joint_map")}
    assert {0, 1, 2} <= joints


def test_the_ur10s_model_predicts_poses_that_were_not_used() -> None:
    report = _report_of_ur10()
    every = ur10("C")
    unused = np.arange(len(every.q)) % 8 == 4
    q, position = every.q[unused], every.position[unused]
    within = report.model.in_support(q)
    error = report.model.forward(q[within])[:, :3, 3] - position[within]
    rigid = report.fit.arm.forward(q[within])[:, :3, 3] - position[within]
    assert within.mean() > 0.8
    assert _rms(error) < 0.35 * _rms(rigid)


@pytest.mark.parametrize("within", [True, False])
def test_what_one_session_teaches_helps_in_another(within: bool) -> None:
    report, other = _report_of_another_session(), ur10("B")
    known = report.model.in_support(other.q)
    assert 0.1 < known.mean() < 0.9
    q, places = other.q[known == within], other.position[known == within]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", bathyal.SupportWarning)
        rigid, corrected = (
            bathyal.verify_arm(arm, q, places).rms_after for arm in (report.fit.arm, report.model)
        )
    assert corrected < (0.75 if within else 0.9) * rigid


def test_the_column_that_bends_is_named() -> None:
    data, _ = hilti("flat")
    report = bathyal.diagnose(trailblazer(), data)
    assert (report.effects[0].name, report.effects[0].joint) == ("link_compliance", 0)
    assert report.effects[0].p_value < 1e-6
    assert report.held_out.rms_before > 3e-3
    assert report.held_out.rms_after < 1.5e-3
    assert "bending under its load" in report.summary()


def test_the_panda_with_a_probe_is_better_with_names_that_are_a_part_of_the_cause() -> None:
    report = bathyal.diagnose(bathyal.arms.panda(), sockets("panda_3"))
    assert report.verdict == "unknown"
    assert report.leftover.is_beyond_noise
    assert report.effects
    assert report.held_out.rms_before < 0.22e-3
    assert report.held_out.rms_after < 0.175e-3


def test_one_name_that_predicts_badly_does_not_take_all_others_along() -> None:
    every = ur10("A")
    report = bathyal.diagnose(
        bathyal.arms.ur10(), bathyal.Tracked(every.q[::30], every.position[::30])
    )
    assert len(report.effects) > 5
    assert report.held_out.rms_after < 0.6 * report.held_out.rms_before
    assert report.held_out.p_value < 0.01


def test_structure_whose_names_predict_nothing_is_unknown() -> None:
    report = bathyal.diagnose(bathyal.arms.gen3_lite(), sockets("dinova_1"))
    assert min(shown.p_value for shown in report.shown) < 1e-9
    assert report.verdict == "unknown"
