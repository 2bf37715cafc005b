# SPDX-License-Identifier: BSD-3-Clause
"""Cases of bad input to a sonar: what is refused, and what the message says."""

from __future__ import annotations

import resource

import numpy as np
import pytest

import bathyal
from tests.support import alone
from tests.support.sea_cases import at, ball, flat_world, plate, world_of

PRESETS = ["side_scan", "multibeam", "echo_sounder", "imaging", "scanning", "paper_side_scan"]
TRACK = bathyal.Trajectory([0.0, 6.0], np.stack([at(0, 0, 9), at(6, 0, 9)]))


def small(name="side_scan", **fields):
    sonar = getattr(bathyal.sonars, name)()
    return sonar.replace(rays_along_fan=50, rays_across_beam=2, beams=min(sonar.beams, 8), **fields)


def full_world():
    """A bottom at z = 0, a ball of 3 m at (0, 0, 10), a surface at 25 m."""
    world = world_of(plate((-90, -90), (90, 90)), (ball(3.0, 24), at(0, 0, 10)))
    world.water = bathyal.Water(surface=25.0)
    return world


@pytest.mark.parametrize("name", PRESETS)
@pytest.mark.parametrize(
    ("place", "says"),
    [
        ((30, 0, -0.5), "above the bottom"),
        ((30, 0, -80), "above the bottom"),
        ((0.5, 0.5, 10.2), "outside of all bodies"),
        ((30, 0, 25.5), "below the surface"),
    ],
)
def test_places_where_no_sonar_is(name, place, says):
    with pytest.raises(ValueError, match=rf"`world_from_vehicle`: expected .*{says}.*, got .*"):
        small(name).ping(full_world(), at(*place))
    assert small(name).ping(full_world(), at(30, 0, 8)).altitude == pytest.approx(8.0)


def test_a_mount_counts_for_the_place():
    """The vehicle in the water, its sonar 2 m below it in the bottom."""
    sonar = small(vehicle_from_sonar=at(0, 0, -2))
    with pytest.raises(ValueError, match="above the bottom"):
        sonar.ping(full_world(), at(30, 0, 1.0))
    assert sonar.ping(full_world(), at(30, 0, 6.0)).altitude == pytest.approx(4.0)


def test_a_survey_names_the_ping():
    """Down into the bottom at half its way, that is at ping 15 of 31."""
    track = bathyal.Trajectory([0.0, 6.0], np.stack([at(20, 0, 5.1), at(26, 0, -4.9)]))
    with pytest.raises(ValueError, match=r"ping 1[56]\b.*above the bottom"):
        small(ping_rate=5.0).survey(full_world(), track)


def bent(kind):
    pose = at(30, 0, 8)
    if kind == "nan":
        pose[0, 3] = np.nan
    elif kind == "infinite":
        pose[2, 3] = np.inf
    elif kind == "scaled":
        pose[:3, :3] *= 2
    elif kind == "mirrored":
        pose[0, 0] = -1
    elif kind == "sheared":
        pose[0, 1] = 0.3
    elif kind == "last row":
        pose[3] = [0, 0, 1, 1]
    elif kind == "flat":
        pose = pose[:3]
    elif kind == "stack":
        pose = np.stack([pose, pose])
    elif kind == "text":
        pose = "here"
    return pose


@pytest.mark.parametrize(
    "kind",
    ["nan", "infinite", "scaled", "mirrored", "sheared", "last row", "flat", "stack", "text"],
)
def test_poses_that_are_none(kind):
    with pytest.raises(ValueError, match=r"`world_from_vehicle`: expected .+, got .+"):
        small().ping(full_world(), bent(kind))


@pytest.mark.parametrize("kind", ["nan", "infinite", "last row"])
def test_the_message_says_what_came(kind):
    with pytest.raises(ValueError, match=r"got (?!.*determinant 1$)"):
        small().ping(full_world(), bent(kind))


def test_none_is_no_pose():
    with pytest.raises((ValueError, TypeError), match="world_from_vehicle"):
        small().ping(full_world(), None)


def test_a_function_that_forgets_its_pose():
    world = full_world()
    world.add(plate((-1, -1), (1, 1)), lambda time: None, material="white")
    with pytest.raises((ValueError, TypeError), match="pose"):
        small().ping(world, at(30, 0, 8))


@pytest.mark.parametrize("name", ["ping", "hear", "survey"])
def test_none_is_no_world(name, tmp_path):
    calls = {
        "ping": lambda: small().ping(None, at(z=9)),
        "hear": lambda: small().hear(None, TRACK, lambda *_: True),
        "survey": lambda: small().survey(None, TRACK),
    }
    alone.check(alone.refused(name, "`world`", calls[name], (TypeError, ValueError)), tmp_path)


FIELDS = {
    "beams": (0, -1, 10**6, 10**12, 2.5, np.nan),
    "samples": (0, -5, 10**9, 10**20),
    "rays_along_fan": (0, 10**9),
    "rays_across_beam": (0, -2),
    "range": (0.0, -10.0, np.nan, np.inf),
    "frequency": (0.0, -1.0, np.nan, 1e12),
    "pulse_length": (0.0, -1e-4, np.nan),
    "ping_rate": (0.0, -1.0, np.nan),
    "tilt": (np.nan, 9.0),
    "beam_width": (0.0, np.nan, 7.0),
    "bits": (-1, 40),
    "dropout_rate": (-0.1, 1.5, np.nan),
    "multiples": (-1, 9),
    "speckle_shape": (0.0, np.nan),
    "absorption": ("salt", 3),
    "speckle": ("grey",),
    "pulse": ("square",),
    "kind": ("gun",),
    "source_level": (np.inf, "loud"),
    "vehicle_from_sonar": (np.zeros((4, 4)), np.full((4, 4), np.nan), np.eye(3)),
}


@pytest.mark.parametrize("field", FIELDS)
def test_fields_out_of_range(field):
    for value in FIELDS[field]:
        with pytest.raises(ValueError, match=rf"`{field}`: expected .+, got .+"):
            bathyal.sonars.multibeam().replace(**{field: value})
        with pytest.raises(ValueError, match=rf"`{field}`: expected .+, got .+"):
            bathyal.Sonar.from_dict(bathyal.sonars.multibeam().to_dict() | {field: value})


def test_a_field_that_is_none():
    with pytest.raises(ValueError, match="`colour`: expected a field"):
        bathyal.sonars.multibeam().replace(colour="red")


@pytest.mark.parametrize("name", ["side_scan", "echo_sounder", "multibeam"])
def test_a_range_shorter_than_the_altitude(name):
    """Nothing is heard, and a warning gives both."""
    with pytest.warns(UserWarning, match=r"8 m .*10 m"):
        ping = small(name, range=8.0).ping(flat_world(), at(z=10))
    assert not ping.intensity.any()
    assert np.all(ping.truth.material == -1)
    assert np.all(np.isnan(ping.truth.range))
    assert ping.altitude == 10.0
    assert any("8 m" in line for line in ping.warnings)


def test_nothing_below():
    """Beyond the bottom's edge nothing is heard and no altitude is made up."""
    ping = small().ping(flat_world(50.0), at(500, 0, 10))
    assert not ping.intensity.any()
    assert np.isnan(ping.altitude)


def test_a_world_of_nothing():
    with pytest.raises(ValueError, match="`world`: expected one object"):
        small().ping(bathyal.World(), at(z=9))


@pytest.mark.parametrize(
    ("argument", "value"),
    [
        ("time", np.nan),
        ("velocity", [1.0, 2.0]),
        ("velocity", [np.nan, 0, 0]),
        ("velocity", [1500.0, 0, 0]),
        ("angular_velocity", [0, np.inf, 0]),
        ("num_threads", -1),
        ("seed", -1),
    ],
)
def test_arguments_of_a_ping(argument, value):
    with pytest.raises(ValueError, match=rf"`{argument}`: expected .+, got .+"):
        small(motion=True).ping(full_world(), at(30, 0, 8), **{argument: value})


def test_a_full_disk_leaves_what_was_written(tmp_path):
    """From ping 40 on no file may grow: OSError; the chunks before stay, and the survey goes on."""
    sonar = small(samples=20_000, ping_rate=10.0)
    out = tmp_path / "survey.zarr"

    def fill(done, of):
        if done >= 40:
            resource.setrlimit(resource.RLIMIT_FSIZE, (0, resource.RLIM_INFINITY))
        return True

    full = alone.refused(
        "disk full", "", lambda: sonar.survey(full_far(), TRACK, out=out, progress=fill), (OSError,)
    )
    assert not alone.run_alone(full, tmp_path)
    whole = sonar.survey(full_far(), TRACK)
    left = bathyal.read_sonar(out)
    there = np.isfinite(left.time)
    assert 10 < there.sum() < len(whole)
    assert any(str(int(there.sum())) in line for line in left.warnings)
    found = np.asarray(left.intensity)[there]
    assert found.tobytes() == whole.intensity[: len(there)][there].tobytes()
    again = sonar.survey(full_far(), TRACK, out=out)
    assert np.asarray(again.intensity).tobytes() == whole.intensity.tobytes()


def full_far():
    return flat_world(60.0)
