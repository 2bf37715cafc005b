# SPDX-License-Identifier: BSD-3-Clause
"""bathyal soundings, triangulate and info."""

from __future__ import annotations

import json

import pytest

import bathyal
from tests.support import scenes
from tests.support.command import run


def test_survey_can_be_planned_over(tmp_path, capsys):
    files = (tmp_path / "survey.xyz", tmp_path / "aims.csv")
    small = ["--length", 20, "--width", 14]
    assert run(capsys, "soundings", files[0], "--aims-out", files[1], "--seed", 5, *small)[0] == 0
    first = files[0].read_bytes()
    run(capsys, "soundings", files[0], "--seed", 5, *small)
    assert files[0].read_bytes() == first
    run(capsys, "soundings", files[0], "--seed", 6, *small)
    assert files[0].read_bytes() != first
    code, text, err = run(
        capsys, "plan", files[0], "--aims", files[1], "-o", tmp_path / "plan", "--json"
    )
    assert code == 0, err
    told = json.loads(text)
    assert told["targets"] >= 5
    assert told["status"].get("hit", 0) >= 5


def test_triangulate(job, tmp_path, capsys):
    code, text, _ = run(
        capsys, "triangulate", job / "survey.xyz", "--out", tmp_path / "seabed.vtp", "--json",
        "--max-edge", 1.2,
    )  # fmt: skip
    assert code == 0
    mesh = bathyal.read_mesh(tmp_path / "seabed.vtp")
    assert len(mesh.triangles) == json.loads(text)["triangles"]
    assert mesh.crs == "EPSG:32602"
    everything = ["triangulate", job / "survey.xyz", "-o", tmp_path / "all.ply"]
    run(capsys, *everything, "--max-edge", "none")
    assert len(bathyal.read_mesh(tmp_path / "all.ply").triangles) > len(mesh.triangles)


def test_info_of_a_cloud(job, capsys):
    code, text, _ = run(capsys, "info", job / "survey.xyz", "--json")
    assert code == 0
    told = json.loads(text)
    assert told["kind"] == "cloud"
    assert told["soundings"] == len(bathyal.read_cloud(job / "survey.xyz"))
    assert told["bounds_m"]["low"][0] == 621_000
    assert told["spacing_m"] == pytest.approx(0.5, rel=0.2)
    assert told["crs"] == "EPSG:32602"
    assert "EPSG:32602" in run(capsys, "info", job / "survey.xyz")[1]


def test_info_of_a_mesh(tmp_path, capsys):
    mesh = scenes.bottom(hole=False).meshes[0]
    bathyal.write_mesh(mesh, tmp_path / "m.ply")
    code, text, _ = run(capsys, "info", tmp_path / "m.ply", "--json")
    assert code == 0
    told = json.loads(text)
    assert (told["kind"], told["triangle_count"], told["components"]) == ("mesh", 1920, 1)
    assert told["area"] == pytest.approx(bathyal.mesh_report(mesh).area)
    assert "rugosity" in run(capsys, "info", tmp_path / "m.ply")[1]


def test_info_of_few_points(tmp_path, capsys):
    for name, text in (("one", "1 2 3\n"), ("line", "".join(f"{k} {k} -5\n" for k in range(40)))):
        (tmp_path / f"{name}.xyz").write_text(text)
        code, _, err = run(capsys, "info", tmp_path / f"{name}.xyz", "--json")
        assert code == 0, err
