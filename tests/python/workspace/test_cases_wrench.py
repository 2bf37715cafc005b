# SPDX-License-Identifier: BSD-3-Clause
"""Wrench, momentum, trim, reach and sampling of a workspace against closed forms in numpy."""

import numpy as np
import pytest

import bathyal
from tests.support import capsule_truth as truth

GRAVITY = np.array([0, 0, -9.80665])


@pytest.mark.parametrize("seed", range(20))
def test_wrench_momentum_and_trim_of_a_body_on_a_massless_arm(seed):
    random = np.random.default_rng(seed)
    n = int(random.integers(1, 5))
    rows = {name: random.normal(size=n) for name in ("a", "alpha", "d", "theta")}
    arm, tool = bathyal.Arm.from_dh(**rows), truth.random_pose(random, 0.3)
    arm.tool = tool
    mount, vehicle = truth.random_pose(random), truth.random_pose(random, 10)
    center, mass, volume = random.normal(size=(2, 3)) * 0.2, random.uniform(1, 3), 0.002
    body = bathyal.RigidBody(
        mass, center_of_mass=center[0], volume=volume, center_of_buoyancy=center[1]
    )
    hull = bathyal.RigidBody(
        70, center_of_mass=(0.1, 0, -0.1), volume=0.08, center_of_buoyancy=(0, 0.05, 0.1)
    )
    ws = bathyal.Workspace(arm, mount, vehicle_pose=vehicle, vehicle_body=hull, radii=0.02)
    ws = ws.attach([], body)
    q, rate, contact = random.uniform(-2, 2, n), random.normal(size=n), random.normal(size=6)

    def tip(q):
        pose = mount
        for a, alpha, d, theta in zip(*rows.values(), strict=True):
            pose = pose @ truth.standard_row(a, alpha, d, theta + q[0])
            q = q[1:]
        return pose @ tool

    down = vehicle[:3, :3].T @ GRAVITY
    at, lifted = truth.apply(tip(q), center)
    weight, buoyancy = mass * down, -1025 * volume * down
    moment = np.cross(at, weight) + np.cross(lifted, buoyancy)
    moment += contact[3:] + np.cross(tip(q)[:3, 3], contact[:3])
    want = np.concatenate([weight + buoyancy + contact[:3], moment])
    assert ws.wrench(q, contact=contact) == pytest.approx(want, abs=1e-10)

    step = 1e-5 * rate
    moved = truth.apply(tip(q + step), center[0]) - truth.apply(tip(q - step), center[0])
    assert ws.momentum(q, rate)[:3] == pytest.approx(mass * moved / 2e-5, abs=1e-6)

    trim = ws.static_trim(q)
    sum_ = 70 * np.array([0.1, 0, -0.1]) + mass * at
    sum_ -= 1025 * (0.08 * np.array([0, 0.05, 0.1]) + volume * lifted)
    turn = truth.pose(axis=(0, 1, 0), angle=trim.pitch) @ truth.pose(
        axis=(1, 0, 0), angle=trim.roll
    )
    assert turn[:3, :3] @ sum_ / np.linalg.norm(sum_) == pytest.approx([0, 0, -1], abs=1e-12)


def test_reach_map_of_three_joints_is_a_shell_about_the_shoulder():
    arm = bathyal.Arm.from_dh(a=[0, 0.5, 0.3], alpha=[np.pi / 2, 0, 0], d=[0] * 3, theta=[0] * 3)
    arm.base = truth.pose((5, 5, 5))  # plays no part
    mount = truth.pose((1, 2, 3), (1, 1, 0), 0.7)
    ws = bathyal.Workspace(arm, mount, radii=0.02, vehicle_pose=truth.pose((90, 0, 4), (1, 2, 3)))
    reach = ws.reach_map(voxel=0.1, directions=6)
    middles = reach.origin + 0.1 * (np.moveaxis(np.indices(reach.reached.shape), 0, -1) + 0.5)
    far = np.linalg.norm(middles - [1, 2, 3], axis=-1)
    assert reach.reached[(far < 0.8 - 1e-9) & (far > 0.2 + 1e-9)].all()
    assert not reach.reached[(far > 0.8 + 1e-9) | (far < 0.2 - 1e-9)].any()


def test_sampling_by_a_tilted_vehicle_is_straight_slow_and_weighs_what_it_should():
    vehicle = truth.pose((10, -5, -50), (0, 0, 1), 2.0) @ truth.pose(axis=(1, 1, 0), angle=0.15)
    corners = np.array([[-99, -99, -50.9], [99, -99, -50.9], [99, 99, -50.9], [-99, 99, -50.9]])
    bottom = bathyal.Scene(bathyal.TriangleMesh(corners, [[0, 1, 2], [0, 2, 3]]))
    mount = truth.pose((0.3, 0, -0.1), (0, 0, 1), 0.2)
    ws = bathyal.Workspace(bathyal.arms.maevskiy_zanin(), mount, scene=bottom, vehicle_pose=vehicle)
    target = truth.apply(vehicle, np.array([1.0, 0.2, -0.8])) * [1, 1, 0] + [0, 0, -50.9]
    tool = bathyal.RigidBody(2.0, volume=0.001)
    plan = bathyal.plan_sampling(
        ws, target, tool=tool, sample=bathyal.RigidBody(3.0, volume=0.001), stiffness=4000
    )
    assert plan.status == "planned"
    assert plan.contact == pytest.approx(target, abs=1e-9)
    for name, phase in zip(("press", "lift"), (plan.phases[1], plan.phases[3]), strict=True):
        assert phase.name == name
        way = truth.apply(vehicle, phase.tip[:, :3, 3]) - plan.contact
        assert np.linalg.norm(np.cross(way, plan.direction), axis=1).max() < 1.01e-3
        speed = np.linalg.norm(np.diff(way, axis=0), axis=1) / np.diff(phase.time)
        assert speed.max() < 0.0201
        force = plan.contact_force[phase.first : phase.first + len(phase.q)]
        assert force == pytest.approx(4000 * np.maximum(way @ plan.direction, 0), abs=1e-6)
    held = ws.attach([], tool).wrench(plan.q[-1])
    weight = (plan.wrench[-1] - held)[:3]
    assert weight == pytest.approx((3 - 1.025) * vehicle[:3, :3].T @ GRAVITY, abs=1e-9)
