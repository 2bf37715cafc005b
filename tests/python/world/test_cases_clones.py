# SPDX-License-Identifier: BSD-3-Clause
"""Cases of clones and fish: how they sit, how far apart, and what a seed keeps."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.distance import pdist

import bathyal
from tests.support.sea_cases import at, flat_world, plate, world_of

STONE = bathyal.make_boulder(0.5, seed=2)


def clones(world, count, **options):
    """Their vertices in the world."""
    first = world.add_clones(STONE, count, "white", **options)
    return np.array([world.scene.mesh_in_world(first + i).vertices for i in range(count)])


def test_they_sit_as_deep_as_said():
    """Upright on a flat bottom, the part `sunk` of each one's own height lies below it."""
    found = clones(flat_world(), 40, tilt=0.0, sunk=0.3, region=(-50, -50, 50, 50))
    low, high = found[:, :, 2].min(axis=1), found[:, :, 2].max(axis=1)
    assert -low / (high - low) == pytest.approx(np.full(40, 0.3), abs=1e-6)
    assert np.ptp(high - low) > 0.1


@pytest.mark.parametrize("slope", [0.0, 0.2, -0.4])
def test_they_follow_a_slope(slope):
    pose = at()
    pose[0, 0] = pose[2, 2] = np.cos(slope)
    pose[0, 2], pose[2, 0] = np.sin(slope), -np.sin(slope)
    world = world_of((plate((-90, -90), (90, 90)), pose))
    found = clones(world, 60, region=(-40, -40, 40, 40))
    middle = found.mean(axis=1)
    above = middle[:, 2] + np.tan(slope) * middle[:, 0]
    assert np.all(np.abs(above) < 1.0)
    assert np.ptp(middle[:, 0]) > 40


def test_sizes_places_and_distances_are_as_said():
    plain = np.linalg.norm(np.ptp(STONE.vertices, axis=0))
    region = (-10.0, 5.0, 30.0, 25.0)
    found = clones(
        flat_world(), 80, scale=(0.5, 0.9), turned=False, tilt=0.0, region=region, apart=2.0
    )
    size = np.linalg.norm(np.ptp(found, axis=1), axis=1) / plain
    assert 0.5 <= size.min() < 0.55
    assert 0.85 < size.max() <= 0.9 + 1e-9
    middle = (found.min(axis=1) + found.max(axis=1)) / 2
    assert np.all(middle[:, :2] > np.add(region[:2], -0.5))
    assert np.all(middle[:, :2] < np.add(region[2:], 0.5))
    assert pdist(middle[:, :2]).min() > 1.9


def test_more_clones_leave_the_first_ones_alone():
    few, many, other = (
        clones(flat_world(), count, seed=seed, region=(-50, -50, 50, 50))
        for count, seed in ((20, 1), (50, 1), (20, 2))
    )
    assert np.array_equal(few, many[:20])
    assert not np.any(np.all(few == other, axis=(1, 2)))


def test_turns_are_even():
    """About the vertical by any angle: the mean direction of 400 vanishes."""
    world = flat_world()
    first = world.add_clones(STONE, 400, "white", tilt=0.0, region=(-90, -90, 90, 90))
    ahead = np.array([world.scene.poses[first + i][:2, 0] for i in range(400)])
    ahead /= np.linalg.norm(ahead, axis=1)[:, None]
    assert np.linalg.norm(ahead.mean(axis=0)) < 0.15


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"count": -3}, "count"),
        ({"region": (500, 500, 600, 600)}, "region|ground"),
        ({"region": (1, 1, 0, 0)}, "region"),
        ({"region": (0, 0, np.nan, 1)}, "region"),
        ({"scale": (2.0, 1.0)}, "scale"),
        ({"scale": (0.0, 1.0)}, "scale"),
        ({"apart": 50.0}, "apart|room"),
        ({"sunk": 1.5}, "sunk"),
        ({"tilt": np.nan}, "tilt"),
        ({"material": "cheese"}, "material"),
    ],
)
def test_what_is_refused(options, says):
    world = flat_world(40.0)
    with pytest.raises(ValueError, match=says):
        world.add_clones(STONE, **({"count": 50} | options))
    assert len(world) == 1


def test_fish_keep_off_the_ground():
    """By dense samples of the paths; the clearance is from the terrain as a whole."""
    ground = bathyal.make_seabed((60, 60), 0.5, seed=3)
    scene = bathyal.Scene(ground)
    for path in bathyal.fish_paths(scene, 6, 60.0, seed=2, clearance=0.7):
        places = path.at(np.linspace(0, 60, 600))[:, :3, 3]
        near = np.sqrt(((ground.vertices[None] - places[::10, None]) ** 2).sum(-1).min(1))
        assert near.min() > 0.7
        speed = np.linalg.norm(np.diff(places[:, :2], axis=0), axis=1) / (60 / 599)
        assert speed.max() < 2.0
        assert np.ptp(places[:, :2], axis=0).max() > 3
