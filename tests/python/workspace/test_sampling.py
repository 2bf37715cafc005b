# SPDX-License-Identifier: BSD-3-Clause
"""A soil sample, from the rows that a plan hands out."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

import bathyal

Array = NDArray[np.float64]
VEHICLE = np.array([[0, -1, 0, 20.0], [1, 0, 0, -5.0], [0, 0, 1, -40.0], [0, 0, 0, 1]])
SAMPLE = bathyal.RigidBody(0.8, center_of_mass=(0, 0, 0.03), volume=3e-4)
TOOL = bathyal.RigidBody(1.5, center_of_mass=(0, 0, -0.05), volume=4e-4)


def bottom(level: float, height: float) -> bathyal.TriangleMesh:
    """5 cm facets about z = `level` of the vehicle, rough by a seeded `height`, in the world."""
    x, y = np.meshgrid(np.arange(-1.5, 1.5, 0.05), np.arange(-1.5, 1.5, 0.05), indexing="ij")
    random = np.random.default_rng(4)
    z = level + height * (np.sin(9 * x) * np.cos(7 * y) + 0.2 * random.uniform(-1, 1, x.shape))
    count = x.shape[0]
    k = (np.arange(count - 1)[:, None] * count + np.arange(count - 1)).ravel()
    faces = np.concatenate([
        np.stack([k, k + count, k + count + 1], axis=1), np.stack([k, k + count + 1, k + 1], axis=1)
    ])  # fmt: skip
    points = np.stack([x, y, z], axis=-1).reshape(-1, 3) @ VEHICLE[:3, :3].T + VEHICLE[:3, 3]
    return bathyal.TriangleMesh(points, faces)


def hanging(z: float) -> Array:
    pose = np.diag([1.0, -1.0, -1.0, 1.0])
    pose[2, 3] = z
    return pose


ARMS = {
    "paper": (
        bathyal.arms.maevskiy_zanin, np.eye(4), (0.75, 0.2), -0.8, np.radians([0, -45, 50]),
    ),
    "panda": (
        bathyal.arms.panda, hanging(-0.1), (0.5, 0.1), -0.9, [0, -0.8, 0, -2.4, 0, 1.7, 0.8],
    ),
}  # fmt: skip


def site(name: str, height: float) -> tuple[bathyal.Workspace, Array, Array]:
    """A workspace, a target on the bottom and where the arm starts."""
    make, mount, place, level, start = ARMS[name]
    scene = bathyal.Scene(bottom(level, height))
    over = VEHICLE @ [*place, 0.0, 1.0]
    hit = scene.cast(over[None, :3], [[0.0, 0.0, -1.0]])
    target = over[:3] - [0, 0, hit.range[0]]
    hull = bathyal.Hull(box([-1.0, -0.3, 0.1], [0.2, 0.3, 0.5]))
    ws = bathyal.Workspace(make(), mount, scene=scene, hull=hull, vehicle_pose=VEHICLE)
    return ws, target, np.asarray(start)


def box(low: list[float], high: list[float]) -> bathyal.TriangleMesh:
    corners = np.array([[(low, high)[(i >> k) & 1][k] for k in range(3)] for i in range(8)])
    faces = [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
             [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]]  # fmt: skip
    return bathyal.TriangleMesh(corners, faces)


@pytest.mark.parametrize("height", [0.0, 0.04], ids=["flat", "rough"])
@pytest.mark.parametrize("name", ARMS)
def test_phases_are_what_they_say(name: str, height: float) -> None:
    ws, target, start = site(name, height)
    plan = bathyal.plan_sampling(
        ws, target, q_start=start, tool=TOOL, sample=SAMPLE, stiffness=8000, force_limit=120
    )
    assert plan, plan.reason
    assert [phase.name for phase in plan.phases] == [
        "approach",
        "press",
        "grab",
        "lift",
        "transport",
    ]
    np.testing.assert_allclose(plan.contact, target, atol=1e-9)
    assert plan.depth == pytest.approx(120 / 8000)
    bare, loaded = ws.attach([], TOOL), ws.attach([], TOOL).attach([], SAMPLE)
    for k, phase in enumerate(plan.phases):
        held, touches = (bare, loaded)[k >= 3], k in (1, 2, 3)
        dense = np.concatenate([phase.q, (phase.q[:-1] + phase.q[1:]) / 2])
        assert held.clearance(dense, tip_contact=touches).distance.min() > 0
        assert held.check_motion(phase.retreat, tip_contact=k in (1, 2)).free
        np.testing.assert_allclose(phase.retreat[0], phase.q[-1], atol=1e-9)
        rows = slice(phase.first, phase.first + len(phase.q))
        np.testing.assert_array_equal(plan.q[rows], phase.q)
        np.testing.assert_array_equal(plan.time[rows], phase.time)
        np.testing.assert_allclose(phase.tip, ws.arm.forward(phase.q), atol=1e-12)
    assert (np.diff(plan.time) > 0).all()
    np.testing.assert_array_equal(plan.q[0], start)
    np.testing.assert_allclose(plan.q[-1], start, atol=1e-9)


@pytest.mark.parametrize("name", ARMS)
def test_the_tip_presses_straight_to_its_depth(name: str) -> None:
    ws, target, start = site(name, 0.04)
    plan = bathyal.plan_sampling(ws, target, q_start=start, press_speed=0.03)
    tips = (VEHICLE @ plan.phases[1].tip)[:, :3, 3] - target
    along = tips @ plan.direction
    assert along[[0, -1]] == pytest.approx([-0.1, 0.02], abs=2e-5)
    assert (np.diff(along) > -1e-6).all()
    assert np.linalg.norm(tips - along[:, None] * plan.direction, axis=1).max() < 1e-3
    speed = np.linalg.norm(np.diff(tips, axis=0), axis=1) / np.diff(plan.phases[1].time)
    assert speed.max() == pytest.approx(0.03, rel=1e-6)


def test_wrench_is_that_of_what_is_held_and_of_the_bottom() -> None:
    ws, target, start = site("paper", 0.04)
    plan = bathyal.plan_sampling(ws, target, q_start=start, tool=TOOL, sample=SAMPLE)
    tips = ws.arm.forward(plan.q)[:, :3, 3]
    into = VEHICLE[:3, :3].T @ plan.direction
    pressed = np.maximum(0, (tips - (np.linalg.inv(VEHICLE) @ [*target, 1])[:3]) @ into)
    np.testing.assert_allclose(plan.contact_force, 5000 * pressed, atol=0.02)
    assert plan.contact_force.max() == pytest.approx(100, abs=0.01)
    assert plan.contact_force.max() <= 100
    push = np.zeros((len(plan.time), 6))
    push[:, :3] = -plan.contact_force[:, None] * into
    bare, loaded = ws.attach([], TOOL), ws.attach([], TOOL).attach([], SAMPLE)
    expected = bare.wrench(plan.q, contact=push)
    lifted = plan.phases[3].first + 1
    expected = np.concatenate(
        [expected[:lifted], loaded.wrench(plan.q[lifted:], contact=push[lifted:])]
    )
    np.testing.assert_allclose(plan.wrench, expected, atol=1e-9)
    # At the depth the bottom carries part of the arm: 100 N upwards, as far forward as the tip.
    deepest = plan.phases[2].first
    lift = (plan.wrench - bare.wrench(plan.q))[deepest]
    np.testing.assert_allclose(lift[:3], -100 * into, atol=0.02)
    np.testing.assert_allclose(lift[3:], np.cross(tips[deepest], -100 * into), atol=0.02)


def test_a_target_mirrored_in_the_plane_of_symmetry_mirrors_the_wrench() -> None:
    links = [
        bathyal.Link(f"link_{k}", mass=2.0, center_of_mass=(-0.2, 0, 0), volume=1e-3,
                     center_of_buoyancy=(-0.25, 0, 0)) for k in range(4)
    ]  # fmt: skip
    arm = bathyal.Arm.from_dh(  # the paper's, without its offset to the side
        a=[0.193, 0.552, 0.596], alpha=[np.pi / 2, 0, 0], d=[0, 0, 0], theta=[0, 0, 0], links=links,
        lower=np.radians([-90, -90, -135]), upper=np.radians([90, 180, 135]),
    )  # fmt: skip
    ws = bathyal.Workspace(arm, radii=0.03)
    start = np.radians([0, -45, 50])
    sample = bathyal.RigidBody(0.8, center_of_mass=(0.03, 0, 0))  # in the arm's own plane
    port, starboard = (
        bathyal.plan_sampling(ws, [0.75, y, -0.8], q_start=start, sample=sample)
        for y in (0.2, -0.2)
    )
    assert port, port.reason
    np.testing.assert_allclose(starboard.time, port.time, atol=1e-6)
    mirrored = port.wrench * [1, -1, 1, -1, 1, -1]
    np.testing.assert_allclose(starboard.wrench, mirrored, atol=2e-3)
    assert np.abs(port.wrench[:, 3]).max() > 1  # N m of roll


def test_inertia_adds_an_impulse_that_vanishes() -> None:
    ws, target, start = site("paper", 0.0)
    ws = ws.attach([], bathyal.RigidBody(5.0))
    still, moving = (
        bathyal.plan_sampling(ws, target, q_start=start, inertia=inertia)
        for inertia in (False, True)
    )
    phase = still.phases[0]
    rows = slice(0, len(phase.q))
    inertia = (moving.wrench - still.wrench)[rows]
    gaps = np.diff(phase.time)
    weight = (np.append(gaps, 0) + np.append(0, gaps)) / 2
    assert np.abs(weight @ inertia).max() < 0.02 * (weight @ np.abs(inertia)).max()
    assert np.abs(inertia).max() > 1


def test_refusals() -> None:
    ws, target, start = site("paper", 0.0)

    def status(point: Array, **options: object) -> str:
        plan = bathyal.plan_sampling(ws, point, **({"q_start": start} | options))  # type: ignore[arg-type]
        assert not plan
        assert plan.reason
        assert plan.phases == []
        assert plan.wrench.shape == (0, 6)
        return plan.status

    assert status(target + VEHICLE[:3, 0] * 0.6) == "unreachable"
    assert status((VEHICLE @ [-0.5, 0, 0.3, 1])[:3]) == "forbidden"
    assert status(np.add(target, [0, 0, 0.3])) == "no_bottom"
    assert status(target, q_start=np.radians([0, -90, 0])) == "start"
    with pytest.raises(ValueError, match="`target`: expected"):
        bathyal.plan_sampling(ws, [0, 0, np.nan])
    with pytest.raises(ValueError, match="`q_start`: expected 3 values, got 2"):
        bathyal.plan_sampling(ws, target, q_start=[0, 0])
    with pytest.raises(ValueError, match="`stiffness`: expected"):
        bathyal.plan_sampling(ws, target, stiffness=-1)
    drifting = ws.with_vehicle_pose(bathyal.Trajectory([0, 1], [np.eye(4), VEHICLE]))
    with pytest.raises(ValueError, match="`vehicle_pose`: expected a vehicle at rest"):
        bathyal.plan_sampling(drifting, target)


def test_another_tool_reaches_with_its_own_tip() -> None:
    ws, target, start = site("panda", 0.0)
    pose = np.eye(4)
    pose[2, 3] = 0.15
    shape = [bathyal.Capsule([0, 0, -0.15], [0, 0, 0], 0.02)]
    plan = bathyal.plan_sampling(
        ws, target, q_start=start, tool=TOOL, tool_pose=pose, tool_capsules=shape
    )
    assert plan, plan.reason
    tip = VEHICLE @ ws.arm.forward(plan.phases[1].q[-1]) @ np.linalg.inv(ws.arm.tool) @ pose
    np.testing.assert_allclose(tip[:3, 3], target + plan.depth * plan.direction, atol=2e-5)
    np.testing.assert_allclose(plan.phases[1].tip[-1][:3, 3], (np.linalg.inv(VEHICLE) @ tip)[:3, 3])
