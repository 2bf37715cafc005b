# SPDX-License-Identifier: BSD-3-Clause
"""Scenarios from YAML: what is read, and what is refused with its line and column."""

from __future__ import annotations

import os
import re

import numpy as np
import pytest

import bathyal
from bathyal.io import yaml_documents
from bathyal.io.yaml_documents import read_yaml
from bathyal.workspace.example import write_example

SMALL = """\
arm:
  name: panda
  q_start_deg: [0, -45, 0, -135, 0, 90, 45]
hull: {box: [1.2, 0.6, 0.4]}
mount: {position: [0.7, 0, 0], rpy_deg: [0, 90, 0]}
keepouts:
  - {name: beam, shape: cone, length: 1.5, angle_deg: 60, pose: {position: [0, 0, 0.2]}}
  - {shape: half_space, frame: world, normal: [0, 0, -1], point: [0, 0, 3]}
vehicle: {position: [1, 2, -50], rpy_deg: [0, 10, 90], rpy_std_deg: [1, 1, 0]}
targets:
  - [1.0, 2.9, -50.2]
  - {name: port, point: [0.4, 2, -50]}
"""


@pytest.fixture
def scenario_file(tmp_path):
    def write(text, name="scenario.yaml"):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return write


def refused(path, **options):
    with pytest.raises(bathyal.Error) as error:
        bathyal.read_scenario(path, **options)
    return str(error.value)


def test_the_values_of_a_file_arrive(scenario_file):
    read = bathyal.read_scenario(scenario_file(SMALL))
    assert read.name == "scenario"
    assert read.target_names == ["1", "port"]
    np.testing.assert_array_equal(read.targets, [[1.0, 2.9, -50.2], [0.4, 2, -50]])
    np.testing.assert_allclose(read.q_start, np.radians([0, -45, 0, -135, 0, 90, 45]), rtol=1e-15)
    beam, roof = read.keepouts
    assert (beam.name, beam.kind, beam.frame) == ("beam", "cone", "hull")
    assert beam.radius == pytest.approx(1.5 * np.tan(np.radians(30)), rel=1e-12)
    assert (roof.kind, roof.frame) == ("half_space", "world")
    assert roof.contains([[0, 0, 3.1], [0, 0, 2.9]]).tolist() == [True, False]
    pose = read.workspace.vehicle_pose.at(0.0)
    np.testing.assert_allclose(pose[:3, 3], [1, 2, -50])
    # Turned to port by 90 degrees, nose down by 10: the bow is east of nothing, north and lower.
    np.testing.assert_allclose(
        pose[:3, 0], [0, np.cos(np.radians(10)), -np.sin(np.radians(10))], atol=1e-15
    )
    np.testing.assert_allclose(read.workspace.mount[:3, 0], [0, 0, -1], atol=1e-15)
    assert read.row_of(None) == 0
    assert read.row_of("port") == 1
    with pytest.raises(ValueError, match=r"`target`: expected one of 1, port, got 'starboard'"):
        read.row_of("starboard")


def test_angles_are_radians_unless_the_key_ends_in_deg(scenario_file):
    text = SMALL.replace("rpy_deg: [0, 90, 0]", f"rpy: [0, {np.pi / 2!r}, 0]")
    np.testing.assert_allclose(
        bathyal.read_scenario(scenario_file(text)).workspace.mount,
        bathyal.read_scenario(scenario_file(SMALL, "other.yaml")).workspace.mount,
        atol=1e-15,
    )


def test_the_example_reads_without_warnings(tmp_path):
    write_example(tmp_path)
    read = bathyal.read_scenario(tmp_path / "scenario.yaml")
    assert read.warnings == []
    assert read.workspace.check_target(read.targets).status.tolist() == ["free", "free"]
    distance = read.scene.nearest(read.targets).distance
    np.testing.assert_allclose(distance, 0, atol=1e-9)
    assert read.workspace.arm.links[2].mass == 5.5
    assert len((tmp_path / "scenario.yaml").read_text().splitlines()) <= 32


def test_files_are_found_next_to_the_scenario_and_nowhere_else(tmp_path):
    folder = tmp_path / "job"
    write_example(folder)
    path = folder / "scenario.yaml"
    text = path.read_text()
    (folder / "hull.stl").rename(tmp_path / "hull.stl")
    assert re.search(r":\d+:8: hull.mesh: no such file: hull.stl", refused(path))
    path.write_text(text.replace("hull.stl", "../hull.stl"))
    message = refused(path)
    assert "hull.mesh: ../hull.stl lies outside" in message
    assert "inside=" in message
    assert bathyal.read_scenario(path, inside=tmp_path).hull is not None
    path.write_text(text.replace("hull.stl", str(tmp_path / "hull.stl")))
    assert "lies outside" in refused(path)
    (folder / "link.stl").symlink_to(tmp_path / "hull.stl")
    path.write_text(text.replace("hull.stl", "link.stl"))
    assert "lies outside" in refused(path)
    path.write_text(text.replace("maevskiy_zanin", "/etc/arm.urdf"))
    assert "arm.name: expected the name of an arm" in refused(path)


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("name: panda", "name: pandora", ":2:3: arm.name: `arm`: expected gen3_lite, "),
        ("-135, 0", "much, 0", ":3:28: arm.q_start_deg[3]: expected a valid number, got 'much'"),
        ("-135, 0, ", "", ":3:3: arm.q_start_deg: expected 7 joint values, got 5"),
        ("0.6, 0.4", "0.6, -0.4", ":4:24: hull.box[2]: expected greater than 0, got -0.4"),
        ("0.6, 0.4", "0.6", ":4:8: hull.box[2]: it is missing"),
        ("[0.7, 0, 0]", "[0.7, 0, .nan]", ":5:28: mount.position[2]: expected a finite number"),
        ("rpy_deg: [0, 90, 0]", "roll: 3", ":5:32: mount.roll: this key is not known"),
        ("rpy_deg: [0, 90, 0]", "rpy_deg: [0, 9, 0], rpy: [0, 0, 0]",
         ":5:1: mount: expected one of rpy, rpy_deg, got rpy and rpy_deg"),
        ("shape: cone", "shape: tube", ":7:5: keepouts[0]: expected one of 'sphere', 'box'"),
        ("shape: cone, ", "", ":7:5: keepouts[0]: its key 'shape' is missing"),
        ("length: 1.5", "length: yes", ":7:31: keepouts[0].length: expected a valid number"),
        ("angle_deg: 60", "angle_deg: 200", ":7:5: keepouts[0]: `angle`: expected an opening"),
        ("frame: world", "frame: wold", "keepout"),
        ("[0, 10, 90]", "[0, 10, [90]]", ":9:51: vehicle.rpy_deg[2]: expected a valid number"),
        ("[1, 1, 0]", "[1, -1, 0]", ":9:73: vehicle.rpy_std_deg[1]: expected greater than or"),
        ("[1.0, 2.9, -50.2]", "[1.0, 2.9]", ":11:5: targets[0][2]: it is missing"),
        ("point: [0.4", "on_bottom: [0.4", ":12:18: targets[1].on_bottom"),
        ("name: port, ", "", None),
        ("targets:", "target:", ":10:1: target: this key is not known"),
        ("arm:\n", "arm: panda\nx:\n", ":1:1: arm: expected a section of keys and values"),
    ],
)  # fmt: skip
def test_a_mistake_is_reported_with_its_line_and_column(old, new, expected, scenario_file):
    assert old in SMALL
    path = scenario_file(SMALL.replace(old, new, 1))
    if expected is None:
        assert bathyal.read_scenario(path).target_names == ["1", "2"]
    else:
        assert expected in refused(path)


def test_all_mistakes_of_the_schema_are_listed_in_the_order_of_the_file(scenario_file):
    text = SMALL.replace("1.5", "-1").replace("0.6, 0.4", "0, 0.4").replace("port", "''")
    lines = refused(scenario_file(text)).splitlines()
    assert [re.search(r":(\d+):", line)[1] for line in lines] == ["4", "7", "12"]


HOSTILE = {
    "code": ("arm: !!python/object/apply:os.system ['touch broken']", ":1:6: tags are refused"),
    "own tag": ("arm: !robot {name: panda}", ":1:6: tags are refused, got '!robot'"),
    "harmless tag": ("arm: !!str panda", ":1:6: tags are refused"),
    "bomb": (
        "a: &a [x, x, x, x, x, x, x, x, x]\n"
        + "".join(
            f"{chr(98 + k)}: &{chr(98 + k)} [{', '.join(9 * ['*' + chr(97 + k)])}]\n"
            for k in range(12)
        ),
        "values, got more",
    ),
    "chain": (
        "a0: &a0 [x]\n" + "".join(f"a{k + 1}: &a{k + 1} [*a{k}]\n" for k in range(80)),
        "levels, got more",
    ),
    "itself": ("arm: &a {name: *a}", ":1:16: anchor &a contains itself"),
    "unknown alias": ("arm: *b", "b"),
    "deep": ("arm: " + 60 * "[" + 60 * "]", "levels, got more"),
    "very deep": ("[" * 100_000, "levels, got more"),
    "twice": ("arm: {name: panda}\narm: {name: ur10}", ":2:1: key 'arm' comes twice"),
    "merge": ("base: &b {name: panda}\narm: {<<: *b}", "this key is not known"),
    "two documents": ("arm: {name: panda}\n---\narm: {name: ur10}", "got a second"),
    "no YAML": ("arm: {name: panda", ":1:"),
    "tab": ("arm:\n\tname: panda", ":2:1: not readable YAML"),
    "control": ("arm: \x00", "not readable YAML"),
    "list as key": ("? [a, b]\n: c", ":1:3: expected a word as key"),
    "a word": ("panda", ":1:1: the document: expected a section of keys and values"),
    "nothing": ("# nothing", "the file holds no value"),
    "digits": ("arm: {name: panda, radius: " + 5000 * "9" + "}", ":1:20: arm.radius"),
    "infinite": ("arm: {name: panda, radius: .inf}", "arm.radius: expected a finite number"),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_files_are_refused(name, scenario_file, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text, expected = HOSTILE[name]
    message = refused(scenario_file(text))
    assert expected in message
    assert message.startswith(str(tmp_path))
    assert len(message) < 2000
    assert os.listdir(tmp_path) == ["scenario.yaml"]


def test_files_that_are_no_text_are_refused(tmp_path):
    path = tmp_path / "scenario.yaml"
    path.write_bytes(b"arm: \xff\xfe")
    assert "bytes that are not UTF-8" in refused(path)
    path.write_bytes(b"")
    assert "the file is empty" in refused(path)
    path.unlink()
    with pytest.raises(FileNotFoundError):
        bathyal.read_scenario(path)
    os.mkfifo(path)
    assert "regular file" in refused(path)


def test_a_gigabyte_is_refused_before_it_is_read(tmp_path):
    path = tmp_path / "scenario.yaml"
    with open(path, "wb") as stream:
        stream.write(b"arm: &a {name: panda}\n")
        stream.truncate(1 << 30)
    assert "at most 4,194,304 bytes, got 1,073,741,824" in refused(path)


def test_aliases_are_taken_and_counted(scenario_file):
    path = scenario_file("a: &a [1, 2.5e-3, no, ~, true, '1', 0x10, .5]\nb: [*a, *a]")
    read = read_yaml(path)
    row = [1, 0.0025, "no", None, True, "1", "0x10", 0.5]
    assert read.value == {"a": row, "b": [row, row]}
    assert read.where(("b", 1, 2)) == f"{path}:1:19"
    assert read.where(("b", 5)) == f"{path}:2:1"
    many = scenario_file("a: &a [1, 1]\nb: [" + ", ".join(66_600 * ["*a"]) + "]", "many.yaml")
    assert len(read_yaml(many).value["b"]) == 66_600
    assert yaml_documents.MOST_VALUES == 200_000


def test_sizes_that_no_vehicle_has_are_reported(tmp_path):
    write_example(tmp_path)
    path = tmp_path / "scenario.yaml"
    text = path.read_text()
    hull = bathyal.read_mesh(tmp_path / "hull.stl")
    assert bathyal.read_scenario(path).warnings == []
    for factor, expected in ((1e3, "millimetres taken for metres"), (1e-2, "scale: 1000")):
        bathyal.write_mesh(
            bathyal.TriangleMesh(np.asarray(hull.vertices) * factor, hull.triangles),
            tmp_path / "hull.stl",
        )
        warning = bathyal.read_scenario(path).warnings[0]
        assert expected in warning
        assert warning.startswith(f"{path}:13:8: the hull is ")
        scaled = text.replace("mesh: hull.stl", f"mesh: hull.stl, scale: {1 / factor}")
        path.write_text(scaled)
        assert bathyal.read_scenario(path).warnings == []
        path.write_text(text)
    far = np.asarray(hull.vertices, float) + np.array([4.3e5, 6.2e6, 0])
    bathyal.write_mesh(bathyal.TriangleMesh(far, hull.triangles), tmp_path / "far.ply")
    path.write_text(text.replace("hull.stl", "far.ply"))
    assert any(
        "6.215e+06 m from the origin" in line for line in bathyal.read_scenario(path).warnings
    )
    path.write_text(text.replace("position: [0, 0, -50.2]", "position: [431000, 6172000, -50.2]"))
    assert any(
        "nearest point of the scene" in line for line in bathyal.read_scenario(path).warnings
    )


def test_a_hull_that_is_not_closed_is_reported(tmp_path):
    write_example(tmp_path)
    hull = bathyal.read_mesh(tmp_path / "hull.stl")
    half = np.asarray(hull.triangles)[: len(hull.triangles) // 2]
    bathyal.write_mesh(bathyal.TriangleMesh(hull.vertices, half), tmp_path / "hull.stl")
    warnings = bathyal.read_scenario(tmp_path / "scenario.yaml").warnings
    assert any(":13:8: " in line and "edges" in line for line in warnings)
    one = bathyal.TriangleMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    bathyal.write_mesh(one, tmp_path / "hull.stl")
    assert ":13:8: hull.mesh: `mesh`: expected a surface" in refused(tmp_path / "scenario.yaml")


def test_a_keep_out_that_covers_the_base_refuses_the_start(scenario_file):
    from bathyal.workspace.check_job import check_scenario

    text = SMALL.replace("shape: cone, length: 1.5, angle_deg: 60", "shape: sphere, radius: 2")
    text = text.replace("pose: {position: [0, 0, 0.2]}", "center: [0.7, 0, 0]")
    found = check_scenario(bathyal.read_scenario(scenario_file(text)))
    assert not found.start_free
    assert str(found.brief).startswith("Refused: the arm may not begin where it is.")


def test_a_trajectory_of_the_vehicle_is_read(scenario_file):
    text = re.sub(
        "vehicle: .*",
        "vehicle:\n  trajectory:\n    - {time: 0, position: [0, 0, -50]}\n"
        "    - {time: 4, position: [2, 0, -50]}",
        SMALL,
    )
    pose = bathyal.read_scenario(scenario_file(text)).workspace.vehicle_pose
    np.testing.assert_allclose(pose.at(1.0)[:3, 3], [0.5, 0, -50])
    both = text.replace("vehicle:\n", "vehicle:\n  position: [0, 0, 1]\n")
    assert "expected a pose or a trajectory" in refused(scenario_file(both))


def test_every_key_is_on_the_page_of_the_format():
    from pathlib import Path

    from bathyal.workspace import sections

    page = Path(__file__).parents[3] / "docs" / "formats" / "scenario.md"
    text = page.read_text(encoding="utf-8")
    models = [
        model
        for model in vars(sections).values()
        if isinstance(model, type) and issubclass(model, sections.Section)
    ]
    assert len(models) > 15
    keys = {key for model in models for key in model.model_fields}
    generated = set(sections.SeabedSection.model_fields) - {"size", "spacing", "center", "seed"}
    absent = {key for key in keys - generated if f"`{key.removesuffix('_deg')}`" not in text}
    assert absent == set()


@pytest.mark.parametrize(
    ("text", "where", "words"),
    [
        (
            "arm: {name: panda}\ntargets:\n  - {name: a, point: [1, 0, 0]}\n"
            "  - {name: a, point: [2, 0, 0]}\n",
            "4:", "a name of its own",
        ),
        ("arm: {name: panda}\nkeepouts: [{shape: sphere, radius: 1, frame: lnk}]\n", "2:", "lnk"),
        ('arm: {name: panda}\nhull: {mesh: "a\\0b.stl"}\n', "2:", "null"),
    ],
)  # fmt: skip
def test_what_the_engine_would_not_place_is_placed(tmp_path, text, where, words) -> None:
    path = tmp_path / "scenario.yaml"
    path.write_text(text)
    with pytest.raises((bathyal.Error, OSError), match=words) as caught:
        bathyal.read_scenario(path)
    assert f"scenario.yaml:{where}" in str(caught.value)
