# SPDX-License-Identifier: BSD-3-Clause
"""The command line as a person uses it: files, words, exit codes."""

from __future__ import annotations

import json
import os
import pathlib
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from typer.testing import CliRunner

import bathyal
import scenes
from bathyal import cli, options
from bathyal.examples import write_aims
from bathyal.vtp import read_vtp

FILES = ["path.csv", "path.json", "path.vtp", "plan.html", "plan.png", "seabed.vtp"]
CORAL = (
    pathlib.Path(__file__).parents[2] / "../shared/data/seabed/coral-mcap/mcap_derived.ply"
).resolve()


@pytest.fixture(scope="module")
def job(tmp_path_factory):
    """A small survey and aims for it, as files."""
    folder = tmp_path_factory.mktemp("job")
    mesh = scenes.bottom(offset=scenes.UTM).meshes[0]
    used = np.unique(mesh.triangles)
    points = mesh.vertices[used]
    points = points[(points[:, 0] < 621_009) | (points[:, 0] > 621_011)]
    bathyal.write_cloud(bathyal.PointCloud(points, crs="EPSG:32602"), folder / "survey.xyz")
    write_aims(scenes.aims(offset=scenes.UTM), folder / "aims.csv")
    write_aims(scenes.aims(offset=scenes.UTM, miss=False), folder / "found.csv")
    return folder


def bathyal_run(*arguments: object, cwd: pathlib.Path | None = None) -> subprocess.CompletedProcess:
    """`bathyal …` in a process of its own."""
    program = "from bathyal.cli import app; app()"
    return subprocess.run(
        [sys.executable, "-c", program, *map(str, arguments)],
        capture_output=True, text=True, timeout=120, cwd=cwd, stdin=subprocess.DEVNULL,
        env={**os.environ, "COLUMNS": "100", "NO_COLOR": "1"},
    )  # fmt: skip


def run(capsys, *arguments: object) -> tuple[int, str, str]:
    """The same within this process: exit code, stdout, stderr."""
    capsys.readouterr()
    with pytest.raises(SystemExit) as left:
        cli.app([str(argument) for argument in arguments])
    out, err = capsys.readouterr()
    return left.value.code, out, err


# plan ---------------------------------------------------------------------------------------------


def test_plan_writes_everything(job, tmp_path):
    done = bathyal_run(
        "plan", job / "survey.xyz", "--aims", job / "aims.csv", "--out", tmp_path / "plan",
        "--step", 0.3, "--standoff", 0.1, "--max-edge", 1.2, "--json",
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    told = json.loads(done.stdout)
    assert sorted(os.listdir(tmp_path / "plan")) == FILES
    assert [pathlib.Path(file).name for file in told["files"]] == FILES
    assert (told["aims"], told["targets"]) == (4, 3)
    assert told["gaps"] == 1
    assert told["warnings"]

    path = json.loads((tmp_path / "plan/path.json").read_text())
    assert path["crs"] == "EPSG:32602"
    assert path["settings"]["path"] == {"step": 0.3, "standoff": 0.1}
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


def test_warnings_are_told_and_do_not_fail(job, tmp_path, capsys):
    code, out, err = run(
        capsys, "plan", job / "survey.xyz", "--aims", job / "aims.csv", "-o", tmp_path, "--quiet",
        "--max-edge", 1.2,
    )  # fmt: skip
    assert code == 0
    assert out == ""
    assert err.count("warning:") >= 2


def test_people_are_told_what_was_done(job, tmp_path, capsys):
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
    assert sorted(os.listdir(out)) == [name for name in FILES if name != "seabed.vtp"]
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
    code, _, err = run(capsys, *common, "-o", tmp_path / "b", "--vertical", "vehicle")
    assert code == 2
    assert "--world-from-vehicle" in err


# the other commands -------------------------------------------------------------------------------


def test_survey_can_be_planned_over(tmp_path, capsys):
    files = (tmp_path / "survey.xyz", tmp_path / "aims.csv")
    small = ["--length", 20, "--width", 14]
    assert run(capsys, "survey", files[0], "--aims-out", files[1], "--seed", 5, *small)[0] == 0
    first = files[0].read_bytes()
    run(capsys, "survey", files[0], "--seed", 5, *small)
    assert files[0].read_bytes() == first
    run(capsys, "survey", files[0], "--seed", 6, *small)
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


# words and codes ----------------------------------------------------------------------------------


def test_help_has_examples_and_defaults():
    for command in ("plan", "triangulate", "info", "survey"):
        shown = CliRunner().invoke(cli.app, [command, "--help"], terminal_width=100)
        assert shown.exit_code == 0
        assert f"bathyal {command} " in shown.output
        assert "Exit codes" in shown.output
    shown = CliRunner().invoke(cli.app, ["plan", "--help"], terminal_width=120).output
    assert shown.count("default:") >= 12


def test_every_default_in_the_help_is_the_engines():
    speed = float(options.engine_default(bathyal.plan_toolpath, "speed"))
    flat = bathyal.Plane((0, 0, 1), -5.0)
    long = [[0, 0, 0, 0, 0, -1], [500, 0, 0, 0, 0, -1]]
    path = bathyal.plan_toolpath(flat, long)
    assert path.time[-1] == pytest.approx(500 / speed, rel=0.05)
    with pytest.raises(LookupError):
        options.engine_default(bathyal.plan_toolpath, "no_such_keyword")


@pytest.mark.parametrize(
    ("arguments", "code", "says"),
    [
        (["plan"], 2, "CLOUD"),
        (["plan", "survey.xyz", "--out", "o"], 2, "--aims"),
        (["plan", "survey.xyz", "--aims", "aims.csv"], 2, "--out"),
        (["plan", "survey.xyz", "--aims", "aims.csv", "-o", "o", "--step", "wide"], 2, "--step"),
        (["plan", "survey.xyz", "--aims", "aims.csv", "-o", "o", "--no-such"], 2, "--no-such"),
        (["nothing"], 2, "nothing"),
        (["plan", "missing.xyz", "--aims", "aims.csv", "-o", "o"], 1, "missing.xyz"),
        (["plan", "survey.xyz", "--aims", "missing.csv", "-o", "o"], 1, "missing.csv"),
        (["plan", "survey.xyz", "--aims", "aims.csv", "-o", "o", "--speed", "-1"], 1, "speed"),
        (["plan", "survey.xyz", "--aims", "aims.csv", "-o", "o", "--missed", "refuse"], 1, "aim"),
        (["plan", "broken.xyz", "--aims", "aims.csv", "-o", "o"], 1, "broken.xyz"),
        (["plan", "empty.ply", "--aims", "aims.csv", "-o", "o"], 1, "empty"),
        (["plan", "survey.xyz", "--aims", "broken.csv", "-o", "o"], 1, "broken.csv"),
        (["plan", "survey.xyz", "--aims", "aims.csv", "-o", "file"], 1, "file"),
        (["info", "survey.doc"], 1, "survey.doc"),
        (["triangulate", "survey.xyz", "-o", "nowhere/seabed.vtp"], 1, "nowhere"),
        (["triangulate", "survey.xyz", "-o", "s.vtp", "--max-edge", "wide"], 2, "max-edge"),
        (["survey", "nowhere/survey.xyz", "--length", "5", "--width", "5"], 1, "nowhere"),
    ],
)
def test_refusals_are_one_line_and_leave_nothing(
    job, tmp_path, capsys, monkeypatch, arguments, code, says
):
    for name in ("survey.xyz", "aims.csv"):
        (tmp_path / name).write_bytes((job / name).read_bytes())
    (tmp_path / "broken.xyz").write_text("1 2 3\n4 5 six\n")
    (tmp_path / "broken.csv").write_text("px_m,py_m,pz_m,dx,dy,dz\n1,2,3,4,5\n")
    (tmp_path / "empty.ply").write_text("")
    (tmp_path / "survey.doc").write_text("1 2 3\n")
    (tmp_path / "file").write_text("")
    before = sorted(os.listdir(tmp_path))
    monkeypatch.chdir(tmp_path)
    got, out, err = run(capsys, *arguments)
    assert got == code, err
    assert says in err
    assert "Traceback" not in err + out
    if code == 1:
        assert err.count("\n") == 1, err
    assert sorted(os.listdir(tmp_path)) == before


def test_exit_codes_of_the_program(job, tmp_path):
    assert bathyal_run("--version").stdout.startswith("bathyal ")
    assert bathyal_run().returncode == 0
    assert bathyal_run("plan", job / "survey.xyz", "-o", tmp_path).returncode == 2
    failed = bathyal_run("info", tmp_path / "missing.xyz")
    assert failed.returncode == 1
    assert failed.stdout == ""
    assert "Traceback" not in failed.stderr
    assert "Traceback" in bathyal_run("--debug", "info", tmp_path / "missing.xyz").stderr


def test_interrupted_plan_leaves_the_folder_as_it_was(job, tmp_path, monkeypatch, capsys):
    out = tmp_path / "plan"
    common = ["plan", job / "survey.xyz", "--aims", job / "aims.csv", "-o", out]
    run(capsys, *common, "--quiet")
    before = {name: (out / name).read_bytes() for name in os.listdir(out)}

    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("bathyal.figures.write_png", interrupted)
    code, _, err = run(capsys, *common, "--standoff", 0.5)
    assert code == 130
    assert "interrupted" in err
    assert {name: (out / name).read_bytes() for name in os.listdir(out)} == before
    code, _, _ = run(capsys, *common[:-1], tmp_path / "new")
    assert code == 130
    assert not (tmp_path / "new").exists()


def test_signal_ends_the_program_cleanly(job, tmp_path):
    """Ctrl-C while it works, in a process of its own: no half-written file, no traceback."""
    program = (
        "import signal, time, bathyal.figures, bathyal.cli\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"  # a background job ignores it
        "def slow(*_):\n    print('drawing', flush=True)\n    time.sleep(60)\n"
        "bathyal.figures.write_png = slow\nbathyal.cli.app()\n"
    )
    child = subprocess.Popen(
        [sys.executable, "-c", program, "plan", job / "survey.xyz", "--aims", job / "aims.csv",
         "-o", tmp_path / "plan"],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    assert child.stdout.readline() == "drawing\n"
    time.sleep(0.05)
    child.send_signal(signal.SIGINT)
    _, err = child.communicate(timeout=30)
    assert child.returncode == 130
    assert "Traceback" not in err
    assert not (tmp_path / "plan").exists()


def test_pose_turns_as_it_says():
    pose = options.pose_matrix((1.0, 2.0, -3.0, 0.0, 10.0, 90.0))
    nose = pose[:3, :3] @ [1, 0, 0]
    down = np.radians(10)
    np.testing.assert_allclose(nose, [0, np.cos(down), -np.sin(down)], atol=1e-12)
    np.testing.assert_allclose(pose[:3, 3], [1, 2, -3])
    port_up = options.pose_matrix((0, 0, 0, 10.0, 0, 0))[:3, :3] @ [0, 1, 0]
    assert port_up[2] > 0
    assert options.pose_matrix(None) is None


def test_columns_and_lengths():
    assert options.column_list("0, 1,2") == [0, 1, 2]
    assert options.column_list("easting,northing,depth") == ["easting", "northing", "depth"]
    assert options.length_or_none("none") == np.inf
    assert options.length_or_none("2.5") == 2.5
