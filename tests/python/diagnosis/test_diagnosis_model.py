# SPDX-License-Identifier: BSD-3-Clause
"""The model that a diagnosis hands out is the one that its report describes."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import bathyal
from bathyal import Arm, CorrectedArm, Link, Touches, Tracked
from bathyal.effects import Effect, FoundEffect, library_effects
from tests.support.elbow_table import ELBOW
from tests.support.model_agreement import difference

Array = NDArray[np.float64]

_MASSES = (30, 28, 22, 8, 9, 2, 1)
_NOISE = 2e-5


def _elastic(rng: np.random.Generator) -> CorrectedArm:
    """An arm of which two joints give way under its weight."""
    heavy = Arm.from_dh(**ELBOW, links=[Link(mass=mass) for mass in _MASSES])
    found = [
        FoundEffect("joint_compliance", {"compliance": 4e-6}, joint=1),
        FoundEffect("joint_compliance", {"compliance": 1e-5}, joint=2),
    ]
    return CorrectedArm(heavy, found, Tracked(rng.uniform(-4, 4, (100, 6)), np.zeros((100, 3))))


def _rms(errors: Array) -> float:
    return float(np.sqrt((errors**2).sum(axis=1).mean()))


@pytest.mark.parametrize("seed", [1, 3])
def test_joints_that_give_way_on_an_arm_of_unknown_masses(seed: int) -> None:
    rng = np.random.default_rng(seed)
    truth = _elastic(rng)
    q = rng.uniform(-1.5, 1.5, (200, 6))
    data = Tracked(q, truth.forward(q)[:, :3, 3] + rng.normal(0, _NOISE, (200, 3)))
    report = bathyal.diagnose(Arm.from_dh(**ELBOW), data)
    assert report.verdict == "named"
    assert {effect.joint for effect in report.effects} == {1, 2}
    assert difference(report, data) < 1e-9
    assert _rms(np.asarray(report.residuals_after)) < 2.2 * _NOISE
    unused = rng.uniform(-1.5, 1.5, (500, 6))
    error = report.model.forward(unused)[:, :3, 3] - truth.forward(unused)[:, :3, 3]
    assert _rms(error) < 1.5 * _NOISE
    assert _rms(error) ** 2 + 3 * _NOISE**2 < (1.3 * report.held_out.rms_after) ** 2


def test_moments_that_the_drawing_has_at_nothing_are_no_numbers() -> None:
    """An arm a little off its drawing makes some torque of each; the next fit makes another."""
    rng = np.random.default_rng(1)
    q = rng.uniform(-1.5, 1.5, (200, 6))

    def numbers(off: float) -> list[list[str]]:
        rows = {k: np.array(v) + off * rng.uniform(-1, 1, 6) for k, v in ELBOW.items()}
        truth = _elastic(rng)
        data = Tracked(q, truth.forward(q)[:, :3, 3] + rng.normal(0, _NOISE, (200, 3)))
        report = bathyal.diagnose(Arm.from_dh(**rows), data)
        return [sorted(e.parameters) for e in report.effects if e.name == "joint_compliance"]

    assert numbers(0.0) == numbers(2e-3)


def test_a_load_that_is_not_known_in_every_row_is_left_out_by_the_model_too() -> None:
    rng = np.random.default_rng(2)
    truth = _elastic(rng)
    q = rng.uniform(-1.5, 1.5, (200, 6))
    position = truth.forward(q)[:, :3, 3] + rng.normal(0, _NOISE, (200, 3))
    load = rng.uniform(0, 5, (200, 1))
    load[7] = np.nan
    data = Tracked(q, position, covariates={"payload": load})
    report = bathyal.diagnose(truth.arm, data)
    assert {e.name for e in report.effects} == {"joint_compliance"}
    assert difference(report, data) < 1e-9


def test_touches_leave_what_the_model_leaves_at_the_recorded_joints() -> None:
    rng = np.random.default_rng(5)
    arm = bathyal.arms.ur10()
    points = arm.forward(rng.uniform(-1.2, 1.2, (6, 6)))[:, :3, 3]
    starts = rng.uniform(-1.5, 1.5, (2000, 6))
    rows: list[Array] = []
    label: list[int] = []
    for k, start in enumerate(starts):
        point = k % len(points)
        found = _touching(arm, points[point], start)
        if found is not None:
            rows.append(found)
            label.append(point)
        if len(rows) == 150:
            break
    q = np.array(rows) + rng.normal(0, 5e-5, (len(rows), 6))
    data = Touches(q, np.array(label), known_distances=_distances(points))
    report = bathyal.diagnose(arm, data)
    assert [(e.name, e.joint) for e in report.effects] == [("joint_harmonic", 1)]
    assert difference(report, data) < 1e-9


def test_a_model_that_does_something_else_than_its_report_is_refused() -> None:
    """An effect of a user's own that changes its mind, once all has been found."""
    rng = np.random.default_rng(3)
    arm = bathyal.arms.ur10()
    q = rng.uniform(-1.5, 1.5, (200, 6))
    true = q.copy()
    true[:, 2] += 1e-3 * np.sin(2 * q[:, 1])
    data = Tracked(q, arm.forward(true)[:, :3, 3] + rng.normal(0, 1e-4, (200, 3)))
    size = 1.0

    def cable(data: Any, _: int) -> Array:
        return size * np.sin(2 * data.q[:, 1])

    def heard(done: float, _: str) -> None:
        nonlocal size
        size = 1.0 if done < 1.0 else 2.0

    own = Effect("cable", cable, parameters={"pull": "rad"}, joints=[2])
    with pytest.raises(bathyal.Error, match="the model that was found gives another tip in row"):
        bathyal.diagnose(arm, data, effects=[*library_effects(), own], progress=heard)


def _touching(arm: Arm, point: Array, start: Array) -> Array | None:
    """Joints at which an arm with a wave along joint 2 touches a point, by Newton's way."""
    q = start.copy()
    for _ in range(60):
        true = q.copy()
        true[1] += 1e-3 * np.cos(2 * q[1])
        miss = point - arm.forward(true[None])[0, :3, 3]
        if np.linalg.norm(miss) < 1e-12:
            return q if np.abs(q).max() < 2.5 else None
        step = np.linalg.pinv(arm.jacobian(true[None])[0][:3]) @ miss
        q += step * min(1.0, 0.3 / np.abs(step).max())
    return None


def _distances(points: Array) -> dict[tuple[int, int], float]:
    return {
        (a, b): float(np.linalg.norm(points[a] - points[b]))
        for a in range(len(points))
        for b in range(a)
    }
