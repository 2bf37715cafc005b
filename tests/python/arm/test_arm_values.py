# SPDX-License-Identifier: BSD-3-Clause
"""Arms against numpy and Pinocchio: manipulability, payloads, limits, followers, threads."""

from pathlib import Path

import numpy as np
import pytest

import bathyal
from tests.support.pin_arms import PinArm, pin
from tests.support.random_arms import CATALOGUE, poses_of, random_arm
from tests.support.urdf_cases import LIMIT, joint, links, read_text, robot

PARTS = {"all": slice(0, 6), "linear": slice(0, 3), "angular": slice(3, 6)}


def follower(folder: Path) -> bathyal.Arm:
    """Two joints from one coordinate, the second turned back by twice the first; then a third."""
    narrow = LIMIT.replace('"-2"', '"-1.5"').replace('"2"', '"1.1"')
    mimic = '<mimic joint="shoulder" multiplier="-2" offset="0.1"/>'
    axis = '<axis xyz="0 1 0"/>'
    text = robot(
        links("foot", "upper", "lower", "hand"),
        joint("shoulder", "foot", "upper"),
        joint("elbow", "upper", "lower", more=axis + narrow + mimic),
        joint("wrist", "lower", "hand"),
    )
    return read_text(folder, text)


@pytest.mark.parametrize("part", PARTS)
@pytest.mark.parametrize("joints", [1, 2, 4, 6, 8])
def test_manipulability_is_of_numpys_singular_values(part: str, joints: int) -> None:
    arm = random_arm(11, joints)
    q = poses_of(arm, 10)
    values = np.linalg.svd(arm.jacobian(q)[:, PARTS[part]], compute_uv=False)
    for kind, expected in [
        ("yoshikawa", values.prod(axis=1)),
        ("smallest", values[:, -1]),
        ("inverse_condition", values[:, -1] / np.where(values[:, 0] > 0, values[:, 0], 1)),
    ]:
        found = arm.manipulability(q, kind=kind, part=part)
        np.testing.assert_allclose(found, expected, atol=1e-12, rtol=1e-10)


def test_yoshikawas_measure_is_the_root_of_a_determinant() -> None:
    arm = bathyal.arms.panda()
    q = poses_of(arm, 10)
    columns = arm.jacobian(q)
    expected = np.sqrt(np.linalg.det(columns @ columns.transpose(0, 2, 1)))
    np.testing.assert_allclose(arm.manipulability(q), expected, rtol=1e-9)


@pytest.mark.parametrize("make", CATALOGUE, ids=lambda make: make.__name__)
@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_tables_come_back_in_either_convention(make, convention: str) -> None:  # type: ignore[no-untyped-def]
    arm = make()
    table = arm.to_dh(convention=convention)
    again = bathyal.Arm.from_dh(
        table.a, table.alpha, table.d, table.theta, beta=table.beta, convention=table.convention,
        joint_types=table.joint_types, root=table.root, flange=table.flange,
    )  # fmt: skip
    q = poses_of(arm, 20)
    np.testing.assert_allclose(again.forward(q), arm.forward(q), atol=1e-14)


@pytest.mark.parametrize("seed", range(5))
def test_payload_and_wrench_as_in_pinocchio(seed: int) -> None:
    arm = random_arm(seed, 6)
    peer = PinArm(arm)
    tip = peer.model.frames[peer.tip]
    center, mass = np.array([0.1, -0.2, 0.3]), 2.5
    body = pin.Inertia(mass, center, np.zeros((3, 3)))
    peer.model.appendBodyToJoint(tip.parentJoint, body, tip.placement)
    peer.data = peer.model.createData()
    gravity, wrench = np.array([0.3, 1.0, -9.5]), np.array([4.0, -3.0, 2.0, 0.5, 0.1, -0.7])
    q = poses_of(arm, 10, seed)
    held = arm.statics(
        q, wrench, gravity=gravity, water_density=0, payload=mass, payload_center=center
    )
    for row, torque in zip(q, held, strict=True):
        pushed = peer.jacobian(row, "world").T @ wrench
        weight = peer.gravity(row, arm.base[:3, :3] @ gravity)
        np.testing.assert_allclose(torque, pushed + weight, atol=1e-10)


def test_payload_displaces_water_at_its_own_centre() -> None:
    arm = bathyal.arms.ur10e()
    q = poses_of(arm, 5)
    lift = arm.statics(
        q, water_density=1000, payload=0, payload_volume=2e-3,
        payload_center_of_buoyancy=(0.1, 0, 0),
    )  # fmt: skip
    weight = arm.statics(q, payload=2.0, payload_center=(0.1, 0, 0))
    np.testing.assert_allclose(lift, -weight, atol=1e-10)


def test_followers_are_honoured_everywhere(tmp_path: Path) -> None:
    arm = follower(tmp_path)
    assert arm.joint_names == ["shoulder", "wrist"]
    np.testing.assert_allclose(arm.lower, [-0.5, -2])  # of the follower: -2 q + 0.1 <= 1.1
    np.testing.assert_allclose(arm.upper, [0.8, 2])
    assert arm.within_limits([[0.7, 0], [0.9, 0], [-0.6, 0]]).tolist() == [True, False, False]

    q = poses_of(arm, 20)
    step = 1e-6
    columns = arm.jacobian(q)
    for k in range(2):
        around = [arm.forward(q + sign * step * np.eye(2)[k])[:, :3, 3] for sign in (1, -1)]
        slope = (around[0] - around[1]) / (2 * step)
        np.testing.assert_allclose(columns[:, :3, k], slope, atol=1e-8)
    wrench = np.array([1.0, 2.0, 3.0, 0.1, 0.2, 0.3])
    expected = np.einsum("nij,i->nj", columns, wrench)
    np.testing.assert_allclose(arm.statics(q, wrench), expected, atol=1e-12)

    found = arm.inverse(arm.forward(q))
    assert (found.status == "reached").all()
    assert arm.within_limits(found.q).all()
    beyond = arm.forward([1.5, 0.4])  # elbow at -2.9
    assert arm.inverse(beyond).status == "limit"
    assert arm.within_limits(arm.inverse(beyond).q)


def test_joints_that_turn_without_end_wrap() -> None:
    arm = bathyal.arms.reach_bravo_7()
    q = np.array([1.0, 1.5, 1.2, 3.0, 1.1, 0.4])
    turned = q + 6 * np.pi * np.eye(6)[5]
    found = arm.inverse(arm.forward(q), start=turned + 0.05)
    assert found.status == "reached"
    np.testing.assert_allclose(found.q, turned, atol=1e-4)


def test_sliding_joints_keep_their_ends() -> None:
    arm = bathyal.Arm.from_dh(
        a=[0, 0.4, 0.3], alpha=[0, 0, 0], d=[0.1, 0, 0], theta=[0, 0, 0],
        joint_types=["prismatic", "revolute", "revolute"], lower=[0, -3, -3], upper=[0.5, 3, 3],
    )  # fmt: skip
    np.testing.assert_allclose(arm.forward([0.2, 0, 0])[:3, 3], [0.7, 0, 0.3])
    np.testing.assert_array_equal(arm.jacobian([0.2, 0, 0])[:, 0], [0, 0, 1, 0, 0, 0])
    found = arm.inverse([[0.5, 0.1, 0.55], [0.5, 0.1, 0.65], [0.5, 0.1, 0.05]], task="position")
    assert found.status.tolist() == ["reached", "limit", "limit"]
    assert found.q[0, 0] == pytest.approx(0.45, abs=1e-5)
    np.testing.assert_allclose(found.q[1:, 0], [0.5, 0.0])
    assert arm.statics([0.2, 0, 0], payload=3.0)[0] == pytest.approx(3 * 9.80665)


@pytest.mark.parametrize("call", ["forward", "links", "jacobian", "manipulability", "statics"])
def test_any_number_of_threads_gives_the_same_bytes(call: str) -> None:
    arm = random_arm(3, 7)
    q = poses_of(arm, 3000)
    options = {"links": True} if call == "links" else {}
    method = arm.forward if call == "links" else getattr(arm, call)
    one = method(q, num_threads=1, **options)
    for count in (0, 2, 5):
        np.testing.assert_array_equal(method(q, num_threads=count, **options), one)


def test_inverse_is_the_same_on_any_number_of_threads() -> None:
    arm = bathyal.arms.panda()
    poses = arm.forward(poses_of(arm, 200))
    one = arm.inverse(poses, num_threads=1)
    two = arm.inverse(poses, num_threads=2)
    np.testing.assert_array_equal(one.q, two.q)
    np.testing.assert_array_equal(one.iterations, two.iterations)


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"inertia": np.eye(2)}, r"`inertia`: .*shape \(3, 3\), got shape \(2, 2\)"),
        ({"inertia": np.zeros((2, 3))}, r"`inertia`: .*shape \(3, 3\), got shape \(2, 3\)"),
        ({"center_of_mass": [0, 0]}, "`center_of_mass`"),
        ({"center_of_mass": [0, 0, np.nan]}, "`center_of_mass`: expected three finite"),
        ({"center_of_buoyancy": "low"}, "`center_of_buoyancy`"),
        ({"frame": np.eye(3)}, r"`frame`: .*\(4, 4\)"),
    ],
)
def test_links_that_are_none_are_refused(options: dict[str, object], says: str) -> None:
    with pytest.raises(ValueError, match=says):
        bathyal.Link("forearm", **options)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"wrench": np.zeros(5)}, "`wrench`"),
        ({"frame": "base"}, '`frame`: expected "world" or "tool"'),
        ({"gravity": [0, 0, np.inf]}, "`gravity`: expected three finite"),
        ({"water_density": -1}, "`water_density`"),
        ({"water_density": np.nan}, "`water_density`"),
        ({"payload": np.inf}, "`payload`"),
        ({"payload_volume": -1e-3}, "`payload_volume`"),
        ({"payload_center": [0, 0, np.nan]}, "`payload_center`: expected three finite"),
        ({"payload_center_of_buoyancy": [0]}, "`payload_center_of_buoyancy`"),
        ({"num_threads": -2}, "`num_threads`"),
    ],
)
def test_statics_of_nonsense_are_refused(options: dict[str, object], says: str) -> None:
    with pytest.raises(ValueError, match=says):
        bathyal.arms.ur10e().statics(np.zeros(6), **options)  # type: ignore[arg-type]


def test_other_refusals() -> None:
    arm = bathyal.arms.ur10e()
    q = np.zeros((2, 6))
    for call, says in [
        (lambda: arm.within_limits(np.zeros((2, 5))), r"`q`.*got shape \(2, 5\)"),
        (lambda: arm.within_limits([np.nan] * 6), "`q`: expected finite"),
        (lambda: arm.manipulability(q, part="both"), '`part`: expected "all"'),
        (lambda: arm.manipulability(q, num_threads=-1), "`num_threads`"),
        (lambda: arm.jacobian(q, num_threads=-1), "`num_threads`"),
        (lambda: arm.inverse(arm.forward(q), num_threads=-1), "`num_threads`"),
        (lambda: arm.inverse(arm.forward(q), steps=0), "`steps`"),
        (lambda: arm.to_dh(convention="craig"), '`convention`: expected "standard"'),
        (lambda: setattr(arm, "base", np.eye(3)), "`base`"),
        (lambda: setattr(arm, "tool", np.full((4, 4), np.nan)), "`tool`"),
        (lambda: arm.plot("left"), "`q`"),
        (lambda: arm.show([None] * 6), "`q`"),
    ]:
        with pytest.raises(ValueError, match=says):
            call()
