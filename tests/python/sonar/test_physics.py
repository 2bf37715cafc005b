# SPDX-License-Identifier: BSD-3-Clause
"""Switches of the physics from Python."""

import numpy as np
import pytest

import bathyal

SWITCHES = {
    "spreading": True,
    "absorption": "francois_garrison",
    "backscatter": "material",
    "beam_pattern": "uniform",
    "refraction": True,
    "multiples": 2,
    "pulse": "rectangle",
    "speckle": "rayleigh",
    "noise": True,
    "tvg": True,
    "bits": 12,
    "dropout_rate": 1.0,
}


@pytest.fixture(scope="module")
def world():
    world = bathyal.World()
    corners = np.array([[-300, -300, -30], [300, -300, -30], [300, 300, -30], [-300, 300, -30.0]])
    world.add(bathyal.TriangleMesh(corners, [[0, 1, 2], [0, 2, 3]]), material="sand")
    cast = bathyal.Profile([0, 10, 20, 50], sound_speed=[1520, 1515, 1492, 1490])
    world.water = bathyal.Water(cast, surface=0.0)
    return world


@pytest.fixture
def pose():
    pose = np.eye(4)
    pose[2, 3] = -12.0
    return pose


@pytest.mark.parametrize("name", SWITCHES)
def test_each_switch_changes_the_ping(world, pose, name):
    sonar = bathyal.sonars.side_scan().replace(
        rays_along_fan=500, frequency=100e3, pulse_length=5e-4
    )
    changed = sonar.replace(**{name: SWITCHES[name]})
    assert not np.array_equal(
        sonar.ping(world, pose).intensity, changed.ping(world, pose).intensity
    )


def test_motion_counts_where_its_switch_is_on(world, pose):
    sonar = bathyal.sonars.side_scan().replace(rays_along_fan=500)
    still = sonar.ping(world, pose).intensity
    turning = {"velocity": [2.0, 0, 0], "angular_velocity": [0, 0, 0.05]}
    assert np.array_equal(sonar.ping(world, pose, **turning).intensity, still)
    moved = sonar.replace(motion=True)
    assert np.array_equal(moved.ping(world, pose).intensity, still)
    assert moved.ping(world, pose, **turning).intensity.sum() < still.sum()


def test_a_survey_takes_the_motion_of_its_trajectory(world, pose):
    end = pose.copy()
    turn = 0.4
    end[:2, :2] = [[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]]
    track = bathyal.Trajectory([0.0, 8.0], [pose, end])
    sonar = bathyal.sonars.side_scan().replace(rays_along_fan=300, motion=True, ping_rate=1.0)
    record = sonar.survey(world, track)
    one = sonar.ping(world, track.at(3.0), 3.0, angular_velocity=[0, 0, turn / 8.0])
    np.testing.assert_allclose(record.intensity[3], one.intensity, rtol=1e-6)
    assert record.intensity[3].sum() < sonar.ping(world, track.at(3.0), 3.0).intensity.sum()


def test_backscatter_is_what_a_ping_has(world):
    angles = np.radians([0.0, 20.0, 60.0, 90.0])
    lambert = bathyal.sonars.side_scan().scattering_strength(world, "sand", angles)
    np.testing.assert_allclose(lambert / lambert[0], np.cos(angles) ** 2, atol=1e-15)
    sand = bathyal.sonars.side_scan(physics="real").replace(frequency=30e3)
    level = 10 * np.log10(sand.scattering_strength(world, "sand", np.radians([60.0]))[0])
    assert -27.0 < level < -22.0  # TR 9407, medium sand at 30 kHz and 30° grazing
    with pytest.raises(ValueError, match="incidence"):
        sand.scattering_strength(world, "sand", [2.0])
    with pytest.raises(ValueError, match="cheese"):
        sand.scattering_strength(world, "cheese", [0.0])


def test_the_sea_surface_is_named_in_the_truth(world, pose):
    sonar = bathyal.sonars.echo_sounder().replace(multiples=1)
    ping = sonar.ping(world, pose)
    assert set(np.unique(ping.truth.material)) == {-2, -1, world.materials.index("sand")}
    heard = ping.truth.material[0] == -2
    assert np.allclose(ping.truth.point[0, heard, 2], 0.0)
    assert ping.range[heard][0] == pytest.approx(18.0 + 30.0, abs=0.1)


def test_notes_and_warnings(world, pose):
    sonar = bathyal.sonars.side_scan().replace(backscatter="material")
    assert "extrapolated" in sonar.ping(world, pose).notes[0]
    assert sonar.replace(frequency=50e3).ping(world, pose).notes == []


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("multiples", -1),
        ("multiples", 9),
        ("multiples", 1.5),
        ("wind_speed", -1.0),
        ("refraction", "yes"),
    ],
)
def test_refuses_nonsense(field, value):
    with pytest.raises(ValueError, match=field):
        bathyal.sonars.side_scan().replace(**{field: value})


@pytest.mark.parametrize("name", ["velocity", "angular_velocity"])
@pytest.mark.parametrize("value", [[1, 2], [np.nan, 0, 0], [1e3, 0, 0], "fast"])
def test_refuses_a_motion_that_is_none(world, pose, name, value):
    with pytest.raises((ValueError, TypeError), match=name):
        bathyal.sonars.side_scan().ping(world, pose, **{name: value})


@pytest.mark.parametrize("name", bathyal.sonars.__all__)
def test_steel_close_by_does_not_clip(world, name):
    corners = np.array([[-9, -9, -20], [9, -9, -20], [9, 9, -20], [-9, 9, -20.0]])
    steel = bathyal.World()
    steel.water = world.water
    steel.add(bathyal.TriangleMesh(corners * [30, 30, 1], [[0, 1, 2], [0, 2, 3]]), material="sand")
    steel.add(
        bathyal.TriangleMesh(corners + np.array([0, 0, 0.5]), [[0, 1, 2], [0, 2, 3]]),
        material="steel",
    )
    above = np.eye(4)
    above[2, 3] = -14.0
    sonar = getattr(bathyal.sonars, name)(physics="real")
    assert sum(sonar.ping(steel, above, seed=seed, truth=False).clipped for seed in range(3)) == 0
    low = sonar.replace(full_scale=-60.0)
    assert low.ping(steel, above, truth=False).clipped > 0


def test_shading_puts_down_the_ring_of_the_nadir(world, pose):
    """A flat bottom 18 m below: the outer beams meet it at twice that."""
    sonar = bathyal.sonars.multibeam().replace(spreading=True, backscatter="material", range=60.0)
    ranges = sonar.ping(world, pose).range
    ring = (ranges > 17.9) & (ranges < 19.0)
    heard = {
        pattern: sonar.replace(beam_pattern=pattern, side_lobes=True).ping(world, pose).intensity[0]
        for pattern in ("uniform", "hann", "taylor")
    }
    assert heard["uniform"][ring].max() > 1e-3 * heard["uniform"].max()
    assert heard["hann"][ring].max() < heard["taylor"][ring].max() < heard["uniform"][ring].max()
