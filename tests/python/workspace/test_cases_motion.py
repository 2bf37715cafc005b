# SPDX-License-Identifier: BSD-3-Clause
"""Motions and targets of a workspace against dense sampling and closed forms."""

import numpy as np
import pytest

import bathyal
from tests.support import capsule_truth as truth


def random_motion(seed):
    """A workspace with small and thin things around, a motion in it, and its times."""
    random = np.random.default_rng(seed)
    arm = [bathyal.arms.maevskiy_zanin, bathyal.arms.panda, bathyal.arms.ur10e][seed % 3]()
    keepouts = []
    for j in range(int(random.integers(1, 4))):
        named = {"frame": str(random.choice(["hull", "world"])), "name": f"k{j}"}
        place = truth.random_pose(random, 0.8)
        keepout = [
            bathyal.KeepOut.sphere(random.uniform(0.001, 0.1), place[:3, 3], **named),
            bathyal.KeepOut.box((0.3, 0.3, 1e-5), place, **named),
            bathyal.KeepOut.cylinder(0.001, 0.5, place, **named),
            bathyal.KeepOut.cone(0.5, place, angle=0.2, **named),
        ][int(random.integers(4))]
        if random.random() < 0.4:
            poses = [np.eye(4), truth.random_pose(random, 0.2), truth.random_pose(random, 0.2)]
            keepout = keepout.moved(bathyal.Trajectory([0, 0.5, 1.3], poses))
        keepouts.append(keepout)
    vehicle = truth.random_pose(random)
    if random.random() < 0.5:
        poses = [
            truth.pose(random.normal(size=3) * 0.1, random.normal(size=3), 0.2) for _ in range(3)
        ]
        vehicle = bathyal.Trajectory([0, 1, 2], poses)
    mount = truth.random_pose(random, 0.2)
    ws = bathyal.Workspace(arm, mount, keepouts=keepouts, vehicle_pose=vehicle, radii=0.01)
    rows = int(random.integers(2, 5))
    q = random.uniform(np.maximum(arm.lower, -3), np.minimum(arm.upper, 3), (rows, arm.size))
    q = q[0] + (q - q[0]) * random.choice([0.05, 0.3, 1])
    return ws, q, np.cumsum(random.uniform(0.05, 1, rows)) - 0.3


@pytest.mark.parametrize("seed", range(100))
def test_motion_check_agrees_with_dense_sampling(seed):
    ws, q, time = random_motion(seed)
    found = ws.check_motion(q, time=time) if ws.moves else ws.check_motion(q)
    rows = np.arange(len(q))
    at = np.linspace(0, len(q) - 1, (len(q) - 1) * 1000 + 1)
    dense = np.stack([np.interp(at, rows, column) for column in q.T], -1)
    near = ws.clearance(dense, time=np.interp(at, rows, time) if ws.moves else 0.0)
    distance = np.minimum(near.distance, near.self_distance)
    hits = np.flatnonzero(distance < 0)
    if len(hits):
        assert not found.free
        assert found.contact <= at[hits[0]] + 1e-3
    elif found.free:
        assert np.isnan(found.contact)
        return
    here = int(np.clip(np.round(found.contact * 1000), 0, len(at) - 1))
    assert distance[max(here - 2, 0) : here + 3].min() < 1e-3
    if ws.moves:
        assert found.time == pytest.approx(np.interp(found.contact, rows, time), abs=1e-9)


def test_contact_is_timed_where_the_vehicle_drives_a_held_arm_into_a_ball():
    arm = bathyal.Arm.from_dh(a=[1.0], alpha=[0], d=[0], theta=[0])
    drive = bathyal.Trajectory([0, 10], [np.eye(4), truth.pose((3, 0, 0))])
    ball = bathyal.KeepOut.sphere(0.1, (3, 0, 0), frame="world")
    ws = bathyal.Workspace(arm, radii=0.02, keepouts=[ball], vehicle_pose=drive)
    want = (3 - 0.12 - 1) / 0.3
    assert ws.check_motion([[0], [0]], time=[0, 10]).time == pytest.approx(want, abs=1e-3)
    found = ws.check_motion([[0], [0]], time=[-100, 100])  # at rest before the first time
    assert found.time == pytest.approx(want, abs=1e-3)
    assert found.contact == pytest.approx((want + 100) / 200, abs=1e-5)
    assert ws.check_motion([[0], [0]], time=[0, want - 0.01]).free
    assert not ws.check_motion([[0]], time=[9])
    with pytest.raises(ValueError, match="time"):
        ws.check_motion([[0], [0]])


@pytest.mark.parametrize("speed", [0.2, 0.5, 1.0])
def test_a_sliding_joint_stops_in_speed_squared_over_twice_the_acceleration(speed):
    arm = bathyal.Arm.from_dh(a=[0], alpha=[0], d=[0], theta=[0], joint_types=["prismatic"])
    wall = bathyal.KeepOut.half_space((0, 0, -1), point=(0, 0, 2))
    ws = bathyal.Workspace(arm, radii=0.05, keepouts=[wall])
    found = ws.check_motion([[0], [3]], time=[0, 3 / speed])
    assert found.contact * 3 == pytest.approx(1.95, abs=1e-3)
    found = ws.check_motion([[0], [3]], time=[0, 3 / speed], stopping=True, acceleration=0.8)
    assert found.contact * 3 == pytest.approx(1.95 - speed**2 / 1.6, abs=1e-3)


@pytest.mark.parametrize("speed", [0.05, 0.2, 0.5, 1.0])
def test_a_turning_joint_has_room_to_stop(speed):
    arm = bathyal.Arm.from_dh(a=[1.0], alpha=[0], d=[0], theta=[0])
    ball = bathyal.KeepOut.sphere(0.01, (np.cos(2), np.sin(2), 0))
    ws = bathyal.Workspace(arm, radii=0.02, keepouts=[ball])
    found = ws.check_motion([[0], [2.2]], time=[0, 2.2 / speed], stopping=True, acceleration=1.0)
    assert found.contact * 2.2 <= 2 - np.arcsin(0.03) - speed**2 / 2 + 1e-3


FLOOR = bathyal.TriangleMesh(
    [[-9, -9, -1], [9, -9, -1], [9, 9, -1], [-9, 9, -1]], [[0, 1, 2], [0, 2, 3]]
)


def test_targets_on_the_floor_are_free_and_under_it_ground():
    ws = bathyal.Workspace(bathyal.arms.ur10e(), scene=bathyal.Scene(FLOOR))
    heights = np.array([0.2, 1e-9, 0.0, -0.1])
    points = np.stack([np.full(4, 0.6), np.full(4, 0.3), heights - 1], -1)
    found = ws.check_target(points)
    assert found.status.tolist() == ["free", "free", "free", "ground"]
    assert found.distance == pytest.approx(heights, abs=1e-12)
    reached = ws.arm.forward(found.q[:3])[:, :3, 3]
    assert reached == pytest.approx(points[:3], abs=2e-6)
    assert (ws.clearance(found.q[:3], tip_contact=True).distance > 0).all()


def test_target_at_the_end_of_a_joint_is_a_limit():
    arm = bathyal.Arm.from_dh(
        a=[0.6, 0.5], alpha=[0, 0], d=[0, 0], theta=[0, 0], lower=[-2, 0.1], upper=[2, 2]
    )
    ws = bathyal.Workspace(arm, radii=0.0)
    points = arm.forward([[2.0, 0.5], [1.995, 0.5], [1.0, 1.0], [1.0, 0.105]])[:, :3, 3]
    assert ws.check_target(points).status.tolist() == ["limit", "limit", "free", "limit"]
    assert ws.check_target([[1.101, 0, 0], [0.01, 0, 0]]).status.tolist() == ["unreachable"] * 2


@pytest.mark.parametrize("rows", [np.zeros((0, 1)), [[np.nan]], [[np.inf]], [[0.0, 1.0]], [["a"]]])
def test_rows_that_are_no_motion_are_refused(rows):
    ws = bathyal.Workspace(bathyal.Arm.from_dh(a=[1.0], alpha=[0], d=[0], theta=[0]), radii=0.02)
    with pytest.raises(ValueError, match="q"):
        ws.check_motion(rows)


@pytest.mark.parametrize(
    "wrong",
    [
        {"stopping": True},
        {"time": [0, 0]},
        {"time": [1, 0]},
        {"time": [0, np.nan]},
        {"time": [0, 1, 2]},
        {"time": [0, 1], "stopping": True, "acceleration": 0},
        {"time": [0, 1], "stopping": True, "acceleration": [1, 2]},
    ],
)
def test_times_and_rates_that_make_no_sense_are_refused(wrong):
    ws = bathyal.Workspace(bathyal.Arm.from_dh(a=[1.0], alpha=[0], d=[0], theta=[0]), radii=0.02)
    with pytest.raises(ValueError, match=r"time|acceleration"):
        ws.check_motion([[0.0], [0.1]], **wrong)


@pytest.mark.parametrize("point", [[np.nan, 0, 0], [np.inf, 0, 0]])
def test_target_that_is_nowhere_is_refused_by_its_row(point):
    ws = bathyal.Workspace(bathyal.arms.maevskiy_zanin())
    with pytest.raises(ValueError, match="row 1"):
        ws.check_target([[0, 0, 0], point])


def test_a_target_in_the_base_or_far_away_is_out_of_reach():
    arm = bathyal.Arm.from_dh(a=[0.6, 0.5], alpha=[0, 0], d=[0, 0], theta=[0, 0])
    found = bathyal.Workspace(arm, radii=0.01).check_target([[0, 0, 0], [1e7, 0, 0], [1e300, 0, 0]])
    assert found.status.tolist() == ["unreachable"] * 3
    assert np.isinf(found.distance).all()
    assert np.isnan(found.q).all()
