# SPDX-License-Identifier: BSD-3-Clause
"""Water and its parts that are pickled answer to the last bit as before."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import bathyal

CAST = bathyal.Profile(
    [0, 15, 30, 80], temperature=[18, 17, 11, 9], salinity=[34.8, 34.8, 35.1, 35.2]
)
WAVES = bathyal.Waves(height=1.3, period=6, direction=0.4, depth=60, seed=5, components=30)
SHEAR = bathyal.Current([0, 20], [[[0.4, 0.1], [0.1, 0]], [[0.6, 0], [0, 0.2]]], time=[0, 3600])
TIDES = {
    "constituents": bathyal.Tide([("M2", (1.2, 0.3)), ("K1", (0.4, 2.0))]),
    "table": bathyal.Tide.from_table([0, 3600, 9000], [0.1, 0.8, -0.4]),
}
TIMES = np.linspace(-500, 20000, 40)


def back(value):
    again = pickle.loads(pickle.dumps(value))
    assert pickle.dumps(again) == pickle.dumps(value)
    assert repr(again) == repr(value)
    return again


@pytest.mark.parametrize("kind", TIDES)
def test_tides(kind):
    np.testing.assert_array_equal(back(TIDES[kind]).height(TIMES), TIDES[kind].height(TIMES))


def test_currents():
    depths = np.linspace(0, 30, 40)
    for current in (SHEAR, bathyal.Current.uniform(0.3, -0.2)):
        np.testing.assert_array_equal(back(current).at(depths, TIMES), current.at(depths, TIMES))
    np.testing.assert_array_equal(SHEAR.at(0, 1800), [0.5, 0.05])


def test_waves():
    for waves in (WAVES, bathyal.Waves.regular(2.0, 9.0, depth=40.0), bathyal.Water().waves):
        again = back(waves)
        assert again.depth == waves.depth
        point = [[3.0, 2.0, -4.0]] * 40
        np.testing.assert_array_equal(again.velocity(point, TIMES), waves.velocity(point, TIMES))
        np.testing.assert_array_equal(again.wave_number, waves.wave_number)


@pytest.mark.parametrize(
    "water",
    [
        bathyal.Water(),
        bathyal.Water(sound_speed=1483.0, ph=7.8, reference_depth=20),
        bathyal.Water(formula="del_grosso", temperature=4, latitude=-33.5),
        bathyal.Water(
            [CAST, CAST.with_sound_speed(formula="chen_millero")],
            time=[0, 7200],
            surface=1.5,
            waves=WAVES,
            tide=TIDES["table"],
            current=SHEAR,
        ),
    ],
    ids=["plain", "speed", "formula", "all"],
)
def test_waters(water):
    again = back(water)
    z = np.linspace(-70, -2, 40)
    for field in ("sound_speed", "temperature", "salinity", "density"):
        np.testing.assert_array_equal(
            getattr(again, field)(z, TIMES), getattr(water, field)(z, TIMES)
        )
    np.testing.assert_array_equal(again.pressure(z), water.pressure(z))
    np.testing.assert_array_equal(again.absorption(4e5, z, TIMES), water.absorption(4e5, z, TIMES))
    points = np.column_stack([TIMES, z, z])
    np.testing.assert_array_equal(again.velocity(points, TIMES), water.velocity(points, TIMES))
    assert again.surface == water.surface
    if water.surface is not None:
        np.testing.assert_array_equal(
            again.surface_height(1.0, 2.0, TIMES), water.surface_height(1.0, 2.0, TIMES)
        )
