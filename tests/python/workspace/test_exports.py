# SPDX-License-Identifier: BSD-3-Clause
"""Motions as ROS' JointTrajectory, and excluded pairs as SRDF."""

from __future__ import annotations

import json

import numpy as np
import pytest
import yaml

import bathyal
from bathyal.workspace.joint_trajectory import joint_trajectory
from bathyal.workspace.srdf import link_pairs

TIME = np.linspace(2, 4, 41)
Q = np.column_stack([TIME**2, np.sin(TIME), 1e-7 * TIME])


def test_a_trajectory_has_positions_velocities_and_times():
    message = joint_trajectory(Q, TIME, ["a", "b", "c"], frame="base_link")
    points = message["points"]
    assert message["joint_names"] == ["a", "b", "c"]
    assert message["header"]["frame_id"] == "base_link"
    np.testing.assert_array_equal([point["positions"] for point in points], Q)
    velocity = np.array([point["velocities"] for point in points])
    np.testing.assert_allclose(velocity[1:-1, 0], 2 * TIME[1:-1], atol=1e-10)
    np.testing.assert_allclose(velocity[1:-1, 1], np.cos(TIME[1:-1]), atol=1e-3)
    assert not velocity[[0, -1]].any()
    starts = [point["time_from_start"] for point in points]
    assert starts[0] == {"sec": 0, "nanosec": 0}
    assert starts[21] == {"sec": 1, "nanosec": 50_000_000}
    assert all(0 <= start["nanosec"] < 10**9 for start in starts)


@pytest.mark.parametrize("suffix", [".yaml", ".yml", ".json"])
def test_both_texts_hold_the_same_to_the_last_digit(suffix, tmp_path):
    path = tmp_path / f"t{suffix}"
    bathyal.write_joint_trajectory(path, Q, TIME, ["a", "b: x", "yes"])
    text = path.read_text()
    read = json.loads(text) if suffix == ".json" else yaml.safe_load(text)
    assert read == joint_trajectory(Q, TIME, ["a", "b: x", "yes"])


def test_the_joints_of_an_arm_are_named(tmp_path):
    arm = bathyal.arms.panda()
    bathyal.write_joint_trajectory(tmp_path / "t.yaml", np.zeros((2, 7)), [0, 1], arm)
    read = yaml.safe_load((tmp_path / "t.yaml").read_text())
    assert read["joint_names"] == [f"panda_joint{k}" for k in range(1, 8)]
    assert len(read["points"]) == 2


@pytest.mark.parametrize(
    ("q", "time", "names", "expected"),
    [
        (Q, TIME[1:], ["a", "b", "c"], "`time`: expected shape \\(41,\\)"),
        (Q, TIME, ["a", "b"], "`q`: expected shape \\(K, 2\\)"),
        (Q * np.nan, TIME, ["a", "b", "c"], "`q`: expected finite numbers"),
        (Q, TIME[::-1], ["a", "b", "c"], "`time`: expected values that rise"),
        (Q, TIME, ["a", "b", "a"], "`names`: expected a name for each joint"),
        (Q, TIME, ["a", "b", ""], "`names`: expected a name for each joint"),
        (np.zeros((0, 3)), [], ["a", "b", "c"], "K at least 1"),
    ],
)
def test_what_is_no_trajectory_is_refused(q, time, names, expected):
    with pytest.raises(ValueError, match=expected):
        joint_trajectory(q, time, names)


def test_excluded_pairs_come_back_from_srdf(tmp_path):
    path = tmp_path / "arm.srdf"
    workspace = bathyal.Workspace(bathyal.arms.panda(), allowed=[("link_2", "link_7")])
    bathyal.write_srdf(workspace, path, name='pan "da" <7>')
    pairs = bathyal.read_srdf(path)
    assert ("link_2", "link_7") in pairs or ("link_7", "link_2") in pairs
    assert len(pairs) == len(link_pairs(workspace)) >= 8
    reasons = {reason for *_, reason in link_pairs(workspace)}
    assert reasons <= {"neighbours", "allowed", "touch in every posture"}
    again = bathyal.Workspace(bathyal.arms.panda(), allowed=pairs)
    assert {frozenset(pair[:2]) for pair in again.excluded} == {frozenset(p) for p in pairs}


def test_pairs_with_obstacles_stay_out(tmp_path):
    ball = bathyal.KeepOut.sphere(0.05, frame="link_8", name="cup")
    workspace = bathyal.Workspace(bathyal.arms.panda(), keepouts=[ball])
    assert any("cup" in pair for pair in workspace.excluded)
    assert not any("cup" in pair for pair in link_pairs(workspace))


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("<robot", "not well-formed XML"),
        ("<world/>", "its root element is world, not robot"),
        ('<!DOCTYPE robot [<!ENTITY a "b">]><robot/>', "a document type"),
        ('<robot><disable_collisions link1="a"/></robot>', "element 1, disable_collisions"),
        ('<robot><x/><disable_collisions link1="a" link2="a"/></robot>', "element 2"),
        ("", "the file is empty"),
    ],
)
def test_what_is_no_srdf_is_refused(text, expected, tmp_path):
    path = tmp_path / "arm.srdf"
    path.write_text(text)
    with pytest.raises(bathyal.Error, match=expected) as error:
        bathyal.read_srdf(path)
    assert str(path) in str(error.value)


def test_pairs_of_a_file_come_once(tmp_path):
    path = tmp_path / "arm.srdf"
    path.write_text(
        '<robot name="r"><group name="arm"/><disable_collisions link1=" a " link2="b"/>'
        '<disable_collisions link1="b" link2="a" reason="Never"/></robot>'
    )
    assert bathyal.read_srdf(path) == [("a", "b")]
