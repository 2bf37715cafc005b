# SPDX-License-Identifier: BSD-3-Clause
"""Joint angles of poses."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bathyal
from tests.support.random_arms import CATALOGUE, poses_of, random_arm


@pytest.mark.parametrize("make", CATALOGUE, ids=lambda make: make.__name__)
def test_inverse_of_forward_is_identity(make) -> None:  # type: ignore[no-untyped-def]
    arm = make()
    poses = arm.forward(poses_of(arm, 200))
    task = "pose" if arm.size >= 6 else "position"
    found = arm.inverse(poses, task=task)
    assert (found.status == "reached").all()
    assert arm.within_limits(found.q).all()
    again = arm.forward(found.q)
    np.testing.assert_allclose(again[:, :3, 3], poses[:, :3, 3], atol=2e-6)
    if task == "pose":
        np.testing.assert_allclose(again, poses, atol=2e-6)


@given(seed=st.integers(0, 2**32 - 1), joints=st.integers(2, 9))
@settings(max_examples=40, deadline=None)
def test_from_a_start_near_it_random_arms_come_back(seed: int, joints: int) -> None:
    arm = random_arm(seed, joints)
    q = poses_of(arm, 5, seed)
    poses = arm.forward(q)
    found = arm.inverse(poses, start=q + 1e-3)
    assert (found.status == "reached").all()
    np.testing.assert_allclose(arm.forward(found.q), poses, atol=3e-6)


def test_fewer_than_six_joints_reach_only_poses_of_their_own() -> None:
    arm = bathyal.arms.reach_alpha_5()
    pose = arm.forward([3.0, 1.5, 1.5, 2.0]).copy()
    assert arm.inverse(pose).status == "reached"
    pose[:3, :3] = pose[:3, :3] @ [[1, 0, 0], [0, 0, -1], [0, 1, 0]]
    found = arm.inverse(pose)
    assert found.status in ("out_of_reach", "limit")
    assert found.error > 1e-3


def test_one_pose_and_many_have_their_shapes() -> None:
    arm = bathyal.arms.panda()
    poses = arm.forward(poses_of(arm, 3))
    many = arm.inverse(poses)
    assert many.q.shape == (3, 7)
    assert many.status.shape == many.error.shape == many.iterations.shape == (3,)
    assert repr(many) == "InverseResult(3 of 3 reached)"
    assert len(many) == 3
    one = arm.inverse(poses[1])
    np.testing.assert_array_equal(one.q, many.q[1])
    assert one.status == "reached"
    assert isinstance(one.error, float)
    assert isinstance(one.iterations, int)
    assert arm.inverse(poses[:0]).q.shape == (0, 7)
    places = arm.inverse(poses[:, :3, 3], task="position")
    assert (places.status == "reached").all()
    assert arm.inverse(poses[0, :3, 3], task="position").q.shape == (7,)


def test_base_and_tool_are_included() -> None:
    arm = bathyal.arms.ur10e()
    q = poses_of(arm, 20)
    arm.base = [[0, -1, 0, 6e5], [1, 0, 0, 7e6], [0, 0, 1, -50], [0, 0, 0, 1]]
    arm.tool = [[1, 0, 0, 0.1], [0, 0, -1, 0], [0, 1, 0, 0.2], [0, 0, 0, 1]]
    found = arm.inverse(arm.forward(q))
    assert (found.status == "reached").all()
    np.testing.assert_allclose(arm.forward(found.q), arm.forward(q), atol=2e-6)


def test_a_path_is_followed_without_jumps() -> None:
    arm = bathyal.arms.panda()
    s = np.linspace(0, 1, 200)[:, None]
    q = np.array([0, 0.3, 0, -2, 0, 2.2, 0]) + s * [0.8, -0.4, 0.3, 0.6, -0.5, 0.4, 1]
    poses = arm.forward(q)
    at = q[0]
    for pose in poses:
        found = arm.inverse(pose, start=at, max_starts=1)
        assert found.status == "reached"
        assert np.abs(found.q - at).max() < 0.02
        at = found.q


@pytest.mark.parametrize("method", ["pseudo_inverse", "jacobian_inverse"])
def test_the_papers_stepping(method: str) -> None:
    arm = bathyal.arms.maevskiy_zanin()
    goal = arm.forward([0.4, -0.9, 0.5])
    start = np.radians([0, -45, 50])
    found = arm.inverse(goal, start, task="position", method=method)
    assert found.status == "reached"
    assert 1e-6 < found.position_error <= 1e-2


def test_reports_of_failure() -> None:
    arm = bathyal.arms.ur10e()
    far = np.eye(4)
    far[0, 3] = 5
    found = arm.inverse(far)
    assert found.status == "out_of_reach"
    assert found.position_error > 3
    limited = bathyal.Arm.from_dh(
        a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0], lower=[-1, -2], upper=[1, 2]
    )
    assert limited.inverse([-0.7, 0.1, 0], task="position").status == "limit"
    stuck = limited.inverse([0.5, 0, 0], [0, 0], task="position", max_starts=1)
    assert stuck.status == "singular"


@pytest.mark.parametrize(
    ("poses", "options", "says"),
    [
        (np.eye(3), {}, r"shape \(N, 4, 4\) or \(4, 4\), got shape \(3, 3\)"),
        (np.zeros(3), {}, "poses"),
        (np.zeros((2, 2)), {"task": "position"}, r"\(N, 3\)"),
        (2 * np.eye(4), {}, "rigid"),
        (np.diag([1, 1, -1, 1.0]), {}, "rigid"),
        (np.full((4, 4), np.nan), {}, "poses in row 0.*finite"),
        (None, {}, "poses"),
        (np.eye(4), {"start": np.zeros(5)}, "start"),
        (np.eye(4), {"start": np.zeros((2, 6))}, "start"),
        (np.eye(4), {"start": [9, 0, 0, 0, 0, 0]}, "start in row 0"),
        (np.eye(4), {"start": [np.nan] * 6}, "start"),
        (np.eye(4), {"task": "aim"}, '"position_axis"'),
        (np.eye(4), {"method": "best"}, '"damped"'),
        (np.eye(4), {"axis": [0, 0, 0]}, "axis"),
        (np.eye(4), {"position_tolerance": -1}, "position_tolerance"),
        (np.eye(4), {"angle_tolerance": np.nan}, "angle_tolerance"),
        (np.eye(4), {"max_starts": 0}, "max_starts"),
        (np.eye(4), {"candidates": 0}, "candidates"),
        (np.eye(4), {"centering_steps": -1}, "centering_steps"),
        (np.eye(4), {"max_iterations": 0}, "max_iterations"),
    ],
)
def test_refusals(poses: object, options: dict[str, object], says: str) -> None:
    with pytest.raises(ValueError, match=says):
        bathyal.arms.ur10e().inverse(poses, **options)  # type: ignore[arg-type]
