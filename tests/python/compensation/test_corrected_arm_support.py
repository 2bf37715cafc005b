# SPDX-License-Identifier: BSD-3-Clause
"""An arm with effects inside is never trusted beyond the data that taught it."""

import warnings
from typing import Any

import numpy as np
import pytest

import bathyal
from bathyal.effects import Effect, FoundEffect, Support
from tests.support.corrected_arm_cases import ALL, COVARIATES, Q, effects, harmonic, model


def test_beyond_the_support_it_says_so_and_falls_back() -> None:
    arm = model()
    q = Q[:4].copy()
    q[1, 2] = 1.5
    covariates = ALL | {"temperature": [25, 25, 45, np.nan], "session": [1, 1, 1, 7]}
    with pytest.warns(bathyal.SupportWarning) as caught:
        poses = arm.forward(q, covariates=covariates)
    assert len(caught) == 1
    warning = caught[0].message
    assert isinstance(warning, bathyal.SupportWarning)
    assert warning.counts == {"joint_harmonic of joint 3": 1, "thermal": 2, "base_shift": 1}
    assert "joint_harmonic of joint 3 in 1 of 4 rows; thermal in 2 of" in str(warning)
    assert [text.split(",")[0] for text in warning.beyond] == [
        "joint 3",
        "temperature",
        "session 7",
    ]
    assert "temperature, asked 25 to 45, taught 10." in str(warning)
    assert caught[0].filename == __file__
    expected = [[1, 1, 1, 1], [0, 1, 1, 1], [1, 0, 1, 1], [1, 0, 0, 1]]
    assert warning.in_support.astype(int).tolist() == expected
    assert arm.in_support(q, covariates=covariates).astype(int).tolist() == expected
    # The wave at its average, the temperature at the highest that was taught.
    row = {name: np.ravel(v)[1] if np.ndim(v) else v for name, v in covariates.items()}
    places = np.linspace(*np.quantile(Q[:, 2], [0, 1]), 10001)
    average = np.mean(1e-3 * np.cos(2 * places) + 5e-4 * np.sin(2 * places))
    held = model(effects()[1:]).forward(q[1] + average * np.eye(6)[2], covariates=row)
    np.testing.assert_allclose(poses[1], held, atol=1e-7)
    hot = ALL | {"temperature": COVARIATES["temperature"].max(), "session": 1}
    assert np.array_equal(poses[2], arm.forward(q[2], covariates=hot))


def test_where_no_effect_is_known_it_is_the_rigid_arm() -> None:
    arm = model(effects()[1:3])
    for call in (arm.forward, arm.jacobian):
        with pytest.warns(bathyal.SupportWarning, match="thermal left out of all rows, for want"):
            call(Q[:3])
    with pytest.warns(bathyal.SupportWarning):
        poses = arm.forward(Q[:3])
    assert np.array_equal(poses, arm.arm.forward(Q[:3]))
    with pytest.warns(bathyal.SupportWarning):
        found = arm.inverse(poses, start=Q[:3])
    np.testing.assert_allclose(found.q, Q[:3], atol=1e-7)


def test_a_gap_is_beyond_the_support() -> None:
    arm = bathyal.arms.ur10e()
    q = np.random.default_rng(4).uniform(-2, 2, (400, 6))
    q[:, 2] += np.sign(q[:, 2])
    data = bathyal.Tracked(q, arm.forward(q)[:, :3, 3])
    arm = bathyal.CorrectedArm(arm, [harmonic(order=4.0)], data)
    widest = max(arm.support.gaps[2], key=np.ptp)
    assert widest[0] < -1 < 1 < widest[1]
    asked = np.zeros((3, 6))
    asked[:, 2] = [0.1, -0.4, 1.2]
    with pytest.warns(
        bathyal.SupportWarning, match="joint 3 in a gap from -1.* to 1.* in 2 of 3 rows"
    ):
        arm.forward(asked)
    assert arm.in_support(asked).ravel().tolist() == [False, False, True]
    assert len(arm.support.gaps[2]) > 1
    assert np.array_equal(arm.gaps[2], [widest])
    slow = bathyal.CorrectedArm(arm.arm, [harmonic(order=2.0)], data)
    assert slow.in_support(asked).all()
    assert len(slow.gaps[2]) == 0


def test_a_gap_of_another_joint_is_not_reported() -> None:
    support = Support([[-2.0] * 6, [2.0] * 6], gaps=[[[-1.0, 1.0]]] * 6)
    arm = bathyal.CorrectedArm(bathyal.arms.ur10e(), [harmonic(2, 9.0), harmonic(4, 2.0)], support)
    assert [len(gaps) for gaps in arm.gaps] == [0, 0, 1, 0, 0, 0]
    with pytest.warns(bathyal.SupportWarning) as caught:
        arm.forward(np.full((1, 6), 0.5))
    assert "joint 3 in a gap from -1 to 1 in 1 of 1 rows" in str(caught[0].message)
    assert str(caught[0].message).count("in a gap") == 1


@pytest.mark.parametrize("gap", [[-3.0, 0.0], [1.0, 2.5], [1.0, 0.5], [np.nan, 1.0]])
def test_gaps_that_are_not_within_their_joints_range_are_refused(gap: list[float]) -> None:
    with pytest.raises(ValueError, match="`support gaps`: expected stretches that rise within"):
        Support([[-2.0] * 6, [2.0] * 6], gaps=[[]] * 5 + [[gap]])


def test_an_effect_of_ones_own_tells_its_period() -> None:
    def teeth(data: Any, joint: int) -> Any:
        return np.sin(9 * data.q[:, joint])

    fine = Effect("teeth", teeth, parameters={"size": "rad"}, joints=[1], period=2 * np.pi / 9)
    support = Support([[-2.0] * 6, [2.0] * 6], gaps=[[]] + [[[-1.0, 1.0]]] * 5)
    arm = bathyal.CorrectedArm(
        bathyal.arms.ur10e(), [FoundEffect(fine, {"size": 1e-3}, joint=1)], support
    )
    assert arm.in_support(np.full((1, 6), 1.5)).all()
    assert not arm.in_support(np.full((1, 6), 0.5)).any()
    with pytest.raises(ValueError, match=r"`period`: expected a length above 0, got 0"):
        Effect("teeth", teeth, parameters={"size": "rad"}, joints=[1], period=0.0)
    with pytest.raises(ValueError, match="support gaps"):
        Support([[-2.0] * 6, [2.0] * 6], gaps=[[[1.0, 0.5]]] * 6)
    with pytest.raises(ValueError, match="support gaps"):
        Support([[-2.0] * 6, [2.0] * 6], gaps=[[]])


def test_inside_the_support_nothing_is_said() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        model().forward(Q, covariates=COVARIATES)
        model([harmonic()]).forward(Q)  # needs nothing
        model(effects()[3:]).forward(Q)  # a tool that slipped has slipped


def test_a_tool_that_slipped_has_slipped_unless_time_says_otherwise() -> None:
    arm = model(effects()[3:])
    moved = arm.forward(Q[0])
    assert np.array_equal(moved, arm.forward(Q[0], covariates={"time": 150.0}))
    assert np.array_equal(moved, arm.forward(Q[0], covariates={"time": 1e6}))
    assert np.array_equal(arm.arm.forward(Q[0]), arm.forward(Q[0], covariates={"time": 3.0}))


def test_identification_holds_effects_beyond_their_support() -> None:
    arm = model([harmonic(1, 1.7)])
    data = bathyal.Tracked(Q + 3.0, arm.arm.forward(Q + 3.0)[:, :3, 3])
    fit = bathyal.identify_arm(arm, data)
    assert fit.rms_after < 1e-9
    again = bathyal.CorrectedArm(fit.arm, arm.effects, arm.support)
    with pytest.warns(bathyal.SupportWarning):
        places = again.forward(data.q)[:, :3, 3]
    np.testing.assert_allclose(places, data.position, atol=1e-9)
