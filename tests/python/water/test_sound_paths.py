# SPDX-License-Identifier: BSD-3-Clause
"""Paths of sound from Python: traced soundings, the smile of an uncorrected survey, eigenrays."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import bathyal

THERMOCLINE = bathyal.Profile([0, 15, 30, 80], sound_speed=[1520.0, 1518.0, 1495.0, 1490.0])


def test_straight_in_uniform_water():
    found = bathyal.trace_sound(
        bathyal.Water(sound_speed=1500), [0.2, np.pi / 2, np.pi / 4], 0.02, 5.0
    )
    across, depth = found
    assert across == pytest.approx(30 * np.cos([0.2, np.pi / 2, np.pi / 4]), abs=1e-12)
    assert depth == pytest.approx(5 + 30 * np.sin([0.2, np.pi / 2, np.pi / 4]))


def test_against_an_integration_of_the_ray_equations():
    speed = lambda z: np.interp(z, THERMOCLINE.depth, THERMOCLINE.sound_speed)  # noqa: E731
    rows, values = THERMOCLINE.depth, THERMOCLINE.sound_speed
    slope = np.diff(values) / np.diff(rows)

    def rate(_, y):
        layer = int(np.clip(np.searchsorted(rows, y[1], "right") - 1, 0, 2))
        c = speed(y[1])
        return [c * np.cos(y[2]), c * np.sin(y[2]), -slope[layer] * np.cos(y[2])]

    for angle in (0.15, 0.5, 1.2):
        end = solve_ivp(rate, (0, 0.04), [0, 3.0, angle], rtol=1e-11, atol=1e-11, max_step=1e-4)
        found = bathyal.trace_sound(THERMOCLINE, angle, 0.04, 3.0)
        assert (found.across, found.depth, found.angle) == pytest.approx(
            tuple(end.y[:, -1]), abs=2e-4
        )


def test_soundings_of_a_flat_bottom_come_back_flat():
    """Eigenrays give the times; traced with the profile they are flat, without it they smile."""
    bottom, sonar = 60.0, 2.0
    across = np.linspace(5, 100, 12)
    rays = [bathyal.eigenrays(THERMOCLINE, sonar, bottom, x)[0] for x in across]
    launch = [ray.launch for ray in rays]
    time = [ray.time for ray in rays]
    found = bathyal.trace_sound(THERMOCLINE, launch, time, sonar)
    assert found.depth == pytest.approx(np.full(12, bottom), abs=1e-5)
    assert found.across == pytest.approx(across, abs=1e-5)
    surface_speed = bathyal.Water(sound_speed=float(np.interp(sonar, *_columns())))
    naive = bathyal.trace_sound(surface_speed, launch, time, sonar)
    error = naive.depth - bottom
    # Less speed below the sonar bends the beams down: the outer ones come out too shallow.
    assert (np.diff(error) < 0).all()
    assert error[-1] < -1.0


def _columns():
    return THERMOCLINE.depth, THERMOCLINE.sound_speed


def test_paths_and_chords():
    path = bathyal.SoundPath(THERMOCLINE, 3.0, 0.3, max_time=0.1)
    assert path.end == "time"
    assert path.duration == 0.1
    assert path.depth[1:-1].tolist() == [15, 30]
    for tolerance in (1.0, 1e-3):
        chords = path.chords(tolerance)
        assert path.at(chords[:, 0])[:, 1:] == pytest.approx(chords[:, 1:], abs=1e-9)
        middle = 0.5 * (chords[1:] + chords[:-1])
        exact = path.at(middle[:, 0])
        assert np.hypot(*(exact - middle)[:, 1:3].T).max() < 1.5 * tolerance
    up = bathyal.SoundPath(THERMOCLINE, 3.0, -0.3)
    assert up.end == "surface"
    assert bathyal.SoundPath(THERMOCLINE, 3.0, -0.3, surface_reflects=True).end == "time"


def test_beams_that_meet_the_surface_are_nan():
    found = bathyal.trace_sound(THERMOCLINE, [-0.5, 0.5], 0.05, 3.0)
    assert np.isnan(found.depth[0])
    assert np.isfinite(found.depth[1])


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: bathyal.trace_sound(THERMOCLINE, 2.0, 0.1, 3.0), "launch_angle"),
        (lambda: bathyal.trace_sound(THERMOCLINE, 0.1, -0.1, 3.0), "travel_time"),
        (lambda: bathyal.trace_sound(THERMOCLINE, 0.1, np.nan, 3.0), "travel_time"),
        (lambda: bathyal.trace_sound(THERMOCLINE, 0.1, 0.1, -3.0), "start_depth"),
        (lambda: bathyal.trace_sound([1500], 0.1, 0.1, 3.0), "a Water or a Profile"),
        (lambda: bathyal.eigenrays(THERMOCLINE, 3.0, 10.0, -1.0), "distance"),
        (lambda: bathyal.eigenrays(THERMOCLINE, 3.0, 10.0, 5.0, angles=1), "angles"),
        (lambda: bathyal.SoundPath(THERMOCLINE, 3.0, 0.1, max_time=0), "max_time"),
        (lambda: bathyal.SoundPath(THERMOCLINE, 3.0, 0.1).chords(0), "tolerance"),
    ],
)
def test_refusals(call, says):
    with pytest.raises(ValueError, match=says):
        call()
