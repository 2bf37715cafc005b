# SPDX-License-Identifier: BSD-3-Clause
"""Arm and vehicle as one tree."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

import bathyal

Array = NDArray[np.float64]
NO_WATER = 1e-9  # [kg/m³]


def heavy_arm(seed: int) -> bathyal.Arm:
    """Five joints, the third sliding; links with masses and inertias in frames of their own."""
    random = np.random.default_rng(seed)

    def link(k: int) -> bathyal.Link:
        part = random.uniform(-0.3, 0.3, (3, 3))
        spread = part @ part.T
        frame = np.eye(4)
        frame[:3, :3] = Rotation.from_rotvec(random.uniform(-1, 1, 3)).as_matrix()
        frame[:3, 3] = random.uniform(-0.1, 0.1, 3)
        return bathyal.Link(
            f"link_{k}", mass=random.uniform(1, 4), center_of_mass=random.uniform(-0.2, 0.2, 3),
            inertia=np.trace(spread) * np.eye(3) - spread, volume=1e-3, frame=frame,
        )  # fmt: skip

    values = random.uniform(-1, 1, (4, 5))
    kinds = ["revolute", "revolute", "prismatic", "revolute", "revolute"]
    return bathyal.Arm.from_dh(
        a=values[0], alpha=2 * values[1], d=values[2], theta=3 * values[3], joint_types=kinds,
        links=[link(k) for k in range(6)],
    )  # fmt: skip


def mount() -> Array:
    pose = np.eye(4)
    pose[:3, :3] = [[0, -1, 0], [0, 0, -1], [1, 0, 0]]
    pose[:3, 3] = 0.4, -0.2, -0.3
    return pose


def hull(density: float = NO_WATER) -> bathyal.Vehicle:
    return bathyal.Vehicle(
        mass=20.0, center_of_mass=(0.02, -0.01, -0.03), volume=0.02, water_density=density,
        inertia=[[0.6, 0.02, 0.01], [0.02, 0.8, -0.03], [0.01, -0.03, 0.9]],
    )  # fmt: skip


def any_state(seed: int) -> tuple[Array, Array, Array, Array]:
    random = np.random.default_rng(seed + 50)
    pose = np.eye(4)
    pose[:3, :3] = Rotation.from_rotvec(random.uniform(-2, 2, 3)).as_matrix()
    pose[:3, 3] = random.uniform(-3, 3, 3)
    return pose, random.uniform(-1, 1, 6), random.uniform(-2, 2, 5), random.uniform(-2, 2, 5)


@pytest.mark.parametrize("seed", range(4))
def test_accelerations_are_those_of_pinocchio(seed: int) -> None:
    from tests.support.pin_arms import PinArm, pin

    ws = bathyal.Workspace(heavy_arm(seed), mount())
    vehicle = hull()
    both = bathyal.ArmOnVehicle(vehicle, ws, added_mass=0.0, drag=0.0)
    body = bathyal.RigidBody(
        vehicle.mass, center_of_mass=vehicle.center_of_mass, inertia=vehicle.inertia
    )
    peer = PinArm(ws.arm, body)
    peer.model.gravity.linear = np.array([0, 0, -vehicle.gravity])
    pose, velocity, q, rate = any_state(seed)
    torque, thrust = np.random.default_rng(seed).uniform(-5, 5, 5), np.arange(6.0) - 2.5
    turn = Rotation.from_matrix(pose[:3, :3]).as_quat()
    expected = pin.aba(
        peer.model, peer.data, np.concatenate([pose[:3, 3], turn, q]),
        np.concatenate([velocity, rate]), np.concatenate([thrust, torque]),
    )  # fmt: skip
    base, joints, driven = both.acceleration(
        (pose, velocity), q, rate, torque=torque, thrust=thrust
    )
    scale = np.abs(expected).max()
    np.testing.assert_allclose(np.concatenate([base, joints]), expected, atol=1e-10 * scale)
    np.testing.assert_array_equal(driven, torque)
    again, _, found = both.acceleration(
        (pose, velocity), q, rate, acceleration=joints, thrust=thrust
    )
    np.testing.assert_allclose(found, torque, atol=1e-9 * scale)
    np.testing.assert_allclose(again, base, atol=1e-10 * scale)


def test_static_trim_is_where_it_comes_to_rest() -> None:
    """The quasi-static attitude of the workspace, by other code."""
    vehicle = hull(1000.0)
    damped = vehicle.replace(
        linear_drag=np.diag([40.0, 40.0, 40.0, 8.0, 8.0, 8.0]), center_of_mass=(0, 0, -0.4)
    )
    body = bathyal.RigidBody(20.0, center_of_mass=(0, 0, -0.4), volume=0.02)
    links = [bathyal.Link("foot")] + [
        bathyal.Link(f"link_{k}", mass=0.6, center_of_mass=(0.1 * k, 0.1, 0), volume=6e-4,
                     inertia=0.01 * np.eye(3)) for k in range(2)
    ]  # fmt: skip
    arm = bathyal.Arm.from_dh(a=[0.3, 0.3], alpha=[0.3, 0.2], d=[0, 0], theta=[0, 0], links=links)
    ws = bathyal.Workspace(arm, mount(), vehicle_body=body)
    q = np.array([0.4, -0.6])
    trim = ws.static_trim(q, water_density=1000.0)
    motion = bathyal.ArmOnVehicle(damped, ws).simulate(np.eye(4), q, np.zeros(6), 60.0, 0.02)
    turn = motion.pose[-1, :3, :3]
    assert abs(trim.pitch) > 1e-3
    assert -np.arcsin(turn[2, 0]) == pytest.approx(trim.pitch, abs=1e-6)
    assert np.arctan2(turn[2, 1], turn[2, 2]) == pytest.approx(trim.roll, abs=1e-6)


def test_rows_are_gone_through_and_torques_carry_them_out() -> None:
    both = bathyal.ArmOnVehicle(hull(1000.0), bathyal.Workspace(heavy_arm(1), mount(), radii=0.05))
    rows = np.random.default_rng(2).uniform(-0.3, 0.3, (4, 5))
    motion = both.simulate(
        np.eye(4), rows, np.zeros(6), 3.0, time=[0, 1, 2, 3], current=(0.1, 0, 0)
    )
    np.testing.assert_allclose(motion.q[::100], rows, atol=1e-12)
    assert len(motion) == 301
    assert motion.torque.shape == (301, 5)
    rate = (motion.q[151] - motion.q[149]) / 0.02
    bend = (motion.q[151] - 2 * motion.q[150] + motion.q[149]) / 1e-4
    state = (motion.pose[150], motion.velocity[150])
    found = both.acceleration(state, motion.q[150], rate, acceleration=bend, current=(0.1, 0, 0))[2]
    np.testing.assert_allclose(motion.torque[150], found, rtol=1e-3, atol=0.05)


def test_bad_input_is_named() -> None:
    arm = heavy_arm(0)
    ws = bathyal.Workspace(arm, mount())
    both = bathyal.ArmOnVehicle(hull(), ws)
    still = np.zeros(6)
    with pytest.raises(ValueError, match="drag"):
        bathyal.ArmOnVehicle(hull(), ws, drag=-1.0)
    with pytest.raises(ValueError, match="strips"):
        bathyal.ArmOnVehicle(hull(), ws, strips=0)
    with pytest.raises(ValueError, match="time"):
        both.simulate(np.eye(4), np.zeros((3, 5)), still, 1.0)
    with pytest.raises(ValueError, match="time"):
        both.simulate(np.eye(4), np.zeros((3, 5)), still, 1.0, time=[0, 2, 1])
    with pytest.raises(ValueError, match="`q`"):
        both.simulate(np.eye(4), np.zeros(4), still, 1.0)
    with pytest.raises(ValueError, match="tip_wrench"):
        both.simulate(np.eye(4), np.zeros(5), still, 1.0, tip_wrench=np.zeros((3, 6)))
    with pytest.raises(ValueError, match="`q`"):
        both.simulate(np.eye(4), [0, 0, np.nan, 0, 0], still, 1.0)
    with pytest.raises(ValueError, match="torque"):
        both.acceleration(
            np.eye(4), np.zeros(5), np.zeros(5), torque=np.zeros(5), acceleration=np.zeros(5)
        )
    with pytest.raises(ValueError, match="step"):
        both.simulate(np.eye(4), np.zeros(5), still, 1.0, 0.0)
