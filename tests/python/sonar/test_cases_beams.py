# SPDX-License-Identifier: BSD-3-Clause
"""Cases of beams with answers on paper: where each instrument looks, and what a pulse does."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import bathyal
from tests.support.sea_cases import at, ball, cut, decibel, flat_world, plate, pointer, world_of


def turn(axis, angle):
    """A turn of the vehicle about x (0) or y (1)."""
    pose, c, s = np.eye(4), np.cos(angle), np.sin(angle)
    i, j = ((1, 2), (2, 0))[axis]
    pose[i, i] = pose[j, j] = c
    pose[i, j], pose[j, i] = -s, s
    return pose


def first_range(ping, beam=0):
    return ping.range[np.argmax(ping.intensity[beam] > 0)]


def room():
    """A shell of 30 m about the origin."""
    return world_of(ball(30.0, 60, inward=True))


@pytest.mark.parametrize(("pulse", "length"), [("rectangle", 2e-3), ("chirp", None)])
def test_length_of_a_pulse(pulse, length):
    """A plate across the pencil: its echo is cτ/2 long, or 1.44 · c/2B (Hann)."""
    world = world_of((plate((-5, -5), (5, 5)), turn(0, np.pi / 2) + shift(0, 30, 0)))
    world.water = bathyal.Water(sound_speed=1500.0)
    sonar = pointer(range=50.0, samples=5000, bandwidth=500.0, fan_span=0.01, beam_width=0.01)
    plain = sonar.ping(world, at())
    fields = dict(pulse=pulse) | (dict(pulse_length=length) if length else {})
    ping = sonar.replace(**fields).ping(world, at())
    row = ping.intensity[0].astype(float)
    wide = np.sum(row >= row.max() / 2) * 0.01
    assert wide == pytest.approx(1.5 if length else 1500 / 1000 * 1.44, rel=0.03)
    assert row.sum() == pytest.approx(plain.intensity.sum(), rel=0.05)


def shift(x, y, z):
    pose = np.zeros((4, 4))
    pose[:3, 3] = x, y, z
    return pose


def test_a_scanning_head_turns_to_port():
    sonar = bathyal.sonars.scanning()
    for i in (0, 50, 100, 250):
        angle = sonar.head_start + i * sonar.head_step
        target = at(20 * np.cos(angle), 20 * np.sin(angle), -20 * np.tan(sonar.tilt))
        world = world_of((ball(0.5, 24), target))
        heard = [sonar.ping(world, at(), ping=j).intensity.sum() for j in (i, i + 20, i - 20)]
        assert heard[0] > 0
        assert heard[1] == heard[2] == 0


@pytest.mark.parametrize("name", ["multibeam", "imaging"])
def test_beams_go_from_port_to_starboard(name):
    """Axes at equal angles over the sector."""
    sonar = getattr(bathyal.sonars, name)()
    sonar = sonar.replace(beams=7, tilt=0.0 if name == "imaging" else sonar.tilt, range=40.0)
    truth = sonar.ping(room(), at()).truth.point
    middle = np.array([np.nanmean(beam, axis=0) for beam in truth])
    y, x = middle[:, 1], middle[:, 0] if name == "imaging" else -middle[:, 2]
    angle = np.arctan2(y, x)
    paper = np.linspace(0.5, -0.5, 7) * sonar.sector
    assert angle == pytest.approx(paper, abs=0.02)


def test_the_papers_forward_sounders():
    """From 60° down to 30° up, ahead; a small ball is heard within 5° of one axis only."""
    sonar = bathyal.sonars.paper_forward_sounders()
    axes = np.array([-60, -37.5, -15, 7.5, 30])
    for offset in (-5.8, -4.2, 0.0, 4.2, 5.8):
        for up in np.radians(axes + offset):
            world = world_of((ball(0.1, 16), at(20 * np.cos(up), 0, 20 * np.sin(up))))
            heard = sonar.ping(world, at()).intensity.sum(axis=1) > 0
            inside = np.abs(np.degrees(up) - axes) < 5.0
            assert sorted(heard) == sorted(inside)


@pytest.mark.parametrize("slope", [0.03, 0.07, 0.2])
def test_an_echo_sounder_over_a_slope(slope):
    """First return: along the normal while it lies in the beam of 10°, then at the beam's edge."""
    half = np.radians(5.0)
    world = world_of((plate((-99, -99), (99, 99)), turn(1, slope)))
    sonar = bathyal.sonars.echo_sounder().replace(samples=5000, range=50.0, rays_along_fan=300)
    ping = sonar.ping(world, at(z=20.0))
    normal = 20 * np.cos(slope)
    paper = normal / np.cos(max(slope - half, 0.0))
    assert first_range(ping) == pytest.approx(paper, abs=0.03)
    assert ping.altitude == pytest.approx(20.0, abs=1e-6)


def test_roll_lowers_one_side():
    """Turned about x by +20° port looks up: its row starts 20° later, off nadir."""
    sonar = bathyal.sonars.side_scan().replace(range=60.0, samples=1200, rays_along_fan=8000)
    angle = np.radians(20.0)
    pose = turn(0, angle) + shift(0, 0, 10)
    ping = sonar.ping(flat_world(), pose)
    assert first_range(ping, 0) == pytest.approx(10 / np.cos(angle), abs=0.06)
    assert first_range(ping, 1) == pytest.approx(10.0, abs=0.06)


def test_pitch_of_the_plane_of_a_side_scan():
    """Bow down by 10°: the fan meets the bottom astern of the vehicle."""
    sonar = bathyal.sonars.side_scan().replace(range=60.0, rays_along_fan=4000)
    pose = turn(1, np.radians(10.0)) + shift(0, 0, 10)
    point = sonar.ping(flat_world(), pose).truth.point[0]
    seen = point[np.isfinite(point[:, 0])]
    assert seen[:, 0] == pytest.approx(-10 * np.tan(np.radians(10.0)), abs=0.6)


def test_survey_coordinates_change_nothing():
    """The same sea in UTM: millimetres in place, 0.01 % in power."""
    offset = np.array([621_000.0, 6_172_000.0, 0.0])
    near = world_of(plate((-99, -99), (99, 99)), (ball(1.0, 30), at(0, 20, 0.5)))
    mesh = plate((-99, -99), (99, 99))
    far = world_of(
        bathyal.TriangleMesh(mesh.vertices + offset, mesh.triangles),
        (ball(1.0, 30), at(*np.add(offset, [0, 20, 0.5]))),
    )
    sonar = bathyal.sonars.side_scan().replace(spreading=True)
    one, two = sonar.ping(near, at(z=9)), sonar.ping(far, at(*np.add(offset, [0, 0, 9])))
    assert two.intensity.sum() == pytest.approx(one.intensity.sum(), rel=1e-4)
    both = np.isfinite(one.truth.range) & np.isfinite(two.truth.range)
    assert both.sum() > 0.99 * np.isfinite(one.truth.range).sum()
    off = two.truth.point[both] - offset - one.truth.point[both]
    assert np.quantile(np.abs(off), 0.99) < 2e-3


def test_a_cable_of_5_cm_at_100_m():
    """The 100 kHz preset, every effect on: found in single pings, its signal-to-noise stated."""
    ground = plate((-150, -150), (150, 150))
    cable = bathyal.make_cable([(-8, 100), (8, 100)], 0.05, bathyal.Scene(ground))
    world = bathyal.World()
    world.add(ground, material="sand", name="bottom")
    world.add(cable.mesh, material="steel", name="cable")
    real = bathyal.sonars.side_scan_100khz(physics="real")
    still = real.replace(speckle="none", noise=False, bits=0)
    ping = still.ping(world, at(z=10))
    off = np.abs(ping.range - np.hypot(100, 10))
    here, around = off < 0.4, (off > 1) & (off < 6)
    cable_level = decibel(ping.intensity[0][here].max())
    assert cable_level - decibel(ping.intensity[0][around].mean()) == pytest.approx(31.7, abs=1.0)
    water = bathyal.World()
    water.add(plate((-1, -1), (1, 1)), pose=at(z=-900.0))
    with pytest.warns(UserWarning, match="ends above the bottom"):
        noise = real.replace(speckle="none").ping(water, at(z=10))
    assert cable_level - decibel(noise.intensity[0][around].mean()) == pytest.approx(74.0, abs=1.5)
    heard = [real.ping(world, at(z=10), seed=seed).intensity[0] for seed in range(20)]
    level = [decibel(row[here].max() / np.median(row[around])) for row in heard]
    assert np.median(level) == pytest.approx(29.2, abs=1.5)
    assert min(level) > 15.0


@pytest.mark.parametrize("name", ["table", "sand"])
def test_a_measured_law_is_followed(name):
    world = bathyal.World()
    angle, level = np.radians([0, 20, 50, 80]), np.array([-8.0, -20.0, -26.0, -40.0])
    world.set_material("table", angle=angle, backscatter=level)
    sonar = bathyal.sonars.side_scan_100khz().replace(backscatter="material")
    found = decibel(sonar.scattering_strength(world, name, angle))
    if name == "table":
        assert found == pytest.approx(level, abs=1e-3)
        middle = sonar.scattering_strength(world, name, np.radians([35.0]))
        assert decibel(middle[0]) == pytest.approx(-23.0, abs=0.1)
    assert np.all(np.diff(found) < 0)
    if name == "table":
        world.add(plate((-99, -99), (99, 99)), material="table")
        other = sonar.replace(backscatter="lambert", rays_along_fan=9000, range=60.0)
        law = sonar.replace(rays_along_fan=9000, range=60.0)
        r = 10 / np.cos(np.radians(50.0))
        heard = [cut(s.ping(world, at(z=10)), 0, r - 0.2, r + 0.2) for s in (law, other)]
        paper = -26.0 - 20 * np.log10(np.cos(np.radians(50.0)))
        assert decibel(heard[0] / heard[1]) == pytest.approx(paper, abs=0.15)


def test_a_sonar_is_a_value():
    sonar = bathyal.sonars.multibeam(physics="real").replace(range=61.0)
    assert pickle.loads(pickle.dumps(sonar)) == sonar
    assert bathyal.Sonar.from_dict(sonar.to_dict()) == sonar
    assert sonar.replace() == sonar != sonar.replace(range=62.0)
    assert hash(sonar) == hash(bathyal.Sonar.from_dict(sonar.to_dict()))
