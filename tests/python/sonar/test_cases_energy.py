# SPDX-License-Identifier: BSD-3-Clause
"""Cases of energy with answers on paper: what comes back from spheres, bottoms and walls."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.spatial.transform import Rotation

import bathyal
from tests.support.sea_cases import at, ball, cut, decibel, flat_world, plate, pointer, world_of

UTM = np.array([621_000.0, 6_172_000.0, -25.0])


def lambert_sphere(radius, distance, strength):
    """∫ μ cos²θ dA over what is seen of a sphere from a finite distance; 2πμa²/3 from afar."""

    def ring(u):
        squared = distance**2 + radius**2 - 2 * distance * radius * u
        return (distance * u - radius) ** 2 / squared

    return 2 * np.pi * strength * radius**2 * quad(ring, radius / distance, 1.0)[0]


def flat_bottom(altitude, low, high, width, strength=1.0):
    """Energy of a flat bottom between two angles from nadir under a line array, with R⁻⁴."""

    def upto(angle):
        return np.sin(angle) - np.sin(angle) ** 3 / 3

    return strength * width / altitude**2 * (upto(high) - upto(low))


def turned(seed, most=np.pi):
    """A rigid motion: turned by at most so much, placed in survey coordinates."""
    rng = np.random.default_rng(seed)
    axis = rng.normal(size=3)
    pose = np.eye(4)
    pose[:3, :3] = Rotation.from_rotvec(
        rng.uniform(0.3, 1.0) * most * axis / np.linalg.norm(axis)
    ).as_matrix()
    pose[:3, 3] = UTM + rng.uniform(-500, 500, 3)
    return pose


@pytest.mark.parametrize("seed", range(5))
def test_a_lambert_sphere(seed):
    """From afar 2πμa²/3, in survey coordinates, the sonar turned at random."""
    rng = np.random.default_rng(seed)
    radius, distance, strength = rng.uniform(0.2, 2), rng.uniform(30, 60), rng.uniform(0.01, 2)
    sonar_pose = turned(seed)
    ahead = sonar_pose[:3, 3] + sonar_pose[:3, 1] * distance
    world = world_of((ball(radius, 90), at(*ahead)), strength=strength)
    span = 2.4 * radius / distance
    sonar = pointer(beam_width=span, fan_span=span, rays_across_beam=200, rays_along_fan=200)
    heard = sonar.ping(world, sonar_pose).intensity.sum(dtype=float)
    assert heard == pytest.approx(lambert_sphere(radius, distance, strength), rel=5e-3)
    assert heard == pytest.approx(2 * np.pi * strength * radius**2 / 3, rel=0.12)


def test_a_far_sphere_by_the_formula():
    world = world_of((ball(1.0, 90), at(0, 1000, 0)))
    sonar = pointer(range=1100.0, beam_width=2.4e-3, fan_span=2.4e-3)
    sonar = sonar.replace(rays_across_beam=200, rays_along_fan=200)
    heard = sonar.ping(world, at()).intensity.sum(dtype=float)
    assert heard == pytest.approx(2 * np.pi / 3, rel=5e-3)


def test_the_error_of_a_sphere_halves_with_fourfold_rays():
    def error(rays):
        off = []
        for seed in range(12):
            y = np.random.default_rng(seed).uniform(-0.1, 0.1, 2)
            world = world_of((ball(1.0, 150), at(y[0], 50, y[1])))
            sonar = pointer(beam_width=0.06, fan_span=0.06)
            sonar = sonar.replace(rays_across_beam=rays, rays_along_fan=rays)
            heard = sonar.ping(world, at()).intensity.sum(dtype=float)
            off.append(heard / lambert_sphere(1.0, 50, 1.0) - 1)
        return np.sqrt(np.mean(np.square(off)))

    errors = [error(rays) for rays in (10, 20, 40)]
    assert errors[1] < errors[0] / 2
    assert errors[2] < errors[1] / 2


@pytest.mark.parametrize("seed", range(5))
def test_a_flat_bottom_in_closed_form(seed):
    rng = np.random.default_rng(100 + seed)
    altitude, width, strength = rng.uniform(5, 40), rng.uniform(0.005, 0.02), rng.uniform(0.01, 2)
    world = world_of(
        (plate((-900, -900), (900, 900)), at(*np.add(UTM, [3, 4, 0]))), strength=strength
    )
    pose = at(*np.add(UTM, [0, 0, altitude]))
    pose[:3, :3] = Rotation.from_euler("z", rng.uniform(0, 2 * np.pi)).as_matrix()
    sonar = bathyal.sonars.side_scan().replace(
        spreading=True, beam_width=width, range=4 * altitude, samples=4000, rays_along_fan=8000
    )
    ping = sonar.ping(world, pose)
    low, high = np.sort(rng.uniform(0.2, 1.25, 2))
    if high - low < 0.2:
        low, high = 0.4, 1.2
    edges = np.round(altitude / np.cos([low, high]) / (sonar.range / 4000)) * sonar.range / 4000
    paper = flat_bottom(altitude, *np.arccos(altitude / edges), width, strength)
    for row in range(2):
        assert cut(ping, row, *edges) == pytest.approx(paper, rel=5e-3)


def test_rigid_motion_of_all_changes_nothing():
    things = [(plate((-80, -80), (80, 80)), at()), (ball(1.0, 30), at(0, 20, 0.5))]
    sonar = bathyal.sonars.side_scan().replace(spreading=True, rays_along_fan=4000)
    plain = sonar.ping(world_of(*things), at(0.3, -0.2, 9)).intensity.astype(float)
    for seed in range(4):
        move = turned(seed, most=0.8)
        world = world_of(*((mesh, move @ pose) for mesh, pose in things))
        other = sonar.ping(world, move @ at(0.3, -0.2, 9)).intensity.astype(float)
        assert other.sum() == pytest.approx(plain.sum(), rel=1e-4)
        assert np.abs(other - plain).sum() < 0.01 * plain.sum()


def test_cos_squared():
    sonar = bathyal.sonars.side_scan()
    found = sonar.scattering_strength(flat_world(), "white", np.radians([0.0, 60.0, 70.0]))
    assert decibel(found) == pytest.approx([0.0, -6.02, -9.32], abs=0.005)


def test_a_row_from_60_to_70_degrees():
    """R φ cτ / (2 sin θ) · cos²θ · R⁻⁴ at constant altitude: −8.60 dB."""
    sonar = bathyal.sonars.side_scan().replace(spreading=True, rays_along_fan=20_000)
    ping = sonar.ping(flat_world(), at(z=20.0))
    level = []
    for degrees in (60.0, 70.0):
        r = 20 / np.cos(np.radians(degrees))
        near = np.abs(ping.range - r) < 0.5
        level.append(np.exp(np.interp(r, ping.range[near], np.log(ping.intensity[0, near]))))
    assert decibel(level[1] / level[0]) == pytest.approx(-8.60, abs=0.05)


def test_twice_the_range():
    """A point −12.04 dB, a bottom −9.03 dB within a pulse, −6.02 dB within a beam."""
    wide = {"beam_width": 0.05, "fan_span": 0.05, "rays_across_beam": 300, "rays_along_fan": 300}
    sonar = pointer(spreading=True, range=100.0, **wide)
    point = [
        sonar.ping(world_of((ball(0.2, 40), at(0, r, 0))), at()).intensity.sum() for r in (40, 80)
    ]
    assert decibel(point[1] / point[0]) == pytest.approx(-12.04, abs=0.1)

    scan = bathyal.sonars.side_scan().replace(
        spreading=True, range=100.0, samples=2000, rays_along_fan=20_000
    )
    pings = [scan.ping(flat_world(), at(z=z)) for z in (10.0, 20.0)]
    pulse = [cut(ping, 0, r - 0.5, r + 0.5) for ping, r in zip(pings, (30, 60), strict=True)]
    assert decibel(pulse[1] / pulse[0]) == pytest.approx(-9.03, abs=0.05)

    sounder = bathyal.sonars.echo_sounder().replace(spreading=True)
    beam = [sounder.ping(flat_world(), at(z=z)).intensity.sum() for z in (20, 40)]
    assert decibel(beam[1] / beam[0]) == pytest.approx(-6.02, abs=0.02)


def francois_garrison(frequency, t, salinity, depth, ph):
    """[dB/km] as printed in J. Acoust. Soc. Am. 72 (1982) 1879; frequency [kHz]."""
    c = 1412 + 3.21 * t + 1.19 * salinity + 0.0167 * depth
    kelvin = 273 + t
    a1 = 8.86 / c * 10 ** (0.78 * ph - 5)
    f1 = 2.8 * (salinity / 35) ** 0.5 * 10 ** (4 - 1245 / kelvin)
    a2 = 21.44 * salinity / c * (1 + 0.025 * t)
    p2 = 1 - 1.37e-4 * depth + 6.2e-9 * depth**2
    f2 = 8.17 * 10 ** (8 - 1990 / kelvin) / (1 + 0.0018 * (salinity - 35))
    cold = (4.937e-4, -2.59e-5, 9.11e-7, -1.50e-8)
    warm = (3.964e-4, -1.146e-5, 1.45e-7, -6.5e-10)
    a3 = sum(k * t**i for i, k in enumerate(cold if t <= 20 else warm))
    p3 = 1 - 3.83e-5 * depth + 4.9e-10 * depth**2
    f = frequency
    return a1 * f1 * f**2 / (f1**2 + f**2) + a2 * p2 * f2 * f**2 / (f2**2 + f**2) + a3 * p3 * f**2


@pytest.mark.parametrize("kilohertz", [30, 100, 200, 450, 900])
@pytest.mark.parametrize(("t", "salinity", "depth"), [(10, 35, 50), (21, 31, 5), (3, 34, 1200)])
def test_absorption_takes_its_share(kilohertz, t, salinity, depth):
    """At every range 2 α R dB, with α of the paper."""
    world = flat_world()
    world.water = bathyal.Water(temperature=t, salinity=salinity, reference_depth=depth)
    dry = bathyal.sonars.side_scan().replace(frequency=1e3 * kilohertz, rays_along_fan=4000)
    wet = dry.replace(absorption="francois_garrison")
    pings = [sonar.ping(world, at(z=10)) for sonar in (dry, wet)]
    heard = pings[0].intensity[0] > 0
    loss = decibel(pings[1].intensity[0, heard] / pings[0].intensity[0, heard].astype(float))
    paper = -2e-3 * pings[0].range[heard] * francois_garrison(kilohertz, t, salinity, depth, 8.0)
    assert loss == pytest.approx(paper, rel=0.01, abs=0.01)


@pytest.mark.parametrize(
    ("height", "away", "altitude"), [(1, 30, 10), (0.5, 20, 6), (2, 50, 9), (3, 12, 14)]
)
def test_the_shadow_of_a_wall(height, away, altitude):
    """The wall 1 m high at 30 m, sonar at 10 m: 3.333 m on the ground, 3.178 m in slant range."""
    wall = bathyal.TriangleMesh(
        [[-20, away, 0], [20, away, 0], [20, away, height], [-20, away, height]],
        [[0, 1, 2], [0, 2, 3]],
    )
    sonar = bathyal.sonars.side_scan().replace(beams=1, rays_along_fan=20_000)
    ping = sonar.ping(world_of(plate((-200, -200), (200, 200)), wall), at(z=altitude))
    foot, top = np.hypot(away, altitude), np.hypot(away, altitude - height)
    ground = away * altitude / (altitude - height)
    end = np.hypot(ground, altitude)
    if (height, away) == (1, 30):
        assert [ground - away, end - foot, end - top] == pytest.approx(
            [3.333, 3.178, 3.480], abs=1e-3
        )
    dark = np.flatnonzero((ping.intensity[0] == 0) & (ping.range > altitude + 1))
    spacing = ping.range[1] - ping.range[0]
    edges = ping.range[dark[[0, -1]]] + [-spacing / 2, spacing / 2]
    assert np.all(np.diff(dark) == 1)
    assert edges == pytest.approx([max(foot, top), end], abs=1.01 * spacing)
    behind = ping.truth.point[0][ping.range > end + spacing]
    assert np.nanmin(behind[:, 1]) == pytest.approx(ground, abs=0.15)


def test_clones_are_copies():
    stone = bathyal.make_boulder(0.6, seed=3)
    world = flat_world(60.0)
    first = world.add_clones(stone, 60, "white", seed=5, region=(-3, -20, 3, 20))
    rows = range(first, len(world))
    assert len(rows) == 60
    copies = world_of(
        plate((-60, -60), (60, 60)), *(world.scene.mesh_in_world(row) for row in rows)
    )
    sonar = bathyal.sonars.side_scan().replace(spreading=True, range=40.0)
    one, two = (sonar.ping(w, at(1, 2, 8)) for w in (world, copies))
    bare = sonar.ping(flat_world(60.0), at(1, 2, 8)).intensity
    difference = np.abs(one.intensity - two.intensity).max() / one.intensity.max()
    assert difference < 1e-4
    assert np.abs(one.intensity - bare).max() > 0.1 * bare.max()


def test_a_moving_object_is_where_it_is_then():
    def path(time):
        pose = at(0.1 * time, 10 + time, 1.5)
        pose[:3, :3] = Rotation.from_euler("xz", [0.1 * time, 0.3 * time]).as_matrix()
        return pose

    body, ground = bathyal.make_boulder(1.0, seed=1), plate((-60, -60), (60, 60))
    moving = world_of(ground)
    moving.add(body, path, material="white")
    sonar = bathyal.sonars.side_scan().replace(range=40.0)
    heard = []
    for time in (7.0, 0.0, 3.25):
        still = world_of(ground, (body, path(time)))
        ping = sonar.ping(moving, at(z=8), time=time)
        assert ping.intensity.tobytes() == sonar.ping(still, at(z=8)).intensity.tobytes()
        heard.append(ping.intensity.tobytes())
    assert len(set(heard)) == 3


def test_pixels_of_the_papers_camera():
    """They carry cos³ of the angle off the axis, −1.03 dB at 22.5°: counted, angles come out."""
    plain = bathyal.sonars.paper_side_scan().replace(rays_across_beam=10)
    pings = [
        plain.replace(pixel_solid_angle=on).ping(flat_world(), at(z=10)) for on in (False, True)
    ]
    ratio = []
    for down in np.radians([22.5, 43.0]):
        r = 10 / np.sin(down)
        heard = [cut(ping, 0, r - 0.15, r + 0.15) for ping in pings]
        ratio.append(heard[1] / heard[0])
    paper = 30 * np.log10(np.cos(np.radians(20.5)))
    assert decibel(ratio[1] / ratio[0]) == pytest.approx(paper, abs=0.02)
