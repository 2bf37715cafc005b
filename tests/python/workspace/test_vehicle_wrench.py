# SPDX-License-Identifier: BSD-3-Clause
"""What an arm exerts on its vehicle."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

import bathyal

Array = NDArray[np.float64]
DENSITY, GRAVITY = 1025.0, 9.80665


def heavy_arm(seed: int, joints: int = 6) -> bathyal.Arm:
    """Any angles and lengths; links with masses, inertias and volumes in frames of their own."""
    random = np.random.default_rng(seed)

    def link(k: int) -> bathyal.Link:
        part = random.uniform(-0.3, 0.3, (3, 3))
        spread = part @ part.T
        frame = np.eye(4)
        frame[:3, 3] = random.uniform(-0.1, 0.1, 3)
        return bathyal.Link(
            f"link_{k}", mass=random.uniform(1, 4), center_of_mass=random.uniform(-0.2, 0.2, 3),
            inertia=np.trace(spread) * np.eye(3) - spread, volume=random.uniform(0, 3e-3),
            center_of_buoyancy=random.uniform(-0.2, 0.2, 3), frame=frame,
        )  # fmt: skip

    values = random.uniform(-1, 1, (4, joints))
    return bathyal.Arm.from_dh(
        a=values[0], alpha=2 * values[1], d=values[2], theta=3 * values[3],
        links=[link(k) for k in range(joints + 1)],
    )  # fmt: skip


def mount() -> Array:
    pose = np.eye(4)
    pose[:3, :3] = [[0, -1, 0], [0, 0, -1], [1, 0, 0]]
    pose[:3, 3] = 0.4, -0.2, -0.3
    return pose


SAMPLE = bathyal.RigidBody(
    1.2, center_of_mass=(0.1, 0, 0.05), inertia=np.diag([0.02, 0.03, 0.04]), volume=5e-4,
    center_of_buoyancy=(0, 0.1, 0),
)  # fmt: skip


def centres(arm: bathyal.Arm, q: Array) -> tuple[Array, Array, Array, Array]:
    """Masses, (N, B, 3) centres of mass, volumes and centres of buoyancy, the sample last."""
    tips, links = arm.forward(q), arm.forward(q, links=True)
    frames = np.concatenate([mount() @ links, (mount() @ tips)[:, None]], axis=1)
    bodies = [link.body for link in arm.links] + [SAMPLE]

    def placed(points: list[Array]) -> Array:
        return np.einsum("nbij,bj->nbi", frames[..., :3, :3], np.array(points)) + frames[..., :3, 3]

    return (
        np.array([b.mass for b in bodies]), placed([b.center_of_mass for b in bodies]),
        np.array([b.volume for b in bodies]), placed([b.center_of_buoyancy for b in bodies]),
    )  # fmt: skip


@pytest.mark.parametrize("seed", range(3))
def test_change_of_moment_is_that_of_the_levers(seed: int) -> None:
    arm = heavy_arm(seed)
    q = np.random.default_rng(seed).uniform(-3, 3, (20, 6))
    wrench = bathyal.Workspace(arm, mount(), radii=0.05).attach([], SAMPLE).wrench(q)
    mass, heavy, volume, light = centres(arm, q)
    weight = mass[:, None] * [0, 0, -GRAVITY]
    buoyancy = volume[:, None] * [0, 0, -GRAVITY * DENSITY]
    change = np.cross(heavy[1:] - heavy[:-1], weight) - np.cross(light[1:] - light[:-1], buoyancy)
    np.testing.assert_allclose(np.diff(wrench[:, 3:], axis=0), change.sum(axis=1), atol=1e-10)
    np.testing.assert_allclose(wrench[:, :3] - (weight - buoyancy).sum(axis=0), 0, atol=1e-10)


@pytest.mark.parametrize("seed", range(3))
def test_moving_arm_as_in_pinocchio(seed: int) -> None:
    from tests.support.pin_arms import PinArm, pin

    arm = heavy_arm(seed)
    ws = bathyal.Workspace(arm, mount(), radii=0.05)
    peer = PinArm(ws.arm)  # without the foot: held by the world
    tip = peer.model.frames[peer.tip]
    carried = pin.Inertia(SAMPLE.mass, SAMPLE.center_of_mass, SAMPLE.inertia)
    peer.model.appendBodyToJoint(tip.parentJoint, carried, tip.placement)
    peer.data = peer.model.createData()
    gravity = np.array([1.0, -2.0, -9.0])
    peer.model.gravity.linear = gravity
    foot = arm.links[0]
    at = (ws.arm.forward(np.zeros(6), links=True)[0] @ [*foot.center_of_mass, 1])[:3]
    footing = np.concatenate([foot.mass * gravity, np.cross(at, foot.mass * gravity)])
    q, velocity, acceleration = np.random.default_rng(seed).uniform(-2, 2, (3, 8, 6))
    found = ws.attach([], SAMPLE).wrench(
        q, velocity=velocity, acceleration=acceleration, gravity=gravity, water_density=0
    )
    for k in range(8):
        pin.rnea(peer.model, peer.data, q[k], velocity[k], acceleration[k])
        held = peer.data.liMi[1].act(peer.data.f[1]).vector
        np.testing.assert_allclose(found[k], footing - held, atol=1e-9)


def planar() -> bathyal.Workspace:
    """Both joints turn about z: opposite swings are mirror images in the plane y = 0."""
    links = [
        bathyal.Link("foot", mass=0.5, center_of_mass=(0.1, 0, 0)),
        bathyal.Link("upper", mass=3.0, center_of_mass=(-0.2, 0, 0.01), volume=1e-3,
                     inertia=np.diag([0.01, 0.06, 0.06]), center_of_buoyancy=(-0.25, 0, 0.02)),
        bathyal.Link("fore", mass=2.0, center_of_mass=(-0.15, 0, 0), volume=8e-4,
                     inertia=np.diag([0.01, 0.04, 0.04]), center_of_buoyancy=(-0.2, 0, 0)),
    ]  # fmt: skip
    arm = bathyal.Arm.from_dh(a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0], links=links)
    return bathyal.Workspace(arm, radii=0.05)


def test_symmetric_motions_give_symmetric_wrenches() -> None:
    ws = planar()
    q, velocity, acceleration = np.random.default_rng(1).uniform(-2, 2, (3, 30, 2))
    port = ws.wrench(q, velocity=velocity, acceleration=acceleration)
    starboard = ws.wrench(-q, velocity=-velocity, acceleration=-acceleration)
    mirrored = port * [1, -1, 1, -1, 1, -1]
    np.testing.assert_allclose(starboard, mirrored, atol=1e-10)
    assert np.abs(port[:, 1]).max() > 1  # and not because nothing pushes sideways


def test_net_impulse_is_the_change_of_momentum() -> None:
    ws = bathyal.Workspace(heavy_arm(5), mount(), radii=0.05).attach([], SAMPLE)
    time = np.linspace(0, 1.5, 601)
    rate = np.linspace(0.7, 2.1, 6)
    q = np.sin(np.outer(time, rate))
    velocity, acceleration = rate * np.cos(np.outer(time, rate)), -(rate**2) * q
    inertia = ws.wrench(q, velocity=velocity, acceleration=acceleration) - ws.wrench(q)
    step = time[1] - time[0]
    simpson = np.ones(601)
    simpson[1:-1:2], simpson[2:-1:2] = 4, 2
    impulse = step / 3 * (simpson[:, None] * inertia).sum(axis=0)
    momentum = ws.momentum(q[[0, -1]], velocity[[0, -1]])
    np.testing.assert_allclose(impulse, momentum[0] - momentum[1], atol=1e-8)


def test_shapes_and_refusals() -> None:
    ws = planar()
    assert ws.wrench([0, 0]).shape == (6,)
    assert ws.wrench([[0, 0]]).shape == (1, 6)
    assert not ws.wrench([0, 0]).flags.writeable
    pushed = ws.wrench([0, 0], contact=[0, 0, 5, 0, 0, 0]) - ws.wrench([0, 0])
    np.testing.assert_allclose(pushed, [0, 0, 5, 0, -4.5, 0], atol=1e-12)
    with pytest.raises(ValueError, match="`velocity`: expected"):
        ws.wrench([[0, 0], [1, 1]], velocity=[0, 0])
    with pytest.raises(ValueError, match="`contact`: expected"):
        ws.wrench([0, 0], contact=[0, 0, np.inf, 0, 0, 0])
    with pytest.raises(ValueError, match="`water_density`: expected"):
        ws.wrench([0, 0], water_density=-1)
    with pytest.raises(ValueError, match="`q`"):
        ws.wrench([0, 0, 0])
