# SPDX-License-Identifier: BSD-3-Clause
"""Worlds from YAML: what is read, and what is refused with its line and column."""

from __future__ import annotations

import math

import numpy as np
import pytest

import bathyal
from bathyal.world.example import write_example
from tests.support.command import run

DOWN = [0.0, 0.0, -1.0]
FLAT = "terrain: {mesh: flat.ply, material: mud}\n"
BOX = "objects: [{name: a, box: [1, 1, 1]%s}]\n"
STONE = "clones: [{name: b, boulder: {radius: 0.3}, count: %s}]\n"


@pytest.fixture
def folder(tmp_path):
    x, y = (part.ravel() for part in np.meshgrid([-10.0, 10.0], [-10.0, 10.0]))
    flat = bathyal.TriangleMesh(np.column_stack([x, y, 0 * x - 2]), [[0, 1, 3], [0, 3, 2]])
    flat.write(tmp_path / "flat.ply")
    return tmp_path


def read(folder, text, **options):
    path = folder / "world.yaml"
    path.write_text(text, encoding="utf-8")
    return bathyal.read_world(path, **options)


def height(scene, x, y):
    return float(50 - scene.cast([[x, y, 50]], [DOWN]).range[0])


def test_the_values_of_a_file_arrive(folder):
    world = read(
        folder,
        FLAT
        + """
water: {surface: 1.5, temperature: 7, salinity: 33, sound_speed: 1475}
materials: {shell: {strength_db: -10}, net: {strength: 0.25}}
objects:
  - name: block
    box: [2, 1, 0.5]
    material: shell
    pose: {position: [3, 2, 1], rpy_deg: [0, 0, 90]}
  - name: stone
    boulder: {radius: 0.5}
    on_ground: true
    scale: 2
    pose: {position: [-4, 0, -0.1]}
  - name: car
    box: [1, 1, 1]
    trajectory: [{time: 0, position: [-8, -8, 5]}, {time: 4, position: [8, -8, 5]}]
clones:
  - {name: pebble, boulder: {radius: 0.1}, count: 3, options: {seed: 4, region: [5, 5, 9, 9]}}
fish: [{count: 2, length: 0.4, duration: 20, seed: 3}]
paint: [{polygon: [[-20, -20], [20, -20], [20, 0], [-20, 0]], material: net}]
""",
    )
    pebbles, fish = [f"pebble_{i}" for i in range(3)], ["fish_0", "fish_1"]
    assert world.names == ["bottom", "block", "stone", "car", *pebbles, *fish]
    assert world.materials[-2:] == ["shell", "net"]
    assert world.water.surface == 1.5
    assert float(world.water.sound_speed(-3.0)) == 1475
    scene = world.scene
    # Turned by 90 degrees: 1 m along x, 2 m along y.
    assert height(scene, 3.4, 2.9) == pytest.approx(1.25, abs=1e-12)
    assert height(scene, 3.6, 2.1) == pytest.approx(-2, abs=1e-12)
    assert scene.poses[2][2, 3] == pytest.approx(-2.1, abs=1e-12)
    assert scene.scales[2] == 2
    for time, x in ((0, -8), (1, -4), (4, 8)):
        assert height(world.at(time).scene, x + 0.2, -8.3) == pytest.approx(5.5, abs=1e-12)
    at = np.array(scene.poses)[4:7, :2, 3]
    assert (at >= 5).all()
    assert (at <= 9).all()
    # The same by hand; rays from another height round otherwise.
    by_hand = bathyal.World()
    by_hand.add(bathyal.read_mesh(folder / "flat.ply"))
    by_hand.add_clones(bathyal.make_boulder(0.1), 3, seed=4, region=[5, 5, 9, 9])
    np.testing.assert_allclose(by_hand.scene.poses[1:], scene.poses[4:7], atol=1e-12)


def test_a_world_is_a_section_of_a_larger_file(folder):
    whole = read(folder, FLAT + BOX % "")
    lines = (FLAT + BOX % "").splitlines()
    section = read(folder, "world:\n" + "".join(f"  {line}\n" for line in lines))
    assert section.names == whole.names
    np.testing.assert_array_equal(section.scene.poses, whole.scene.poses)


def test_example_is_read_and_drawn(tmp_path, capsys):
    picture = tmp_path / "world.png"
    path = tmp_path / "sea" / "world.yaml"
    code, out, _ = run(capsys, "world", path, "--example", "--picture", picture)
    assert code == 0
    assert "wreck" in out
    assert picture.read_bytes()[:4] == b"\x89PNG"
    assert (tmp_path / "sea" / "track.csv").is_file()
    again = write_example(tmp_path / "other.yaml")
    one, two = (bathyal.read_world(p) for p in (path, again[0]))
    assert np.array(one.scene.poses).tobytes() == np.array(two.scene.poses).tobytes()


REFUSED = [
    ("", "the file is empty"),
    ("- 1\n", "1:1: the document: expected a section of keys and values"),
    ("name: a\n", "terrain: it is missing"),
    ("world: 3\n", "world: expected a section of keys and values, got 3"),
    ("terrain: !!python/object/apply:os.system ['true']\n", "1:10: tags are refused"),
    ("terrain: &a {mesh: *a}\n", "1:"),
    ("terrain: {mesh: ../x.ply}\n", "1:11: terrain.mesh: ../x.ply lies outside"),
    ("terrain: {mesh: /etc/passwd}\n", "1:11: terrain.mesh: /etc/passwd lies outside"),
    ("terrain: {mesh: link.ply}\n", "1:11: terrain.mesh: link.ply lies outside"),
    ("terrain: {mesh: x.ply}\n", "1:11: terrain.mesh: no such file: x.ply"),
    ("terrain: {mesh: broken.ply}\n", "1:11: terrain.mesh: "),
    (
        "terrain: {mesh: a.ply, survey: b.xyz}\n",
        "expected one of mesh, survey, seabed, got mesh and",
    ),
    (
        "terrain: {seabed: {size: [9, 9], spacing: 1, colour: 3}}\n",
        "1:11: terrain.seabed: `colour`",
    ),
    ("terrain: {seabed: {size: [1e9, 1e9], spacing: 1e-3}}\n", "terrain.seabed: `size`"),
    (FLAT + "materials: {a: {strength_db: 1e6}}\n", "2:17: materials.a.strength_db"),
    (FLAT + "materials: {a: {}}\n", "materials.a: expected one of strength, strength_db, got none"),
    (FLAT + BOX % ", material: cheese", "2:11: objects[0]: `material`: expected one of rock"),
    (FLAT + BOX % ", fish: {length: 1}", "got fish and box"),
    (FLAT + BOX % ", colour: red", "objects[0].colour"),
    (FLAT + BOX % ", scale: 1e300", "objects[0].scale"),
    (FLAT + BOX % ", trajectory: []", "objects[0].trajectory"),
    (FLAT + BOX % ", trajectory: [{time: 1}, {time: 0}]", "`time`: expected rising times"),
    (FLAT + BOX % ", pose: {}, trajectory: [{time: 0}]", "got pose and trajectory"),
    (FLAT + BOX % ", on_ground: true, pose: {position: [99, 0, 0]}", "expected ground below"),
    (FLAT + BOX % ", pose: {position: [.nan, 0, 0]}", "expected a finite number, got nan"),
    (FLAT + "objects: [{name: a}]\n", "objects[0]: expected one of mesh, boulder"),
    (FLAT + "objects: [{name: a, box: [1e300, 1, 1]}]\n", "objects[0].box[0]"),
    (
        FLAT + "objects: [{name: bottom, box: [1, 1, 1]}]\n",
        "`name`: expected a name that is not taken",
    ),
    (FLAT + "objects: [{name: a, boulder: {}}]\n", "2:21: objects[0].boulder: `radius`"),
    (FLAT + "objects: [{name: a, boulder: {radius: [1, 2]}}]\n", "objects[0].boulder: `radius`"),
    (FLAT + STONE % "100000000", "clones[0].count: expected less than or equal to 1000000"),
    (FLAT + STONE % "999, options: {apart: 3}", "clones[0]: `count`: expected as many places"),
    (FLAT + STONE % "3, options: {mesh: 3}", "clones[0]: `mesh`: expected one value, got two"),
    (
        FLAT + "fish: [{count: 1, options: {seed: 3}}]\n",
        "fish[0]: `options`: expected seed next to",
    ),
    (FLAT + "fish: [{count: 1, duration: 1e12}]\n", "fish[0]: `step`"),
    (
        FLAT + "pipelines: [{name: p, route: [[0, 0], [90, 0]], diameter: 1}]\n",
        "pipelines[0]: `route`",
    ),
    (FLAT + "cables: [{name: p, route: [[0, 0]], diameter: 1}]\n", "cables[0].route"),
    (FLAT + "paint: [{object: x, polygon: [[0, 0], [1, 0], [0, 1]], material: mud}]\n", "`object`"),
    (FLAT + "paint: [{polygon: [[0, 0], [1, 0]], material: mud}]\n", "2:10: paint[0].polygon"),
    (FLAT + "water: {salinity: -1}\n", "2:9: water.salinity"),
    (FLAT + "water: {temperature: 1e9}\n", "water: `temperature`"),
    (FLAT + "water: {profile: cast.csv}\n", "2:9: water.profile: no such file: cast.csv"),
]


@pytest.mark.parametrize(("text", "message"), REFUSED)
def test_mistakes_are_reported_by_their_place(folder, text, message):
    (folder / "broken.ply").write_bytes(b"ply\nformat ascii 1.0\nelement vertex 9\n")
    (folder / "link.ply").symlink_to("/etc/passwd")
    with pytest.raises(bathyal.Error) as error:
        read(folder, text)
    assert "world.yaml" in str(error.value)
    assert message in str(error.value)


def test_files_elsewhere_are_read_where_that_is_meant(folder):
    below = folder / "below"
    below.mkdir()
    text = FLAT.replace("flat.ply", "../flat.ply")
    with pytest.raises(bathyal.Error, match="lies outside"):
        read(below, text)
    assert len(read(below, text, inside=folder)) == 1


def test_tides_and_waves_come_from_the_file(folder):
    world = read(
        folder,
        FLAT
        + """
water:
  surface: 1.5
  waves: {height: 0.8, period: 6, direction: 0.3, seed: 4}
  tide: {constituents: {M2: {amplitude: 1.2, phase_deg: 30}, K1: {amplitude: 0.4, phase: 0.5}}}
""",
    )
    times = np.linspace(0, 90000, 50)
    tide = bathyal.Tide([("M2", (1.2, math.radians(30))), ("K1", (0.4, 0.5))])
    waves = bathyal.Waves(height=0.8, period=6, direction=0.3, seed=4)
    np.testing.assert_array_equal(
        world.water.surface_height(2.0, 3.0, times),
        bathyal.Water(surface=1.5, tide=tide, waves=waves).surface_height(2.0, 3.0, times),
    )
    table = read(
        folder, FLAT + "water: {surface: 0, tide: {time: [0, 600, 900], height: [0, 2, 1]}}\n"
    )
    assert table.water.surface_height(0, 0, [300, 750, 5000]).tolist() == [1, 1.5, 1]


def test_laws_of_materials_come_from_the_file(folder):
    world = read(
        folder,
        FLAT
        + """
materials:
  shell: {strength: 0.02, sediment: {density_ratio: 2.2, spectral_exponent: 3.0}}
  net: {strength_db: -20, angle_deg: [0, 60], backscatter_db: [-5, -25]}
""",
    )
    sediment = bathyal.Sediment(density_ratio=2.2, spectral_exponent=3.0)
    assert world.material("shell") == bathyal.Material("shell", 0.02, sediment=sediment)
    net = world.material("net")
    assert net.strength == pytest.approx(0.01)
    np.testing.assert_allclose(net.angle, [0, math.pi / 3])
    assert net.backscatter.tolist() == [-5, -25]


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("water: {tide: {constituents: {M2: {amplitude: 1}}}}", "surface"),
        ("water: {surface: 0, tide: {}}", "one of constituents, time"),
        ("water: {surface: 0, tide: {time: [0, 1]}}", "time and height together"),
        ("water: {surface: 0, tide: {time: [1, 0], height: [0, 0]}}", r"water\.tide: `time`"),
        ("water: {surface: 0, tide: {constituents: {X9: {amplitude: 1}}}}", "M2"),
        (
            "water: {tide: {constituents: {M2: {amplitude: 1, phase: 1, phase_deg: 3}}}}",
            "one of phase, phase_deg",
        ),
        ("water: {surface: 0, waves: {height: -1}}", r"water\.waves: `height`"),
        ("water: {surface: 0, waves: {hight: 1}}", r"water\.waves"),
        ("materials: {a: {strength: 1, angle: [0, 1]}}", "backscatter_db together"),
        ("materials: {a: {strength: 1, angle: [1, 0], backscatter_db: [0, 0]}}", "`angle`"),
        ("materials: {a: {strength: 1, sediment: {spectral_exponent: 9}}}", "`spectral_exponent`"),
        ("materials: {a: {sediment: {}}}", "one of strength, strength_db"),
    ],
)
def test_mistakes_in_tides_and_materials_are_found_by_line(folder, text, reason):
    with pytest.raises(bathyal.Error, match=rf"world\.yaml:\d+:\d+: .*{reason}"):
        read(folder, FLAT + text + "\n")
