# SPDX-License-Identifier: BSD-3-Clause
"""Cases of sound in water: circles, an integration of our own, printed formulas, gauges of time."""

from __future__ import annotations

import numpy as np
import pytest

import bathyal
from tests.support.sea_cases import at, plate, pointer, world_of


def integrated(depth, speed, start, angle, duration, surface=0.0):
    """(x, z, angle below the horizontal) after a time, by RK4 on the ray equations.

    dx/dt = c cos θ, dz/dt = c sin θ, dθ/dt = −cos θ dc/dz, in steps of 0.1 ms.
    None where it meets the surface.
    """

    def rate(state):
        z = state[1]
        c = np.interp(z, depth, speed)
        k = np.searchsorted(depth, z, side="right") - 1
        inside = 0 <= k < len(depth) - 1
        slope = (speed[k + 1] - speed[k]) / (depth[k + 1] - depth[k]) if inside else 0.0
        cos, sin = np.cos(state[2]), np.sin(state[2])
        return np.array([c * cos, c * sin, -cos * slope])

    state = np.array([0.0, start, angle])
    steps = int(np.ceil(duration / 1e-4))
    h = duration / steps
    for _ in range(steps):
        a = rate(state)
        b = rate(state + 0.5 * h * a)
        c = rate(state + 0.5 * h * b)
        d = rate(state + h * c)
        state = state + h / 6 * (a + 2 * b + 2 * c + d)
        if state[1] < surface:
            return None
    return state


def random_profile(seed):
    rng = np.random.default_rng(seed)
    depth = np.concatenate([[0.0], np.cumsum(rng.uniform(2, 25, 12))])
    speed = 1500 + np.cumsum(rng.normal(0, 3, len(depth)))
    return depth, speed


@pytest.mark.parametrize("gradient", [-0.09, -0.017, 0.017, 0.09])
@pytest.mark.parametrize("angle", [-0.2, 0.0, 0.3, 1.0])
def test_constant_gradient_is_a_circle(gradient, angle):
    """Every point lies on the circle of radius c / (g cos θ), within 1 mm to 1 000 m."""
    start, depth = 1000.0, np.array([0.0, 2000.0])
    speed = 1500 + gradient * (depth - start)
    path = bathyal.SoundPath(
        bathyal.Profile(depth, sound_speed=speed), start, angle, max_time=0.66, max_distance=1000.0
    )
    points = path.at(np.linspace(0, path.duration, 200))
    radius = 1500 / (gradient * np.cos(angle))
    middle = np.array([radius * np.sin(angle), start - 1500 / gradient])
    off = np.hypot(points[:, 1] - middle[0], points[:, 2] - middle[1]) - abs(radius)
    assert np.abs(off).max() < 1e-3
    assert np.ptp(points[:, 1]) > 300


@pytest.mark.parametrize("seed", range(12))
def test_paths_through_random_profiles(seed):
    depth, speed = random_profile(seed)
    profile = bathyal.Profile(depth, sound_speed=speed)
    rng = np.random.default_rng(1000 + seed)
    start, angle = rng.uniform(20, depth[-1] - 20), rng.uniform(-1.4, 1.4)
    duration = rng.uniform(0.05, 0.25)
    own = integrated(depth, speed, start, angle, duration)
    path = bathyal.SoundPath(profile, start, angle, max_time=duration)
    if own is None:
        assert path.end == "surface"
        assert path.duration < duration
        return
    assert path.end == "time"
    found = path.at([duration])[0]
    assert found[1:3] == pytest.approx(own[:2], abs=2e-2)
    assert found[3] == pytest.approx(own[2], abs=2e-4)


def test_a_grazing_path_turns_and_comes_back():
    """Upward refraction from 100 m: the path is a symmetric arc, and returns after 2 R sin θ."""
    gradient, c = 0.1, 1500.0
    profile = bathyal.Profile([0, 2000], sound_speed=[c - gradient * 100, c + gradient * 1900])
    angle = 0.05
    radius = c / (gradient * np.cos(angle))
    path = bathyal.SoundPath(profile, 100.0, angle, max_distance=1.0, max_time=3.0)
    chord = 2 * radius * np.sin(angle)
    path = bathyal.SoundPath(profile, 100.0, angle, max_time=2.0)
    back = path.at(np.linspace(0.5, 2.0, 40_001))
    row = np.argmin(np.abs(back[:, 1] - chord))
    assert back[row, 2] == pytest.approx(100.0, abs=0.05)
    assert back[row, 3] == pytest.approx(-angle, abs=1e-4)
    deepest = radius - radius * np.cos(angle)
    assert path.at(np.linspace(0, 2, 4001))[:, 2].max() == pytest.approx(100 + deepest, abs=1e-3)


@pytest.mark.parametrize("seed", range(5))
def test_time_of_a_vertical_path(seed):
    """∫ dz / c, in closed form in each layer."""
    depth, speed = random_profile(seed)
    end = depth[-2]
    c = np.interp([5.0, end], depth, speed)
    rows = (depth > 5.0) & (depth < end)
    z = np.concatenate([[5.0], depth[rows], [end]])
    v = np.concatenate([c[:1], speed[rows], c[1:]])
    slope = np.diff(v) / np.diff(z)
    time = np.sum(np.log(v[1:] / v[:-1]) / slope)
    traced = bathyal.trace_sound(
        bathyal.Profile(depth, sound_speed=speed), np.pi / 2, time, start_depth=5.0
    )
    assert float(traced.depth) == pytest.approx(end, abs=1e-6)
    assert float(traced.across) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("seed", range(6))
def test_a_way_there_is_a_way_back(seed):
    """The time of an eigenray, and the swapped ray's: reciprocity; no straight line is quicker."""
    depth, speed = random_profile(40 + seed)
    profile = bathyal.Profile(depth, sound_speed=speed)
    distance = np.random.default_rng(seed).uniform(20, 150)
    there = bathyal.eigenrays(profile, 10.0, 60.0, distance)[0]
    back = bathyal.eigenrays(profile, 60.0, 10.0, distance)[0]
    assert there.time == pytest.approx(back.time, rel=1e-8)
    line = np.linspace(0, 1, 20_001)
    c = np.interp(10 + 50 * line, depth, speed)
    straight = np.hypot(distance, 50.0) * np.trapezoid(1 / c, line)
    assert there.time <= straight * (1 + 1e-9)
    assert there.time == pytest.approx(straight, rel=2e-3)


@pytest.mark.parametrize("gradient", [-0.4, 0.4])
def test_the_bottom_of_a_refracting_sonar(gradient):
    """Straight down a bottom comes at c₀ times ∫ dz / c: what a survey without a cast reads."""
    cast = bathyal.Profile([0, 200], sound_speed=[1500 - gradient * 20, 1500 + gradient * 180])
    world = world_of(plate((-200, -200), (200, 200)))
    world.water = bathyal.Water(cast, surface=100.0)
    sonar = bathyal.sonars.echo_sounder().replace(
        range=100.0, samples=10_000, fan_span=0.02, beam_width=0.02
    )
    ping = sonar.replace(refraction=True).ping(world, at(z=80.0))
    c = np.array([ping.sound_speed, 1500 + gradient * 80])
    assert c[0] == pytest.approx(1500.0, abs=1e-6)
    paper = c[0] * np.log(c[1] / c[0]) / gradient
    first = ping.range[np.argmax(ping.intensity[0] > 0)]
    assert first == pytest.approx(paper, abs=0.01)
    assert abs(paper - 80) > 0.5
    straight = sonar.ping(world, at(z=80.0))
    assert straight.range[np.argmax(straight.intensity[0] > 0)] == pytest.approx(80.0, abs=0.01)


@pytest.mark.parametrize("seed", range(6))
def test_a_tilted_pencil_in_a_random_profile(seed):
    """It meets the bottom where an integration of our own does, and hears it at c₀ t."""
    depth, speed = random_profile(70 + seed)
    speed = speed - 0.15 * depth
    tilt, bottom = np.random.default_rng(seed).uniform(0.35, 1.0), depth[-1] - 1.0
    world = world_of(plate((-900, -900), (900, 900), z=-bottom))
    world.water = bathyal.Water(bathyal.Profile(depth, sound_speed=speed), surface=0.0)
    narrow = {"beam_width": 1e-4, "fan_span": 1e-4, "rays_across_beam": 1, "rays_along_fan": 1}
    sonar = pointer(
        range=600.0, samples=20_000, refraction=True, tilt=tilt, axis_tilt=tilt, **narrow
    )
    ping = sonar.ping(world, at(z=-5.0))
    time = (bottom - 5.0) / np.sin(tilt) / 1500
    for _ in range(4):
        paper = integrated(depth, speed, 5.0, tilt, time)
        time += (bottom - paper[1]) / np.sin(paper[2]) / 1500
    point = ping.truth.point[0][np.isfinite(ping.truth.range[0])].mean(axis=0)
    assert point == pytest.approx([0.0, paper[0], -bottom], abs=0.05)
    heard = ping.range[ping.intensity[0] > 0]
    assert heard.mean() == pytest.approx(ping.sound_speed * time, abs=0.04)
    straight = (bottom - 5.0) / np.tan(tilt)
    assert abs(paper[0] - straight) > 0.5


def mackenzie(t, s, z):
    """J. Acoust. Soc. Am. 70 (1981) 807."""
    return (
        1448.96 + 4.591 * t - 5.304e-2 * t**2 + 2.374e-4 * t**3 + 1.340 * (s - 35)
        + 1.630e-2 * z + 1.675e-7 * z**2 - 1.025e-2 * t * (s - 35) - 7.139e-13 * t * z**3
    )  # fmt: skip


def ainslie_mccolm(f, t, s, depth, ph):
    """[dB/km] at f [kHz], J. Acoust. Soc. Am. 103 (1998) 1671; depth in km inside."""
    z = depth / 1000
    f1 = 0.78 * np.sqrt(s / 35) * np.exp(t / 26)
    f2 = 42 * np.exp(t / 17)
    return (
        0.106 * f1 * f**2 / (f1**2 + f**2) * np.exp((ph - 8) / 0.56)
        + 0.52 * (1 + t / 43) * s / 35 * f2 * f**2 / (f2**2 + f**2) * np.exp(-z / 6)
        + 0.00049 * f**2 * np.exp(-(t / 27 + z / 17))
    )


def test_printed_formulas_over_their_ranges():
    rng = np.random.default_rng(3)
    t, s, z = rng.uniform(2, 30, 300), rng.uniform(25, 40, 300), rng.uniform(0, 7000, 300)
    assert bathyal.sound_speed(t, s, z) == pytest.approx(mackenzie(t, s, z), abs=1e-6)
    f, ph = 10 ** rng.uniform(2.1, 5.99, 300), rng.uniform(7.7, 8.3, 300)
    found = bathyal.absorption(f, t, s, z, ph, formula="ainslie_mccolm")
    assert found == pytest.approx(ainslie_mccolm(f / 1000, t, s, z, ph), rel=1e-6)


def test_published_check_values():
    assert bathyal.sound_speed(25, 35, 1000) == pytest.approx(1550.744, abs=5e-4)
    unesco = bathyal.sound_speed(40, 40, pressure=10_000, formula="chen_millero")
    assert unesco == pytest.approx(1731.995, abs=5e-4)
    surface = [
        bathyal.sound_speed(t, 35, pressure=0.0, formula="chen_millero") for t in (0, 10, 20)
    ]
    assert surface == pytest.approx([1449.14, 1489.82, 1521.46], abs=0.02)
    for formula, paper in (
        ("francois_garrison", [33.4, 158.6, 298.6]),
        ("ainslie_mccolm", [34.1, 168.9, 321.1]),
    ):
        found = bathyal.absorption([100e3, 600e3, 900e3], 10, 35, 50, formula=formula)
        assert found == pytest.approx(paper, rel=0.01)


@pytest.mark.parametrize(
    ("name", "value"),
    [("temperature", np.nan), ("temperature", 90.0), ("salinity", -1.0), ("salinity", np.inf)],
)
def test_water_that_is_none(name, value):
    arguments = {"temperature": 10.0, "salinity": 35.0, "depth": 20.0, name: value}
    with pytest.raises(ValueError, match=name):
        bathyal.sound_speed(**arguments)
    with pytest.raises(ValueError, match=name):
        bathyal.absorption(100e3, **arguments)


@pytest.mark.parametrize(
    ("depth", "speed", "fault"),
    [
        ([5.0], [1500.0], "row"),
        ([0, 20, 10], [1500.0, 1490, 1495], "ris|sort|increas"),
        ([0, 10, 10, 20], [1500.0, 1490, 1491, 1495], "ris|doubl|increas"),
        ([0, 10, 20], [1500.0, np.nan, 1495], "NaN|nan|finite|missing"),
        ([0, 10, 20], [1500.0, 20.0, 1495], "m/s|speed"),
        ([0, np.nan, 20], [1500.0, 1499, 1495], "depth"),
    ],
)
def test_profiles_that_are_none(depth, speed, fault):
    with pytest.raises(ValueError, match=fault):
        bathyal.Water(bathyal.Profile(depth, sound_speed=speed), surface=0.0)


def test_a_profile_that_ends_above_the_bottom_says_so():
    world = world_of(plate((-200, -200), (200, 200)))
    world.water = bathyal.Water(bathyal.Profile([0, 30], sound_speed=[1500, 1490]), surface=60.0)
    sonar = bathyal.sonars.side_scan().replace(refraction=True)
    with pytest.warns(UserWarning, match="30 m"):
        warned = sonar.ping(world, at(z=40)).warnings
    assert any("profile" in line and "30" in line for line in warned), warned
    world.water = bathyal.Water(bathyal.Profile([0, 90], sound_speed=[1500, 1490]), surface=60.0)
    assert not sonar.ping(world, at(z=40)).warnings
