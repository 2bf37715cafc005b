# SPDX-License-Identifier: BSD-3-Clause
"""The filter and its smoother, by sensors on a circle."""

import numpy as np
import pytest

import bathyal

SPEED, TURN = 1.5, 0.05


def circle(rate: float, end: float) -> dict[str, np.ndarray]:
    """A level circle to port, exact."""
    time = np.arange(round(rate * end) + 1) / rate
    yaw = TURN * time
    pose = np.tile(np.eye(4), (len(time), 1, 1))
    pose[:, 0, 0] = pose[:, 1, 1] = np.cos(yaw)
    pose[:, 1, 0] = np.sin(yaw)
    pose[:, 0, 1] = -np.sin(yaw)
    pose[:, 0, 3] = SPEED / TURN * np.sin(yaw)
    pose[:, 1, 3] = SPEED / TURN * (1.0 - np.cos(yaw))
    velocity = np.zeros((len(time), 6))
    velocity[:, 0], velocity[:, 5] = SPEED, TURN
    return {"time": time, "pose": pose, "velocity": velocity}


def devices() -> list[bathyal.Sensor]:
    return [
        bathyal.Sensor("imu", rate=50.0, noise=[1e-3] * 3 + [1e-2] * 3),
        bathyal.Sensor("dvl", rate=5.0, noise=0.01),
        bathyal.Sensor("compass", rate=2.0, noise=0.01),
        bathyal.Sensor("depth", rate=2.0, noise=0.05),
        bathyal.Sensor(
            "usbl", rate=0.2, noise=0.5, beacons=[[0, 0, 0]], latency=0.5, dropout=0.1,
            outlier_rate=0.1, outlier_size=100.0,
        ),
    ]  # fmt: skip


def make_filter(**changed: object) -> bathyal.NavigationFilter:
    options: dict[str, object] = {
        "initial_position": 1.0, "initial_attitude": 0.02, "initial_velocity": 0.1,
        "gyro_noise": 1e-3 / np.sqrt(50.0), "accel_noise": 1e-2 / np.sqrt(50.0), "lag": 2.0,
    }  # fmt: skip
    return bathyal.NavigationFilter(
        devices(), velocity=[SPEED, 0, 0], **(options | changed)  # type: ignore[arg-type]
    )  # fmt: skip


def test_a_run_stays_within_its_own_deviations() -> None:
    truth = circle(50.0, 120.0)
    readings = [sensor.simulate(**truth, seed=4) for sensor in devices()]
    navigation = make_filter(record=True)
    track = navigation.run(readings)
    assert np.allclose(track.time, truth["time"])
    error = track.position - truth["pose"][:, :3, 3]
    assert np.abs(error[-1]).max() < 1.0
    assert np.mean((error[1000:] / track.std[1000:, :3]) ** 2) < 3.0
    fixes = readings[-1]
    rows = np.searchsorted(truth["time"], fixes.time - 1e-9)
    outliers = (np.abs(fixes.values - truth["pose"][rows, :3, 3]) > 3.0).any(axis=1)
    assert outliers.sum() > 3
    assert np.array_equal(~track.accepted("usbl"), outliers)
    assert np.mean(track.nis("dvl")) == pytest.approx(3.0, abs=0.4)
    back = navigation.smooth()
    smoothed = back.position - truth["pose"][:, :3, 3]
    assert np.sqrt((smoothed**2).mean()) < 0.8 * np.sqrt((error**2).mean())
    assert (back.std[:, :3] <= track.std[:, :3] + 1e-9).all()


def test_a_restored_state_goes_on_to_the_same_bytes() -> None:
    truth = circle(50.0, 20.0)
    readings = [sensor.simulate(**truth, seed=4) for sensor in devices()]
    imu = readings[0]
    one, two = make_filter(), make_filter()
    one.run(readings)
    two.restore(one.to_bytes())
    for navigation in (one, two):
        navigation.predict(20.02, imu.values[-1, :3], imu.values[-1, 3:])
        navigation.update("usbl", 19.0, [27.0, 13.0, 0.0])
    assert one.to_bytes() == two.to_bytes()
    with pytest.raises(ValueError, match="state"):
        one.restore(b"nothing of it")


def test_readings_made_of_arrays() -> None:
    navigation = make_filter()
    imu, *_, usbl = devices()
    still = bathyal.SensorReadings(imu, [0.0, 0.5, 1.0], [[0, 0, 0, 0, 0, 9.81]] * 3)
    fixes = bathyal.SensorReadings(usbl, [0.5], [[0.7, 0.0, 0.0]], arrival=[0.9], valid=[True])
    track = navigation.run([still, fixes])
    assert len(track) == 3
    assert track.accepted("usbl").tolist() == [True]
    with pytest.raises(ValueError, match="values"):
        bathyal.SensorReadings(usbl, [0.5], [[0.7, 0.0]])
    with pytest.raises(ValueError, match="arrival"):
        bathyal.SensorReadings(usbl, [0.5], [[0.7, 0.0, 0.0]], arrival=[0.4])
    with pytest.raises(ValueError, match="device"):
        track.nis("sextant")


@pytest.mark.parametrize(
    ("wrong", "field"),
    [
        ({"gyro_noise": -1.0}, "gyro_noise"),
        ({"lag": np.nan}, "lag"),
        ({"gate": 1.5}, "gate"),
        ({"sextant": 1.0}, "sextant"),
        ({"initial_position": [1.0, 2.0]}, "initial_position"),
        ({"current_time": 0.0}, "current_time"),
        ({"pose": np.zeros((4, 4))}, "pose"),
    ],
)
def test_bad_options_are_refused(wrong: dict[str, object], field: str) -> None:
    with pytest.raises(ValueError, match=field):
        make_filter(**wrong)


def test_bad_readings_are_refused() -> None:
    navigation = make_filter()
    navigation.predict(1.0, [0, 0, 0], [0, 0, 9.81])
    with pytest.raises(ValueError, match="time"):
        navigation.predict(0.5, [0, 0, 0], [0, 0, 9.81])
    with pytest.raises(ValueError, match="force"):
        navigation.predict(2.0, [0, 0, 0], [0, 0, np.inf])
    with pytest.raises(ValueError, match="device"):
        navigation.update("sextant", 1.0, [1.0])
    with pytest.raises(ValueError, match="values"):
        navigation.update("depth", 1.0, [np.nan])
    with pytest.raises(ValueError, match="1 values"):
        navigation.update("depth", 1.0, [1.0, 2.0])
    with pytest.raises(ValueError, match="record"):
        navigation.smooth()
