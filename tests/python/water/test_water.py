# SPDX-License-Identifier: BSD-3-Clause
"""The water of a world: fields, profiles, current, waves, tide."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import bathyal

CAST = bathyal.Profile([0, 20, 60], temperature=[18, 14, 9], salinity=[34, 34.5, 35])


def test_uniform_water():
    water = bathyal.Water()
    assert water.surface is None
    assert water.sound_speed(12.0) == bathyal.sound_speed(10, 35, 50)
    assert water.absorption(100e3, [0, 5]).tolist() == [bathyal.absorption(100e3, 10, 35, 50)] * 2
    assert water.density(0.0) == bathyal.seawater_density(10, 35, bathyal.pressure_from_depth(50))
    assert water.covers(1e4)
    assert water.depth(3.0) == water.reference_depth == 50
    assert bathyal.Water(sound_speed=1500).sound_speed(0.0) == 1500
    assert not water.current([1, 2, 3]).any()


def test_a_profile_by_depth():
    water = bathyal.Water(CAST, surface=2.0)
    assert water.temperature(depth=[0, 10, 40, 90]).tolist() == [18, 16, 11.5, 9]
    assert water.temperature(2.0) == 18
    assert water.sound_speed(depth=20) == bathyal.sound_speed(14, 34.5, 20)
    assert water.deepest == 60
    assert water.covers(60)
    assert not water.covers(61)
    assert water.profiles[0].sound_speed is not None
    with pytest.raises(ValueError, match="at or below the surface at 2 m, got 3 m"):
        water.sound_speed(3.0)


def test_a_measured_sound_speed_counts_before_the_formula():
    cast = bathyal.Profile([0, 50], sound_speed=[1500.0, 1480.0])
    water = bathyal.Water(cast, surface=0, temperature=8, salinity=33)
    assert water.sound_speed(-25.0) == 1490
    assert water.temperature(-25.0) == 8
    assert water.salinity(-25.0) == 33


@pytest.mark.filterwarnings("ignore::bathyal.RangeWarning")
def test_profiles_in_time_and_formulas():
    later = bathyal.Profile([0, 60], temperature=[22, 9], salinity=[34, 35])
    water = bathyal.Water([CAST, later], surface=0, time=[0, 100], formula="chen_millero")
    assert water.temperature(0.0, 50) == 20
    assert water.temperature(0.0, [-5, 500]).tolist() == [18, 22]
    assert water.sound_speed(0.0, 0) == bathyal.sound_speed(18, 34, 0, formula="chen_millero")
    pytest.importorskip("gsw")
    assert bathyal.Water(CAST, surface=0, formula="teos10").sound_speed(0.0) == bathyal.sound_speed(
        18, 34, 0, formula="teos10"
    )


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda: bathyal.Profile([1], temperature=[1], salinity=[1]), "two rows.*got 1 row"),
        (lambda: bathyal.Profile([5, 1], sound_speed=[1500, 1500]), "rising depths.*cleaned"),
        (lambda: bathyal.Profile([1, 1], sound_speed=[1500, 1500]), "rising depths"),
        (lambda: bathyal.Profile([1, np.nan], sound_speed=[1500, 1500]), "depth nan in row 1"),
        (lambda: bathyal.Profile([0, 1], sound_speed=[1500, np.nan]), "sound_speed nan in row 1"),
        (lambda: bathyal.Profile([0, 1], sound_speed=[1500, 15]), "sound_speed 15 in row 1"),
        (lambda: bathyal.Profile([-1, 1], sound_speed=[1500, 1500]), "depth -1 in row 0"),
        (lambda: bathyal.Profile([0, 1], temperature=[1, 2]), "no salinity"),
        (lambda: bathyal.Profile([0, 1]), "no temperature"),
        (lambda: "cast.csv", "a Profile"),
        (lambda: [[0, 1500], [1, 1500]], "a Profile"),
        (lambda: [CAST, CAST], "a time for each of 2 profiles"),
    ],
)
def test_bad_profiles(make, says):
    with pytest.raises(ValueError, match=says):
        bathyal.Water(make(), surface=0)


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"surface": np.nan}, "surface"),
        ({"temperature": 400}, "temperature"),
        ({"salinity": -1}, "salinity"),
        ({"sound_speed": 0}, "sound_speed"),
        ({"ph": np.nan}, "ph"),
        ({"latitude": 100}, "latitude"),
        ({"reference_depth": -1}, "reference_depth"),
        ({"waves": bathyal.Waves()}, "surface"),
        ({"tide": bathyal.Tide([("M2", (1, 0))])}, "surface"),
        ({"current": [1, 2, 3]}, "horizontal"),
        ({"current": [[1, 2]]}, "shape"),
        ({"current": [np.nan, 0]}, "current"),
        ({"formula": "medwin"}, "mackenzie"),
    ],
)
def test_bad_options(options, says):
    with pytest.raises(ValueError, match=says):
        bathyal.Water(**options)


def test_bad_profiles_and_columns():
    with pytest.raises(ValueError, match="`salinity`: expected 2 values, one a depth, got 1"):
        bathyal.Profile([0, 1], salinity=[3])
    with pytest.raises(ValueError, match="at least one depth"):
        bathyal.Profile([])
    with pytest.raises(ValueError, match="NaN where none was measured, got sound_speed inf"):
        bathyal.Profile([0], sound_speed=[np.inf])
    with pytest.raises(ValueError, match="latitude"):
        bathyal.Profile([0], position=(91, 0))
    with pytest.raises(ValueError, match="one of z and depth="):
        bathyal.Water().sound_speed()
    with pytest.raises(ValueError, match="`z`"):
        bathyal.Water().sound_speed(np.nan)


def test_profiles_travel():
    cast = bathyal.Profile([0, 1], sound_speed=[1500, np.nan], position=(43.1, -70.7), time=5.0)
    same = pickle.loads(pickle.dumps(cast))
    assert same.position == (43.1, -70.7)
    assert same.temperature is None
    np.testing.assert_array_equal(same.sound_speed, [1500, np.nan])
    assert repr(same) == "Profile(2 rows, to 1 m)"


def test_cleaned_in_layers():
    depth = np.r_[np.linspace(0, 10, 101), np.linspace(10, 0, 50)]
    cast = bathyal.Profile(depth, sound_speed=1500 + depth)
    assert len(cast.cleaned()) == 101
    layers = cast.cleaned(step=1.0)
    assert len(layers) == 11
    assert layers.sound_speed == pytest.approx(1500 + layers.depth)


def test_current_waves_and_tide_together():
    waves = bathyal.Waves.regular(1.0, 8.0, direction=np.pi / 2)
    water = bathyal.Water(
        surface=10.0,
        current=bathyal.Current([0, 10], [[1, 0], [0, 0]]),
        waves=waves,
        tide=bathyal.Tide.from_table([0, 100], [0, 1]),
    )
    assert water.surface_height(0, 0, 0) == 10.5
    assert water.surface_height(0, [0, 0], [0, 100]).shape == (2,)
    assert water.current([[0, 0, 10.0], [0, 0, 5.0]], 0).tolist() == [[1, 0, 0], [0.5, 0, 0]]
    crest = water.velocity([0, 0, 10.5], 0)
    assert crest == pytest.approx([1, 0.5 * 2 * np.pi / 8, 0])
    step = 1e-4
    point = np.array([3.0, 2.0, 6.0])
    slope = (waves.velocity(point - [0, 0, 10], 2 + step) - waves.velocity(
        point - [0, 0, 10], 2 - step)) / (2 * step)  # fmt: skip
    assert waves.acceleration(point - [0, 0, 10], 2.0) == pytest.approx(slope, rel=1e-5, abs=1e-7)


def test_waves_of_components():
    waves = bathyal.Waves.of_components([1.0, 0.5], [8.0, 5.0], phase=[0.0, np.pi])
    assert waves.elevation(0, 0, 0) == pytest.approx(0.5)
    assert waves.amplitude.tolist() == [1.0, 0.5]
    assert waves.frequency == pytest.approx(2 * np.pi / np.array([8.0, 5.0]))
    assert waves.wave_number[:, 0] == pytest.approx(waves.frequency**2 / 9.80665)
    with pytest.raises(ValueError, match="period"):
        bathyal.Waves.of_components(1.0, 0.0)
