# SPDX-License-Identifier: BSD-3-Clause
"""Arms to look at: what is drawn lies where the arm has it."""

from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread

import bathyal
from bathyal.view.arm_solid import posture, resting_pose, size_of, solid

POSE = [0.2, -1.2, 1.5, -1.9, -1.6, 0.4]
CATALOGUE = {name: getattr(bathyal.arms, name) for name in bathyal.arms.__all__}


@pytest.mark.parametrize("name", CATALOGUE)
def test_links_run_from_base_to_tool_without_a_break(name: str) -> None:
    arm = CATALOGUE[name]()
    arm.tool = [[1, 0, 0, 0.1], [0, 1, 0, 0.2], [0, 0, 1, 0.3], [0, 0, 0, 1]]
    q = resting_pose(arm) + 0.1
    at = posture(arm, q)
    np.testing.assert_allclose(at.strokes[0][0], arm.base[:3, 3])
    for before, after in zip(at.strokes[:-1], at.strokes[1:], strict=True):
        np.testing.assert_allclose(before[-1], after[0], atol=1e-12)
    np.testing.assert_allclose(at.strokes[-1][-1], arm.forward(q)[:3, 3], atol=1e-12)


@pytest.mark.parametrize("name", CATALOGUE)
def test_a_joint_moves_only_what_lies_behind_its_axis(name: str) -> None:
    arm = CATALOGUE[name]()
    q = resting_pose(arm)
    still = posture(arm, q)
    for k in range(arm.size):
        turned = posture(arm, q + 0.3 * np.eye(arm.size)[k])
        np.testing.assert_allclose(turned.axes[: k + 1], still.axes[: k + 1], atol=1e-12)


def test_every_part_is_closed_and_faces_outward() -> None:
    at = posture(bathyal.arms.ur10e(), POSE)
    for part in solid(at, size_of([at])):
        corners = part.vertices[part.triangles]
        volume = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
        assert volume > 0, part.name
        edges = np.sort(part.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        inner = edges[edges[:, 0] != edges[:, 1]]
        used = np.unique(inner, axis=0, return_counts=True)[1]
        assert (used <= 2).all(), part.name


def test_a_slider_on_the_axis_of_a_drum_stays_in_sight() -> None:
    arm = bathyal.Arm.from_dh(
        a=[0, 0.4], alpha=[0, 0], d=[0.2, 0], theta=[0, 0],
        joint_types=["prismatic", "revolute"], names=["lift", "turn"],
    )  # fmt: skip
    at = posture(arm, [0.1, 0.3])
    np.testing.assert_allclose(at.axes[0], at.axes[1])
    parts = {part.name: part.vertices for part in solid(at, size_of([at]))}
    lift, turn = parts["lift"], parts["turn"]
    assert np.hypot(*lift[:, :2].T).max() > 1.2 * np.hypot(*turn[:, :2].T).max()
    assert np.ptp(turn[:, 2]) > 1.2 * np.ptp(lift[:, 2])


def test_rest_keeps_the_limits() -> None:
    arm = bathyal.Arm.from_dh(
        a=[1, 1, 1], alpha=[0] * 3, d=[0] * 3, theta=[0] * 3,
        lower=[-1, 0.5, 2], upper=[1, 1.5, np.inf],
    )  # fmt: skip
    assert resting_pose(arm).tolist() == [0, 1, 2]


def test_figure_names_the_joints_and_ends_at_the_tool() -> None:
    arm = bathyal.arms.ur10e()
    figure = arm.show(POSE)
    names = [trace.name for trace in figure.data]
    assert set(arm.joint_names) <= set(names)
    tool = next(trace for trace in figure.data if trace.name == "tool")
    np.testing.assert_allclose(
        [tool.x[0], tool.y[0], tool.z[0]], arm.forward(POSE)[:3, 3], atol=1e-12
    )


def test_poses_before_the_last_are_faint_and_few() -> None:
    arm = bathyal.arms.ur10e()
    one = sum(trace.type == "mesh3d" for trace in arm.show(POSE).data)
    shown = [t for t in arm.show(np.tile(POSE, (500, 1))).data if t.type == "mesh3d"]
    assert len(shown) == 40 * one
    assert [t.opacity == 1.0 for t in shown] == [False] * (39 * one) + [True] * one


def test_picture_shows_the_arm(tmp_path: Path) -> None:
    arm = bathyal.arms.panda()
    arm.plot([0, -0.8, 0, -2.4, 0, 1.6, 0.8], tmp_path / "arm.png")
    pixels = imread(tmp_path / "arm.png")[..., :3]
    orange = (np.abs(pixels - [0.95, 0.58, 0.10]) < 0.15).all(axis=2)
    assert 0.005 < orange.mean() < 0.2


def test_same_picture_twice_is_the_same_bytes(tmp_path: Path) -> None:
    for name in ("a.png", "b.png"):
        bathyal.arms.ur10e().plot(POSE, tmp_path / name)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


@pytest.mark.parametrize(
    "q", [[0.0] * 5, np.zeros((2, 7)), np.zeros((0, 6)), [np.nan] * 6, np.zeros((1, 2, 6))]
)
def test_wrong_poses_are_refused(q: object) -> None:
    for draw in (bathyal.arms.ur10e().show, bathyal.arms.ur10e().plot):
        with pytest.raises(ValueError, match="`q`: expected"):
            draw(q)
