# SPDX-License-Identifier: BSD-3-Clause
"""What an arm with effects inside does beyond the data that taught it."""

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
    q[1, 2] = 2.7
    covariates = ALL | {"temperature": [25, 25, 45, np.nan], "session": [1, 1, 1, 7]}
    with pytest.warns(bathyal.SupportWarning) as caught:
        poses = arm.forward(q, covariates=covariates)
    assert len(caught) == 1
    warning = caught[0].message
    assert isinstance(warning, bathyal.SupportWarning)
    assert warning.counts == {"joint_harmonic of joint 3": 1, "thermal": 2, "base_shift": 1}
    low, high = np.quantile(COVARIATES["temperature"], [0, 1])
    assert warning.beyond == [
        f"joint 3: {q[1:, 2].min():.4g} to 2.7, data {Q[:, 2].min():.4g} to {Q[:, 2].max():.4g}, "
        "1 rows",
        "session: 7 not in the data",
        f"temperature: 25 to 45, data {low:.4g} to {high:.4g}, 1 rows; unknown, 1 rows",
    ]
    assert str(warning).splitlines() == [
        "3 of 4 rows lie beyond the data of this model; effects: 1 extrapolated, 1 held, 2 omitted "
        "(support_reasons() tells each row's).",
        *warning.beyond,
    ]
    assert caught[0].filename == __file__
    expected = [[1, 1, 1, 1], [0, 1, 1, 1], [1, 0, 1, 1], [1, 0, 0, 1]]
    assert warning.effects_in_support.astype(int).tolist() == expected
    assert warning.in_support.tolist() == [True, False, False, False]
    # The wave at its average, heat extrapolated.
    row = {name: np.ravel(v)[1] if np.ndim(v) else v for name, v in covariates.items()}
    places = np.linspace(*np.quantile(Q[:, 2], [0, 1]), 10001)
    average = np.mean(1e-3 * np.cos(2 * places) + 5e-4 * np.sin(2 * places))
    held = model(effects()[1:]).forward(q[1] + average * np.eye(6)[2], covariates=row)
    np.testing.assert_allclose(poses[1], held, atol=1e-7)
    grown = arm.arm.forward(q[2])
    warm = model(effects()[1:2]).forward(q[2], covariates={"temperature": 25.0})
    hot = model(effects()[1:2])
    with pytest.warns(bathyal.SupportWarning):
        hotter = hot.forward(q[2], covariates={"temperature": 45.0})
    np.testing.assert_allclose(hotter - grown, 5.0 * (warm - grown), atol=1e-12)


def test_where_no_effect_is_known_it_is_the_rigid_arm() -> None:
    arm = model(effects()[1:3])
    for call in (arm.forward, arm.jacobian):
        with pytest.warns(bathyal.SupportWarning, match="temperature: not given"):
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
    with pytest.warns(bathyal.SupportWarning, match=r"joint 3: gaps up to -1.* to 1.*, 2 rows$"):
        arm.forward(asked)
    assert arm.in_support(asked).tolist() == [False, False, True]
    assert "in the gap of the data from -1." in arm.support_reasons(asked[0])
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
    assert str(caught[0].message).splitlines()[1:] == ["joint 3: gaps up to -1 to 1, 1 rows"]


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


def test_each_row_has_its_reasons() -> None:
    arm = model()
    q = Q[:4].copy()
    q[1, 2] = 1.5
    covariates = ALL | {"temperature": [25, 25, 45, np.nan], "session": [1, 1, 1, 7]}
    within = arm.in_support(q, covariates=covariates)
    assert within.dtype == bool
    assert within.tolist() == [True, False, False, False]
    each = arm.effects_in_support(q, covariates=covariates)
    assert np.array_equal(each.all(axis=1), within)
    assert each[3].tolist() == [True, False, False, True]
    reasons = arm.support_reasons(q, covariates=covariates)
    assert [text == "" for text in reasons] == within.tolist()
    low, high = np.quantile(COVARIATES["temperature"], [0, 1])
    assert reasons[2] == f"temperature at 45, data {low:.6g} to {high:.6g}: thermal extrapolated"
    assert reasons[3] == (
        "temperature unknown: thermal omitted; session 7, not in the data: base_shift omitted"
    )
    row = {name: np.ravel(v)[1] if np.ndim(v) else v for name, v in covariates.items()}
    assert arm.support_reasons(q[1], covariates=row) == reasons[1]
    assert not arm.in_support(q[1], covariates=row)
    assert arm.effects_in_support(q[1], covariates=row).tolist() == [False, True, True, True]


def test_a_joint_on_which_no_effect_depends_is_no_reason() -> None:
    arm = model([harmonic()])
    far = Q[0] + 3.0 * np.eye(6)[5]
    assert arm.in_support(far)
    assert arm.support_reasons(far) == ""
    with pytest.warns(bathyal.SupportWarning) as caught:
        arm.forward(far + 3.0 * np.eye(6)[2])
    assert [line.split(":")[0] for line in str(caught[0].message).splitlines()[1:]] == ["joint 3"]


def test_a_warning_has_one_line_a_joint_and_is_short() -> None:
    many = [harmonic(joint, order) for joint in range(6) for order in (1.0, 2.0, 3.0)]
    support = Support([[-0.5123456] * 6, [0.5123456] * 6], gaps=[[[-0.4, 0.1], [0.12, 0.5]]] * 6)
    arm = bathyal.CorrectedArm(bathyal.arms.ur10e(), [*many, harmonic(3, 40.0)], support)
    with pytest.warns(bathyal.SupportWarning) as caught:
        arm.forward(np.random.default_rng(2).uniform(-3, 3, (5000, 6)))
    message = caught[0].message
    assert isinstance(message, bathyal.SupportWarning)
    lines = str(message).splitlines()
    assert len(str(message)) <= 500
    assert [line.split(":")[0] for line in message.beyond] == [f"joint {j}" for j in range(1, 7)]
    assert lines[1:-1] == message.beyond[: len(lines) - 2] or lines[1:] == message.beyond


def test_what_follows_from_physics_is_extrapolated() -> None:
    h = np.pi / 2
    arm = bathyal.Arm.from_dh(
        a=[0.08, 0.42, 0, 0, 0, 0], alpha=[-h, 0, h, -h, h, 0], d=[0.4, 0, 0.06, 0.48, 0, 0.09],
        theta=[0, -h, h, 0, 0, 0],
        links=[bathyal.Link(mass=m) for m in (30, 28, 22, 8, 9, 2, 1)],
    )  # fmt: skip
    sag = FoundEffect("joint_compliance", {"compliance": 1e-5}, joint=1)
    narrow = bathyal.CorrectedArm(arm, [sag], bathyal.Tracked(0.2 * Q, np.zeros((200, 3))))
    wide = bathyal.CorrectedArm(arm, [sag], bathyal.Tracked(5 * Q, np.zeros((200, 3))))
    assert narrow.effects[0].extrapolates
    assert not narrow.in_support(Q).all()
    with pytest.warns(bathyal.SupportWarning, match="1 extrapolated"):
        poses = narrow.forward(Q)
    assert np.array_equal(poses, wide.forward(Q))
    # Found by moments of unknown masses it is held, as any curve.
    moments = FoundEffect(
        "joint_compliance", {"moment_1": 1e-5}, joint=1, settings={"moment_1": 9.0}
    )
    assert not moments.extrapolates
    held = bathyal.CorrectedArm(arm, [moments], narrow.support)
    free = bathyal.CorrectedArm(arm, [moments], wide.support)
    with pytest.warns(bathyal.SupportWarning, match="1 held"):
        assert not np.allclose(held.forward(Q), free.forward(Q), atol=1e-7)


def test_identification_holds_effects_beyond_their_support() -> None:
    arm = model([harmonic(1, 1.7)])
    data = bathyal.Tracked(Q + 5.0, arm.arm.forward(Q + 5.0)[:, :3, 3])
    fit = bathyal.identify_arm(arm, data)
    assert fit.rms_after < 1e-9
    again = bathyal.CorrectedArm(fit.arm, arm.effects, arm.support)
    with pytest.warns(bathyal.SupportWarning):
        places = again.forward(data.q)[:, :3, 3]
    np.testing.assert_allclose(places, data.position, atol=1e-9)
