# SPDX-License-Identifier: BSD-3-Clause
"""What a vehicle reports, in Python and in a survey's record."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import bathyal
from bathyal.sonar.tracks import poses_of
from tests.support import seas

FIELDS = list(bathyal.NavigationErrors().to_dict())


def test_errors_are_their_fields() -> None:
    errors = bathyal.NavigationErrors(speed_scale=0.01, latency=0.1)
    assert errors.to_dict()["speed_scale"] == errors.speed_scale == 0.01
    assert errors.replace(latency=0.0) == bathyal.NavigationErrors(speed_scale=0.01)
    assert errors != bathyal.NavigationErrors()
    assert errors != "errors"
    assert hash(errors) == hash(bathyal.NavigationErrors(speed_scale=0.01, latency=0.1))
    assert pickle.loads(pickle.dumps(errors)) == errors
    assert repr(errors) == "NavigationErrors(speed_scale=0.01, latency=0.1)"
    assert repr(bathyal.NavigationErrors()) == "NavigationErrors()"
    assert all(value == 0.0 for value in bathyal.NavigationErrors().to_dict().values())


@pytest.mark.parametrize("name", FIELDS)
@pytest.mark.parametrize("value", [np.nan, np.inf, -1e9, "much", None])
def test_a_wrong_field_is_refused_by_name(name: str, value) -> None:
    if name in {"depth_bias", "altitude_bias"} and value == -1e9:
        value = -np.inf
    with pytest.raises((ValueError, TypeError), match=name):
        bathyal.NavigationErrors(**{name: value})


def test_an_unknown_field_or_class_is_refused() -> None:
    with pytest.raises(ValueError, match="`drift`: expected a field of NavigationErrors"):
        bathyal.NavigationErrors(drift=1.0)
    with pytest.raises(ValueError, match="`name`: expected"):
        bathyal.NavigationErrors.preset("perfect")
    with pytest.raises(ValueError, match="`time`: expected times that rise"):
        bathyal.NavigationErrors().report(seas.line(4.0), [1.0, 0.0])


def test_reported_angles_are_those_that_make_the_pose() -> None:
    rng = np.random.default_rng(5)
    heading, pitch, roll = rng.uniform(0, 6, 30), rng.uniform(-1, 1, 30), rng.uniform(-2, 2, 30)
    place = rng.normal(size=(30, 3))
    time = np.arange(30.0)
    track = bathyal.Trajectory(time, poses_of(place, heading, pitch, roll))
    got = bathyal.NavigationErrors().report(track, time, surface=3.0)
    assert np.allclose(got.heading, heading)
    assert np.allclose(got.pitch, pitch)
    assert np.allclose(got.roll, roll)
    assert np.array_equal(got.position, place)
    assert np.allclose(got.depth, 3.0 - place[:, 2])


def test_a_record_holds_what_is_reported_and_the_truth() -> None:
    errors = bathyal.NavigationErrors(
        heading_bias=0.1, speed_scale=0.02, altitude_bias=0.5, altitude_noise=0.1, depth_noise=0.2,
        latency=0.25,
    )  # fmt: skip
    world = seas.flat_world()
    world.water = bathyal.Water(surface=40.0)
    track = seas.line(20.0)
    sonar = seas.small_side_scan(ping_rate=4.0)
    record = sonar.survey(world, track, seed=5, truth=True, navigation=errors)
    reported = errors.report(track, record.time, surface=40.0, seed=5)
    for name in ("position", "heading", "pitch", "roll", "depth", "speed"):
        assert np.array_equal(getattr(record.navigation, name), getattr(reported, name))
    expected = errors.report_altitude(np.full(len(record), 10.0), seed=5)
    assert np.allclose(record.navigation.altitude, expected)
    assert np.allclose(record.truth.pose[:, 0, 3], 2.0 * record.time)
    off = record.navigation.position[-1, :2] - [19.5, 0.0]
    assert off == pytest.approx([19.5 * (1.02 * np.cos(0.1) - 1), -19.5 * 1.02 * np.sin(0.1)])
    plain = sonar.survey(world, track, seed=5)
    assert np.array_equal(plain.intensity, record.intensity)  # the sonar hears where it is
    assert np.array_equal(plain.navigation.position, record.truth.pose[:, :3, 3])
    assert np.allclose(plain.navigation.depth, 30.0)


def test_altitudes_that_are_not_there_stay_so() -> None:
    errors = bathyal.NavigationErrors(altitude_noise=1.0)
    got = errors.report_altitude([np.nan, 5.0], seed=1)
    assert np.isnan(got[0])
    assert np.isfinite(got[1])
    assert got[1] == errors.report_altitude([5.0], first=1, seed=1)[0]
