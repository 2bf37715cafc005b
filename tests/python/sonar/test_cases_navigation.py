# SPDX-License-Identifier: BSD-3-Clause
"""Cases of what a vehicle reports: angles as a mariner reads them, and errors that can be added."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import bathyal
from tests.support.sea_cases import at, plate, world_of

UTM = np.array([621_000.0, 6_172_000.0, 0.0])


def mariner(place, heading, pitch, roll):
    """Heading clockwise from y, bow up, starboard down: x forward, y port, z up."""
    pose = at(*np.add(UTM, place))
    pose[:3, :3] = Rotation.from_euler("ZYX", [np.pi / 2 - heading, -pitch, roll]).as_matrix()
    return pose


def straight(seconds=200.0, speed=1.5):
    """To the east at constant speed."""
    ends = [mariner([x, 0, 10], np.pi / 2, 0, 0) for x in (0.0, speed * seconds)]
    return bathyal.Trajectory([0.0, seconds], np.stack(ends))


@pytest.mark.parametrize("suffix", ["xtf", "zarr"])
def test_attitude_as_a_mariner_reads_it(suffix, tmp_path):
    heading, pitch, roll = (
        np.radians([350, 10, 200, 330]),
        [0.1, -0.1, 0.05, 0],
        [0.05, 0, -0.1, 0.2],
    )
    poses = [mariner([2 * i, i, 10 + i], heading[i], pitch[i], roll[i]) for i in range(4)]
    world = world_of((plate((-300, -300), (300, 300)), at(*UTM)))
    world.water = bathyal.Water(surface=25.0)
    sonar = bathyal.sonars.side_scan().replace(ping_rate=1.0, samples=100, rays_along_fan=100)
    record = sonar.survey(world, bathyal.Trajectory(np.arange(4.0), np.stack(poses)))
    path = tmp_path / f"survey.{suffix}"
    record.write(path)
    for found in (record, bathyal.read_sonar(path)):
        told = found.navigation
        assert np.mod(told.heading, 2 * np.pi) == pytest.approx(heading, abs=1e-5)
        assert told.pitch == pytest.approx(pitch, abs=1e-6)
        assert told.roll == pytest.approx(roll, abs=1e-6)
        assert told.depth == pytest.approx(25 - 10 - np.arange(4), abs=1e-5)
        assert told.position[:, 0] == pytest.approx(UTM[0] + 2 * np.arange(4), abs=1e-3)
        assert told.position[:, 1] == pytest.approx(UTM[1] + np.arange(4), abs=1e-3)
        assert told.speed == pytest.approx(np.full(4, np.sqrt(5)), rel=0.2)


def test_biases_add_up():
    """A log of 1 % and a compass of 2° put a straight track of 300 m where plane geometry says."""
    errors = bathyal.NavigationErrors(
        speed_scale=0.01, heading_bias=np.radians(2.0), pitch_bias=0.03, roll_bias=-0.02,
        depth_bias=0.4, altitude_bias=-0.3,
    )  # fmt: skip
    time = np.linspace(0, 200, 201)
    told = errors.report(straight(), time, surface=25.0)
    way = 1.01 * 1.5 * time
    assert told.position[:, 0] - UTM[0] == pytest.approx(way * np.cos(np.radians(2.0)), abs=1e-3)
    assert told.position[:, 1] - UTM[1] == pytest.approx(-way * np.sin(np.radians(2.0)), abs=1e-3)
    assert told.heading == pytest.approx(np.full(201, np.radians(92.0)), abs=1e-9)
    assert told.pitch == pytest.approx(np.full(201, 0.03), abs=1e-9)
    assert told.roll == pytest.approx(np.full(201, -0.02), abs=1e-9)
    assert told.depth == pytest.approx(np.full(201, 15.4), abs=1e-9)
    assert errors.report_altitude([10.0, np.nan, 3.0])[[0, 2]] == pytest.approx([9.7, 2.7])
    assert np.isnan(errors.report_altitude([10.0, np.nan, 3.0])[1])


def test_a_late_report_is_of_an_earlier_place():
    time = np.linspace(10, 190, 181)
    late = bathyal.NavigationErrors(latency=2.5).report(straight(), time)
    assert late.position[:, 0] - UTM[0] == pytest.approx(1.5 * (time - 2.5), abs=1e-6)


def test_a_walk_grows_with_the_root_of_time():
    """σ = w √t in x and in y, over 400 seeds."""
    errors = bathyal.NavigationErrors(position_walk=0.2)
    time = np.linspace(0, 200, 101)
    off = np.array(
        [errors.report(straight(), time, seed=seed).position[:, :2] for seed in range(400)]
    )
    off = off - errors.replace(position_walk=0.0).report(straight(), time).position[:, :2]
    for k in (20, 50, 100):
        assert off[:, k].std(axis=0) == pytest.approx(0.2 * np.sqrt(2.0 * k) * np.ones(2), rel=0.12)
    assert abs(np.corrcoef(off[:, 100].T)[0, 1]) < 0.2


def test_fixes_end_a_drift():
    """A log 10 % wrong between fixes every 20 s drifts 3 m at most; without them 30 m."""
    free = bathyal.NavigationErrors(speed_scale=0.1)
    time = np.linspace(0, 200, 401)
    true = 1.5 * time
    for errors, low, high in ((free, 29.9, 30.1), (free.replace(fix_interval=20.0), 2.5, 3.2)):
        off = errors.report(straight(), time).position[:, 0] - UTM[0] - true
        assert low < np.abs(off).max() < high
