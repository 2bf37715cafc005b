# SPDX-License-Identifier: BSD-3-Clause
"""A vehicle holds its trim while its arm reaches out and presses (Maevskiy, Zanin 2020)."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from numpy.typing import NDArray

import bathyal
from tests.support import uvms_runs

Array = NDArray[np.float64]
pytestmark = pytest.mark.skipif(not uvms_runs.there(), reason="uvms of the shared data is not here")

STOWED = np.array([0.3, 0.2, 0.3, 5.5])
REACHED = np.array([0.338, 1.028, 2.766, 5.502])  # the tip 0.58 m ahead of the origin
# At rest, reaching out, pressing, letting go; the arm moves in the second, the force in the third.
TIME = np.array([0.0, 15.0, 20.0, 25.0, 26.0, 36.0, 37.0, 45.0])
FORCE = 5.0 * np.array([0, 0, 0, 0, 1, 1, 0, 0])
WRONG = 0.8
FREQUENCY = (1.5, 1.5, 1.5, 3.0, 3.0, 1.5)  # [rad/s]


def workspace(part: float) -> bathyal.Workspace:
    """With an arm whose masses are a part of those known."""
    arm = uvms_runs.arm()
    links = [
        bathyal.Link(
            link.name, mass=part * link.mass, center_of_mass=link.center_of_mass,
            volume=link.volume, center_of_buoyancy=link.center_of_buoyancy, frame=link.frame,
        )
        for link in arm.links
    ]  # fmt: skip
    table = arm.to_dh()
    jaw = np.eye(4)
    jaw[2, 3] = -0.19
    changed = bathyal.Arm.from_dh(
        table.a, table.alpha, table.d, table.theta, beta=table.beta, root=table.root,
        flange=table.flange @ jaw, lower=arm.lower, upper=arm.upper, links=links, name="Alpha 5",
    )  # fmt: skip
    return bathyal.Workspace(changed, uvms_runs.MOUNT, radii=0.02)


def pressing() -> tuple[Array, Array, Array]:
    """Times, postures and the force on the tip."""
    time = np.arange(0.0, TIME[-1] + 0.05, 0.1)
    s = np.clip((time - TIME[1]) / (TIME[2] - TIME[1]), 0.0, 1.0)
    q = STOWED + np.outer(s**3 * (10 - 15 * s + 6 * s * s), REACHED - STOWED)
    wrench = np.zeros((len(time), 6))
    wrench[:, 2] = np.interp(time, TIME, FORCE)
    return time, q, wrench


@dataclasses.dataclass
class Held:
    depth: float  # largest error [m]
    rms: float  # of pitch [deg]
    peak: float


def held(*, fed: bool, wrong: float = WRONG) -> Held:
    """While the arm reaches out, presses and lets go; the model has `wrong` of mass and force."""
    vehicle = bathyal.vehicles.bluerov2_heavy()
    believed = vehicle.replace(
        mass=wrong * vehicle.mass, volume=wrong * vehicle.volume, inertia=wrong * vehicle.inertia,
        added_mass=wrong * vehicle.added_mass,
    )  # fmt: skip
    time, q, contact = pressing()
    expected = workspace(wrong).wrench(
        q, contact=wrong * contact, water_density=vehicle.water_density
    )
    run = bathyal.ArmOnVehicle(vehicle, workspace(1.0)).hold(
        np.eye(4), q, bathyal.Allocation(bathyal.VehicleSystem.bluerov2_heavy().thrusters),
        bathyal.PoseHold(believed, frequency=FREQUENCY), TIME[-1], time=time, tip_wrench=contact,
        expected_wrench=expected if fed else None,
    )  # fmt: skip
    working = run.time >= TIME[1]
    pitch = np.degrees(np.arcsin(-run.pose[working, 2, 0]))
    depth = run.pose[working, 2, 3]
    return Held(
        float(np.abs(depth).max()), float(np.sqrt(np.mean(pitch**2))), float(np.abs(pitch).max())
    )


def test_trim_is_held_while_the_tool_presses() -> None:
    known, alone = held(fed=True), held(fed=False)
    assert known.depth < 0.05
    assert known.rms < 1.2
    assert known.peak < 5.0
    assert known.rms < alone.rms / 3
    assert alone.peak > 3.0  # it was no easy case


def test_what_is_known_exactly_hardly_disturbs() -> None:
    assert held(fed=True, wrong=1.0).rms < 0.3


def test_more_than_the_thrusters_give_is_refused() -> None:
    vehicle = bathyal.vehicles.bluerov2_heavy()
    both = bathyal.ArmOnVehicle(vehicle, workspace(1.0))
    allocation = bathyal.Allocation(bathyal.VehicleSystem.bluerov2_heavy().thrusters)
    moment = np.array([0, 0, 0, 0, 19.0, 0])
    with pytest.raises(ValueError, match=r"expected_wrench.*19 N m in pitch.*they give \d+ %"):
        both.hold(
            np.eye(4), REACHED, allocation, bathyal.PoseHold(vehicle), 1.0, expected_wrench=moment
        )
