# SPDX-License-Identifier: BSD-3-Clause
"""An arm with effects inside: used as any other, kept in files."""

import copy
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import bathyal
from bathyal.effects import Effect, FoundEffect, Support
from tests.support.corrected_arm_cases import ALL, COVARIATES, RNG, Q, effects, harmonic, model


def test_forward_puts_the_effects_in_the_chain() -> None:
    arm = model()
    q = Q.copy()
    q[:, 2] += 1e-3 * np.cos(2 * Q[:, 2]) + 5e-4 * np.sin(2 * Q[:, 2])
    table = arm.arm.to_dh()
    slipped = np.array(arm.tool)
    slipped[:3, 3] += [1e-3, 2e-3, 3e-3]
    for row in (0, 50, 150):
        grown = 1 + 2e-5 * (COVARIATES["temperature"][row] - 20)
        rigid = bathyal.Arm.from_dh(
            a=grown * table.a, alpha=table.alpha, d=grown * table.d, theta=table.theta,
            root=table.root, flange=table.flange, tool=slipped if row > 100 else arm.tool,
        )  # fmt: skip
        pose = rigid.forward(q[row])
        if row >= 100:
            angle = 1e-3 * np.sqrt(3)
            cross = np.array([[0, -1, 1], [1, 0, -1], [-1, 1, 0]]) / np.sqrt(3)
            base = np.eye(4)
            base[:3, :3] += np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
            base[:3, 3] = 1e-3
            pose = base @ pose
        covariates = {name: values[row] for name, values in COVARIATES.items()}
        np.testing.assert_allclose(arm.forward(Q[row], covariates=covariates), pose, atol=1e-14)


def test_shapes_are_those_of_any_arm() -> None:
    arm = model()
    assert arm.forward(Q, covariates=COVARIATES).shape == (200, 4, 4)
    assert arm.forward(Q[0], covariates=ALL).shape == (4, 4)
    assert arm.forward(Q, covariates=COVARIATES, links=True).shape == (200, 7, 4, 4)
    assert arm.jacobian(Q[:2], covariates=ALL).shape == (2, 6, 6)
    assert arm.jacobian(Q[0], covariates=ALL, frame="tool").shape == (6, 6)
    assert arm.effects_in_support(Q, covariates=COVARIATES).shape == (200, 4)
    assert arm.effects_in_support(Q[0], covariates=ALL).tolist() == [True] * 4
    assert arm.in_support(Q, covariates=COVARIATES).shape == (200,)
    assert arm.forward(np.zeros((0, 6)), covariates=ALL).shape == (0, 4, 4)


def test_what_knows_no_effects_has_the_rigid_part() -> None:
    arm = model()
    assert arm.size == 6
    assert arm.name == "UR10e"
    assert arm.joint_names == arm.arm.joint_names
    assert np.array_equal(arm.upper, arm.arm.upper)
    assert arm.within_limits(Q[0])
    assert "<robot" in arm.to_urdf()
    assert arm.to_urdf() == arm.arm.to_urdf()
    arm.base = np.diag([1.0, -1.0, -1.0, 1.0])
    assert np.array_equal(arm.base, arm.arm.base)
    assert repr(arm) == (
        'CorrectedArm("UR10e", 6 joints, joint_harmonic of joint 3, thermal, base_shift, tool_slip)'
    )


def test_the_jacobian_is_the_derivative() -> None:
    arm, step = model(), 1e-6
    jacobian = arm.jacobian(Q[:5], covariates=ALL)
    for j in range(6):
        move = step * np.eye(6)[j]
        up = arm.forward(Q[:5] + move, covariates=ALL)
        down = arm.forward(Q[:5] - move, covariates=ALL)
        velocity = (up - down)[:, :3, 3] / (2 * step)
        np.testing.assert_allclose(jacobian[:, :3, j], velocity, atol=1e-7)


def test_the_inverse_comes_back_to_a_nanometre() -> None:
    arm = model()
    q = Q[:50].copy()
    q[:, 2] = 0.2 + 0.7 * np.abs(q[:, 2])
    targets = arm.forward(q, covariates=ALL)
    found = arm.inverse(targets, start=q, covariates=ALL)
    assert set(found.status.tolist()) == {"reached"}
    back = arm.forward(found.q, covariates=ALL)
    assert np.linalg.norm((back - targets)[:, :3, 3], axis=1).max() <= 1e-9
    assert found.position_error.max() <= 1e-9
    one = arm.inverse(targets[0, :3, 3], start=q[0], covariates=ALL, task="position")
    assert one.status == "reached"
    assert isinstance(one.position_error, float)


def test_verify_arm_takes_it_like_any_other() -> None:
    arm = model([harmonic()])
    seen = arm.forward(Q)[:, :3, 3] + [4.0, 5.0, 6.0]
    assert bathyal.verify_arm(arm, Q, seen).rms_after < 1e-12
    assert bathyal.verify_arm(arm.arm, Q, seen).rms_after > 1e-4


def test_verify_arm_tells_it_its_covariates() -> None:
    arm = model()
    seen = arm.forward(Q, covariates=COVARIATES)[:, :3, 3] + [4.0, 5.0, 6.0]
    assert bathyal.verify_arm(arm, Q, seen, covariates=COVARIATES).rms_after < 1e-12
    with pytest.warns(bathyal.SupportWarning, match="temperature: not given"):
        assert bathyal.verify_arm(arm, Q, seen).rms_after > 1e-4
    with pytest.raises(ValueError, match="`covariates`: expected none of a rigid arm, got temp"):
        bathyal.verify_arm(arm.arm, Q, seen, covariates={"temperature": 20.0})


@pytest.mark.parametrize(
    ("covariates", "text"),
    [
        ({"payload": 1.0}, "`covariates`: expected temperature, which thermal needs, got payload"),
        (ALL | {"temperature": [1.0, 2.0, 3.0]}, "`covariates temperature`: expected 2 rows"),
        (ALL | {"temperature": "warm"}, "`covariates temperature`"),
        (ALL | {"temperature": np.inf}, "`covariates temperature`: expected finite"),
        (ALL | {"payload": -1.0}, "`covariates payload`: expected finite numbers of 0 or more"),
        (ALL | {"session": 1.5}, "`covariates session`: expected whole numbers"),
        ([1.0], "`covariates`: expected a dict"),
    ],
)
def test_covariates_that_do_not_fit_are_refused(covariates: Any, text: str) -> None:
    with pytest.raises(ValueError, match=text):
        model().forward(Q[:2], covariates=covariates)


@pytest.mark.parametrize(
    "found",
    [
        FoundEffect("joint_harmonic", {"cos": 1e-3, "sin": 0.0}, joint=2),
        FoundEffect("joint_harmonic", {"cos": 1e-3}, joint=2, settings={"order": 2}),
        FoundEffect("joint_harmonic", {"cos": 1e-3, "sin": np.nan}, joint=2, settings={"order": 2}),
        FoundEffect("joint_harmonic", {"cos": 0.0, "sin": 0.0}, settings={"order": 2}),
        harmonic(joint=6),
        harmonic(joint=-2),
        harmonic(order=np.inf),
        FoundEffect("joint_scale", {"scale": 1e-3}),
        FoundEffect("joint_map", {"cos_1": 1e-3, "sin_1": 0.0}, settings={"wave": 1.0}),
        FoundEffect("joint_coupling", {"ratio": 1e-3}, joint=1, settings={"by": 6}),
        FoundEffect("joint_coupling", {"ratio": 1e-3}, joint=1, settings={"by": 0.5}),
        FoundEffect("backlash", {"gap": 1e-3}, joint=1),
        FoundEffect("joint_compliance", {"moment_1": 1e-3}, joint=1, settings={"moment_1": 1e9}),
        FoundEffect("joint_compliance", {"compliance": 1e-3}),
        FoundEffect("link_compliance", {"flexibility": 1e-3}, settings={"row": -1}),
        FoundEffect("payload", {"mass_compliance_1": 1e-3}, settings={"mass_compliance_1": 7}),
        FoundEffect("base_shift", {"shift_x_2": 1e-3}),
        FoundEffect("base_shift", {str(i): 1e-3 for i in range(9)}, settings={"from": 2}),
        FoundEffect("tool_slip", {str(i): 1e-3 for i in range(9)}, settings={"moment": 3}),
        FoundEffect("tool_slip", {"shift_x": 1e-3}, settings={"moment": np.nan}),
        FoundEffect("thermal", {"expansion": 1e-3}),
        FoundEffect("drift", {"rate_x": 1e-3}),
        FoundEffect("outliers", {"any": 1.0}),
    ],
    ids=repr,
)
def test_effects_that_do_not_fit_the_arm_are_refused(found: FoundEffect) -> None:
    with pytest.raises(ValueError, match=r"`.*`: expected "):
        model([found])


def test_an_effect_twice_or_without_its_covariate_is_refused() -> None:
    with pytest.raises(ValueError, match="joint_harmonic of joint 3"):
        model([harmonic(), harmonic()])
    model([harmonic(), harmonic(order=3.0)])
    support = Support([[-1.0] * 6, [1.0] * 6])
    with pytest.raises(ValueError, match="`support`: expected temperature, which thermal needs"):
        bathyal.CorrectedArm(bathyal.arms.ur10e(), effects()[1:2], support)


def test_copies_are_their_own() -> None:
    arm = model()
    for other in (arm.copy(), copy.copy(arm), copy.deepcopy(arm)):
        other.tool = None
        assert not np.array_equal(other.tool, arm.tool)
        assert repr(other) == repr(arm)


# Identification ---------------------------------------------------------------------------------


def test_identification_holds_the_effects() -> None:
    true = model([harmonic(1, 1.7), effects()[1]])
    table = true.arm.to_dh()
    nominal = bathyal.Arm.from_dh(
        a=table.a, alpha=table.alpha, d=table.d + RNG.normal(0, 1e-3, 6), theta=table.theta
    )
    nominal.tool = true.tool
    seen = true.forward(Q, covariates=COVARIATES)[:, :3, 3]
    data = bathyal.Tracked(Q, seen, covariates=COVARIATES)
    start = bathyal.CorrectedArm(nominal, true.effects, true.support)
    fit = bathyal.identify_arm(start, data)
    assert fit.rms_after < 1e-7 < 1e-5 < bathyal.identify_arm(nominal, data).rms_after
    held = {p.name: p for p in fit.parameters if p.name.startswith("joint_harmonic")}
    assert [(p.value, p.status) for p in held.values()] == [(1e-3, "fixed"), (5e-4, "fixed")]
    again = bathyal.CorrectedArm(fit.arm, true.effects, true.support)
    tips = again.forward(Q, covariates=COVARIATES)[:, :3, 3]
    np.testing.assert_allclose(tips, seen, atol=1e-7)


def test_identification_takes_touches_too() -> None:
    arm = model([harmonic(1, 1.7)])
    touches = bathyal.Touches(Q[:40], np.arange(40) // 10)
    assert len(bathyal.identify_arm(arm, touches).parameters) > 2
    with pytest.raises(ValueError, match="`arm`: expected an Arm or a CorrectedArm"):
        bathyal.identify_arm(None, touches)


# Files ------------------------------------------------------------------------------------------


def contents_of(tmp_path: Path) -> dict[str, Any]:
    model().save(tmp_path / "arm.json")
    contents: dict[str, Any] = json.loads((tmp_path / "arm.json").read_text())
    return contents


def test_a_file_keeps_all_to_the_last_digit(tmp_path: Path) -> None:
    arm, path, again = model(), tmp_path / "model.json", tmp_path / "again.json"
    arm.write(path)
    read = bathyal.read_arm(path)
    assert isinstance(read, bathyal.CorrectedArm)
    assert repr(read) == repr(arm)
    read.save(again)
    assert again.read_bytes() == path.read_bytes()
    poses = arm.forward(Q, covariates=COVARIATES)
    assert np.array_equal(read.forward(Q, covariates=COVARIATES), poses)
    assert [found.settings for found in read.effects] == [found.settings for found in arm.effects]
    assert np.array_equal(read.support.joints, [Q.min(axis=0), Q.max(axis=0)])
    assert read.support.sessions.tolist() == [1.0, 2.0]
    for one, other in zip(read.support.gaps, arm.support.gaps, strict=True):
        assert np.array_equal(one, other)
    assert set(read.support.covariates) == {"payload", "temperature", "time"}


def test_a_file_of_an_arm_with_a_users_effect_needs_it_registered(tmp_path: Path) -> None:
    def bend(data: Any, joint: int) -> Any:
        return data.q[:, joint] ** 2

    effect = Effect("bend", bend, parameters={"rate": "1/rad"}, joints=[1])
    path = tmp_path / "model.json"
    model([FoundEffect(effect, {"rate": 1e-3}, joint=1)]).save(path)
    with pytest.raises(bathyal.Error, match=r"model.json: its effect 'bend' is not known: give it"):
        bathyal.read_arm(path)
    bathyal.effects.register(effect)
    try:
        assert bathyal.read_arm(path).effects[0].units == {"rate": "1/rad"}
    finally:
        bathyal.effects.unregister("bend")


def test_other_suffixes_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="json"):
        model().write(tmp_path / "model.urdf")


def without(contents: dict[str, Any], key: str) -> dict[str, Any]:
    return {k: v for k, v in contents.items() if k != key}


BREAKS: dict[str, Any] = {
    "version": lambda c: c | {"version": 3},
    "no_effects": lambda c: c | {"effects": None},
    "no_support": lambda c: without(c, "support"),
    "support_list": lambda c: c | {"support": [1]},
    "no_joints": lambda c: c | {"support": without(c["support"], "joints")},
    "narrow": lambda c: c | {"support": c["support"] | {"joints": {"low": [0], "high": [1]}}},
    "crossed": lambda c: c | {"support": c["support"] | {"sessions": [2, 1]}},
    "covariates": lambda c: c | {"support": c["support"] | {"covariates": [1]}},
    "uncovered": lambda c: c | {"support": c["support"] | {"covariates": {}}},
    "effects": lambda c: c | {"effects": {"name": "thermal"}},
    "an_effect": lambda c: c | {"effects": ["thermal"]},
    "a_key": lambda c: c | {"effects": [c["effects"][0] | {"colour": "red"}]},
    "nameless": lambda c: c | {"effects": [without(c["effects"][0], "name")]},
    "unknown": lambda c: c | {"effects": [c["effects"][0] | {"name": "wobble"}]},
    "joint": lambda c: c | {"effects": [c["effects"][0] | {"joint": 99}]},
    "huge_joint": lambda c: c | {"effects": [c["effects"][0] | {"joint": 10**30}]},
    "text_joint": lambda c: c | {"effects": [c["effects"][0] | {"joint": "two"}]},
    "settings": lambda c: c | {"effects": [c["effects"][0] | {"settings": [2]}]},
    "setting": lambda c: c | {"effects": [c["effects"][0] | {"settings": {"order": "two"}}]},
    "parameters": lambda c: c | {"effects": [c["effects"][0] | {"parameters": []}]},
    "value": lambda c: c | {"effects": [c["effects"][0] | {"parameters": [{"name": "cos"}]}]},
}


@pytest.mark.parametrize("name", BREAKS)
def test_broken_files_are_refused(name: str, tmp_path: Path) -> None:
    path = tmp_path / "broken.json"
    path.write_text(json.dumps(BREAKS[name](contents_of(tmp_path))))
    with pytest.raises(bathyal.Error, match=r"broken\.json"):
        bathyal.read_arm(path)


def test_truncated_files_and_numbers_that_are_none_are_refused(tmp_path: Path) -> None:
    text = json.dumps(contents_of(tmp_path))
    path = tmp_path / "broken.json"
    for broken in (text[:-9], text.replace("20.0", "NaN"), text.replace("20.0", "1e999")):
        assert broken != text
        path.write_text(broken)
        with pytest.raises(bathyal.Error, match=r"broken\.json"):
            bathyal.read_arm(path)


def test_commands_that_want_a_rigid_arm_say_so(tmp_path: Path) -> None:
    from bathyal.arm.files import find_arm

    model().save(tmp_path / "model.json")
    with pytest.raises(ValueError, match="an arm without effects"):
        find_arm(tmp_path / "model.json")
