# SPDX-License-Identifier: BSD-3-Clause
"""What an independent hand found wrong in a workspace, each kept right."""

from __future__ import annotations

import numpy as np
import pytest

import bathyal
from tests.support import vehicles
from tests.support.vehicles import pose


def planar(**around) -> bathyal.Workspace:
    arm = bathyal.Arm.from_dh(a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0])
    return bathyal.Workspace(arm, radii=0.05, **around)


@pytest.mark.parametrize("upper", [2.0, 5.0, 50.0, np.inf])
def test_a_sliding_joint_that_leaves_the_hull_is_compared_with_it(upper: float) -> None:
    arm = bathyal.Arm.from_dh(
        a=[0], alpha=[0], d=[0], theta=[0], joint_types=["prismatic"], lower=[0], upper=[upper]
    )
    ball = bathyal.Capsule((0, 0, 0), (0, 0, 0), 0.1)
    hull = bathyal.Hull(vehicles.box_mesh([-0.5] * 3, [0.5] * 3))
    ws = bathyal.Workspace(arm, hull=hull, capsules={"link_1": [ball]})
    assert ws.clearance([1.0]).distance == pytest.approx(0.4)
    assert not ws.check_motion([[0.0], [1.0]])


def test_a_hull_around_the_whole_arm_is_no_free_place() -> None:
    hull = bathyal.Hull(vehicles.box_mesh([-5] * 3, [5] * 3))
    with pytest.warns(UserWarning, match="whole arm"):
        ws = bathyal.Workspace(bathyal.arms.ur10e(), hull=hull)
    assert ws.clearance(np.zeros(6)).distance < -3
    assert not ws.check_motion(np.zeros((1, 6)))


@pytest.mark.parametrize("lift", [pose(z=3.0), bathyal.Trajectory([0.0], pose(z=3.0)[None])])
def test_a_keepout_moved_once_is_where_it_was_moved_to(lift) -> None:
    ball = bathyal.KeepOut.sphere(0.1, (0, 0, 1)).moved(lift)
    ws = planar(keepouts=[ball])
    assert ws.clearance([0, 0]).distance == pytest.approx(3.85)
    assert ws.check_target([[0.5, 0.4, 0]]).distance[0] > 3


def test_the_arm_of_a_workspace_is_a_copy() -> None:
    ws = planar(keepouts=[bathyal.KeepOut.sphere(0.1, (0, 0, 1))])
    before = ws.clearance([0, 0]).distance
    ws.arm.base = pose(z=9.0)
    ws.arm.tool = pose(x=2.0)
    assert ws.clearance([0, 0]).distance == before


def test_targets_are_certain_against_the_world_and_not_against_the_vehicle() -> None:
    ws = planar(scene=vehicles.flat_bottom(-1.0), vehicle_pose_std=[0, 0, 0.1, 0, 0, 0])
    found = ws.check_target([[0.6, 0.2, -0.8], [0.6, 0.2, -1.0]])
    np.testing.assert_allclose(found.distance, [0.2, 0.0], atol=1e-9)
    assert "ground" not in found.status
    fixed = planar(
        keepouts=[bathyal.KeepOut.sphere(0.1, (0.6, 0.2, 0.5))],
        vehicle_pose_std=[0, 0, 0.1, 0, 0, 0],
    )
    assert fixed.check_target([[0.6, 0.2, 0.0]]).distance[0] == pytest.approx(0.4 - 0.3)


@pytest.mark.parametrize("speed", [0.5, 1.0, 1.4])
def test_stopping_comes_as_late_as_it_may(speed: float) -> None:
    """A rod of 1 m turns to a wall that it meets at an angle; braking takes speed² / 2."""
    arm = bathyal.Arm.from_dh(a=[1.0], alpha=[0], d=[0], theta=[0])
    wall = bathyal.KeepOut.sphere(0.05, (np.cos(2.0), np.sin(2.0), 0))
    ws = bathyal.Workspace(arm, keepouts=[wall], radii=0.05)
    meets = ws.check_motion([[0.0], [2.0]]).contact * 2.0
    turn = ws.check_motion([[0.0], [2.0]], time=[0, 2.0 / speed], stopping=True, acceleration=1.0)
    assert turn.contact * 2.0 == pytest.approx(meets - speed**2 / 2, abs=5e-3)


def test_a_contact_at_the_start_is_in_row_0() -> None:
    ws = planar(keepouts=[bathyal.KeepOut.sphere(0.1, (0.9, 0, 0))])
    assert ws.check_motion([[0.0, 0.0]]).contact == 0.0
    assert ws.check_motion([[0.0, 0.0], [1.0, 0.0]]).contact == 0.0


def test_names_differ_and_pairs_are_of_two_links() -> None:
    balls = [bathyal.KeepOut.sphere(0.1, (k, 0, 2)) for k in range(2)]
    assert planar(keepouts=balls).obstacles == ["sphere", "sphere_2"]
    with pytest.raises(ValueError, match="two different links"):
        planar(allowed=[("link_1", "link_1")])
    with pytest.raises(ValueError, match="None"):
        planar(vehicle_pose=lambda _: None)
    assert ("link_0", "sphere", "foot") in planar(keepouts=balls).excluded


def test_a_part_without_a_collision_shape_has_the_one_it_is_seen_by(tmp_path) -> None:
    ball = '<origin xyz="0 0 {}"/><geometry><sphere radius="0.1"/></geometry>'
    path = tmp_path / "arm.urdf"
    path.write_text(
        '<robot name="r"><link name="foot"/><link name="a"><collision>'
        + ball.format(0.5)
        + '</collision></link><link name="b"><visual>'
        + ball.format(2.0)
        + '</visual></link><joint name="j" type="continuous"><parent link="foot"/>'
        '<child link="a"/><axis xyz="0 0 1"/></joint><joint name="f" type="fixed">'
        '<parent link="a"/><child link="b"/></joint></robot>'
    )
    placed = bathyal.Workspace(bathyal.Arm.from_urdf(path)).place_capsules([0.0])
    assert sorted(placed[placed[:, 6] > 0][:, 2].round(6)) == [0.5, 2.0]


def test_the_tip_may_be_as_deep_as_the_workspace_says() -> None:
    bottom = bathyal.Scene(vehicles.box_mesh([0.0, -1.0, -1.0], [2.0, 1.0, -0.3]))
    arm = bathyal.Arm.from_dh(
        a=[0], alpha=[0], d=[0], theta=[0], joint_types=["prismatic"], lower=[0], upper=[1]
    )
    mount = pose(x=1.0) @ np.diag([1.0, -1.0, -1.0, 1.0])
    rod = bathyal.Capsule((0, 0, -1), (0, 0, 0), 0.02)
    down = bathyal.Workspace(arm, mount=mount, scene=bottom, capsules={"link_1": [rod]})
    deep = down.with_tip_depth(0.2)
    assert (down.tip_depth, deep.tip_depth) == (0.0, 0.2)
    # 0.1 m deep: the tool is in the bottom over 0.1 m.
    assert down.clearance([0.4], tip_contact=True).distance < 0
    assert deep.clearance([0.4], tip_contact=True).distance > 0
    assert deep.clearance([0.4]).distance < 0
    # 0.5 m deep, more than it may.
    assert deep.clearance([0.8], tip_contact=True).distance < 0
    for bad in (-0.1, np.nan, np.inf):
        with pytest.raises(ValueError, match="`tip_depth`: expected"):
            down.with_tip_depth(bad)
