# SPDX-License-Identifier: BSD-3-Clause
"""Thrusters, battery, fins and the vehicle with them from Python: figures, files, bad input."""

from __future__ import annotations

import copy
from pathlib import Path

import numpy as np
import pytest

import bathyal

T200 = Path(__file__).parents[3] / "../shared/data/thruster/t200_data.csv"


@pytest.fixture(scope="module")
def table():
    if not T200.is_file():
        pytest.skip(f"no {T200}")
    return bathyal.read_thruster_table(T200)


def test_bollard_tests_are_read(table):
    assert table.command.shape == (201,)
    np.testing.assert_array_equal(table.voltage, [10, 12, 14, 16, 18, 20])
    assert table.thrust.shape == table.power.shape == table.speed.shape == (6, 201)
    thrust, power, speed = bathyal.Thruster.t200(table).steady(1.0, 16.0)
    assert thrust == pytest.approx(51.5, abs=0.05)
    assert power == pytest.approx(381, abs=1)
    assert speed > 50
    assert table.at(-1.0, 16.0)[2] < -50


def test_the_fitted_law_is_the_one_shipped(table):
    fit = bathyal.fit_thruster(table)
    assert fit.rms_ahead == pytest.approx(0.60, abs=0.005)
    assert fit.rms_astern == pytest.approx(0.67, abs=0.005)
    shipped = bathyal.Thruster.t200()
    np.testing.assert_allclose(fit.thruster.thrust, shipped.thrust, rtol=1e-6)
    np.testing.assert_allclose(fit.thruster.speed, shipped.speed, rtol=1e-6)


def test_a_table_with_newtons_and_any_order_is_read(tmp_path):
    path = tmp_path / "own.csv"
    path.write_text(
        "PWM (us),Voltage,Force (N),Power (W),RPM\n"
        "1900,12,9,80,600\n1500,12,0,0,0\n1100,12,-6,70,600\n"
    )
    table = bathyal.read_thruster_table(path)
    np.testing.assert_array_equal(table.command, [-1, 0, 1])
    np.testing.assert_array_equal(table.thrust, [[-6, 0, 9]])
    np.testing.assert_array_equal(table.speed, [[-10, 0, 10]])


HEAD = "Voltage,PWM,RPM,Power,Force\n"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("\n", "header"),
        ("Voltage,PWM,RPM,Power\n16,1500,0,0\n", "line 1: `force`"),
        (HEAD + "16,1500,0,0,x\n", "line 2: `force`: expected a number, got x"),
        (HEAD + "16,1500,0,0\n", "line 2: `force`: expected a number, got nothing"),
        (HEAD + "16,1500,0,0,nan\n", "finite"),
        (HEAD + "16,1100,0,0,0\n16,1500,0,0,0\n12,1500,0,0,0\n", "same pulses"),
        (HEAD + "16,1000,9,9,-1\n16,1500,0,0,0\n", "`command`"),
        (HEAD + "16,1100,9,-9,-1\n16,1500,0,0,0\n", "`power`"),
    ],
)
def test_broken_tables_are_named(tmp_path, text, message):
    path = tmp_path / "broken.csv"
    path.write_text(text)
    with pytest.raises(bathyal.Error, match="broken.csv.*" + message):
        bathyal.read_thruster_table(path)


def test_a_span_of_nothing_is_refused(tmp_path):
    with pytest.raises(ValueError, match="`span`"):
        bathyal.read_thruster_table(tmp_path / "none.csv", span=0)


def test_battery_and_load_agree():
    battery = bathyal.Battery.lithium_ion_4s()
    load = battery.solve(lambda voltage: 3.0 * voltage**2, charge=0.5)
    assert load.voltage * load.current == pytest.approx(3.0 * load.voltage**2)
    assert load.voltage == pytest.approx(battery.open_circuit(0.5) - 0.05 * load.current)
    assert battery.solve(1e4).collapsed
    with pytest.raises(ValueError, match="`charge`"):
        battery.solve(1.0, charge=1.5)
    with pytest.raises(ValueError, match="`power`"):
        battery.solve(float("nan"))


def test_fin_lifts_across_the_flow_and_stalls():
    fin = bathyal.Fin(area=0.01, lift_slope=3.0, position=[-0.6, 0, 0], limit=0.3, lag=0.1)
    wrench = fin.wrench(0.1, [2, 0, 0, 0, 0, 0])
    assert wrench[1] == pytest.approx(0.5 * 1025 * 0.01 * 4 * 0.3, rel=1e-3)
    assert wrench[5] == pytest.approx(-0.6 * wrench[1])
    assert fin.coefficients(0.6)[0] < fin.coefficients(0.3)[0]
    assert fin.advanced(0.0, 1.0, 10.0) == pytest.approx(0.3)


def test_a_propeller_loses_thrust_to_inflow():
    propeller = bathyal.Thruster.propeller(diameter=0.1, thrust=(0.4, -0.4), speed=30.0)
    still, moving = propeller.wrench(30.0), propeller.wrench(30.0, [1.5, 0, 0, 0, 0, 0])
    advance = 1.5 / (30.0 * 0.1)
    assert moving[0] / still[0] == pytest.approx(1 - advance)
    assert propeller.advanced(0.0, 1.0, 12.0, 0.1) == 30.0


def test_a_tether_holds_by_its_weight():
    tether = bathyal.Tether(anchor=[0, 0, 0], length=10, weight=2.0)
    wrench = tether.wrench(np.eye(4))
    assert wrench[2] == pytest.approx(-10.0, rel=1e-3)  # both ends there: half of it at each


def test_remus_runs_and_turns():
    remus = bathyal.VehicleSystem.remus100()
    state = remus.rest()
    state.thruster_speed = [25.0]
    remus.step(state, thrusters=[1.0], step=0.02, steps=200)
    assert (
        state.velocity[0] > 0.3
    )  # its 7 N of buoyancy pitch it, so that it is slower than in surge
    before = copy.deepcopy(state)
    remus.step(state, thrusters=[1.0], fins=[0.07, 0.0], step=0.02, steps=100)
    assert state.velocity[5] > before.velocity[5] + 0.002  # to port
    np.testing.assert_array_equal(state.fin_angle, [0.07, 0.0])
    again = copy.copy(before)
    remus.step(again, thrusters=[1.0], fins=[0.07, 0.0], step=0.02, steps=100)
    np.testing.assert_array_equal(again.pose, state.pose)


def test_bluerov_lets_its_weight_go():
    rov = bathyal.VehicleSystem(
        bathyal.vehicles.bluerov2_heavy(), drop_weights=[bathyal.DropWeight(mass=1.0)]
    )
    state = rov.rest()
    rov.step(state, steps=300)
    assert state.velocity[2] < -0.05
    rov.step(state, drop=[True])
    assert state.released == [True]
    assert rov.wrench(state)[2] == 0.0


def test_the_benchmark_thrusters_push_less():
    pushed = []
    for benchmark in (False, True):
        rov = bathyal.VehicleSystem.bluerov2_heavy(benchmark_thrusters=benchmark)
        state = rov.rest()
        rov.step(state, thrusters=[0, 0, 0, 0, 0.97, 0.97, 0.97, 0.97], steps=300)
        pushed.append(rov.wrench(state, thrusters=[0, 0, 0, 0, 0.97, 0.97, 0.97, 0.97])[2])
    assert pushed[1] == pytest.approx(4 * 30.6, abs=0.5)
    assert pushed[0] > pushed[1]


def test_bad_input():
    rov = bathyal.VehicleSystem.bluerov2_heavy()
    state = rov.rest()
    with pytest.raises(ValueError, match=r"`commands.thrusters`: expected 8 numbers"):
        rov.step(state, thrusters=[0.0])
    with pytest.raises(ValueError, match="`step`"):
        rov.step(state, step=0.0)
    with pytest.raises(ValueError, match="`steps`"):
        rov.step(state, steps=-1)
    with pytest.raises(ValueError, match="`wrench`"):
        rov.step(state, wrench=[1, 2, 3])
    with pytest.raises(ValueError, match="`charge`"):
        state.charge = 2.0
    with pytest.raises(ValueError, match="`thruster_speed`"):
        state.thruster_speed = [1.0]
    with pytest.raises(ValueError, match="`pose`"):
        state.pose = 2 * np.eye(4)
    with pytest.raises(ValueError, match=r"`ahead\.thrust`"):
        bathyal.Thruster(thrust=(-1, 1), speed=(1, 1))
    with pytest.raises(ValueError, match="`length`"):
        bathyal.Tether(anchor=[0, 0, 0], length=0)
    with pytest.raises(ValueError, match="`shaft`"):
        bathyal.Fin(shaft=[1, 0, 0])
    with pytest.raises(ValueError, match="`mass`"):
        bathyal.DropWeight(mass=-1)
    with pytest.raises(ValueError, match="`thrust`"):
        bathyal.ThrusterTable([-1, 1], [12], thrust=[[1, 2, 3]], power=[[1, 2]], speed=[[1, 2]])
