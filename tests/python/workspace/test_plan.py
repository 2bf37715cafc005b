# SPDX-License-Identifier: BSD-3-Clause
"""Motions among obstacles: free wherever they are sampled, within limits, the same each time."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bathyal
from tests.support import vehicles
from tests.support.coal_bodies import touches_by_coal
from tests.support.random_worlds import dense, random_spheres, two_free_postures
from tests.support.vehicles import MOUNT, Q_START, pose, sampler


def behind_a_wall(**around) -> bathyal.Workspace:
    """The paper's arm, and a wall ahead of it that is lower than the arm is long."""
    wall = bathyal.KeepOut.box((0.1, 0.02, 1.2), pose(1.2, 0.0, -0.8), name="wall")
    return sampler(keepouts=[wall, *around.pop("keepouts", [])], **around)


LEFT, RIGHT = np.array([0.6, -0.3, 0.6]), np.array([-0.6, -0.3, 0.6])


def expect_limits(plan, velocity, acceleration, jerk) -> None:
    step = plan.time[1] - plan.time[0]
    rest = [plan.path[:1]] * 3, [plan.path[-1:]] * 3
    rows = np.concatenate([*rest[0], plan.path, *rest[1]])
    for order, limit in enumerate((velocity, acceleration, jerk), start=1):
        assert (np.abs(np.diff(rows, order, axis=0)) / step**order <= limit * (1 + 1e-5)).all()


def test_a_wall_is_passed() -> None:
    ws = behind_a_wall()
    assert not ws.check_motion([LEFT, RIGHT])
    plan = ws.plan(LEFT, RIGHT)
    assert plan
    assert plan.status == "solved"
    assert plan.reason == ""
    np.testing.assert_array_equal(plan.path[[0, -1]], [LEFT, RIGHT])
    assert plan.time.shape == (len(plan.path),)
    assert plan.time[0] == 0
    assert np.diff(plan.time).max() <= 0.02 + 1e-12
    assert ws.check_motion(plan.path, time=plan.time)
    assert (ws.clearance(dense(plan.path, 1e-3)).distance >= 0).all()
    with pytest.raises(ValueError, match="read-only"):
        plan.path[0, 0] = 1.0


def test_limits_of_the_caller() -> None:
    plan = behind_a_wall().plan(LEFT, RIGHT, velocity=0.3, acceleration=[0.5, 0.4, 0.6], jerk=2.0)
    expect_limits(plan, 0.3, np.array([0.5, 0.4, 0.6]), 2.0)
    faster = behind_a_wall().plan(LEFT, RIGHT)
    assert faster.time[-1] < plan.time[-1]


def test_same_seed_same_bytes() -> None:
    ws = behind_a_wall()
    plans = [ws.plan(LEFT, RIGHT, seed=seed) for seed in (1, 1, 2)]
    assert plans[0].path.tobytes() == plans[1].path.tobytes()
    assert plans[0].checks == plans[1].checks
    assert plans[0].path.tobytes() != plans[2].path.tobytes()


@settings(max_examples=8, deadline=None)
@given(st.tuples(*[st.floats(-3, 3)] * 3), st.floats(-3.1, 3.1))
def test_moving_everything_moves_the_goal_with_it(shift, yaw) -> None:
    world = pose(*shift, yaw)
    scene = vehicles.flat_bottom()
    moved = bathyal.TriangleMesh(
        scene.meshes[0].vertices @ world[:3, :3].T + world[:3, 3], scene.meshes[0].triangles
    )
    ws = behind_a_wall(scene=bathyal.Scene(moved), vehicle_pose=world)
    goal = (world @ [1.3, -0.4, -0.6, 1])[:3]
    plan = ws.plan(LEFT, point=goal)
    assert plan.status == "solved"
    tip = world @ ws.arm.forward(plan.path[-1])
    np.testing.assert_allclose(tip[:3, 3], goal, atol=1e-5)


def test_the_tip_may_touch_only_where_it_is_allowed_to() -> None:
    ws = sampler(scene=vehicles.flat_bottom())
    assert ws.plan(Q_START, point=[1.4, 0.2, -1.2]).status == "goal_in_collision"
    plan = ws.plan(Q_START, point=[1.4, 0.2, -1.2], tip_contact=True)
    assert plan.status == "solved"
    assert ws.check_motion(plan.path, tip_contact=True)
    below = sampler().check_target([[1.0, 0.2, -1.35]])
    assert below.status[0] == "free"
    through = ws.plan(Q_START, point=[1.0, 0.2, -1.35], tip_contact=True)
    assert through.status == "goal_in_collision"


def test_a_ball_that_crosses_is_waited_out_or_passed() -> None:
    """It lies in the way until it has moved on, or comes into the way while the arm moves."""
    for there_from, there_to in (((1.3, 0, -0.5), (1.3, 0, 3)), ((1.3, 0, 3), (1.3, 0, -0.5))):
        motion = bathyal.Trajectory([0, 2], [pose(*there_from), pose(*there_to)])
        ball = bathyal.KeepOut.sphere(0.25, frame="world", name="ball").moved(motion)
        ws = sampler(keepouts=[ball])
        assert ws.moves
        plan = ws.plan(LEFT, RIGHT, velocity=0.5)
        assert plan.status == "solved", plan.reason
        assert ws.check_motion(plan.path, time=plan.time)
        near = ws.clearance(plan.path, time=plan.time)
        assert (near.distance >= 0).all()


def test_random_worlds_by_dense_sampling_and_by_coal() -> None:
    crossed = 0
    for seed in range(20):
        ws = random_spheres(seed)
        ends = two_free_postures(ws, seed)
        crossed += not ws.check_motion(ends)
        plan = ws.plan(*ends, seed=seed)
        assert plan.status == "solved", (seed, plan.reason)
        arm = ws.arm
        assert ((plan.path >= arm.lower) & (plan.path <= arm.upper)).all()
        rows = dense(plan.path, 1e-3)
        near = ws.clearance(rows)
        assert (np.minimum(near.distance, near.self_distance) >= 0).all(), seed
        assert not touches_by_coal(ws, rows[::50]).any(), seed
    assert crossed >= 8


def test_coal_sees_a_contact() -> None:
    ws = random_spheres(1)
    q = np.random.default_rng(0).uniform(ws.arm.lower, ws.arm.upper, (200, 7))
    touching = ws.clearance(q).distance <= 0
    assert 20 < touching.sum() < 180
    np.testing.assert_array_equal(touches_by_coal(ws, q), touching)


def test_why_there_is_no_path() -> None:
    ws = behind_a_wall()
    inside_wall = np.array([0.0, -0.3, 0.6])
    start = ws.plan(inside_wall, RIGHT)
    assert start.status == "start_in_collision"
    assert start.path is None
    assert start.time.shape == (0,)
    assert "wall" in start.reason
    assert ws.clearance(start.way_out[-1]).distance > 0
    assert ws.plan(start.way_out[-1], RIGHT).status == "solved"
    assert ws.plan(LEFT, inside_wall).status == "goal_in_collision"
    assert ws.plan(LEFT, [9.0, 0, 0]).status == "goal_outside_limits"
    outside = ws.plan([0.6, -0.3, ws.arm.upper[2] + 0.1], RIGHT)
    assert outside.status == "start_outside_limits"
    np.testing.assert_array_equal(outside.way_out[1], [0.6, -0.3, ws.arm.upper[2]])
    assert ws.plan(LEFT, point=[9, 0, 0]).status == "unreachable"
    assert ws.plan(LEFT, pose=pose(9, 0, 0)).status == "unreachable"
    assert ws.plan(LEFT, point=MOUNT[:3, 3]).path is None
    assert ws.plan(LEFT, RIGHT, max_checks=4).status == "no_path"
    assert ws.plan(LEFT, RIGHT, max_seconds=1e-9).status == "time_limit"
    bars = [bathyal.KeepOut.box((0.6, 0.02, 0.2), pose(x), name=f"bar at {x}") for x in (-0.6, 0.6)]
    arm = bathyal.Arm.from_dh(a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0])
    between = bathyal.Workspace(arm, keepouts=bars, radii=0.02)
    up, down = [np.pi / 2, 0.0], [-np.pi / 2, 0.0]
    nowhere = between.plan(up, down, max_checks=500)
    assert nowhere.status == "no_path"
    assert nowhere.checks <= 520


@pytest.mark.parametrize(
    ("bad", "name"),
    [
        ({}, "goal"),
        ({"goal": RIGHT, "point": [1, 0, 0]}, "goal"),
        ({"goal": [0, 0]}, "goal"),
        ({"goal": [0, 0, np.nan]}, "goal"),
        ({"point": [np.nan, 0, 0]}, "point"),
        ({"point": [0, np.inf, 0]}, "point"),
        ({"pose": np.ones((4, 4))}, "pose"),
        ({"pose": np.full((4, 4), np.nan)}, "pose"),
        ({"goal": RIGHT, "velocity": 0}, "velocity"),
        ({"goal": RIGHT, "acceleration": [1, -1, 1]}, "acceleration"),
        ({"goal": RIGHT, "jerk": np.inf}, "jerk"),
        ({"goal": RIGHT, "velocity": [1, 1]}, "velocity"),
        ({"goal": RIGHT, "max_checks": 0}, "max_checks"),
        ({"goal": RIGHT, "max_seconds": np.nan}, "max_seconds"),
        ({"goal": RIGHT, "step": 0}, "step"),
        ({"goal": RIGHT, "tolerance": -1}, "tolerance"),
        ({"goal": RIGHT, "time": np.nan}, "time"),
    ],
)
def test_bad_input_is_named(bad, name: str) -> None:
    with pytest.raises(ValueError, match=f"`{name}"):
        behind_a_wall().plan(LEFT, **bad)


@pytest.mark.parametrize("start", [[0, 0], [0, 0, np.nan], [[0, 0, 0]]])
def test_a_bad_start_is_named(start) -> None:
    with pytest.raises(ValueError, match="`q_start"):
        behind_a_wall().plan(start, RIGHT)
