# SPDX-License-Identifier: BSD-3-Clause
"""bathyal scenario example, check, reach and sample."""

from __future__ import annotations

import csv
import json
import re
from pathlib import Path

import numpy as np
import pytest
import yaml

import bathyal
from bathyal.view.brief import MOST_NUMBERS
from tests.support.command import run


@pytest.fixture
def scene(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, out, err = run(capsys, "scenario", "example", "scene")
    assert (code, err) == (0, "")
    assert out.split() == ["written", *(f"scene/{n}" for n in NAMES)]
    return tmp_path / "scene" / "scenario.yaml"


NAMES = ("scenario.yaml", "hull.stl", "seabed.ply")


def add_target(scene, text):
    scene.write_text(scene.read_text().replace("targets:\n", f"targets:\n  - {text}\n"))


def test_the_example_is_the_same_for_the_same_seed(scene, capsys, tmp_path):
    first = [(scene.parent / name).read_bytes() for name in NAMES]
    run(capsys, "scenario", "example", "again", "--quiet")
    assert [(tmp_path / "again" / name).read_bytes() for name in NAMES] == first
    run(capsys, "scenario", "example", "other", "--seed", 4)
    assert (tmp_path / "other" / "seabed.ply").read_bytes() != first[2]


def test_check_says_each_target_in_a_line(scene, capsys):
    code, out, err = run(capsys, "check", scene)
    assert (code, err) == (0, "")
    lines = out.splitlines()
    assert lines[0] == "Free: all 2 targets."
    assert lines[1].startswith("  start  clear by 0.")
    assert lines[2] == "  ahead  free, on a surface"
    assert lines[-1] == "Next: plan the sample: bathyal sample."


def test_check_refuses_and_says_why(scene, capsys):
    add_target(scene, "{name: inside, point: [0.2, 0, -50.2]}")
    code, out, _ = run(capsys, "check", scene)
    assert code == 3
    assert out.startswith("Refused: 1 of 3 targets is not free.\n")
    assert re.search(r"^  inside  inside the hull, 0\.2\d\d m deep$", out, re.MULTILINE)
    assert "Next: move the target" in out
    add_target(scene, "{name: beam, point: [0.1, 0, -49.6]}")
    add_target(scene, "{name: far, point: [9, 0, -50]}")
    add_target(scene, "{name: deep, point: [1.5, 0, -52]}")
    code, out, _ = run(capsys, "check", scene)
    assert out.startswith("Refused: 4 of 6 targets are not free.\n")
    assert len(out.splitlines()) == 1 + MOST_NUMBERS + 1
    code, text, _ = run(capsys, "check", scene, "--json", "--out", "targets.csv")
    assert code == 3
    known = {row["name"]: row for row in json.loads(text)["targets"]}
    assert {name: row["status"] for name, row in known.items()} == {
        "deep": "ground", "far": "unreachable", "beam": "keepout", "inside": "hull",
        "ahead": "free", "port": "free",
    }  # fmt: skip
    assert known["beam"]["keepout"] == "modem beam"
    assert known["far"]["q"] is None
    rows = list(csv.DictReader(Path("targets.csv").read_text().splitlines()))
    assert [row["status"] for row in rows] == [known[row["target"]]["status"] for row in rows]
    assert float(rows[1]["x_m"]) == 9


def test_check_refuses_a_start_that_touches(scene, capsys):
    scene.write_text(
        scene.read_text().replace("q_start_deg: [0, -45, 50]", "q_start: [0, -1.5, 0]")
    )
    code, out, _ = run(capsys, "check", scene)
    assert code == 3
    assert out.startswith(
        "Refused: the arm may not begin where it is.\n  start  in contact, link_3 "
    )
    scene.write_text(scene.read_text().replace("[0, -1.5, 0]", "[0, 0, 3]"))
    assert "start  outside the joints' limits" in run(capsys, "check", scene)[1]


@pytest.mark.parametrize("command", ["check", "sample", "reach"])
def test_a_broken_scenario_is_one_line_with_its_place(command, scene, capsys, tmp_path):
    out = [] if command == "check" else ["--out", "results"]
    scene.write_text(scene.read_text().replace("length: 1.2", "length: -1.2"))
    code, text, err = run(capsys, command, scene, *out)
    assert (code, text) == (1, "")
    place = re.escape(str(scene))
    assert re.fullmatch(
        rf"error: {place}:\d+:\d+: keepouts\[0\].length: expected greater than 0, got -1.2\n", err
    )
    assert run(capsys, command, tmp_path / "none.yaml", *out)[0] == 1
    assert not (tmp_path / "results").exists()


def test_warnings_are_printed_and_fail_nothing(scene, capsys):
    scene.write_text(scene.read_text().replace("{mesh: hull.stl}", "{mesh: hull.stl, scale: 1e-2}"))
    code, out, err = run(capsys, "check", scene)
    assert code == 0, out
    assert "warning: " in err
    assert "the hull is 0.016 m long" in err


def test_files_elsewhere_must_be_asked_for(scene, capsys, tmp_path):
    (scene.parent / "hull.stl").rename(tmp_path / "hull.stl")
    scene.write_text(scene.read_text().replace("hull.stl", "../hull.stl"))
    code, _, err = run(capsys, "check", scene)
    assert code == 1
    assert "lies outside" in err
    assert run(capsys, "check", scene, "--inside", tmp_path)[0] == 0


def test_reach_writes_a_map(scene, capsys, tmp_path):
    code, out, err = run(capsys, "reach", scene, "--voxel", "20cm", "-o", "reach")
    assert (code, err) == (0, "")
    assert out.startswith("Reached: ")
    assert "Written to reach: reach.json reach.npz reach.png" in out
    known = json.loads((tmp_path / "reach" / "reach.json").read_text())
    assert known["voxel_m"] == 0.2
    assert 0 < known["free_m3"] <= known["reached_m3"] < 4 / 3 * np.pi * 1.35**3
    assert known["targets"] == {"ahead": "free", "port": "free"}
    kept = bathyal.read_reach_map(tmp_path / "reach" / "reach.npz")
    assert np.count_nonzero(kept.reached) == known["reached_voxels"]


def test_sample_writes_the_motion(scene, capsys, tmp_path):
    code, out, err = run(capsys, "sample", scene, "-o", "sample", "--frames", 2)
    assert (code, err) == (0, "")
    lines = out.splitlines()
    assert re.fullmatch(r"Planned: a sample at ahead in \d+\.\d s\.", lines[0])
    assert lines[1].startswith("  phases          approach ")
    assert lines[-2] == "Next: watch the motion: open motion.html."
    files = "motion.csv motion.html motion.png summary.json trajectory.yaml"
    assert lines[-1] == f"Written to sample: {files}"
    folder = tmp_path / "sample"
    frames = sorted(file.name for file in (folder / "frames").glob("*.png"))
    assert frames == ["0001.png", "0002.png"]
    known = json.loads((folder / "summary.json").read_text())
    assert known["status"] == "planned"
    names = ["approach", "press", "grab", "lift", "transport"]
    assert [phase["name"] for phase in known["phases"]] == names
    assert known["clearance_m"] >= 0
    rows = list(csv.DictReader((folder / "motion.csv").read_text().splitlines()))
    trajectory = yaml.safe_load((folder / "trajectory.yaml").read_text())
    assert len(trajectory["points"]) == len(rows)
    assert trajectory["joint_names"] == ["joint_1", "joint_2", "joint_3"]
    q = np.array([[float(row[f"joint_{k}_rad"]) for k in (1, 2, 3)] for row in rows])
    np.testing.assert_array_equal(q, [point["positions"] for point in trajectory["points"]])
    np.testing.assert_allclose(q[0], np.radians([0, -45, 50]))
    workspace = bathyal.read_scenario(scene).workspace
    tip = workspace.arm.forward(q)[:, :3, 3]
    np.testing.assert_allclose(
        tip, [[float(row[f"tip_{axis}_m"]) for axis in "xyz"] for row in rows], atol=1e-12
    )
    deepest = np.argmin(tip[:, 2])
    assert rows[deepest]["phase"] in ("press", "grab", "lift")
    assert known["depth_m"] == pytest.approx(0.03)
    assert known["contact_force_N"] == pytest.approx(120)
    assert max(float(row["contact_force_N"]) for row in rows) == pytest.approx(120)


def test_the_same_scenario_gives_the_same_bytes(scene, capsys, tmp_path):
    for out in ("one", "two"):
        assert run(capsys, "sample", scene, "-o", out, "--frames", 0, "--quiet")[0] == 0
    for file in (tmp_path / "one").iterdir():
        assert file.read_bytes() == (tmp_path / "two" / file.name).read_bytes(), file.name
    assert not (tmp_path / "one" / "frames").exists()


def test_a_target_that_is_refused_is_no_plan(scene, capsys, tmp_path):
    add_target(scene, "{name: inside, point: [0.2, 0, -50.2]}")
    code, out, _ = run(capsys, "sample", scene, "--target", "inside", "-o", "sample")
    assert code == 3
    assert out.startswith("Refused: the target is where the tool may not be.\n")
    assert [
        file.name for file in (tmp_path / "sample").glob("*.*") if "manif" not in file.name
    ] == ["summary.json"]
    assert json.loads((tmp_path / "sample" / "summary.json").read_text())["status"] == "forbidden"
    code, _, err = run(capsys, "sample", scene, "--target", "under", "-o", "sample")
    assert code == 1
    assert "`target`: expected one of inside, ahead, port, got 'under'" in err
