# SPDX-License-Identifier: BSD-3-Clause
"""bathyal plan: what it writes and says."""

from __future__ import annotations

import json
import os
import pathlib

import numpy as np
import pytest

import bathyal
from bathyal.cli import values
from bathyal.io.formats.vtp.reader import read_vtp
from bathyal.io.manifest import NAME
from bathyal.toolpath.example_aims import write_aims
from tests.support import scenes
from tests.support.command import FILES, bathyal_run, run

CORAL = (
    pathlib.Path(__file__).parents[3] / "../shared/data/seabed/coral-mcap/mcap_derived.ply"
).resolve()


def test_plan_writes_everything(job, tmp_path):
    done = bathyal_run(
        "plan", job / "survey.xyz", "--aims", job / "aims.csv", "--out", tmp_path / "plan",
        "--step", 0.3, "--standoff", 0.1, "--offset", "plain", "--max-edge", 1.2, "--json",
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    told = json.loads(done.stdout)
    assert sorted(os.listdir(tmp_path / "plan")) == sorted([*FILES, NAME])
    assert [pathlib.Path(file).name for file in told["files"]] == FILES
    assert (told["aims"], told["targets"]) == (4, 3)
    assert told["gaps"] == 1
    assert told["warnings"]

    path = json.loads((tmp_path / "plan/path.json").read_text())
    assert path["crs"] == "EPSG:32602"
    assert path["settings"]["path"] == {"step": 0.3, "standoff": 0.1, "offset": "plain"}
    assert path["settings"]["bottom"]["triangulate"] == {"max_edge": 1.2}
    assert path["provenance"]["input"]["file"] == "survey.xyz"
    assert path["provenance"]["cleaning"]["after"] == told["soundings"]
    assert path["warnings"] == told["warnings"]
    assert read_vtp(tmp_path / "plan/seabed.vtp").field_data["crs"].item() == "EPSG:32602"
    assert len(path["path"]["time_s"]) == told["samples"]
    assert path["path"]["arc_length_m"][-1] == told["length_m"]


def test_plan_is_what_the_functions_give(job, tmp_path, capsys):
    code, _, err = run(
        capsys, "plan", job / "survey.xyz", "--aims", job / "found.csv", "-o", tmp_path
    )
    assert code == 0, err
    seabed = bathyal.triangulate(bathyal.read_cloud(job / "survey.xyz"))
    path = bathyal.plan_toolpath(bathyal.Scene(seabed), bathyal.read_aims(job / "found.csv"))
    told = read_vtp(tmp_path / "path.vtp")
    np.testing.assert_array_equal(told.points, path.position)
    np.testing.assert_array_equal(told.point_data["time"], path.time)


def test_plan_twice_gives_the_same_bytes(job, tmp_path, capsys):
    for name in ("a", "b"):
        run(capsys, "plan", job / "survey.xyz", "--aims", job / "aims.csv", "-o", tmp_path / name)
    for name in FILES:
        assert (tmp_path / "a" / name).read_bytes() == (tmp_path / "b" / name).read_bytes(), name


def test_warnings_are_printed_and_do_not_fail(job, tmp_path, capsys):
    code, out, err = run(
        capsys, "plan", job / "survey.xyz", "--aims", job / "aims.csv", "-o", tmp_path, "--quiet",
        "--max-edge", 1.2,
    )  # fmt: skip
    assert code == 0
    assert out == ""
    assert err.count("warning:") >= 2


def test_people_see_what_was_done(job, tmp_path, capsys):
    _, out, _ = run(capsys, "plan", job / "survey.xyz", "--aims", job / "aims.csv", "-o", tmp_path)
    for word in ("soundings", "triangles", "3 of 4 aims", "path length", "duration", "plan.png"):
        assert word in out


def test_plane_way(job, tmp_path, capsys):
    x, y = np.meshgrid(np.arange(0, 20, 0.5), np.arange(0, 12, 0.5))
    z = -30 + 0.05 * x + np.random.default_rng(1).normal(0, 0.01, x.shape)
    flat = np.column_stack([x.ravel(), y.ravel(), z.ravel()])
    bathyal.write_cloud(bathyal.PointCloud(flat), tmp_path / "flat.xyz")
    write_aims(scenes.aims(miss=False), tmp_path / "aims.csv")
    out = tmp_path / "out"
    code, text, err = run(
        capsys, "plan", tmp_path / "flat.xyz", "--aims", tmp_path / "aims.csv", "-o", out,
        "--plane", "--json",
    )  # fmt: skip
    assert code == 0, err
    assert json.loads(text)["warnings"] == []
    assert sorted(os.listdir(out)) == sorted({*FILES, NAME} - {"seabed.vtp"})
    plane = json.loads((out / "path.json").read_text())["provenance"]["plane"]
    assert plane["flat"]
    normal = np.array([-0.05, 0, 1]) / np.hypot(1, 0.05)
    assert plane["normal"] == pytest.approx(normal, abs=1e-3)
    code, text, _ = run(
        capsys, "plan", job / "survey.xyz", "--aims", job / "found.csv", "-o", tmp_path / "rough",
        "--plane", "--json",
    )  # fmt: skip
    assert code == 0
    assert any("not flat" in warning for warning in json.loads(text)["warnings"])


def test_mesh_is_planned_over_as_given(tmp_path, capsys):
    mesh = scenes.bottom().meshes[0]
    write_aims(scenes.aims(miss=False), tmp_path / "aims.csv")
    for suffix, flag in ((".ply", []), (".stl", []), (".vtp", ["--mesh"])):
        bathyal.write_mesh(mesh, tmp_path / f"bottom{suffix}")
        code, text, err = run(
            capsys, "plan", tmp_path / f"bottom{suffix}", "--aims", tmp_path / "aims.csv",
            "-o", tmp_path / suffix, "--json", *flag,
        )  # fmt: skip
        assert code == 0, err
        told = json.loads(text)
        assert (told["soundings"], told["triangles"]) == (0, len(mesh.triangles))
    code, text, _ = run(
        capsys, "plan", tmp_path / "bottom.ply", "--cloud", "--aims", tmp_path / "aims.csv",
        "-o", tmp_path / "points", "--json",
    )  # fmt: skip
    assert code == 0
    assert json.loads(text)["soundings"] == len(mesh.vertices)


@pytest.mark.skipif(not CORAL.exists(), reason="../shared/data is not there")
def test_coral_as_cloud_warns_of_overhangs_and_as_mesh_does_not(tmp_path, capsys):
    mesh = bathyal.read_mesh(CORAL)
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    places = low[:2] + np.array([[0.35, 0.4], [0.5, 0.5], [0.6, 0.6]]) * (high - low)[:2]
    axes = np.column_stack([places, np.full(3, high[2] + 0.3), np.tile([0, 0, -1.0], (3, 1))])
    write_aims(axes, tmp_path / "aims.csv")
    for flag, warned in (("--mesh", False), ("--cloud", True)):
        code, text, err = run(
            capsys, "plan", CORAL, "--aims", tmp_path / "aims.csv", "-o", tmp_path / flag, flag,
            "--json",
        )  # fmt: skip
        assert code == 0, err
        assert any("height field" in warning for warning in json.loads(text)["warnings"]) == warned


def test_vehicle_frame_and_its_vertical(job, tmp_path, capsys):
    east, north = scenes.UTM[:2]
    write_aims([[0, 0, 0, 0, 0, -1], [4, 1, 0, 0, 0, -1]], tmp_path / "aims.csv")
    pose = (east + 3, north + 4, -20, 0, 5, 90)
    common = ["plan", job / "survey.xyz", "--aims", tmp_path / "aims.csv", "--json"]
    code, _, err = run(
        capsys, *common, "-o", tmp_path / "a", "--world-from-vehicle", *pose,
        "--vertical", "vehicle",
    )  # fmt: skip
    assert code == 0, err
    targets = json.loads((tmp_path / "a/path.json").read_text())["targets"]
    # nose down by 5°: what is straight below the vehicle lies behind it, and its nose looks north
    assert targets["point_x_m"][0] == pytest.approx(east + 3, abs=1e-6)
    assert targets["point_y_m"][0] < north + 4 - 0.5


def test_vertical_of_the_vehicle_takes_the_pose_of_the_aims_file(job, tmp_path, capsys):
    """The same aims with the pose on the command line, and in their own file: the same path."""
    aims = [[0, 0, 0, 0, 0, -1], [4, 1, 0, 0, 0, -1]]
    pose = (scenes.UTM[0] + 3, scenes.UTM[1] + 4, -20, 10, 5, 90)
    write_aims(aims, tmp_path / "aims.csv")
    content = {"aims": aims, "world_from_vehicle": values.pose_matrix(pose).tolist()}
    (tmp_path / "aims.json").write_text(json.dumps(content))
    upright = ["--vertical", "vehicle", "--step", 0.3]
    for name, given in (("csv", ["--world-from-vehicle", *pose]), ("json", [])):
        code, _, err = run(
            capsys, "plan", job / "survey.xyz", "--aims", tmp_path / f"aims.{name}",
            "-o", tmp_path / name, *upright, *given,
        )  # fmt: skip
        assert code == 0, err
    told, same = (json.loads((tmp_path / n / "path.json").read_text()) for n in ("csv", "json"))
    assert told["path"] == same["path"]
    assert same["settings"]["path"]["world_from_vehicle"] == content["world_from_vehicle"]
    run(capsys, "plan", job / "survey.xyz", "--aims", tmp_path / "aims.json",
        "-o", tmp_path / "gravity", "--step", 0.3)  # fmt: skip
    gravity = json.loads((tmp_path / "gravity/path.json").read_text())
    assert gravity["targets"] == same["targets"]
    assert gravity["path"] != same["path"]

    code, _, err = run(
        capsys, "plan", job / "survey.xyz", "--aims", tmp_path / "aims.csv", "-o", tmp_path / "no",
        *upright,
    )  # fmt: skip
    assert code == 1
    assert "`world_from_vehicle`: expected" in err
    assert "--world-from-vehicle" in err
