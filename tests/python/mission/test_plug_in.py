# SPDX-License-Identifier: BSD-3-Clause
"""Dynamics and controllers written in Python in place of the engine's."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import bathyal

Array = NDArray[np.float64]
MISSION = """\
world: {water: {surface: 0}, terrain: {seabed: {size: [40, 40], spacing: 1, depth: 10}}}
vehicle: {preset: bluerov2_heavy}
start: {position: [0, 0, -1]}
mission: [wait: {time: 20 s}]
"""


def test_drag_in_python_is_drag_in_the_engine() -> None:
    vehicle = bathyal.vehicles.bluerov2_heavy()
    push = np.array([20.0, -5.0, 8.0, 0.3, 0.2, 0.5])

    def pushed(_time: float, _pose: Array, velocity: Array) -> Array:
        force = push - vehicle.linear_drag @ velocity
        for row, a, b, absolute, coefficient in vehicle.terms:
            other = abs(velocity[b]) if absolute else velocity[b]
            force[row] += coefficient * velocity[a] * other
        return force

    bare = vehicle.replace(linear_drag=np.zeros((6, 6)), terms=[])
    own = bare.simulate(np.eye(4), pushed, 10.0)
    engine = vehicle.simulate(np.eye(4), push, 10.0)
    np.testing.assert_allclose(own.pose, engine.pose, atol=1e-10)
    assert np.linalg.norm(engine.pose[-1, :3, 3]) > 0.5


def controller(run: bathyal.Run) -> dict[str, Array]:
    """Goes to 3 m depth; a force pushes it aside."""
    rov = bathyal.VehicleSystem.bluerov2_heavy()
    hold, allocation = bathyal.PoseHold(rov.vehicle), bathyal.Allocation(rov.thrusters)
    target = np.eye(4)
    target[2, 3] = -3.0
    memory = bathyal.PoseHoldState()
    while run.status == "running":
        wanted = hold.step(memory, run.pose, run.velocity, target=target, time=0.1)
        given = allocation.allocate(wanted, voltage=15.0)
        memory.shortfall = given.achieved - wanted
        run.step({"wrench": [3, 0, 0, 0, 0, 0], "thrusters": given.command})
    return {"pose": run.pose}


def test_a_controller_in_python_steers_and_is_replayed_without_it(tmp_path: Path) -> None:
    path = tmp_path / "mission.yaml"
    path.write_text(MISSION)
    (tmp_path / "first").mkdir()
    run = bathyal.Run(path, seed=1, log=tmp_path / "first" / "log.mcap")
    pose = controller(run)["pose"]
    run.close()
    assert abs(pose[2, 3] + 3.0) < 0.05
    assert abs(pose[0, 3]) < 0.1  # against the force
    bathyal.run(path, seed=1, out=tmp_path / "again", replay=tmp_path / "first")
    logs = [(tmp_path / name / "log.mcap").read_bytes() for name in ("first", "again")]
    assert logs[0] == logs[1]
