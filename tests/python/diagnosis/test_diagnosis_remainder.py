# SPDX-License-Identifier: BSD-3-Clause
"""Unexplained structure of any form: data that have it are never clean or named."""

import numpy as np
import pytest

import bathyal
from bathyal.identify.simulate import simulate_touches

NOISE = 5e-5


def poses(rows: int, seed: int) -> np.ndarray:
    return np.random.default_rng(seed).uniform(-1.5, 1.5, (rows, 6))


def diagnosed(q: np.ndarray, error: np.ndarray, seed: int) -> bathyal.Diagnosis:
    arm = bathyal.arms.ur10()
    arm.base = np.array(
        [[0.0, -1.0, 0.0, 2.5], [1.0, 0.0, 0.0, 0.4], [0.0, 0.0, 1.0, -0.3], [0.0, 0.0, 0.0, 1.0]]
    )
    noise = np.random.default_rng([seed, 1]).normal(0.0, NOISE, (len(q), 3))
    position = arm.forward(q)[:, :3, 3] + error + noise
    return bathyal.diagnose(arm, bathyal.Tracked(q, position))


@pytest.mark.parametrize("seed", range(3))
def test_more_than_repeats_of_a_pose_differ_is_never_clean(seed):
    """An error of each pose of its own, which no smooth function is: pure error shows it."""
    each = poses(60, seed)
    of_pose = np.random.default_rng([seed, 2]).normal(0.0, 1.7 * NOISE, (60, 3))
    report = diagnosed(np.repeat(each, 4, axis=0), np.repeat(of_pose, 4, axis=0), seed)
    assert report.verdict == "unknown"
    assert report.noise == pytest.approx(NOISE, rel=0.15)
    assert report.leftover.is_beyond_noise


@pytest.mark.parametrize("seed", range(3))
def test_repeats_without_more_are_clean(seed):
    q = np.repeat(poses(60, seed), 4, axis=0)
    assert diagnosed(q, np.zeros((len(q), 3)), seed).verdict == "clean"


@pytest.mark.parametrize("seed", range(4))
def test_touches_with_noise_alone_are_clean(seed):
    made = simulate_touches(bathyal.arms.ur10e(), seed=seed)
    report = bathyal.diagnose(bathyal.arms.ur10e(), made.touches)
    assert report.verdict == "clean"


@pytest.mark.parametrize("seed", range(3))
def test_an_error_that_repeats_itself_along_the_range_is_seen(seed):
    """The cyclic error of an instrument that measures distances by phase."""
    q = poses(250, seed)
    arm = bathyal.arms.ur10()
    arm.base = np.array(
        [[0.0, -1.0, 0.0, 2.5], [1.0, 0.0, 0.0, 0.4], [0.0, 0.0, 1.0, -0.3], [0.0, 0.0, 0.0, 1.0]]
    )
    tip = arm.forward(q)[:, :3, 3]
    distance = np.linalg.norm(tip, axis=1)
    along = tip / distance[:, None]
    error = 4 * NOISE * np.sin(2.0 * np.pi * distance / 0.3)[:, None] * along
    report = diagnosed(q, error, seed)
    assert report.verdict == "unknown"
    assert (report.leftover.kind, report.leftover.against) == (
        "range",
        "the range from the instrument",
    )


@pytest.mark.parametrize("seed", range(3))
def test_names_that_crowd_around_something_else_are_not_named(seed):
    """A joint that is turned by the product of two others: each name takes a little of it."""
    q = poses(250, seed)
    arm = bathyal.arms.ur10()
    wrong = q.copy()
    wrong[:, 1] += 4e-4 * np.sin(2.0 * q[:, 2]) * np.sin(1.5 * q[:, 3] + 1.0)
    error = arm.forward(wrong)[:, :3, 3] - arm.forward(q)[:, :3, 3]
    turned = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    report = diagnosed(q, error @ turned.T, seed)
    assert report.verdict == "unknown"


@pytest.mark.parametrize("seed", [0, 2, 3, 4])
def test_names_that_leave_a_twentieth_beyond_noise_are_partial(seed):
    """A joint that another one takes along beyond an angle: a coupling and a wave of the two joints
    leave 4 to 7 % of the variance, and were named."""
    q = np.random.default_rng(seed).uniform(-1.5, 1.5, (200, 6))
    arm = bathyal.arms.ur10()
    wrong = q.copy()
    wrong[:, 2] += 8e-4 * np.maximum(0.0, q[:, 1] - 0.2)
    noise = np.random.default_rng([seed, 1]).normal(0.0, NOISE, (200, 3))
    data = bathyal.Tracked(q, arm.forward(wrong)[:, :3, 3] + noise)
    report = bathyal.diagnose(arm, data)
    assert report.verdict == "unknown"
    assert report.effects
    assert 0.02 < report.leftover.share < 0.1
    assert bathyal.diagnose(arm, data, leftover=0.25).verdict == "named"
