# SPDX-License-Identifier: BSD-3-Clause
"""The run base: what is added comes back, queries, comparisons, two writers, bad input."""

from __future__ import annotations

import dataclasses
import json
import math
import shutil
import sqlite3
import subprocess
import sys

import numpy as np
import pytest

import bathyal
from bathyal.mission.log import RunLog
from bathyal.mission.run_query import compile_query
from tests.support.command import run as command

MISSION = """\
world: {water: {surface: 0}, terrain: {seabed: {size: [40, 40], spacing: 1, depth: 10}}}
vehicle: {preset: bluerov2_heavy}
start: {position: [0, 0, -0.5]}
mission: [dive: {depth: DEPTH}, surface]
"""
WRITER = """
import sys
from tests.python.mission.test_run_base import made
import bathyal
base = bathyal.RunBase(sys.argv[1])
for seed in range(int(sys.argv[2]), int(sys.argv[3])):
    base.add(made(seed))
"""


def made(seed: int, **changes: object) -> bathyal.RunResult:
    """A record without a log."""
    run = bathyal.RunResult(
        name="made",
        seed=seed,
        status="done" if seed % 2 == 0 else "failed",
        metrics={"duration": 10.0 * seed, "depth_max": float(seed), "unknown": math.nan},
        events=[
            bathyal.RunEvent(1.0, "fault", f"thruster_{seed} dead begins"),
            bathyal.RunEvent(2.0, "end", "done"),
        ],
        log=RunLog("nowhere/log.mcap"),
        versions={"bathyal": "0"},
        scenario_sha256="ab",
    )
    return dataclasses.replace(run, **changes)


@pytest.fixture
def base(tmp_path):
    with_runs = bathyal.RunBase(tmp_path / "runs.db")
    for seed in range(6):
        with_runs.add(made(seed))
    yield with_runs
    with_runs.close()


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    """Twice the same, another seed, another depth."""
    root = tmp_path_factory.mktemp("runs")
    cases = {"one": ("3 m", 1), "again": ("3 m", 1), "seed": ("3 m", 2), "deeper": ("4 m", 1)}
    for name, (depth, seed) in cases.items():
        path = root / f"{name}.yaml"
        path.write_text(MISSION.replace("DEPTH", depth))
        bathyal.run(path, seed=seed, out=root / name)
    return root


def test_what_is_added_comes_back(base, tmp_path):
    shown = bathyal.RunBase(tmp_path / "runs.db").show(4)
    expected = made(3)
    assert (shown.name, shown.seed, shown.status) == ("made", 3, "failed")
    assert shown.events == expected.events
    assert shown.versions == expected.versions
    assert math.isnan(shown.metrics.pop("unknown"))
    assert shown.metrics == {"duration": 30.0, "depth_max": 3.0}
    assert [row.id for row in base.list()] == [1, 2, 3, 4, 5, 6]


@pytest.mark.parametrize(
    ("text", "seeds"),
    [
        ("metric depth_max < 3", [0, 1, 2]),
        ("metric depth_max < 3 and status = 'done'", [0, 2]),
        ("seed = 1 or seed = 4 and status = 'done'", [1, 4]),
        ("(seed = 1 or seed = 4) and status = 'done'", [4]),
        ("not metric depth_max <= 1e0", [2, 3, 4, 5]),
        ("metric unknown < 1", []),
        ("metric missing > -1", []),
        ("not metric missing > -1", [0, 1, 2, 3, 4, 5]),
        ("fault = 'thruster_5'", [5]),
        ("event = 'end' and duration >= 40", [4, 5]),
        ("event = \"guard\"", []),
        ("name != 'made' or id = 2", [1]),
        ("status = 'done'' or 1=1'", None),
        ("status = \"' OR 1=1 --\"", []),
    ],
)  # fmt: skip
def test_queries(base, text, seeds):
    if seeds is None:
        with pytest.raises(ValueError, match="column"):
            base.query(text)
    else:
        assert [row.seed for row in base.query(text)] == seeds


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "expected metric NAME.*got the end at column 1"),
        ("metric", "a metric's name, got the end at column 7"),
        ("depth < 3", "got 'depth' at column 1"),
        ("seed < 'a'", "a number, got \"'a'\" at column 8"),
        ("status = 3", "a text in quotes, got '3' at column 10"),
        ("seed < 3 seed", "`and`, `or` or the end, got 'seed' at column 10"),
        ("(seed < 3", r"`\)`, got the end at column 10"),
        ("seed < 3; DROP TABLE runs", "got ';' at column 9"),
        ("event < 'a'", "expected `=`, got '<' at column 7"),
        ("(" * 99 + "seed < 3" + ")" * 99, "at most 50 levels"),
        ("not " * 99 + "seed < 3", "at most 50 levels"),
        (" or ".join(["seed < 3"] * 201), "at most 200 comparisons"),
    ],
)
def test_wrong_queries_name_the_place(text, message):
    with pytest.raises(ValueError, match=message):
        compile_query(text)


def test_the_largest_query_is_answered(base):
    assert len(base.query(" or ".join(["metric depth_max < 3"] * 200))) == 3
    assert len(base.query("(" * 50 + "seed < 3" + ")" * 50)) == 3


def test_compare_names_the_first_message_that_differs(folders, tmp_path):
    base = bathyal.RunBase(tmp_path / "runs.db")
    one, again, seed, deeper = (
        base.add_folder(folders / name) for name in ("one", "again", "seed", "deeper")
    )
    assert base.compare(one, again).same
    other = base.compare(one, seed)
    assert not other.same
    assert other.first_difference is not None
    first, second = (base.show(number).log for number in (one, seed))
    difference = other.first_difference
    for topic in first.topics:
        rows, others = first.messages(topic), second.messages(topic)
        for name in rows:
            for time, value, another in zip(rows["time"], rows[name], others[name], strict=False):
                if time < difference.time:
                    assert value == pytest.approx(another, rel=0, abs=0, nan_ok=True)
    rows, others = (log.messages(difference.topic) for log in (first, second))
    (at,) = (rows["time"] == difference.time).nonzero()[0]
    assert rows[difference.field][at] != pytest.approx(others[difference.field][at], rel=0, abs=0)
    changed = base.compare(one, deeper)
    assert changed.metrics["duration"][0] < changed.metrics["duration"][1]
    assert "depth: 4 m" in base.scenario(deeper)


def test_a_folder_that_was_used_again_is_not_compared(folders, tmp_path):
    base = bathyal.RunBase(tmp_path / "runs.db")
    shutil.copytree(folders / "one", tmp_path / "run")
    one, used = base.add_folder(folders / "one"), base.add_folder(tmp_path / "run")
    shutil.rmtree(tmp_path / "run")
    gone = base.compare(one, used)
    assert "run" in gone.note
    assert not gone.same
    shutil.copytree(folders / "seed", tmp_path / "run")
    assert "holds another run now" in base.compare(one, used).note


def test_two_programs_that_write_at_once_lose_nothing(tmp_path):
    path = tmp_path / "runs.db"
    writers = [
        subprocess.Popen([sys.executable, "-c", WRITER, str(path), str(start), str(start + 100)])
        for start in (0, 100)
    ]
    assert [writer.wait(timeout=120) for writer in writers] == [0, 0]
    base = bathyal.RunBase(path)
    assert sorted(row.seed for row in base.list()) == list(range(200))
    assert len(base.query("event = 'end'")) == 200


def test_bad_input(base, tmp_path):
    for number in (0, 7, -1, 2**70):
        with pytest.raises(ValueError, match="`id`: expected the number of a run in"):
            base.show(number)
    with pytest.raises(ValueError, match="`seed`: expected a whole number"):
        base.add(made(2**63))
    with pytest.raises(FileNotFoundError):
        base.add_folder(tmp_path / "nowhere")
    (tmp_path / "text.db").write_text("no database " * 100)
    with pytest.raises(bathyal.Error, match=r"text\.db: file is not a database"):
        bathyal.RunBase(tmp_path / "text.db")
    with pytest.raises(bathyal.Error, match="unable to open"):
        bathyal.RunBase(tmp_path / "no" / "folder.db")


def test_another_programs_database_is_left_alone(tmp_path):
    path = tmp_path / "other.db"
    with sqlite3.connect(path) as other:
        other.execute("CREATE TABLE mine (a INTEGER)")
    other.close()
    before = path.read_bytes()
    with pytest.raises(bathyal.Error, match="expected a run base, got another database"):
        bathyal.RunBase(path)
    assert path.read_bytes() == before


def test_a_run_that_cannot_be_written_leaves_no_part(base):
    twice = made(9, status=object())
    with pytest.raises(bathyal.Error):
        base.add(twice)
    assert len(base.list()) == 6
    base.add(made(9))
    assert len(base.list()) == 7


def test_commands(folders, tmp_path, capsys):
    path = tmp_path / "runs.db"
    names = [folders / "one", folders / "again", folders / "seed"]
    assert command(capsys, "runs", "add", path, *names)[0] == 0
    code, out, _ = command(capsys, "runs", "list", path, "--json")
    assert code == 0
    assert [run["seed"] for run in json.loads(out)["runs"]] == [1, 1, 2]
    assert "seed 2: done" in command(capsys, "runs", "query", path, "seed = 2")[1]
    assert "none" in command(capsys, "runs", "query", path, "seed = 9")[1]
    assert "surface" in command(capsys, "runs", "show", path, 1)[1]
    assert "yes" in command(capsys, "runs", "compare", path, 1, 2)[1]
    _, out, _ = command(capsys, "runs", "compare", path, 1, 3, "--json")
    assert json.loads(out)["first_difference"]["topic"].startswith("/")
    code, _, err = command(capsys, "runs", "query", path, "seed ~ 2")
    assert code != 0
    assert "column 6" in err
    code, _, err = command(capsys, "runs", "list", tmp_path / "mistyped.db")
    assert code == 1
    assert "no such run base" in err
    assert not (tmp_path / "mistyped.db").exists()


def test_ways_of_earlier_runs_lie_under_the_next_map(tmp_path, capsys):
    path = tmp_path / "mission.yaml"
    path.write_text(
        "world: {water: {surface: 0}, terrain: {seabed: {size: [40, 40], spacing: 1, depth: 10}}}\n"
        "vehicle: {preset: bluerov2_heavy}\nstart: {position: [0, 0, -2]}\n"
        "mission: [leg: {to: [4, 0], depth: 2 m}]\n"
    )
    base = tmp_path / "runs.db"
    for seed in (1, 2):
        code, _, error = command(
            capsys, "run", path, "--seed", seed, "--out", tmp_path / str(seed), "--base", base
        )
        assert code == 0, error
    found = bathyal.RunBase(base)
    assert [row.seed for row in found.list()] == [1, 2]
    ways = found.ways()
    last = bathyal.read_run(tmp_path / "2")
    np.testing.assert_array_equal(ways[0], last.log.poses("/truth")[:, :2, 3])
    assert len(ways) == 2
    assert len(found.ways(most=1)) == 1
    (tmp_path / "2" / "log.mcap").unlink()
    assert len(found.ways()) == 1
    one = bathyal.read_run(tmp_path / "1").plot(earlier=ways)
    lines = [line for line in one.axes[0].lines if line.get_label() == "earlier"]
    np.testing.assert_array_equal(lines[0].get_xydata(), ways[0])
    code, _, error = command(
        capsys, "mission", path, "--base", base, "--picture", tmp_path / "map.png"
    )
    assert code == 0, error
    assert (tmp_path / "map.png").stat().st_size > 5000
