# SPDX-License-Identifier: BSD-3-Clause
"""What the command line refuses, how it says so, and what an interrupted run leaves."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time

import pytest

from tests.support.command import bathyal_run, run


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
        (["soundings", "nowhere/survey.xyz", "--length", "5", "--width", "5"], 1, "nowhere"),
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

    monkeypatch.setattr("bathyal.view.figure.write_png", interrupted)
    code, _, err = run(capsys, *common, "--standoff", 0.5)
    assert code == 130
    assert "interrupted" in err
    assert {name: (out / name).read_bytes() for name in os.listdir(out)} == before
    code, _, _ = run(capsys, *common[:-1], tmp_path / "new")
    assert code == 130
    assert not (tmp_path / "new").exists()


@pytest.mark.parametrize(("number", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_signal_ends_the_program_cleanly(job, tmp_path, number, status):
    """Ctrl-C or SIGTERM while it works, in its own process: no half-written file, no traceback."""
    program = (
        "import signal, time, bathyal.view.figure, bathyal.cli\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"  # a background job ignores it
        "def slow(*_):\n    print('drawing', flush=True)\n    time.sleep(60)\n"
        "bathyal.view.figure.write_png = slow\nbathyal.cli.app()\n"
    )
    child = subprocess.Popen(
        [sys.executable, "-c", program, "plan", job / "survey.xyz", "--aims", job / "aims.csv",
         "-o", tmp_path / "plan"],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    assert child.stdout.readline() == "drawing\n"
    time.sleep(0.05)
    child.send_signal(number)
    _, err = child.communicate(timeout=30)
    assert child.returncode == status
    assert "Traceback" not in err
    assert not (tmp_path / "plan").exists()
