# SPDX-License-Identifier: BSD-3-Clause
"""Cases of a world's file: the same world as by script, and files that mean harm."""

from __future__ import annotations

import numpy as np
import pytest

import bathyal
from tests.support.sea_cases import at

FILE = """
materials:
  chalk: {strength: 0.25}
terrain: {seabed: {size: [40, 40], spacing: 0.5, seed: 1, ripple_height: 0.05}, material: sand}
objects:
  - {name: mine, mine: {kind: manta}, material: steel, pose: {position: [5, 3, 0.2]}}
clones:
  - {name: stone, boulder: {radius: 0.4}, count: 20}
"""
PLAIN = "terrain: {seabed: {size: [9, 9], spacing: 1}}\n"
LAUGHS = "a: &a [x,x,x,x,x,x,x,x,x]\n" + "".join(
    f"{c}: &{c} [{','.join(['*' + p] * 9)}]\n" for p, c in zip("abcdefgh", "bcdefghi", strict=True)
)


@pytest.fixture
def read(tmp_path):
    def read_text(text):
        path = tmp_path / "world.yaml"
        path.write_text(text)
        return bathyal.read_world(path)

    return read_text


def test_a_file_gives_the_same_world_twice(read):
    one, two = read(FILE), read(FILE)
    assert one.names == two.names
    assert len(one) == 22
    sonar = bathyal.sonars.side_scan(physics="real").replace(range=25.0)
    pings = [sonar.ping(world, at(z=6.0), seed=1) for world in (one, two)]
    assert pings[0].intensity.tobytes() == pings[1].intensity.tobytes()
    place = one.scene.mesh_in_world(one.names.index("mine")).vertices
    assert place[:, :2].mean(0) == pytest.approx([5, 3], abs=0.05)
    assert place[:, 2].min() == pytest.approx(0.2)


def test_a_seabed_by_file_and_by_script(read):
    world = read("terrain: {seabed: {size: [40, 40], spacing: 0.5, seed: 1, ripple_height: 0.05}}")
    mesh = bathyal.make_seabed((40, 40), 0.5, seed=1, ripple_height=0.05)
    assert world.scene.mesh_in_world(0).vertices == pytest.approx(mesh.vertices, abs=1e-12)


HOSTILE = {
    "tag": ("terrain: !!python/object/apply:os.system ['true']", "1:.*tags"),
    "unknown key": (FILE + "\nsharks: 3\n", "sharks"),
    "unknown inner key": (FILE.replace("spacing:", "spacingg:"), "4:.*spacingg"),
    "not a number": (FILE.replace("0.5, seed", "far, seed"), "4:.*spacing"),
    "nan": (FILE.replace("spacing: 0.5", "spacing: .nan"), "4:.*spacing"),
    "negative": (FILE.replace("spacing: 0.5", "spacing: -0.5"), "4:.*spacing.*above 0.*-0.5"),
    "endless": (FILE.replace("count: 20", "count: 100000000000"), "8:.*count"),
    "fine": (FILE.replace("spacing: 0.5", "spacing: 1e-9"), "4:.*spacing"),
    "list": ("- a\n- b\n", "1:1.*section"),
    "unclosed": ("terrain: {seabed: {size: [40, 40", "YAML"),
    "tabs": ("terrain:\n\tseabed: 1\n", "2:1.*YAML"),
    "outside": (PLAIN + "objects:\n  - {name: a, mesh: ../../../../etc/passwd}\n", "3:.*outside"),
    "twice": (PLAIN + PLAIN, "2:1.*terrain.*twice"),
    "unknown material": (FILE.replace("material: steel", "material: cheese"), "6:.*cheese"),
    "same name": (
        FILE.replace("objects:", "objects:\n  - {name: mine, mine: {kind: manta}}"),
        "7:.*mine",
    ),
    "binary": ("\x00\x01\x02", "YAML"),
    "laughs": (LAUGHS, "200,000"),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_files(read, name):
    text, fault = HOSTILE[name]
    with pytest.raises(bathyal.Error, match=rf"world\.yaml.*{fault}"):
        read(text)


def test_a_nan_is_named_as_no_number(read):
    with pytest.raises(bathyal.Error, match="spacing: expected a finite number"):
        read(HOSTILE["nan"][0])


def test_nesting_without_end(read):
    with pytest.raises(bathyal.Error):
        read("terrain: " + "[" * 100_000)


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(OSError, match="none"):
        bathyal.read_world(tmp_path / "none.yaml")


def test_poses_over_time_by_file(read):
    world = read(
        "terrain: {seabed: {size: [40, 40], spacing: 1.0, relief_rms: 0.0}}\n"
        "objects:\n"
        "  - name: mine\n"
        "    mine: {kind: manta}\n"
        "    trajectory:\n"
        "      - {time: 0, position: [0, 0, 1]}\n"
        "      - {time: 10, position: [8, 0, 1]}\n"
    )
    row = world.names.index("mine")
    for time, x in ((0, 0.0), (5, 4.0), (10, 8.0), (20, 8.0)):
        place = world.at(time).scene.mesh_in_world(row).vertices
        assert np.mean([place[:, 0].min(), place[:, 0].max()]) == pytest.approx(x, abs=1e-6)
