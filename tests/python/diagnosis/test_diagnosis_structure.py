# SPDX-License-Identifier: BSD-3-Clause
"""Structure: what residuals depend on, as facts, and the next step that follows from them."""

import numpy as np
import pytest

import bathyal
from bathyal.diagnosis.report.advice import next_steps
from tests.support import diagnosis_cases as cases

ROWS = 160


def diagnosed(error, **covariates) -> bathyal.Diagnosis:
    """Without any effect in the library, of tips that are off by `error(q)` (N, 3) [m]."""
    arm = bathyal.arms.ur10()
    random = np.random.default_rng(3)
    q = random.uniform(-1.5, 1.5, (ROWS, 6))
    position = arm.forward(q)[:, :3, 3] + error(q) + random.normal(0.0, 1e-4, (ROWS, 3))
    return bathyal.diagnose(arm, bathyal.Tracked(q, position, covariates=covariates), effects=[])


def test_a_vibration_has_a_period_and_no_joints():
    time = np.arange(ROWS, dtype=float)
    report = diagnosed(
        lambda q: np.outer(np.sin(2.0 * np.pi * time / 12.0), [1e-3, 0.0, 5e-4]), time=time
    )
    assert report.verdict == "unknown"
    found = report.leftover
    assert (found.kind, found.coordinates, found.joint) == ("time", [], None)
    assert found.period == pytest.approx(12.0, rel=0.02)
    assert found.against == f"time, period {found.period:.4g} s"
    assert (found.covariate, found.component) == (None, None)
    assert found.is_beyond_noise
    assert report.shown[0].kind == "time"


def test_a_dependence_on_two_joints_names_both():
    report = diagnosed(
        lambda q: 1e-3 * np.outer(np.cos(q[:, 1]) * np.cos(q[:, 4]), [0.0, 0.0, 1.0])
    )
    pairs = [s for s in report.shown if s.kind == "joints" and len(s.coordinates) == 2]
    assert pairs
    for found in pairs:
        first, second = found.coordinates
        assert 0 <= first < second < 6
        assert found.against == f"joints {first + 1} and {second + 1}"
        assert found.period is None
    assert [1, 4] in [list(found.coordinates) for found in pairs]


def test_a_covariate_has_a_name_and_of_several_columns_a_component():
    pressure = np.random.default_rng(4).uniform(0.0, 1.0, (ROWS, 2))
    report = diagnosed(lambda q: np.outer(pressure[:, 1], [2e-3, 0.0, 0.0]), pressure=pressure)
    found = report.shown[0]
    assert (found.kind, found.covariate, found.component) == ("covariate", "pressure", 1)
    assert found.against == "pressure 2"


def test_where_nothing_is_unexplained_the_kind_is_none():
    report = diagnosed(lambda q: np.zeros((ROWS, 3)))
    assert report.verdict == "clean"
    assert (report.leftover.kind, report.leftover.against) == ("none", "")


@pytest.mark.parametrize(
    ("kind", "step"),
    [
        ("time", "look for what runs with that period"),
        ("order", "record the time"),
        ("approach", "record `direction`"),
        ("position", "a body of known size"),
        ("session", "what was changed between sessions"),
        ("covariate", "Repeat a few poses"),
        ("none", "Repeat a few poses"),
    ],
)
def test_the_next_step_follows_from_the_kind(kind, step):
    report = cases.unknown()
    # The text says something else: only the kind counts.
    report.leftover = cases.structure(kind, "joint 3", "time", 1e-4, 0.5, 1e-9)
    assert any(step in text for text in next_steps(report))


def test_the_next_step_names_the_joints():
    report = cases.unknown()
    report.leftover = cases.on_joint(3, "", 1e-4, 0.5, 1e-9)
    assert any("depend on joint 3: sweep that joint" in text for text in next_steps(report))
    report.leftover = cases.on_pair(2, 3, "", 1e-4, 0.5, 1e-9)
    assert any("depend on joints 2 and 3: sweep these" in text for text in next_steps(report))
