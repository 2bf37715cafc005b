# SPDX-License-Identifier: BSD-3-Clause
"""Sensors, their noise, and what is made of it."""

import numpy as np
import pytest

import bathyal


def straight(count: int, step: float, depth: float = 10.0) -> tuple[np.ndarray, np.ndarray]:
    """Times and poses of a run of 1.5 m/s along x."""
    time = step * np.arange(count)
    pose = np.tile(np.eye(4), (count, 1, 1))
    pose[:, 0, 3] = 1.5 * time
    pose[:, 2, 3] = -depth
    return time, pose


def test_a_sensor_samples_at_its_rate() -> None:
    time, pose = straight(1001, 0.01)
    readings = bathyal.Sensor("depth", rate=4.0).simulate(time, pose)
    assert np.allclose(readings.time, np.arange(41) / 4.0)
    assert np.array_equal(readings.values, np.full((41, 1), 10.0))
    assert readings.valid.all()


def test_a_new_sensor_changes_nobodys_noise() -> None:
    time, pose = straight(50, 1.0)
    one = bathyal.Sensor("depth", name="a", noise=1.0)
    first = one.simulate(time, pose, seed=3).values
    bathyal.Sensor("depth", name="b", noise=1.0).simulate(time, pose, seed=3)
    assert np.array_equal(one.simulate(time, pose, seed=3).values, first)
    other = bathyal.Sensor("depth", name="b", noise=1.0).simulate(time, pose, seed=3).values
    assert not np.allclose(other, first)


def test_errors_are_one_a_channel() -> None:
    time, pose = straight(4000, 1.0)
    dvl = bathyal.Sensor("dvl", noise=[0.1, 0.2, 0.0])
    assert np.allclose(dvl.simulate(time, pose).values.std(axis=0), [0.1, 0.2, 0.0], rtol=0.05)


def test_usbl_comes_late_and_gps_only_at_the_surface() -> None:
    time, pose = straight(3, 1.0, depth=1000.0)
    pose[:, 0, 3] = 0.0
    usbl = bathyal.Sensor("usbl", beacons=[[0.0, 0.0, 0.0]]).simulate(time, pose)
    assert np.allclose(usbl.arrival - usbl.time, 2.0 * 1000.0 / 1500.0)
    assert not bathyal.Sensor("gps").simulate(time, pose).valid.any()


@pytest.mark.parametrize(
    ("kind", "wrong", "field"),
    [
        ("sextant", {}, "kind"),
        ("depth", {"rate": -1.0}, "rate"),
        ("depth", {"rate": np.nan}, "rate"),
        ("depth", {"latency": -0.1}, "latency"),
        ("depth", {"dropout": 2.0}, "dropout"),
        ("depth", {"noise": -1.0}, "channels"),
        ("dvl", {"noise": [1.0, 2.0]}, "noise"),
        ("depth", {"markov": 1.0}, "markov_time"),
        ("usbl", {}, "beacons"),
        ("lbl", {"beacons": np.zeros((13, 3))}, "beacons"),
        ("imu", {"vehicle_from_sensor": 2.0 * np.eye(4)}, "vehicle_from_sensor"),
    ],
)
def test_bad_sensors_are_refused(kind: str, wrong: dict[str, object], field: str) -> None:
    with pytest.raises(ValueError, match=field):
        bathyal.Sensor(kind, **wrong)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"time": [0.0, 2.0, 1.0]}, "time"),
        ({"time": [0.0, 1.0, np.nan]}, "time"),
        ({"time": [-1.0, 1.0, 2.0]}, "time"),
        ({"pose": np.tile(np.eye(4), (2, 1, 1))}, "pose"),
        ({"pose": np.zeros((3, 4, 4))}, "pose"),
        ({"velocity": np.zeros((3, 3))}, "velocity"),
        ({"velocity": np.full((3, 6), np.nan)}, "velocity"),
    ],
)
def test_bad_motions_are_refused(change: dict[str, object], field: str) -> None:
    time, pose = straight(3, 1.0)
    given = {"time": time, "pose": pose} | change
    with pytest.raises(ValueError, match=field):
        bathyal.Sensor("dvl").simulate(**given)  # type: ignore[arg-type]


def test_allan_deviation_of_a_simulated_gyro() -> None:
    rate, density = 50.0, 1e-3
    time, pose = straight(200_000, 1 / rate)
    gyro = bathyal.Sensor("imu", rate=rate, noise=density * np.sqrt(rate))
    samples = gyro.simulate(time, pose, seed=2).values[:, 0]
    interval, deviation = bathyal.allan_deviation(samples, rate, [1, 10, 100])
    assert np.allclose(deviation, density / np.sqrt(interval), rtol=0.05)


@pytest.mark.parametrize(
    ("heading", "scale", "drift", "length", "speed", "off"),
    [
        (1.0, 0.0, 0.0, 1000.0, 1.0, 17.45),
        (0.0, 0.002, 0.0, 1000.0, 1.0, 2.0),
        (0.0, 0.0, 1.0 / 3600.0, 5400.0, 1.5, 47.1),
    ],
)
def test_dead_reckoning_errs_as_the_formulas_say(
    heading: float, scale: float, drift: float, length: float, speed: float, off: float
) -> None:
    time = np.linspace(0.0, length / speed, 1001)
    yaw = np.radians(heading + drift * time)
    log = np.column_stack([np.full(1001, speed * (1.0 + scale)), np.zeros((1001, 2))])
    end = bathyal.dead_reckon(time, yaw, log)[-1]
    assert np.linalg.norm(end - [length, 0.0, 0.0]) == pytest.approx(off, abs=0.05)


def test_dead_reckoning_refuses_bad_input() -> None:
    with pytest.raises(ValueError, match="time"):
        bathyal.dead_reckon([0.0, 0.0], [0.0, 0.0], np.zeros((2, 3)))
    with pytest.raises(ValueError, match="velocity"):
        bathyal.dead_reckon([0.0, 1.0], [0.0, 0.0], np.zeros((3, 3)))
    with pytest.raises(ValueError, match="attitude"):
        bathyal.dead_reckon([0.0, 1.0], [0.0, np.nan], np.zeros((2, 3)))
    with pytest.raises(ValueError, match="sample_rate"):
        bathyal.allan_deviation(np.zeros(10), 0.0)
