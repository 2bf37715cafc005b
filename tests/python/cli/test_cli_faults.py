# SPDX-License-Identifier: BSD-3-Clause
"""Whatever goes wrong on the command line is one line and an exit status that says which kind."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys

import pytest

from bathyal.io.manifest import NAME
from tests.support.command import FILES, bathyal_run, run
from tests.support.touch_jobs import simulated, table

PLAN_TOUCHES = ["touches", "plan", "--arm", "ur10e", "-o", "p.csv"]
HUGE = str(10**30)


@pytest.mark.parametrize(
    ("arguments", "option"),
    [
        (["soundings", "s.xyz", "--seed", "-1"], "--seed"),
        (["soundings", "s.xyz", "--seed", HUGE], "--seed"),
        (["touches", "example", "t.csv", "--seed", "-1"], "--seed"),
        (["touches", "example", "t.csv", "--seed", HUGE], "--seed"),
        (["touches", "example", "t.csv", "--count", HUGE], "--count"),
        ([*PLAN_TOUCHES, "--count", "21", "--seed", "-1"], "--seed"),
        ([*PLAN_TOUCHES, "--count", "21", "--seed", HUGE], "--seed"),
        ([*PLAN_TOUCHES, "--count", "-1"], "--count"),
        ([*PLAN_TOUCHES, "--count", HUGE], "--count"),
        ([*PLAN_TOUCHES, "--count", "21", "--points", HUGE], "--points"),
        ([*PLAN_TOUCHES, "--count", "21", "--known-distance", f"0,{HUGE}"], "--known-distance"),
    ],
)
def test_whole_numbers_out_of_range_are_wrong_usage(
    tmp_path, capsys, monkeypatch, arguments, option
):
    monkeypatch.chdir(tmp_path)
    code, out, err = run(capsys, *arguments)
    assert code == 2, err
    assert option in err
    assert "Traceback" not in err + out
    assert "incompatible function arguments" not in err
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize(
    ("content", "says"),
    [
        ('{"unit": ["m"], "aims": []}', "`unit`: expected one of"),
        ('{"unit": {}, "aims": []}', "`unit`: expected one of"),
        ('{"frame": ["world"], "aims": []}', "`frame`"),
        ('{"aims": [[1, 2, 3, 0, 0, %s]]}' % ("9" * 5000), "not JSON"),
        ('{"world_from_vehicle": [[1%s]], "aims": []}' % ("0" * 400), "world_from_vehicle"),
    ],
)  # fmt: skip
def test_json_of_wrong_kinds_is_refused_by_name(job, tmp_path, capsys, content, says):
    (tmp_path / "aims.json").write_text(content)
    code, _, err = run(capsys, "plan", job / "survey.xyz", "--aims", tmp_path / "aims.json",
                       "-o", tmp_path / "out")  # fmt: skip
    assert code == 1
    assert err.startswith(f"error: {tmp_path}/aims.json")
    assert says in err
    assert err.count("\n") == 1


@pytest.mark.parametrize(
    ("fault", "says"),
    [
        (MemoryError("Unable to allocate 7 TiB"), "not enough memory: Unable to allocate 7 TiB"),
        (MemoryError(), "not enough memory"),
        (KeyError("joint"), "KeyError: 'joint' (a fault of bathyal itself; --debug shows where)"),
        (TypeError("two\nlines"), "TypeError: two lines (a fault"),
        (RecursionError("too deep"), "RecursionError: too deep (a fault"),
    ],
)
def test_faults_that_nobody_foresaw_are_one_line(job, capsys, monkeypatch, fault, says):
    def faulty(*_, **__):
        raise fault

    monkeypatch.setattr("bathyal.seabed.describe.describe", faulty)
    code, out, err = run(capsys, "info", job / "survey.xyz")
    assert (code, out) == (1, "")
    assert err.startswith(f"error: {says}")
    assert err.count("\n") == 1


# Names that are not UTF-8 -------------------------------------------------------------------------


@pytest.fixture
def latin(tmp_path):
    """A folder whose name is not UTF-8."""
    folder = os.fsencode(tmp_path) + b"/h\xf6he"
    try:
        os.mkdir(folder)
    except OSError:
        pytest.skip("this file system takes only names in UTF-8")
    return type(tmp_path)(os.fsdecode(folder))


def done_well(*arguments, table=False):
    """The JSON; with `table` what people read must come, too."""
    for more in [["--json"], []][: 1 + table]:
        done = bathyal_run(*arguments, *more)
        assert done.returncode == 0, done.stderr
        if more:
            summary = json.loads(done.stdout)
    return summary


def test_a_plan_of_files_whose_names_are_not_utf_8(job, latin):
    survey, aims = latin / os.fsdecode(b"t\xe4.xyz"), latin / os.fsdecode(b"a\xff.csv")
    survey.write_bytes((job / "survey.xyz").read_bytes())
    aims.write_bytes((job / "aims.csv").read_bytes())
    out = latin / os.fsdecode(b"pl\xe4n")
    summary = done_well("plan", survey, "--aims", aims, "--step", 0.3, "-o", out, table=True)
    assert sorted(os.listdir(out)) == sorted([*FILES, NAME])
    assert [os.path.basename(file) for file in summary["files"]] == FILES
    assert all(os.path.exists(file) for file in summary["files"]), "names come back as they are"
    facts = json.loads((out / "path.json").read_bytes().decode("utf-8"))["provenance"]
    assert (facts["input"]["file"], facts["aims"]["file"]) == ("t\\xe4.xyz", "a\\xff.csv")
    assert "t\\xe4.xyz" in (out / "plan.html").read_text(encoding="utf-8")
    assert done_well("info", survey, table=True)["file"] == str(survey)
    seabed = latin / os.fsdecode(b"s\xe4.vtp")
    assert done_well("triangulate", survey, "-o", seabed)["files"] == [str(seabed)]
    survey.write_text("1 2 3\n4 5 six\n")
    broken = bathyal_run("info", survey)
    assert broken.returncode == 1
    assert "t\\xe4.xyz:2: expected a number" in broken.stderr
    assert "Traceback" not in broken.stderr


def test_touches_in_files_whose_names_are_not_utf_8(latin):
    made = simulated()
    touches = table(latin, made).rename(latin / os.fsdecode(b"t\xe4.csv"))
    arm = latin / os.fsdecode(b"\xe4rm.json")
    from bathyal import arms

    arms.ur10e().save(arm)
    known = ["--known-distance", "left,right=350mm"]
    found = done_well("identify", touches, "--arm", arm, *known, "-o", latin / "found",
                      table=True)  # fmt: skip
    assert all(os.path.exists(file) for file in found["files"])
    report = done_well("diagnose", touches, "--arm", arm, *known, "-o", latin / "diagnosis")
    assert all(os.path.exists(file) for file in report["files"])
    assert "t\\xe4.csv" in (latin / "found" / "report.html").read_text(encoding="utf-8")
    example = latin / os.fsdecode(b"\xe4xample.csv")
    assert done_well("touches", "example", example, "--arm", arm)["file"] == str(example)
    planned = latin / os.fsdecode(b"pl\xe4n.csv")
    done_well("touches", "plan", "--arm", arm, "--count", 30, "--points", 2, "-o", planned,
              "--picture", latin / os.fsdecode(b"pl\xe4n.png"))  # fmt: skip
    made = latin / os.fsdecode(b"m\xe4de.xyz")
    aims = latin / os.fsdecode(b"\xe4ims.csv")
    summary = done_well("soundings", made, "--aims-out", aims, "--length", 5, "--width", 5)
    assert summary["files"] == [str(made), str(aims)]


def test_a_terminal_of_few_signs_ends_no_job(job, monkeypatch):
    monkeypatch.setenv("PYTHONIOENCODING", "ascii")
    for more in ([], ["--json"]):
        done = bathyal_run("info", job / "survey.xyz", *more)
        assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["kind"] == "cloud"


# Signals ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("number", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_signals_are_answered_while_the_package_is_imported(number, status):
    program = (
        "import signal, sys, time, bathyal_command\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"  # a background job ignores it
        "class Slow:\n"
        "    def find_spec(self, name, *_):\n"
        "        if name == 'bathyal.cli':\n"
        "            print('importing', flush=True)\n"
        "            time.sleep(60)\n"
        "sys.meta_path.insert(0, Slow())\n"
        "bathyal_command.main()\n"
    )
    child = subprocess.Popen(
        [sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert child.stdout.readline() == "importing\n"
    child.send_signal(number)
    out, err = child.communicate(timeout=30)
    assert (child.returncode, out, err) == (status, "", "")


def test_the_program_is_the_command_that_answers_signals():
    from importlib.metadata import entry_points

    (script,) = entry_points(group="console_scripts", name="bathyal")
    assert script.value == "bathyal_command:main"
