# SPDX-License-Identifier: BSD-3-Clause
"""Allocation and controllers from Python: lost thrusters, closed loops, bad input."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest

import bathyal


@pytest.fixture(scope="module")
def rov():
    return bathyal.VehicleSystem.bluerov2_heavy()


@pytest.fixture(scope="module")
def allocation(rov):
    return bathyal.Allocation(rov.thrusters)


def test_rank_agrees_with_numpys(allocation):
    whole = 0
    for failed in combinations(range(8), 2):
        left = np.delete(allocation.matrix, failed, axis=1)
        rank, lost = allocation.rank(failed)
        assert rank == np.linalg.matrix_rank(left) == 6 - len(lost)
        whole += rank == 6
    assert whole == 16
    assert all(allocation.rank([one]) == (6, []) for one in range(8))


def test_commands_give_the_wrench(rov, allocation):
    rng = np.random.default_rng(0)
    for _ in range(20):
        wrench = rng.uniform(-1, 1, 6) * [20, 20, 20, 2, 2, 2]
        given = allocation.allocate(wrench, 15.0)
        thrust = [t.steady(c, 15.0)[0] for t, c in zip(rov.thrusters, given.command, strict=True)]
        np.testing.assert_allclose(allocation.matrix @ thrust, wrench, atol=1e-4)
        np.testing.assert_allclose(thrust, given.thrust, atol=1e-9)


def test_it_is_the_optimum_of_scipys_bounded_least_squares(allocation):
    optimize = pytest.importorskip("scipy.optimize")
    weights = np.array([1, 1, 100, 100, 100, 10.0])
    rows = weights / np.abs(allocation.matrix).max(axis=1)
    matrix = np.vstack([rows[:, None] * allocation.matrix, 1e-4 * np.eye(8)])
    thruster = bathyal.Thruster.t200()
    low, high = thruster.steady(-1, 14.0)[0], thruster.steady(1, 14.0)[0]
    rng = np.random.default_rng(1)
    saturated = 0
    for _ in range(30):
        wrench = rng.uniform(-1, 1, 6) * [200, 200, 200, 30, 30, 30]
        right = np.concatenate([rows * wrench, np.zeros(8)])
        best = optimize.lsq_linear(matrix, right, (low, high), method="bvls", tol=1e-14)
        given = allocation.allocate(wrench, 14.0)
        cost = 0.5 * np.sum((matrix @ given.thrust - right) ** 2)
        assert cost <= best.cost * (1 + 1e-9)
        saturated += given.saturated
    assert saturated > 20


def test_holding_a_pose_in_a_current(rov, allocation):
    hold = bathyal.PoseHold(rov.vehicle)
    memory, state = bathyal.PoseHoldState(), rov.rest()
    commands, worst = np.zeros(8), 0.0
    for k in range(800):
        asked = hold.step(memory, state.pose, state.velocity, time=0.05)
        given = allocation.allocate(asked, rov.supply(state, thrusters=commands).voltage)
        memory.shortfall = given.achieved - asked
        commands = given.command
        angle = 2 * np.pi * k * 0.05 / 120
        current = [0.25 * np.cos(angle), 0.25 * np.sin(angle), 0]
        rov.step(state, thrusters=commands, current=current, step=0.01, steps=5)
        if k > 400:
            worst = max(worst, float(np.linalg.norm(state.pose[:3, 3])))
    assert worst < 0.05


def test_remus_cruises_along_a_line_over_the_bottom():
    remus = bathyal.VehicleSystem.remus100()
    control, memory = bathyal.CruiseControl(remus), bathyal.CruiseState()
    line, leg = bathyal.LineOfSight([[0, 0], [300, 0]]), bathyal.LineOfSightState()
    state = remus.rest()
    pose = np.eye(4)
    pose[:3, 3] = [0, 5, -27]
    state.pose, state.velocity = pose, [1.5, 0, 0, 0, 0, 0]
    altitude = []

    def bottom(x, y):
        return -30 + 1.2 * np.sin(2 * np.pi * x / 60)

    for _ in range(1500):
        here = state.pose[:3, 3]
        heading, offset = line.step(leg, here, 0.1)
        z, climb = bathyal.follow_bottom(here, heading, bottom)
        rudder, plane, thrust = control.step(
            memory,
            state.pose,
            state.velocity,
            speed=1.5,
            heading=heading,
            z=z,
            climb=climb,
            time=0.1,
        )
        command = remus.thrusters[0].command_for(thrust, 16.0)
        remus.step(state, thrusters=[command], fins=[rudder, plane], step=0.02, steps=5)
        altitude.append(state.pose[2, 3] - bottom(*state.pose[:2, 3]))
    assert abs(offset) < 0.2
    assert min(altitude) > 2.0
    assert np.mean(altitude[300:]) == pytest.approx(3.0, abs=0.4)


def test_bad_input(rov, allocation):
    with pytest.raises(ValueError, match="`thrusters`"):
        bathyal.Allocation([])
    with pytest.raises(ValueError, match="`weights`"):
        bathyal.Allocation(rov.thrusters, weights=[1, 1, 1, 1, 1, 0])
    with pytest.raises(ValueError, match="`failed`"):
        allocation.rank([9])
    with pytest.raises(ValueError, match="`wrench`"):
        allocation.allocate([1, 2], 16.0)
    with pytest.raises(ValueError, match="`voltage`"):
        allocation.allocate(np.zeros(6), -1.0)
    with pytest.raises(ValueError, match="`frequency`"):
        bathyal.PoseHold(rov.vehicle, frequency=[0, 1, 1, 1, 1, 1])
    hold = bathyal.PoseHold(rov.vehicle)
    with pytest.raises(ValueError, match="`pose`"):
        hold.step(bathyal.PoseHoldState(), 2 * np.eye(4), np.zeros(6), time=0.1)
    with pytest.raises(ValueError, match="`time`"):
        hold.step(bathyal.PoseHoldState(), np.eye(4), np.zeros(6), time=0.0)
    with pytest.raises(ValueError, match="`rudder`"):
        bathyal.CruiseControl(rov)
    with pytest.raises(ValueError, match="`points`"):
        bathyal.LineOfSight([[0, 0]])
    with pytest.raises(ValueError, match="`altitude`"):
        bathyal.follow_bottom([0, 0, 0], 0.0, lambda x, y: -9.0, altitude=0)
    with pytest.raises(ValueError, match="`bottom`"):
        bathyal.follow_bottom([0, 0, 0], 0.0, lambda x, y: float("nan"))
