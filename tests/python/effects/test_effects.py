# SPDX-License-Identifier: BSD-3-Clause
"""The library of effects as Python sees it, and effects that a user brings."""

import doctest
import gc
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import bathyal
from bathyal.effects import Effect, FoundEffect

NAMES = [
    "joint_harmonic",
    "joint_map",
    "joint_scale",
    "joint_coupling",
    "backlash",
    "joint_compliance",
    "link_compliance",
    "payload",
    "base_shift",
    "base_compliance",
    "tool_slip",
    "tool_change",
    "thermal",
    "drift",
    "clock_shift",
    "outliers",
    "range_noise",
    "quantisation",
]
Q = np.random.default_rng(5).uniform(-1, 1, (30, 6))


def cable(data: Any, joint: int) -> Any:
    return np.sin(data.q[:, 1] + data.q[:, 2])


def model_of(function: Callable[..., Any], *, value: float = 1e-3, **options: Any) -> Any:
    """A UR10e with one effect of a user's, of one parameter."""
    options = {"parameters": {"size": "rad"}, "joints": "each"} | options
    effect = Effect("mine", function, **options)
    joint = 3 if options["joints"] else None
    arm = bathyal.arms.ur10e()
    data = bathyal.Tracked(Q, arm.forward(Q)[:, :3, 3])
    parameters = dict.fromkeys(options["parameters"], value)
    return bathyal.CorrectedArm(arm, [FoundEffect(effect, parameters, joint=joint)], data)


def test_the_library_has_every_effect_and_says_what_it_is() -> None:
    effects = bathyal.effects.list()
    assert [effect.name for effect in effects] == NAMES
    for effect in effects:
        assert effect.words
        assert effect.formula
        assert effect.source
        assert all(0 < r.low < r.high and r.unit for r in effect.ranges)
        assert effect.name in str(effect)
        assert effect.source in str(effect)
        assert repr(effect) == f'Effect("{effect.name}")'
    assert bathyal.effects.get("drift").needs == ["time"]
    assert bathyal.effects.get("clock_shift").by_difference
    assert not bathyal.effects.get("joint_map").by_difference


def test_joints_of_small_arms_may_be_soft() -> None:
    """A servo that yields by a hundredth of a radian per N m is no exception."""
    [compliance] = bathyal.effects.get("joint_compliance").ranges
    assert compliance.high >= 1e-2


def test_the_library_says_what_is_extrapolated() -> None:
    physics = {
        "joint_scale",
        "joint_coupling",
        "joint_compliance",
        "link_compliance",
        "payload",
        "base_compliance",
        "thermal",
    }
    assert {effect.name for effect in bathyal.effects.list() if effect.extrapolates} == physics
    assert "beyond the data: extrapolated" in str(bathyal.effects.get("thermal"))
    assert "beyond the data" not in str(bathyal.effects.get("joint_map"))


def test_an_effect_of_a_user_is_extrapolated_where_it_says_so() -> None:
    held, free = (model_of(cable, extrapolates=given) for given in (False, True))
    q = np.full((1, 6), 1.4)
    for model in (held, free):
        assert not model.in_support(q).any()
    with pytest.warns(bathyal.SupportWarning):
        assert np.array_equal(
            free.forward(q), held.arm.forward(q + 1e-3 * np.sin(2.8) * np.eye(6)[3])
        )
    with pytest.warns(bathyal.SupportWarning):
        assert not np.array_equal(free.forward(q), held.forward(q))


def test_a_name_that_no_effect_has_is_refused_with_those_that_there_are() -> None:
    with pytest.raises(ValueError, match=r"`effect`: expected one of joint_harmonic, .*, got 'x'"):
        bathyal.effects.get("x")


def test_an_effect_of_a_user_moves_its_joint() -> None:
    model = model_of(cable)
    moved = Q.copy()
    moved[:, 3] += 1e-3 * np.sin(Q[:, 1] + Q[:, 2])
    assert np.array_equal(model.forward(Q), model.arm.forward(moved))


def test_an_effect_of_a_user_moves_the_base() -> None:
    def twist(data: Any) -> Any:
        return np.tile([1.0, 2.0, 3.0, 0.0, 0.0, 0.0], (len(data), 1)) * data.q[:, :1]

    model = model_of(twist, joints=None, site="base")
    shift = 1e-3 * Q[:, :1] * [1.0, 2.0, 3.0]
    np.testing.assert_allclose(
        model.forward(Q)[:, :3, 3], model.arm.forward(Q)[:, :3, 3] + shift, atol=1e-14
    )


def test_an_effect_of_a_user_moves_the_tool_by_several_parameters() -> None:
    def slip(data: Any) -> Any:
        numbers = np.zeros((len(data), 2, 6))
        numbers[:, 0, 0] = numbers[:, 1, 2] = 1.0
        return numbers

    parameters = {"x": "m", "z": "m"}
    model = model_of(slip, joints=None, site="tool", parameters=parameters)
    poses = model.arm.forward(Q)
    at = poses[:, :3, :3] @ [1e-3, 0.0, 1e-3] + poses[:, :3, 3]
    np.testing.assert_allclose(model.forward(Q)[:, :3, 3], at, atol=1e-14)


def test_an_effect_of_a_user_moves_the_lengths() -> None:
    model = model_of(lambda data: np.ones(len(data)), joints=None, site="lengths")
    table = model.arm.to_dh()
    longer = bathyal.Arm.from_dh(
        a=1.001 * table.a, alpha=table.alpha, d=1.001 * table.d, theta=table.theta,
        root=table.root, flange=table.flange,
    )  # fmt: skip
    np.testing.assert_allclose(model.forward(Q), longer.forward(Q), atol=1e-14)


def test_a_function_sees_what_was_recorded() -> None:
    seen: list[Any] = []

    def look(data: Any, joint: int) -> Any:
        seen.append((data, joint))
        return data.covariates.get("depth", np.zeros(len(data)))

    model = model_of(look)
    model.forward(Q, covariates={"depth": np.arange(30.0), "payload": 0.0})
    data, joint = seen[-1]
    gc.collect()
    assert joint == 3
    assert len(data) == 30
    assert not data.recording
    assert not data.has_rotation
    assert np.array_equal(data.q, Q)
    assert np.array_equal(data.covariates["depth"], np.arange(30.0))
    assert data.gravity.shape == (30, 3)
    assert data.gravity[0].tolist() == [0, 0, -9.80665]
    assert np.array_equal(data.order, np.arange(30))
    assert data.arm.size == 6
    assert not data.q.flags.writeable


@pytest.mark.parametrize(
    ("gives", "error", "text"),
    [
        (
            lambda data, joint: 1 / 0,
            bathyal.Error,
            r"effect mine: .* ZeroDivisionError: .* \(line \d+ of .*test_effects\.py\)$",
        ),
        (lambda data: 0, bathyal.Error, "effect mine: .*TypeError"),
        (lambda data, joint: np.nan * data.q[:, 0], ValueError, "`effect mine`: .*finite.* row 0"),
        (lambda data, joint: data.q, ValueError, r"`effect mine`: .*\(\d+, 1\), got shape"),
        (lambda data, joint: data.q[1:, 0], ValueError, "`effect mine`: .*got shape"),
        (lambda data, joint: 1.0, ValueError, "`effect mine`: .*got shape"),
        (lambda data, joint: "much", ValueError, "`effect mine`: .*got dtype"),
        (lambda data, joint: None, ValueError, "`effect mine`: .*got NoneType"),
        (lambda data, joint: 1j * data.q[:, 0], ValueError, "`effect mine`: .*got dtype complex"),
    ],
    ids=["raises", "arguments", "nan", "wide", "short", "number", "text", "nothing", "complex"],
)
def test_a_function_that_fails_is_reported_by_the_name_of_its_effect(
    gives: Callable[..., Any], error: type[Exception], text: str
) -> None:
    with pytest.raises(error, match=text):
        model_of(gives)


def test_an_interrupt_inside_a_function_is_no_error_of_the_effect() -> None:
    def stop(data: Any, joint: int) -> Any:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        model_of(stop)


@pytest.mark.parametrize(
    ("options", "text"),
    [
        ({"parameters": {}}, "one parameter or more"),
        ({"parameters": {"size": 1}}, "a dict of name to unit"),
        ({"joints": None}, "`joints` where its site"),
        ({"joints": "all"}, '"each" or a list'),
        ({"joints": [-1]}, "joints from 0"),
        ({"site": "base"}, "`joints` where its site"),
        ({"site": "wrist"}, '"joint" or "link" or "base" or "tool" or "lengths"'),
        ({"scales": {"size": 0.0}}, "above 0"),
    ],
)
def test_an_effect_that_is_defined_wrongly_is_refused(options: dict[str, Any], text: str) -> None:
    with pytest.raises(ValueError, match=text):
        Effect("mine", cable, **({"parameters": {"size": "rad"}, "joints": "each"} | options))


def test_registered_effects_follow_the_library() -> None:
    effect = Effect("cable", cable, parameters={"pull": "rad"}, joints="each")
    bathyal.effects.register(effect)
    try:
        bathyal.effects.register(effect)  # again the same is no other
        assert [known.name for known in bathyal.effects.list()] == [*NAMES, "cable"]
        assert bathyal.effects.get("cable") is effect
        other = Effect("cable", cable, parameters={"pull": "rad"}, joints="each")
        with pytest.raises(ValueError, match="a name that is not taken"):
            bathyal.effects.register(other)
    finally:
        bathyal.effects.unregister("cable")
    with pytest.raises(ValueError, match="one that was registered"):
        bathyal.effects.unregister("cable")
    mine = Effect("drift", cable, parameters={"pull": "rad"}, joints="each")
    with pytest.raises(ValueError, match="a name that is not taken"):
        bathyal.effects.register(mine)


def test_found_effects_say_what_they_are() -> None:
    found = FoundEffect(
        "joint_harmonic", {"cos": 1e-3, "sin": -2e-3}, joint=2, settings={"order": 2},
        cause="curve of joint 2",
    )  # fmt: skip
    assert found.name == "joint_harmonic"
    assert found.joint == 2
    assert found.settings == {"order": 2}
    assert found.parameters == {"cos": 1e-3, "sin": -2e-3}
    assert list(found.parameters) == ["cos", "sin"]
    assert found.units["cos"] == "rad or m"
    assert found.cause == "curve of joint 2"
    assert found.scales["sin"] == 1e-3
    assert found.effect.name == "joint_harmonic"
    assert FoundEffect("thermal", {"expansion": 1e-5}).joint is None
    with pytest.raises(ValueError, match="one of joint_harmonic"):
        FoundEffect("wobble", {})
    with pytest.raises(ValueError, match="a dict of name to number"):
        FoundEffect("thermal", {"expansion": "much"})


def test_the_example_for_contributors_runs() -> None:
    page = Path(__file__).parents[3] / "CONTRIBUTING.md"
    failed, tried = doctest.testfile(str(page), module_relative=False)
    assert (failed, tried) == (0, 6)
