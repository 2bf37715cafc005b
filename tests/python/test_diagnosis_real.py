# SPDX-License-Identifier: BSD-3-Clause
"""What diagnosis finds in recordings of real arms."""

from __future__ import annotations

from functools import cache

import numpy as np

import bathyal
from real_arms import sockets, ur10


@cache
def _report_of_ur10() -> bathyal.Diagnosis:
    every = ur10("C")
    return bathyal.diagnose(bathyal.arms.ur10(), bathyal.Tracked(every.q[::8], every.position[::8]))


def test_gears_of_the_ur10_are_found() -> None:
    report = _report_of_ur10()
    assert report.verdict in ("named", "ambiguous")
    assert report.held_out.rms_before > 0.40e-3
    assert report.held_out.rms_after < 0.13e-3
    assert report.held_out.p_value < 0.01
    joints = {e.joint for e in report.effects if e.name in ("joint_harmonic", "joint_map")}
    assert {0, 1, 2} <= joints


def test_the_ur10s_model_foretells_poses_that_were_not_used() -> None:
    report = _report_of_ur10()
    every = ur10("C")
    unused = np.arange(len(every.q)) % 8 == 4
    q, position = every.q[unused], every.position[unused]
    within = report.model.in_support(q).all(axis=1)
    error = report.model.forward(q[within])[:, :3, 3] - position[within]
    rigid = report.fit.arm.forward(q[within])[:, :3, 3] - position[within]
    rms = [float(np.sqrt((e**2).sum(axis=1).mean())) for e in (rigid, error)]
    assert within.mean() > 0.8
    assert rms[1] < 0.35 * rms[0]


def test_the_panda_with_a_probe_is_better_with_what_is_named() -> None:
    report = bathyal.diagnose(bathyal.arms.panda(), sockets("panda_3"))
    assert report.verdict in ("named", "ambiguous")
    assert report.held_out.rms_before < 0.22e-3
    assert report.held_out.rms_after < 0.175e-3
