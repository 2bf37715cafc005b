# SPDX-License-Identifier: BSD-3-Clause
"""Cases of the receiver: statistics of speckle and noise, gain, steps, dropouts, multiples."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import kstest

import bathyal
from tests.support.sea_cases import at, decibel, flat_world, plate, world_of

PLAIN = bathyal.sonars.side_scan().replace(range=60.0, samples=1200, rays_along_fan=1500)


def over_mean(sonar, pings, moving=True, z=10.0):
    """Samples beyond the first echo over the power they are drawn about, (pings, samples)."""
    world = flat_world()
    mean = sonar.replace(speckle=None, noise=False).ping(world, at(z=z)).intensity
    far = sonar.ping(world, at(z=z)).range > 1.2 * z
    rows = [
        sonar.ping(world, at(0.5 * i * moving, 0, z), 0.1 * i).intensity[:, far] / mean[:, far]
        for i in range(pings)
    ]
    return np.concatenate([row.ravel() for row in rows]).reshape(pings, -1)


def test_rayleigh_speckle_is_exponential():
    """Contrast 1 of the intensity, 0.523 of the amplitude, over 10⁵ samples and more."""
    drawn = over_mean(PLAIN.replace(speckle="rayleigh"), 60)
    assert drawn.size > 1e5
    assert drawn.mean() == pytest.approx(1.0, abs=0.02)
    assert drawn.std() / drawn.mean() == pytest.approx(1.0, abs=0.02)
    root = np.sqrt(drawn)
    assert root.std() / root.mean() == pytest.approx(0.523, abs=0.005)
    assert kstest(drawn.ravel()[::7], "expon").pvalue > 1e-3


@pytest.mark.parametrize("shape", [1.0, 4.0, 20.0])
def test_contrast_of_k(shape):
    drawn = over_mean(PLAIN.replace(speckle="k", speckle_shape=shape), 60)
    assert drawn.mean() == pytest.approx(1.0, abs=0.03)
    assert drawn.std() / drawn.mean() == pytest.approx(np.sqrt(1 + 2 / shape), rel=0.04)


@pytest.mark.parametrize("law", ["rayleigh", "k"])
def test_speckle_belongs_to_the_place(law):
    sonar = PLAIN.replace(speckle=law)
    moving, still = over_mean(sonar, 4), over_mean(sonar, 4, moving=False)
    assert np.all(still == still[0])
    assert np.abs(np.corrcoef(moving)[np.triu_indices(4, 1)]).max() < 0.1
    rows = moving[0].reshape(2, -1)
    assert abs(np.corrcoef(rows)[0, 1]) < 0.15
    assert abs(np.corrcoef(rows[0, 1:], rows[0, :-1])[0, 1]) < 0.15


def silence(**fields):
    """Rows of noise alone: no bottom is within reach of the beams."""
    world = world_of(plate((-9, -9), (9, 9)))
    sonar = PLAIN.replace(noise=True, samples=6000, **fields)
    rows = [sonar.ping(world, at(500, 0, 10), 0.1 * i).intensity for i in range(8)]
    return np.array(rows, dtype=float)


def test_noise_is_exponential_and_follows_its_levels():
    plain = silence(noise_level=40.0)
    assert plain.std() / plain.mean() == pytest.approx(1.0, abs=0.02)
    for fields, change in (
        ({"noise_level": 46.0}, 6.0),
        ({"noise_level": 40.0, "source_level": PLAIN.source_level + 3}, -3.0),
        ({"noise_level": 40.0, "beam_width": 2 * PLAIN.beam_width}, 10 * np.log10(2)),
    ):
        assert decibel(silence(**fields).mean() / plain.mean()) == pytest.approx(change, abs=0.1)


def test_noise_is_new_at_every_time():
    sonar = PLAIN.replace(noise=True, noise_level=60.0)
    world = world_of(plate((-9, -9), (9, 9)))
    one, same, later = (sonar.ping(world, at(500, 0, 10), t).intensity for t in (1.0, 1.0, 1.1))
    assert np.array_equal(one, same)
    assert abs(np.corrcoef(one.ravel(), later.ravel())[0, 1]) < 0.1


def test_gain_over_range():
    """a log R + 2 b R + g."""
    gain = {"tvg_spreading": 37.0, "tvg_absorption": 0.12, "tvg_offset": -4.0}
    off, on = (PLAIN.replace(tvg=tvg, **gain).ping(flat_world(), at(z=10)) for tvg in (False, True))
    heard = off.intensity[0] > 0
    found = decibel(on.intensity[0, heard] / off.intensity[0, heard])
    r = off.range[heard]
    assert found == pytest.approx(37 * np.log10(r) + 0.24 * r - 4, abs=1e-3)


@pytest.mark.parametrize("bits", [8, 12, 16])
def test_steps_of_amplitude(bits):
    """Even steps up to the full scale, each sample at the nearest, and what is above is counted."""
    fine = PLAIN.ping(flat_world(), at(z=10)).intensity
    level = float(decibel(np.quantile(fine, 0.97)))
    ping = PLAIN.replace(bits=bits, full_scale=level).ping(flat_world(), at(z=10))
    step = np.sqrt(10 ** (level / 10)) / (2**bits - 1)
    number = np.sqrt(ping.intensity) / step
    assert np.abs(number - np.round(number)).max() < 0.01
    clipped = fine > 10 ** (level / 10)
    assert 20 < clipped.sum() < 100
    assert ping.clipped == pytest.approx(clipped.sum(), abs=2)
    assert number.max() == pytest.approx(2**bits - 1, abs=0.01)
    off = np.abs(np.sqrt(ping.intensity[~clipped]) - np.sqrt(fine[~clipped]))
    assert off.max() < 0.51 * step


def test_dropouts_come_as_often_as_said():
    few = PLAIN.replace(samples=20, rays_along_fan=60, dropout_rate=0.2, beam_dropout_rate=0.3)
    track = bathyal.Trajectory([0.0, 99.9], np.stack([at(0, 0, 9), at(5, 0, 9)]))
    rows = np.asarray(few.survey(flat_world(), track).intensity).any(axis=2)
    pings = len(rows)
    assert pings == 1000
    whole = ~rows.any(axis=1)
    assert whole.mean() == pytest.approx(0.2 + 0.8 * 0.09, abs=0.05)
    assert (~rows).mean() == pytest.approx(0.2 + 0.8 * 0.3, abs=0.05)


@pytest.mark.parametrize(("depth", "altitude"), [(12.0, 18.0), (5.0, 21.0), (9.0, 7.0)])
def test_multiples_under_a_surface(depth, altitude):
    """Bottom at H; by way of the bottom the surface at 2H + d; the bottom once more at 3H + 2d,
    that is at 2H + d as well where the surface reflected first."""
    world = world_of(plate((-300, -300), (300, 300)))
    world.water = bathyal.Water(sound_speed=1500.0, surface=depth + altitude)
    sonar = bathyal.sonars.echo_sounder().replace(
        multiples=2, spreading=True, range=120.0, samples=2400
    )
    starts = []
    row = sonar.ping(world, at(z=altitude)).intensity[0]
    heard = np.flatnonzero(row > 0)
    gaps = np.flatnonzero(np.diff(heard) > 2)
    starts = (heard[np.concatenate([[0], gaps + 1])]) * 0.05
    paper = [altitude, 2 * altitude + depth, 3 * altitude + 2 * depth]
    assert starts[:3] == pytest.approx([x for x in paper if x < 120], abs=0.11)
    single = sonar.replace(multiples=0).ping(world, at(z=altitude)).intensity[0]
    assert np.flatnonzero(single).max() < heard[gaps[0] + 1]


def test_a_vehicle_that_moves_within_a_ping():
    """Towards a wall at v: the echo comes at c t / 2 with t = 2R / (c + v)."""
    wall = np.eye(4)
    wall[:3, :3] = [[0, 0, -1], [0, 1, 0], [1, 0, 0]]
    wall[:3, 3] = 80, 0, 0
    world = world_of((plate((-30, -30), (30, 30)), wall))
    world.water = bathyal.Water(sound_speed=1500.0)
    sonar = bathyal.sonars.imaging().replace(
        motion=True, tilt=0.0, axis_tilt=0.0, beams=1, beam_width=0.02, fan_span=0.02,
        fan_width=0.02, range=90.0, samples=9000, rays_along_fan=100,
    )  # fmt: skip
    for speed in (0.0, 10.0, -20.0):
        ping = sonar.ping(world, at(), velocity=[speed, 0, 0])
        first = ping.range[np.argmax(ping.intensity[0] > 0)]
        assert first == pytest.approx(80 * 1500 / (1500 + speed), abs=0.02)
