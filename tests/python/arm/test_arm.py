# SPDX-License-Identifier: BSD-3-Clause
"""Arms: tables, properties, forward kinematics, Jacobians, statics."""

import copy
import pickle

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

import bathyal
from tests.support.pin_arms import PinArm
from tests.support.random_arms import CATALOGUE, poses_of, random_arm, rigid

Array = NDArray[np.float64]


def check_against_pinocchio(arm: bathyal.Arm) -> None:
    peer = PinArm(arm)
    q = poses_of(arm, 20)
    gravity = np.array([0.5, -1.0, -9.0])
    forward = arm.forward(q)
    world, tool = arm.jacobian(q), arm.jacobian(q, frame="tool")
    torques = arm.statics(q, gravity=gravity, water_density=0)
    for i, row in enumerate(q):
        np.testing.assert_allclose(forward[i], peer.forward(row), atol=1e-12)
        np.testing.assert_allclose(world[i], peer.jacobian(row, "world"), atol=1e-12)
        np.testing.assert_allclose(tool[i], peer.jacobian(row, "tool"), atol=1e-12)
        held = peer.gravity(row, arm.base[:3, :3] @ gravity)
        np.testing.assert_allclose(torques[i], held, atol=1e-10)


@pytest.mark.parametrize("make", CATALOGUE, ids=lambda make: make.__name__)
def test_catalogue_arms_agree_with_pinocchio(make) -> None:  # type: ignore[no-untyped-def]
    check_against_pinocchio(make())


@given(seed=st.integers(0, 2**32 - 1), joints=st.integers(1, 9))
@settings(max_examples=60, deadline=None)
def test_random_tables_agree_with_pinocchio(seed: int, joints: int) -> None:
    check_against_pinocchio(random_arm(seed, joints))


def test_one_pose_and_many_have_their_shapes() -> None:
    arm = bathyal.arms.panda()
    q = poses_of(arm, 4)
    assert arm.forward(q).shape == (4, 4, 4)
    assert arm.forward(q[0]).shape == (4, 4)
    assert arm.forward(q[:0]).shape == (0, 4, 4)
    assert arm.forward(q, links=True).shape == (4, 9, 4, 4)
    assert arm.forward(q[0], links=True).shape == (9, 4, 4)
    assert arm.jacobian(q).shape == (4, 6, 7)
    assert arm.manipulability(q).shape == (4,)
    assert isinstance(arm.manipulability(q[0]), float)
    assert arm.statics(q).shape == (4, 7)
    assert arm.statics(q[0], np.ones(6)).shape == (7,)
    assert arm.within_limits(q).all()
    assert arm.within_limits(q[0]) is True
    np.testing.assert_array_equal(arm.forward(q)[2], arm.forward(q[2]))
    assert not arm.forward(q).flags.writeable
    assert arm.forward(q.astype(np.float32)).dtype == np.float64
    assert arm.forward(q[::2, :].copy(order="F")).shape == (2, 4, 4)


def test_the_last_link_ends_where_flange_and_tool_begin() -> None:
    arm = random_arm(5, 5)
    links = arm.forward(np.zeros(arm.size), links=True)
    last = links[-1] @ np.linalg.inv(arm.links[-1].frame)
    tip = last @ arm.to_dh().flange @ arm.tool
    np.testing.assert_allclose(tip, arm.forward(np.zeros(arm.size)), atol=1e-13)
    foot = arm.base @ arm.to_dh().root @ arm.links[0].frame
    np.testing.assert_allclose(links[0], foot, atol=1e-13)


def test_a_wrench_in_either_frame() -> None:
    arm = bathyal.arms.ur10e()
    q = poses_of(arm, 3)
    wrench = np.arange(18.0).reshape(3, 6)
    turned = wrench.reshape(3, 2, 3) @ arm.forward(q)[:, :3, :3]
    np.testing.assert_allclose(
        arm.statics(q, turned.reshape(3, 6), frame="tool"), arm.statics(q, wrench), atol=1e-10
    )
    expected = np.einsum("nij,ni->nj", arm.jacobian(q), wrench)
    np.testing.assert_allclose(arm.statics(q, wrench), expected, atol=1e-10)


def test_buoyancy_takes_weight_off() -> None:
    dry = random_arm(7, 4)
    q = poses_of(dry, 5)
    table = dry.to_dh()
    links = [
        bathyal.Link(mass=k.mass, center_of_mass=k.center_of_mass, volume=k.mass / 1000,
                     center_of_buoyancy=k.center_of_mass, frame=k.frame) for k in dry.links
    ]  # fmt: skip
    afloat = bathyal.Arm.from_dh(
        table.a, table.alpha, table.d, table.theta, beta=table.beta, joint_types=table.joint_types,
        links=links, root=table.root,
    )  # fmt: skip
    np.testing.assert_allclose(afloat.statics(q, water_density=1000.0), 0, atol=1e-10)
    assert np.abs(afloat.statics(q, water_density=0)).max() > 1


def test_modified_tables_come_back() -> None:
    arm = bathyal.arms.panda()
    table = arm.to_dh(convention="modified")
    np.testing.assert_allclose(table.a, [0, 0, 0, 0.0825, -0.0825, 0, 0.088, 0], atol=1e-15)
    np.testing.assert_allclose(table.d, [0.333, 0, 0.316, 0, 0.384, 0, 0, 0.107], atol=1e-15)
    again = bathyal.Arm.from_dh(
        table.a, table.alpha, table.d, table.theta, joint_types=table.joint_types,
        convention="modified", root=table.root, flange=table.flange,
    )  # fmt: skip
    q = poses_of(arm, 5)
    np.testing.assert_allclose(again.forward(q), arm.forward(q), atol=1e-14)
    assert repr(table) == "DhTable(8 rows, modified)"


def test_base_and_tool_are_the_users() -> None:
    arm = bathyal.arms.ur10e()
    q = poses_of(arm, 3)
    plain = arm.forward(q)
    random = np.random.default_rng(1)
    arm.base, arm.tool = rigid(random), rigid(random)
    np.testing.assert_allclose(arm.forward(q), arm.base @ plain @ arm.tool, atol=1e-12)
    arm.base = arm.tool = None
    np.testing.assert_array_equal(arm.forward(q), plain)
    with pytest.raises(ValueError, match="tool"):
        arm.tool = 2 * np.eye(4)
    with pytest.raises(AttributeError):
        arm.name = "other"


@pytest.mark.parametrize("twin", [bathyal.Arm.copy, copy.copy, copy.deepcopy,
                                  lambda arm: pickle.loads(pickle.dumps(arm))])  # fmt: skip
def test_copies_are_whole_and_their_own(twin) -> None:  # type: ignore[no-untyped-def]
    arm = random_arm(3, 6)
    other = twin(arm)
    q = poses_of(arm, 3)
    for call in ("forward", "statics", "jacobian"):
        np.testing.assert_array_equal(getattr(other, call)(q), getattr(arm, call)(q))
    assert (other.name, other.source, other.joint_names) == (arm.name, arm.source, arm.joint_names)
    other.base = np.eye(4)
    assert not np.array_equal(other.base, arm.base)


def test_properties_of_a_table() -> None:
    arm = bathyal.Arm.from_dh(
        a=[0.1, 0.2, 0.3], alpha=[0, 0, 0], d=[0, 0, 0], theta=[0, 0, 0],
        joint_types=["prismatic", "fixed", "revolute"], lower=[0, 0, -1], upper=[2, 0, 1],
        velocity=[0.1, 0, 0.5], effort=[100, 0, 20], names=["lift", "bracket", "turn"],
        name="crane", source="a drawing",
    )  # fmt: skip
    assert arm.size == 2
    assert arm.joint_names == ["lift", "turn"]
    assert arm.joint_types == ["prismatic", "revolute"]
    np.testing.assert_array_equal(arm.lower, [0, -1])
    np.testing.assert_array_equal(arm.upper, [2, 1])
    np.testing.assert_array_equal(arm.velocity, [0.1, 0.5])
    np.testing.assert_array_equal(arm.effort, [100, 20])
    assert repr(arm) == 'Arm("crane", 2 joints)'
    assert arm.source == "a drawing"
    assert len(arm.link_names) == len(arm.links) == 4


COLUMNS = {"a": [0.1, 0.2], "alpha": [0, 0], "d": [0, 0], "theta": [0, 0]}


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"alpha": [0]}, "`alpha`: expected 2 values"),
        ({"beta": [0.0]}, "`beta`"),
        ({"a": [0.1, np.nan]}, "finite"),
        ({"a": [[0.1, 0.2]]}, r"`a`: expected real numbers of shape \(N,\)"),
        ({"a": ["x", "y"]}, "`a`"),
        ({"a": [], "alpha": [], "d": [], "theta": []}, "at least one that moves"),
        ({"joint_types": ["fixed", "fixed"]}, "at least one that moves"),
        ({"joint_types": ["revolute"]}, "joint_types"),
        ({"joint_types": ["revolute", "bent"]}, '"revolute" or "prismatic" or "fixed"'),
        ({"convention": "new"}, '"standard" or "modified"'),
        ({"lower": [1, 1], "upper": [0, 2]}, "lower <= upper"),
        ({"lower": [0]}, "lower"),
        ({"names": ["one"]}, "names"),
        ({"links": [bathyal.Link()]}, "links"),
        ({"root": np.diag([1, 1, -1, 1])}, "root"),
        ({"flange": np.eye(3)}, "flange"),
        ({"base": np.full((4, 4), np.nan)}, "base"),
    ],
)
def test_tables_that_are_no_arm_are_refused(change: dict[str, object], says: str) -> None:
    with pytest.raises(ValueError, match=says):
        bathyal.Arm.from_dh(**{**COLUMNS, **change})  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("q", "says"),
    [
        (np.zeros(5), r"shape \(N, 6\) or \(6,\), got shape \(5,\)"),
        (np.zeros((2, 7)), r"got shape \(2, 7\)"),
        (np.zeros((2, 2, 6)), "got shape"),
        (np.full(6, np.nan), "nan in row 0"),
        ([[0] * 6, [0, 0, np.inf, 0, 0, 0]], "inf in row 1"),
        (None, "NoneType"),
        ("q", "q"),
        (np.zeros(6, complex), "dtype complex128"),
    ],
)
@pytest.mark.parametrize("call", ["forward", "jacobian", "statics", "manipulability"])
def test_joint_values_that_are_none_are_refused(call: str, q: object, says: str) -> None:
    with pytest.raises(ValueError, match=says):
        getattr(bathyal.arms.ur10e(), call)(q)


def test_other_refusals() -> None:
    arm = bathyal.arms.ur10e()
    q = np.zeros((3, 6))
    for call, says in [
        (lambda: arm.jacobian(q, frame="flange"), '"world" or "tool"'),
        (lambda: arm.manipulability(q, kind="best"), '"yoshikawa"'),
        (lambda: arm.statics(q, np.zeros((2, 6))), "wrench"),
        (lambda: arm.statics(q, [np.nan] * 6), "wrench"),
        (lambda: arm.statics(q, payload=-1), "payload"),
        (lambda: arm.statics(q, gravity=[0, 0]), "gravity"),
        (lambda: arm.forward(q, num_threads=-1), "num_threads"),
    ]:
        with pytest.raises(ValueError, match=says):
            call()
