# SPDX-License-Identifier: BSD-3-Clause
"""Cases of determinism: the same bytes from any threads, other ones from another seed."""

from __future__ import annotations

import numpy as np
import pytest

import bathyal
from tests.support.sea_cases import at

NAMES = ["side_scan", "side_scan_100khz", "multibeam", "echo_sounder", "imaging", "scanning"]


def sea():
    """Ripples, stones, a moving fish, a cast and a surface."""
    world = bathyal.World()
    world.add(bathyal.make_seabed((60, 60), 0.5, seed=4, ripple_height=0.05), name="bottom")
    world.add_clones(bathyal.make_boulder(0.5, seed=2), 80, seed=3)
    world.add(bathyal.make_fish(0.8), lambda time: at(time, 5.0, 4.0), material="fish", name="fish")
    cast = bathyal.Profile([0, 8, 15, 40], sound_speed=[1510, 1508, 1490, 1488])
    world.water = bathyal.Water(cast, surface=20.0)
    return world


WORLD = sea()
TRACK = bathyal.Trajectory([0.0, 4.0], np.stack([at(-4, 0, 8), at(4, 1, 8.5)]))


def sonar_of(name):
    """Every effect on, few rays."""
    sonar = bathyal.Sonar.preset(name, physics="real").replace(range=40.0, dropout_rate=0.1)
    if name in ("multibeam", "imaging"):
        return sonar.replace(beams=16)
    return sonar.replace(rays_along_fan=min(sonar.rays_along_fan, 400))


def everything(ping):
    truth = ping.truth
    parts = (ping.intensity, truth.range, truth.incidence, truth.material, truth.point)
    return b"".join(np.ascontiguousarray(part).tobytes() for part in parts)


@pytest.mark.parametrize("name", NAMES)
def test_pings_of_one_thread_and_of_more(name):
    sonar = sonar_of(name)
    moving = {"velocity": [1.5, 0.2, 0], "angular_velocity": [0, 0, 0.1]}
    for seed in range(3):
        pings = [
            everything(sonar.ping(WORLD, at(1, 2, 7), 2.0, seed=seed, num_threads=n, **moving))
            for n in (1, 2, 3, 0)
        ]
        assert len(set(pings)) == 1


@pytest.mark.parametrize("name", NAMES)
def test_another_seed_is_another_ping(name):
    sonar = sonar_of(name).replace(dropout_rate=0.0)
    pings = [sonar.ping(WORLD, at(1, 2, 7), seed=seed).intensity.tobytes() for seed in range(6)]
    assert len(set(pings)) == 6


@pytest.mark.parametrize("switch", ["speckle", "noise", "dropout_rate", "beam_dropout_rate"])
def test_a_seed_counts_only_where_chance_is(switch):
    plain = bathyal.sonars.side_scan().replace(range=40.0, rays_along_fan=400)
    value = {"speckle": "rayleigh", "noise": True}.get(switch, 0.5)
    chance = plain.replace(**{switch: value})
    for sonar, kinds in ((plain, 1), (chance, 2)):
        pings = {
            sonar.ping(WORLD, at(1, 2, 7), seed=seed).intensity.tobytes() for seed in range(12)
        }
        assert (len(pings) > 1) == (kinds > 1)


def test_a_survey_of_one_thread_and_of_more():
    sonar = sonar_of("side_scan").replace(ping_rate=5.0)
    errors = bathyal.NavigationErrors.preset("compass")
    one, two = (
        sonar.survey(WORLD, TRACK, seed=7, truth=True, navigation=errors, num_threads=n)
        for n in (1, 2)
    )
    assert np.asarray(one.intensity).tobytes() == np.asarray(two.intensity).tobytes()
    for name in ("range", "incidence", "material", "point"):
        pair = (np.asarray(getattr(record.truth, name)) for record in (one, two))
        assert len({part.tobytes() for part in pair}) == 1
    for name in ("position", "heading", "altitude", "speed"):
        pair = (np.asarray(getattr(record.navigation, name)) for record in (one, two))
        assert len({part.tobytes() for part in pair}) == 1
    other = sonar.survey(WORLD, TRACK, seed=8, navigation=errors)
    assert np.mean(np.asarray(other.intensity) != one.intensity) > 0.2
    assert not np.array_equal(other.navigation.position, one.navigation.position)


def test_parts_join_to_the_whole():
    sonar = sonar_of("side_scan").replace(ping_rate=5.0)
    whole = np.asarray(sonar.survey(WORLD, TRACK, seed=7).intensity)
    parts = [
        np.asarray(sonar.survey(WORLD, TRACK, seed=7, first=first, count=count).intensity)
        for first, count in ((0, 6), (6, 9), (15, -1))
    ]
    assert np.concatenate(parts).tobytes() == whole.tobytes()


def test_a_survey_is_its_pings():
    """At rest, so that no velocity has to be given; a record holds float32."""
    sonar = sonar_of("scanning").replace(ping_rate=5.0)
    rest = bathyal.Trajectory([0.0, 2.0], np.stack([at(0, 0, 8), at(0, 0, 8)]))
    record = sonar.survey(WORLD, rest, seed=3)
    for i in (0, 3, 10):
        ping = sonar.ping(WORLD, at(0, 0, 8), float(record.time[i]), seed=3, ping=i)
        assert np.array_equal(ping.intensity.astype(np.float32), record.intensity[i])
        assert ping.intensity.any()


def test_a_world_made_again_is_the_same():
    sonar = sonar_of("side_scan")
    pings = [everything(sonar.ping(world, at(1, 2, 7), 1.0)) for world in (WORLD, sea())]
    assert pings[0] == pings[1]


def test_every_instruction_set_gives_the_same_bytes():
    sonar, best = sonar_of("side_scan"), bathyal.simd_level()
    levels = {"avx512": ["avx2", "baseline"], "avx2": ["baseline"]}.get(best, [])
    if not levels:
        pytest.skip(f"only {best} here")
    here = everything(sonar.ping(WORLD, at(1, 2, 7)))
    try:
        for level in levels:
            bathyal.set_simd_level(level)
            assert everything(sonar.ping(WORLD, at(1, 2, 7))) == here
    finally:
        bathyal.set_simd_level(best)
