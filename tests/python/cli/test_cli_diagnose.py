# SPDX-License-Identifier: BSD-3-Clause
"""bathyal diagnose: what it reads, writes, says and refuses."""

from __future__ import annotations

import io
import json
import os

import numpy as np
import pytest
from rich.console import Console

import bathyal
from bathyal import cli
from bathyal.cli.talk import Talk
from bathyal.cli.touch_options import CovariateColumns
from bathyal.io.manifest import NAME
from tests.support import diagnosis_cases as cases
from tests.support.command import run

FILES = ["model.json", "report.html", "report.json", "report.png", "residuals.csv"]


def write_tracked(data, path, rows=slice(None), titles=(), columns=()):
    """A logger's table: degrees, millimetres, covariates."""
    time, temperature = (data.covariates[name].ravel() for name in ("time", "temperature"))
    names = [*(f"q{k}_deg" for k in range(1, 7)), "x_mm", "y_mm", "z_mm", "time_s", "T_arm_C",
             "session", *titles]  # fmt: skip
    table = np.column_stack(
        [np.degrees(data.q), 1e3 * data.position, time, temperature,
         data.covariates["session"].ravel(), *columns]
    )[rows]  # fmt: skip
    lines = [",".join(f"{value:.9g}" for value in row) for row in table]
    path.write_text("\n".join([",".join(names), *lines]) + "\n")
    return path


@pytest.fixture
def table(tmp_path):
    return write_tracked(cases.measured(), tmp_path / "tracked.csv")


@pytest.fixture
def asked(monkeypatch):
    """The engine's place is taken by a diagnosis with known contents; what it was asked is kept."""
    calls = []

    def diagnose(arm, data, *, progress=None, **options):
        calls.append((arm, data, options))
        if progress is not None:
            progress(0.0, "Fitting geometry")
            progress(0.5, "Trying effects [2 of 4]")
            progress(1.0, "")
        return cases.named()

    monkeypatch.setattr("bathyal.diagnosis.job.diagnose", diagnose)
    return calls


@pytest.fixture
def undrawn(monkeypatch):
    """Pictures are tried elsewhere: here they cost time alone."""
    monkeypatch.setattr("bathyal.diagnosis.report.page.write_page", lambda *_, **__: None)
    monkeypatch.setattr("bathyal.diagnosis.report.figure.diagnosis_figure", lambda *_, **__: None)
    monkeypatch.setattr("bathyal.view.figure.write_png", lambda *_: None)


def test_everything_is_written_and_reported(table, tmp_path, capsys, asked):
    code, text, err = run(
        capsys, "diagnose", table, "--tracked", "--arm", "ur10", "-o", tmp_path / "out", "--json",
        "--temperature", "T_arm_C",
    )  # fmt: skip
    assert code == 0, err
    assert err == ""
    told = json.loads(text)
    assert sorted(os.listdir(tmp_path / "out")) == sorted([*FILES, NAME])
    assert [os.path.basename(file) for file in told["files"]] == FILES
    assert told["verdict"] == "named"
    assert told["effects"][0]["name"] == "joint_harmonic"
    assert "residuals_before_m" not in told
    assert "before_m" not in told["held_out"]
    kept = json.loads((tmp_path / "out" / "report.json").read_text())
    assert kept["provenance"]["input"][0]["file"] == "tracked.csv"
    assert kept["provenance"]["arm"]["name"] == "UR10"
    assert kept["settings"]["read"]["covariates"] == {"temperature": "T_arm_C"}
    assert len(kept["residuals_before_m"]) == 240
    arm, data, options = asked[0]
    assert arm.name == "UR10"
    assert options == {}
    assert told["held_out"]["nested"] is None
    assert sorted(data.covariates) == ["session", "temperature", "time"]
    np.testing.assert_allclose(data.q, cases.measured().q, atol=1e-8)
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "UR10 from tracked.csv" in page
    assert "session, temperature, time" in page


def test_the_engine_finds_what_was_hidden_and_says_so(table, tmp_path, capsys):
    """From table to folder with nothing in anyone's place: the encoder's harmonic is named."""
    code, text, err = run(
        capsys, "diagnose", table, "--tracked", "--arm", "ur10", "-o", tmp_path / "out", "--json"
    )
    assert code == 0, err
    told = json.loads(text)
    assert told["verdict"] == "named"
    assert [(effect["name"], effect["joint"]) for effect in told["effects"]] == [
        ("joint_harmonic", 2)
    ]
    found = told["effects"][0]["parameters"]
    assert found["order"]["value"] == pytest.approx(cases.ORDER, rel=0.05)
    assert told["gain"] > 0.9
    assert sorted(os.listdir(tmp_path / "out")) == sorted([*FILES, NAME])
    model = bathyal.read_arm(tmp_path / "out" / "model.json")
    data = cases.measured()
    off = model.forward(data.q)[:, :3, 3] - data.position
    assert np.sqrt(np.mean(off**2)) < 1.2 * cases.NOISE
    with open(tmp_path / "out" / "residuals.csv", encoding="utf-8") as stream:
        assert len(stream.readlines()) == 241


def test_nested_folds_are_asked_for(table, tmp_path, capsys):
    code, text, err = run(
        capsys, "diagnose", table, "--tracked", "--arm", "ur10", "-o", tmp_path / "out", "--json",
        "--nested", "2",
    )  # fmt: skip
    assert code == 0, err
    nested = json.loads(text)["held_out"]["nested"]
    assert nested["verdicts"] == ["named", "named"]
    assert sorted(nested) == ["folds", "rms_after_m", "verdicts"]
    kept = json.loads((tmp_path / "out" / "report.json").read_text())["held_out"]["nested"]
    assert len(kept["after_m"]) == 240


def test_people_see_the_verdict_first(table, tmp_path, capsys, asked, undrawn, monkeypatch):
    monkeypatch.setenv("COLUMNS", "160")
    code, out, err = run(capsys, "diagnose", table, "--tracked", "--arm", "ur10", "-o", tmp_path)
    assert code == 0, err
    assert out.startswith("Named: a harmonic of order 2 along joint 3.\n")
    assert "warning: The arm's masses are not known" in err
    for words in (
        "100 % of the variance above noise",
        "Next: check the corrected arm",
        "report.json",
    ):
        assert words in " ".join(out.split())
    code, out, err = run(
        capsys, "diagnose", table, "--tracked", "--arm", "ur10", "-o", tmp_path, "--quiet"
    )
    assert (code, out) == (0, "")


@pytest.mark.parametrize("verdict", cases.CASES)
def test_no_verdict_fails_the_job(verdict, table, tmp_path, capsys, monkeypatch, undrawn):
    monkeypatch.setattr("bathyal.diagnosis.job.diagnose", lambda *_, **__: cases.CASES[verdict]())
    code, _, err = run(
        capsys, "diagnose", table, "--tracked", "--arm", "ur10", "-o", tmp_path, "--json"
    )
    assert code == 0, err


def test_a_table_for_each_session(tmp_path, capsys, asked, undrawn):
    data = cases.measured()
    files = []
    for name, rows in (("monday", slice(0, 100)), ("tuesday", slice(100, 240))):
        files.append(write_tracked(data, tmp_path / f"{name}.csv", rows))
        text = files[-1].read_text().replace("session", "run")
        files[-1].write_text(text)
    options = ["--tracked", "--arm", "ur10", "-o", tmp_path / "out"]
    code, _, err = run(capsys, "diagnose", *files, *options)
    assert code == 0, err
    session = asked[0][1].covariates["session"].ravel()
    assert session.tolist() == [0] * 100 + [1] * 140
    code, _, err = run(capsys, "diagnose", *files, *options, "--session", "run")
    assert code == 1
    assert "expected one file where a column gives the sessions, got 2 files" in err


def test_columns_by_name(tmp_path, capsys, asked, undrawn):
    data = cases.measured()
    directions = np.sign(np.sin(np.arange(240.0)[:, None] + np.arange(6)))
    path = write_tracked(
        data, tmp_path / "t.csv",
        titles=["P_bar", "load_g", *(f"way{k}" for k in range(6)), "gx", "gy", "gz"],
        columns=[np.full(240, 3.0), np.full(240, 500.0), directions,
                 np.tile([0, 0, -9.8], (240, 1))],
    )  # fmt: skip
    path.write_text(path.read_text().replace("session", "day").replace("time_s", "clock_min"))
    code, _, err = run(
        capsys, "diagnose", path, "--tracked", "--arm", "ur10", "-o", tmp_path / "out",
        "--session", "day", "--time", "clock", "--payload", "load", "--covariate", "pressure=P_bar",
        "--direction", "way0,way1,way2,way3,way4,way5", "--gravity", "gx,gy,gz",
    )  # fmt: skip
    assert code == 0, err
    found = asked[0][1].covariates
    assert sorted(found) == ["direction", "gravity", "payload", "pressure", "session", "time"]
    assert np.array_equal(found["direction"], directions)
    assert found["payload"].ravel()[0] == pytest.approx(0.5)
    assert found["gravity"].shape == (240, 3)
    np.testing.assert_allclose(
        found["time"].ravel(), 60 * data.covariates["time"].ravel(), rtol=1e-8
    )


def test_touches_ride_with_covariates(tmp_path, capsys, asked, undrawn):
    from tests.support.touch_jobs import simulated
    from tests.support.touch_jobs import table as touch_table

    path = touch_table(tmp_path, simulated())
    title, *lines = path.read_text().splitlines()
    extended = [f"{line},{20 + k},{'ab'[k % 2]}" for k, line in enumerate(lines)]
    path.write_text("\n".join([f"{title},temperature_C,shift", *extended]))
    code, _, err = run(
        capsys, "diagnose", path, "--arm", "ur10e", "-o", tmp_path / "out", "--session", "shift",
        "--known-distance", "left,right=350mm",
    )  # fmt: skip
    data = asked[0][1]
    assert isinstance(data, bathyal.Touches)
    assert data.covariates["temperature"].ravel()[:3].tolist() == [20, 21, 22]
    assert data.covariates["session"].ravel()[:4].tolist() == [0, 1, 0, 1]
    assert data.known_distances == {(0, 1): pytest.approx(0.35)}
    assert code == 0, err


# Refusals -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "code", "says"),
    [
        (["diagnose"], 2, "DATA"),
        (["diagnose", "t.csv", "--tracked", "-o", "o"], 2, "--arm"),
        (["diagnose", "t.csv", "--tracked", "--arm", "ur10"], 2, "--out"),
        (["t.csv", "--arm", "ur11", "-o", "o"], 1, "ur10"),
        (["no.csv", "-o", "o"], 1, "no.csv"),
        (["t.csv", "-o", "o", "--temperature", "heat"], 1, "`heat`: expected a column"),
        (["t.csv", "-o", "o", "--covariate", "pressure=P"], 1, "`P`: expected a column"),
        (["t.csv", "-o", "o", "--covariate", "pressure"], 2, "expected a name"),
        (["t.csv", "-o", "o", "--covariate", "a=b", "--covariate", "a=c"], 2, "once"),
        (["t.csv", "-o", "o", "--time", "time", "--covariate", "time=q1"], 2, "expected time once"),
        (["gap.csv", "-o", "o"], 1, "gap.csv, line 4: `time`: expected a number in every row"),
        (["hole.csv", "-o", "o", "--covariate", "heat=T_arm"], 1, "line 4: `T_arm_C`: expected a"),
        (["t.csv", "-o", "o", "--direction", "q1,q9"], 1, "`q9`"),
        (["t.csv", "-o", "o", "--session", "T_arm"], 1, "line 2: `T_arm`: expected a whole number"),
        (["t.csv", "-o", "file"], 1, "file"),
        (["t.csv", "-o", "o", "--plane", "deck"], 1, "planes"),
    ],
)  # fmt: skip
def test_refusals_are_one_line_and_leave_nothing(
    table, tmp_path, capsys, monkeypatch, asked, arguments, code, says
):
    text = table.read_text()
    (tmp_path / "t.csv").write_text(text)
    for name, column, cell in (("gap.csv", 9, "nan"), ("hole.csv", 10, "")):
        cells = [line.split(",") for line in text.splitlines()]
        cells[3][column] = cell
        (tmp_path / name).write_text("\n".join(map(",".join, cells)))
    (tmp_path / "file").write_text("")
    before = sorted(os.listdir(tmp_path))
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "200")
    if arguments[0] != "diagnose":
        arm = [] if "--arm" in arguments else ["--arm", "ur10"]
        arguments = ["diagnose", *arguments, "--tracked", *arm]
    got, out, err = run(capsys, *arguments)
    assert got == code, err
    assert says in err
    assert "Traceback" not in err + out
    if code == 1:
        assert err.count("\n") == 1, err
    assert sorted(os.listdir(tmp_path)) == before


@pytest.mark.parametrize("where", ["job.diagnose", "report.page.write_page"])
def test_interrupted_leaves_nothing(where, table, tmp_path, monkeypatch, capsys, asked):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(f"bathyal.diagnosis.{where}", interrupted)
    code, _, err = run(
        capsys, "diagnose", table, "--tracked", "--arm", "ur10", "-o", tmp_path / "new"
    )
    assert code == 130
    assert "interrupted" in err
    assert not (tmp_path / "new").exists()


def test_sessions_by_word_and_by_number(table, tmp_path):
    words = table.read_text().splitlines()
    words = [words[0], *(line[: line.rindex(",")] + ",früh spät"[: 5 if k % 3 else 10]
                         for k, line in enumerate(words[1:]))]  # fmt: skip
    (tmp_path / "w.csv").write_text("\n".join(words))
    data = bathyal.read_tracked(tmp_path / "w.csv")
    assert data.covariates["session"].ravel()[:4].tolist() == [0, 1, 1, 0]
    (tmp_path / "e.csv").write_text("\n".join([*words[:2], words[2][: words[2].rindex(",")] + ","]))
    with pytest.raises(bathyal.Error, match=r"e.csv, line 3: `session`: expected a session, got"):
        bathyal.read_tracked(tmp_path / "e.csv")


# Progress -----------------------------------------------------------------------------------------


def test_progress_shows_how_far_it_is():
    talk = Talk(json=False, quiet=False)
    said = io.StringIO()
    talk.err = Console(file=said, force_terminal=True, width=100)
    with talk.progress() as step, step("Diagnosing") as tell:
        tell(0.5, "Trying effects [2 of 4]")
    assert "Trying effects [2 of 4]" in said.getvalue()
    for quiet in (True, False):
        talk = Talk(json=not quiet, quiet=quiet)
        talk.err = Console(file=said, force_terminal=True)
        with talk.progress() as step, step("Silent") as tell:
            tell(0.5, "stage")
    assert "Silent" not in said.getvalue()


def test_help_has_examples(capsys):
    code, out, _ = run(capsys, "diagnose", "--help")
    assert code == 0
    assert "bathyal diagnose " in out
    assert "Exit codes" in out
    assert "--covariate" in out
    assert cli.app.info.name == "bathyal"


def test_options_name_each_covariate_once():
    assert CovariateColumns().keywords() == {}
    assert CovariateColumns(time="clock", direction="a, b", covariate=["p = P_bar"]).keywords() == {
        "covariates": {"time": "clock", "direction": ["a", "b"], "p": "P_bar"}
    }
