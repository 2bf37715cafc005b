# SPDX-License-Identifier: BSD-3-Clause
"""Surveys, their records, the description of a sonar in Python, tracks."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import bathyal
from bathyal._core import Sonar
from tests.support import seas

ALL = bathyal.sonars.__all__


@pytest.mark.parametrize("name", ALL)
@pytest.mark.parametrize("physics", ["off", "real"])
def test_a_sonar_is_its_description(name: str, physics: str) -> None:
    sonar = getattr(bathyal.sonars, name)(physics=physics)
    assert Sonar.from_dict(sonar.to_dict()) == sonar
    assert pickle.loads(pickle.dumps(sonar)) == sonar
    assert sonar.replace(range=12.0) != sonar
    assert sonar.replace(range=12.0).range == 12.0
    assert len(sonar.beam_names) == sonar.beams
    assert sonar.spreading == (physics == "real")


@pytest.mark.parametrize(
    ("field", "value", "message"),
    [
        ("frequency", 0.0, "`frequency`: expected"),
        ("frequency", np.nan, "`frequency`: expected"),
        ("frequency", "high", "`frequency`: expected a number, got 'high'"),
        ("range", -1.0, "`range`: expected"),
        ("samples", 0, "`samples`: expected"),
        ("samples", 10.5, "`samples`: expected a whole number"),
        ("beams", 0, "`beams`: expected"),
        ("beams", 10**6, "`beams`: expected"),
        ("spreading", 1, "`spreading`: expected True or False"),
        ("absorption", "thorp", "`absorption`: expected"),
        ("rays_along_fan", 10**7, "`rays_along_fan`: expected"),
        ("depth", 3.0, "`depth`: expected a field of a sonar"),
        ("vehicle_from_sonar", np.full((4, 4), np.nan), "`vehicle_from_sonar`: expected"),
    ],
)
def test_a_wrong_field_is_refused_by_name(field: str, value, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        bathyal.sonars.side_scan().replace(**{field: value})


def test_a_survey_is_its_pings() -> None:
    world = seas.flat_world()
    sonar = seas.small_side_scan(speckle=True, noise=True, ping_rate=4.0)
    track = seas.line(5.0)
    record = sonar.survey(world, track, seed=3, truth=True)
    assert record.intensity.shape == (11, 2, 400)
    assert np.allclose(np.diff(record.time), 0.25)
    for k in (0, 4, 10):
        ping = sonar.ping(world, track.at(record.time[k]), time=record.time[k], seed=3, ping=k)
        assert np.array_equal(record.intensity[k], ping.intensity.astype(np.float32))
        assert np.array_equal(record.truth.range[k], ping.truth.range, equal_nan=True)
        assert np.array_equal(record.truth.pose[k], track.at(record.time[k]))
    assert np.allclose(record.navigation.altitude, 10.0)
    assert np.allclose(np.degrees(record.navigation.heading), 90.0)
    assert np.allclose(record.navigation.speed, 2.0)
    again = sonar.survey(world, track, seed=3, num_threads=1)
    assert np.array_equal(again.intensity, record.intensity)
    assert not np.array_equal(sonar.survey(world, track, seed=4).intensity, record.intensity)


def test_parts_of_a_survey_join_to_the_whole() -> None:
    world = seas.flat_world()
    sonar = seas.small_side_scan(speckle="k", noise=True, dropout_rate=0.3)
    track = seas.line(4.0)
    heard = []
    for first, count in ((0, 7), (7, -1)):
        sonar.hear(
            world, track, lambda ping, k, pose: heard.append(ping.intensity) or True,
            seed=1, first=first, count=count,
        )  # fmt: skip
    whole = sonar.survey(world, track, seed=1)
    assert np.array_equal(np.array(heard, np.float32), whole.intensity)
    dropped = (whole.intensity == 0).all(axis=(1, 2)).mean()
    assert 0.05 < dropped < 0.7


def test_a_survey_ends_where_its_progress_says_so() -> None:
    record = seas.small_side_scan().survey(
        seas.flat_world(), seas.line(4.0), progress=lambda done, total: done < 5
    )
    assert len(record) == 5


def test_a_survey_below_the_bottom_names_its_ping() -> None:
    track = bathyal.Trajectory([0, 1], np.stack([seas.at(z=1.0), seas.at(z=-1.0)]))
    with pytest.raises(ValueError, match=r"ping \d+ at .* s: `world_from_vehicle`"):
        seas.small_side_scan().survey(seas.flat_world(), track)


def test_a_record_is_written_as_xtf_and_read_again(tmp_path) -> None:
    sonar = seas.small_side_scan(spreading=True, speckle=True)
    record = sonar.survey(seas.flat_world(), seas.line(60.0), seed=2)
    assert len(record) > 255
    record.write(tmp_path / "survey.xtf")
    read = bathyal.read_sonar(tmp_path / "survey.xtf")
    amplitude, found = np.sqrt(record.intensity), np.sqrt(read.intensity)
    assert found.shape == amplitude.shape
    assert np.abs(found - amplitude).max() <= 0.51 * amplitude.max() / 65535
    assert np.allclose(read.range, record.range)
    assert np.allclose(read.navigation.position[:, :2], record.navigation.position[:, :2])
    assert np.allclose(read.navigation.heading, record.navigation.heading, atol=1e-6)
    assert np.allclose(read.navigation.altitude, 10.0)
    with pytest.raises(ValueError, match="`path`: expected"):
        record.write(tmp_path / "survey.txt")
    multibeam = bathyal.sonars.multibeam().replace(beams=4, samples=50)
    with pytest.raises(ValueError, match="side-scan"):
        multibeam.survey(seas.flat_world(), seas.line(1.0)).write(tmp_path / "multibeam.xtf")


def test_a_track_turns_as_a_mariner_says(tmp_path) -> None:
    path = tmp_path / "track.csv"
    path.write_text("time,x,y,z,heading_deg,pitch_deg,roll_deg\n0,1,2,-3,0,10,5\n2,1,6,-3,90,0,0\n")
    track = bathyal.read_track(path)
    pose = track.at(0.0)
    assert np.allclose(pose[:3, 3], [1, 2, -3])
    assert pose[1, 0] > 0.9  # the bow to north
    assert pose[2, 0] == pytest.approx(np.sin(np.radians(10)))  # and up
    assert pose[2, 1] > 0  # port up: starboard down
    assert np.allclose(track.at(2.0)[:3, :3], np.eye(3), atol=1e-12)  # the bow to east
    path.write_text("x,y,z\n0,0,-5\n6,8,-5\n")
    track = bathyal.read_track(path, speed=2.0)
    assert track.time[-1] == pytest.approx(5.0)
    assert np.allclose(track.at(0.0)[:2, 0], [0.6, 0.8])


@pytest.mark.parametrize(
    ("text", "speed", "message"),
    [
        ("x,y\n1,2\n", 1.0, "expected the columns x, y, z, without z"),
        ("x,y,z\n1,2,3\n", 1.0, "two rows or more"),
        ("x,y,z\n1,2,3\n1,a,3\n", 1.0, "3: y: no number: 'a'"),
        ("x,y,z\n1,2,3\n1,2,4\n", None, "`speed`: expected"),
        ("time,x,y,z\n0,1,2,3\n1,1,2,4\n", 1.0, "`speed`: expected"),
        ("x,y,z\n1,2,3\n1,2,4\n", -1.0, "`speed`: expected"),
    ],
)
def test_a_broken_track_is_refused(text: str, speed, message: str, tmp_path) -> None:
    path = tmp_path / "track.csv"
    path.write_text(text)
    with pytest.raises((ValueError, bathyal.Error), match=message):
        bathyal.read_track(path, speed=speed)


def test_a_ping_without_truth() -> None:
    world = bathyal.World()
    corners = [[-99, -99, 0], [99, -99, 0], [99, 99, 0], [-99, 99, 0]]
    world.add(bathyal.TriangleMesh(corners, [[0, 1, 2], [0, 2, 3]]), material="sand")
    pose = np.eye(4)
    pose[2, 3] = 10.0
    sonar = bathyal.sonars.multibeam(physics="real").replace(beams=16, samples=500)
    ping = sonar.ping(world, pose, truth=False)
    assert np.array_equal(ping.intensity, sonar.ping(world, pose).intensity)
    with pytest.raises(ValueError, match="`truth`: expected a ping heard with truth=True"):
        _ = ping.truth
