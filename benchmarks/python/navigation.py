# SPDX-License-Identifier: BSD-3-Clause
"""The navigation filter and smoother against truths that they do not see.

    python -m benchmarks.python.navigation

Consistency: a motion by formulas, its derivatives by differences; the project's sensors measure it;
the filter starts as wrong as it says. The mean normalised square of its 15 errors after 40 s over
100 seeds is between 13.95 and 16.09 with 95 % probability if its covariance is right.

Logs: positions of AUV trials (shared/data/auvlogs), one a minute and the last as fixes; rms over
all rows, with one set of options for the three.
"""

from __future__ import annotations

import time as clock
import warnings
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import bathyal

Array = NDArray[np.float64]
LOGS = Path(__file__).parents[2] / "../shared/data/auvlogs"
RATE, END, SEEDS = 50.0, 40.0, 100
GYRO, ACCEL, GYRO_BIAS, ACCEL_BIAS = 2e-4, 2e-3, 1e-4, 5e-3
GYRO_WALK, ACCEL_WALK = 1e-6, 1e-5
STEP = 1e-4  # of the differences [s]
GRAVITY = 9.81


def position(t: Array) -> Array:
    return np.column_stack([1.2 * t + 2 * np.sin(0.11 * t), 15 * np.sin(0.05 * t),
                            -20 + 3 * np.cos(0.07 * t)])  # fmt: skip


def rotation(t: Array) -> Array:
    """(N, 3, 3) world_from_vehicle."""
    angles = [0.1 * np.sin(0.5 * t), 0.15 * np.sin(0.31 * t), 0.8 * np.sin(0.06 * t) + 0.02 * t]
    (cr, cp, cy), (sr, sp, sy) = np.cos(angles), np.sin(angles)
    rows = [[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr]]  # fmt: skip
    return np.moveaxis(np.array(rows), 2, 0)


def velocity(t: Array) -> Array:
    """(N, 6) in the vehicle."""
    turn = rotation(t)
    linear = (position(t + STEP) - position(t - STEP)) / (2 * STEP)
    spin = np.einsum("nji,njk->nik", turn, rotation(t + STEP) - rotation(t - STEP)) / (2 * STEP)
    return np.column_stack([np.einsum("nji,nj->ni", turn, linear),
                            spin[:, 2, 1], spin[:, 0, 2], spin[:, 1, 0]])  # fmt: skip


def imu(noise: float) -> bathyal.Sensor:
    """The same drifts and biases with any noise: they are drawn by the sensor's name."""
    return bathyal.Sensor(
        "imu", rate=RATE, noise=[noise * GYRO * RATE**0.5] * 3 + [noise * ACCEL * RATE**0.5] * 3,
        bias=[GYRO_BIAS] * 3 + [ACCEL_BIAS] * 3, walk=[GYRO_WALK] * 3 + [ACCEL_WALK] * 3,
    )  # fmt: skip


def devices() -> list[bathyal.Sensor]:
    lever = np.eye(4)
    lever[:3, 3] = 0.4, 0.0, -0.2
    return [
        imu(1.0),
        bathyal.Sensor("dvl", rate=5.0, noise=0.01, vehicle_from_sensor=lever),
        bathyal.Sensor("depth", rate=5.0, noise=0.05),
        bathyal.Sensor("compass", rate=2.0, noise=[0.005, 0.005, 0.02]),
        bathyal.Sensor("usbl", rate=0.2, noise=[0.5, 0.5, 1.0], beacons=[[0, 0, 0]], latency=1.3),
    ]


def turned(vector: Array) -> Array:
    """exp of a rotation vector."""
    angle = np.linalg.norm(vector)
    x, y, z = vector / angle
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def one_run(seed: int, truth: dict[str, Array]) -> tuple[float, float, int]:
    """NEES of the 15 errors at the end, seconds of the filter, steps."""
    draw = np.random.default_rng(seed)
    sizes = {"initial_position": 1.0, "initial_velocity": 0.1, "initial_attitude": 0.02}
    start = np.array(truth["pose"][0])
    start[:3, 3] -= draw.normal(0, 1.0, 3)
    start[:3, :3] = turned(-draw.normal(0, 0.02, 3)) @ start[:3, :3]
    speed = truth["pose"][0, :3, :3] @ truth["velocity"][0, :3] - draw.normal(0, 0.1, 3)
    navigation = bathyal.NavigationFilter(
        devices(), pose=start, velocity=speed, lag=2.0, gyro_noise=GYRO, accel_noise=ACCEL,
        gyro_walk=GYRO_WALK, accel_walk=ACCEL_WALK, initial_gyro_bias=GYRO_BIAS,
        initial_accel_bias=ACCEL_BIAS, **sizes,
    )  # fmt: skip
    readings = [sensor.simulate(**truth, seed=seed) for sensor in devices()]
    begin = clock.perf_counter()
    navigation.run(readings, every=50)
    spent = clock.perf_counter() - begin
    still = {"time": truth["time"], "pose": np.tile(np.eye(4), (len(truth["time"]), 1, 1))}
    bias = imu(0.0).simulate(**still, gravity=0.0, seed=seed).values[-1]
    pose = truth["pose"][-1]
    off = pose[:3, :3] @ navigation.pose[:3, :3].T
    error = np.concatenate([
        pose[:3, 3] - navigation.position,
        pose[:3, :3] @ truth["velocity"][-1, :3] - navigation.velocity,
        [off[2, 1], off[0, 2], off[1, 0]],
        bias[:3] - navigation.gyro_bias, bias[3:] - navigation.accel_bias,
    ])  # fmt: skip
    covariance = np.asarray(navigation.covariance)[:15, :15]
    return float(error @ np.linalg.solve(covariance, error)), spent, len(readings[0])


def consistency() -> None:
    time = np.arange(round(RATE * END) + 1) / RATE
    pose = np.tile(np.eye(4), (len(time), 1, 1))
    pose[:, :3, :3], pose[:, :3, 3] = rotation(time), position(time)
    change = (velocity(time + STEP) - velocity(time - STEP)) / (2 * STEP)
    truth = {"time": time, "pose": pose, "velocity": velocity(time), "acceleration": change}
    runs = [one_run(seed, truth) for seed in range(SEEDS)]
    mean = float(np.mean([nees for nees, _, _ in runs]))
    assert 13.95 <= mean <= 16.09, mean
    spent = sum(seconds for _, seconds, _ in runs) / sum(steps for _, _, steps in runs)
    print(f"Mean NEES of 15 errors over {SEEDS} seeds, fixes 1.3 s late: **{mean:.2f}** (95 %: "
          f"13.95 to 16.09). {1e6 * spent:.1f} µs a sample of the imu, readings and late fixes "
          f"included: {1 / (spent * RATE):.0f} × real time at {RATE:.0f} Hz.\n")  # fmt: skip


def rms(error: Array) -> float:
    return float(np.sqrt((error**2).sum(axis=1).mean()))


def logs() -> None:
    print("| log | rows | straight line | dead reckoning, bridged | smoothed | goal |")
    print("|---|---|---|---|---|---|")
    goals = {"20220719_6_1": 1.0, "20230517_0_0": 1.5, "20220712_0_1": 1.3}
    for name, goal in goals.items():
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", bathyal.NavigationLogWarning)
            log = bathyal.read_navigation_log(LOGS / f"{name}.csv")
        time, truth = log.time, log.position
        rows = [*np.searchsorted(time, np.arange(0.0, time[-1], 60.0) - 1e-9), len(time) - 1]
        off = truth - log.dead_reckon()
        line, bridge = (
            rms(a - np.column_stack([np.interp(time, time[rows], a[rows, i]) for i in (0, 1)]))
            for a in (truth, off)
        )
        smoothed = rms(log.smooth(time[rows], truth[rows]).fix_point[:, :2] - truth)
        assert smoothed <= goal, (name, smoothed)
        print(f"| {name} | {len(time)} | {line:.1f} m | {bridge:.2f} m | **{smoothed:.2f} m** "
              f"| {goal} m |")  # fmt: skip


def main() -> None:
    print("## Navigation filter and smoother\n")
    print("`python -m benchmarks.python.navigation`: the first figure by sensors of its own on a "
          "motion by formulas; the table by logs of AUV trials, their position given once a minute "
          "and at the end, rms over all rows.\n")  # fmt: skip
    consistency()
    logs()


if __name__ == "__main__":
    main()
