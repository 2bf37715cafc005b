# SPDX-License-Identifier: BSD-3-Clause
"""bathyal identify and bathyal touches example: what they write, say and refuse."""

from __future__ import annotations

import json
import os

import numpy as np
import pytest

import bathyal
from bathyal.cli import values
from bathyal.cli.touch_options import Known, Searching
from bathyal.io.manifest import NAME
from tests.support.command import bathyal_run, run
from tests.support.touch_jobs import FILES, simulated, table

KNOWN = ["--known-distance", "left,right=350mm"]


@pytest.fixture(scope="module")
def made():
    return simulated()


@pytest.fixture(scope="module")
def job(made, tmp_path_factory):
    return table(tmp_path_factory.mktemp("job"), made)


@pytest.fixture(scope="module")
def found(job, tmp_path_factory):
    """A run in a process of its own: the folder, and what was said."""
    out = tmp_path_factory.mktemp("found") / "arm"
    done = bathyal_run("identify", job, "--arm", "ur10e", *KNOWN, "--out", out, "--json")
    assert done.returncode == 0, done.stderr
    return out, json.loads(done.stdout)


def test_identify_writes_everything(found):
    out, told = found
    assert sorted(os.listdir(out)) == sorted([*FILES, NAME])
    assert [os.path.basename(file) for file in told["files"]] == FILES
    assert (told["rank"], told["parameters"], told["poses"]) == (21, 27, 63)
    assert told["scale_source"] == "known distance"
    assert told["rms_after_m"] < 0.15e-3 < 1e-3 < told["rms_before_m"]
    assert told["next"]
    kept = json.loads((out / "fit.json").read_text())
    assert kept["provenance"]["input"][0]["file"] == "touches.csv"
    assert kept["settings"]["read"]["known_distances"] == pytest.approx({"left right": 0.35})
    assert np.shape(kept["covariance"]) == (27, 27)
    assert kept["summary"] == {key: told[key] for key in kept["summary"]}


def test_arm_loads_again_and_goes_where_the_true_one_goes(made, found, job):
    out, _ = found
    touches = bathyal.read_touches(job, known_distances={("left", "right"): 0.35})
    fit = bathyal.identify_arm(bathyal.arms.ur10e(), touches)
    q = np.random.default_rng(2).uniform(-np.pi, np.pi, (200, 6))
    for name in ("arm.json", "arm.urdf"):
        arm = bathyal.read_arm(out / name)
        np.testing.assert_allclose(arm.forward(q), fit.arm.forward(q), rtol=0, atol=1e-9)
        assert arm.joint_names == bathyal.arms.ur10e().joint_names
        check = bathyal.verify_arm(arm, q, made.true_arm.forward(q)[:, :3, 3])
        assert check.rms_after < 0.5e-3
    nominal = bathyal.arms.ur10e()
    nominal.tool = fit.arm.tool
    check = bathyal.verify_arm(nominal, q, made.true_arm.forward(q)[:, :3, 3])
    assert check.rms_after > 1e-3


def test_identify_twice_gives_the_same_bytes(found, job, tmp_path, capsys):
    out, _ = found
    code, _, err = run(capsys, "identify", job, "--arm", "ur10e", *KNOWN, "-o", tmp_path / "b")
    assert code == 0, err
    for name in FILES:
        assert (out / name).read_bytes() == (tmp_path / "b" / name).read_bytes(), name


def test_people_see_what_was_found_and_what_to_touch_next(job, tmp_path, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    code, out, err = run(capsys, "identify", job, "--arm", "UR10e", "--out", tmp_path)
    assert code == 0, err
    for word in ("error falls", "20 of 27", "prior on lengths (1 mm)", "left, right, top",
                 "measure one distance", "left to right", "report.png"):  # fmt: skip
        assert word in out, word
    code, out, _ = run(capsys, "identify", job, "--arm", "ur10e", "--out", tmp_path, "--quiet")
    assert (code, out) == (0, "")


def test_warnings_are_printed_first_and_do_not_fail(job, tmp_path, capsys, monkeypatch):
    """Whatever the fit warns of is on stderr, in the page and in the summary."""
    from bathyal.identify import job as identify_report

    class Warned:
        """A fit that warns."""

        warnings = ("The <lights> are off.",)

        def __init__(self, fit):
            self._fit = fit

        def __getattr__(self, name):
            return getattr(self._fit, name)

        def summary(self, *, warnings=True):
            text = self._fit.summary(warnings=False)
            return f"{text} {self.warnings[0]}" if warnings else text

    identify_arm = identify_report.identify_arm
    monkeypatch.setattr(
        identify_report, "identify_arm", lambda *a, **k: Warned(identify_arm(*a, **k))
    )
    code, out, err = run(capsys, "identify", job, "--arm", "ur10e", "-o", tmp_path, "--json")
    assert code == 0, err
    assert json.loads(out)["warnings"] == ["The <lights> are off."]
    code, _, err = run(capsys, "identify", job, "--arm", "ur10e", "-o", tmp_path, *KNOWN, "--quiet")
    assert code == 0
    assert err == "warning: The <lights> are off.\n"
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert page.count("The &lt;lights&gt; are off.") == 1
    assert page.index("lights") < page.index("What was found")
    assert "Resolve the warnings" in page


def test_exports_on_request(job, tmp_path, capsys):
    code, _, err = run(
        capsys, "identify", job, "--arm", "ur10e", "-o", tmp_path, "--ros", "--ur-calibration"
    )
    assert code == 0, err
    assert {"kinematics.yaml", "calibration.conf"} <= set(os.listdir(tmp_path))
    assert "delta_theta" in (tmp_path / "calibration.conf").read_text()


def test_options_reach_the_engine(job, tmp_path, capsys):
    code, text, err = run(
        capsys, "identify", job, "--arm", "ur10e", "-o", tmp_path, "--json",
        "--parametrization", "dh", "--loss", "huber", "--length-prior", "0.5mm",
        "--angle-prior", "0.1deg", "--prior", "a_2=2mm", "--fixed", "d_5",
    )  # fmt: skip
    assert code == 0, err
    told = json.loads(text)
    assert told["scale_source"] == "prior on lengths (0.5 mm)"
    assert told["status"]["fixed"] == 1
    settings = json.loads((tmp_path / "fit.json").read_text())["settings"]["identify"]
    assert settings == {
        "length_prior": 0.5e-3, "angle_prior": np.radians(0.1), "priors": {"a_2": 2e-3},
        "fixed": ["d_5"], "loss": "huber", "parametrization": "dh",
    }  # fmt: skip
    names = [line.split(",")[0] for line in (tmp_path / "parameters.csv").read_text().splitlines()]
    assert "d_2" in names
    assert "beta_2" not in names


def test_tracked_poses_and_an_arm_from_a_file(made, tmp_path, capsys):
    q = made.touches.q
    seen = made.true_arm.forward(q)[:, :3, 3] * 1e3
    titles = [*(f"axis {k}" for k in range(6)), "X", "Y", "Z"]
    rows = [";".join(f"{v:.6f}".replace(".", ",") for v in row) for row in np.hstack([q, seen])]
    (tmp_path / "tracked.csv").write_text("\n".join([";".join(titles), *rows]))
    bathyal.arms.ur10e().write(tmp_path / "drawing.urdf")
    code, text, err = run(
        capsys, "identify", tmp_path / "tracked.csv", "--tracked", "--arm",
        tmp_path / "drawing.urdf", "-o", tmp_path / "out", "--json", "--unit", "rad",
        "--joints", ",".join(titles[:6]), "--position", "X,Y,Z", "--position-unit", "mm",
    )  # fmt: skip
    assert code == 0, err
    told = json.loads(text)
    assert told["scale_source"] == "measured positions"
    assert told["rms_after_m"] < 5e-6


def test_example_and_identify_run_as_written(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    code, out, err = run(capsys, "touches", "example", "touches.csv", "--arm", "ur10e")
    assert code == 0, err
    assert "left to right: 350 mm" in out
    text = (tmp_path / "touches.csv").read_text()
    assert text.startswith("# simulated touches of UR10e; left to right: 350 mm\npoint,q1_deg")
    code, text, err = run(capsys, "identify", "touches.csv", "--arm", "ur10e", *KNOWN, "-o", "arm",
                          "--json")  # fmt: skip
    assert code == 0, err
    assert json.loads(text)["rank"] == 21
    run(capsys, "touches", "example", "b.csv", "--count", 4, "--noise", "1mm", "--seed", 3)
    assert len(bathyal.read_touches("b.csv")) == 12


@pytest.mark.parametrize(
    ("arguments", "code", "says"),
    [
        (["identify"], 2, "TOUCHES"),
        (["identify", "touches.csv", "-o", "o"], 2, "--arm"),
        (["identify", "touches.csv", "--arm", "ur10e"], 2, "--out"),
        (["identify", "touches.csv", "--arm", "ur10f", "-o", "o"], 1, "ur10e"),
        (["identify", "touches.csv", "--arm", "no.urdf", "-o", "o"], 1, "no.urdf"),
        (["identify", "touches.csv", "--arm", "panda", "-o", "o"], 1, "7"),
        (["identify", "missing.csv", "--arm", "ur10e", "-o", "o"], 1, "missing.csv"),
        (["identify", "bare.csv", "--arm", "ur10e", "-o", "o"], 1, "unit"),
        (["identify", "touches.csv", "--arm", "ur10e", "-o", "file"], 1, "file"),
        (["identify", "touches.csv", "--arm", "ur10e", "-o", "o", "--tip", "t"], 1, "tip"),
        (["identify", "touches.csv", "--arm", "ur10e", "-o", "o", "--tracked"], 1, "x"),
        (["identify", "touches.csv", "--arm", "ur10e", "-o", "o", "--fixed", "g_9"], 1, "g_9"),
        (["identify", "touches.csv", "--arm", "ur10e", "-o", "o", "--plane", "deck"], 1, "deck"),
        (
            ["identify", "touches.csv", "--arm", "ur10e", "-o", "o", "--tracked", *KNOWN],
            1,
            "known_distances",
        ),
        (
            ["identify", "touches.csv", "--arm", "ur10e", "-o", "o", "--known-distance", "a,b=5mm"],
            1,
            "left, right, top",
        ),
        (
            ["identify", "touches.csv", "--arm", "ur10e", "-o", "o", "--known-distance", "a,b=50"],
            2,
            "50mm",
        ),
        (
            ["identify", "touches.csv", "--arm", "ur10e", "-o", "o", "--length-prior", "5deg"],
            2,
            "length",
        ),
        (["touches", "example", "nowhere/t.csv"], 1, "nowhere"),
        (["touches", "example", "t.csv", "--arm", "maevskiy_zanin"], 1, "4 moving joints"),
        (["touches", "example", "t.csv", "--count", "1"], 1, "count"),
        (["touches", "nothing"], 2, "nothing"),
    ],
)
def test_refusals_are_one_line_and_leave_nothing(
    job, tmp_path, capsys, monkeypatch, arguments, code, says
):
    (tmp_path / "touches.csv").write_bytes(job.read_bytes())
    (tmp_path / "bare.csv").write_text(job.read_text().replace("_deg", ""))
    (tmp_path / "file").write_text("")
    before = sorted(os.listdir(tmp_path))
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "200")
    got, out, err = run(capsys, *arguments)
    assert got == code, err
    assert says in err
    assert "Traceback" not in err + out
    if code == 1:
        assert err.count("\n") == 1, err
    assert sorted(os.listdir(tmp_path)) == before


def test_interrupted_identify_leaves_nothing(job, tmp_path, monkeypatch, capsys):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr("bathyal.identify.report.page.write_page", interrupted)
    code, _, err = run(capsys, "identify", job, "--arm", "ur10e", "-o", tmp_path / "new")
    assert code == 130
    assert "interrupted" in err
    assert not (tmp_path / "new").exists()


@pytest.mark.parametrize("command", [["identify"], ["touches", "example"]])
def test_help_has_examples_and_defaults(command, capsys):
    code, out, _ = run(capsys, *command, "--help")
    assert code == 0
    assert f"bathyal {' '.join(command)} " in out
    assert "Exit codes" in out
    assert out.count("default:") >= 3


# What the options become --------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "value"),
    [("50mm", 0.05), ("0,05 m", 0.05), ("1e-1cm", 1e-3), ("2 µm", 2e-6), (".5m", 0.5)],
)
def test_lengths_need_their_unit(text, value):
    assert values.length(text) == pytest.approx(value)
    for wrong in (text.rstrip("cmµ "), f"{text}x", "5 deg", "mm", "1.2.3mm", ""):
        with pytest.raises(ValueError, match="expected a"):
            values.length(wrong)


def test_angles_need_their_unit():
    assert values.angle("180°") == pytest.approx(np.pi)
    assert values.angle("2 mrad") == pytest.approx(2e-3)
    with pytest.raises(ValueError, match="expected an angle"):
        values.angle("2mm")


def test_what_is_known_is_given_by_name():
    known = Known(
        known_distance=["left, right=50mm", "a,b = 0.2 m"], known_point=["pin=500,-200,10.5mm"],
        plane=["deck"],
    )  # fmt: skip
    assert known.keywords() == {
        "known_distances": {("left", "right"): 0.05, ("a", "b"): 0.2},
        "known_points": {"pin": pytest.approx((0.5, -0.2, 0.0105))},
        "planes": ["deck"],
    }
    assert Known().keywords() == {}
    assert Searching(prior=["a_2=1mm", "theta_1=1mrad"]).keywords() == {
        "priors": {"a_2": pytest.approx(1e-3), "theta_1": pytest.approx(1e-3)}
    }


@pytest.mark.parametrize(
    "known",
    [
        Known(known_distance=["left=50mm"]),
        Known(known_distance=["left,right"]),
        Known(known_distance=["left,right=1mm", "left,right=2mm"]),
        Known(known_point=["pin=1,2mm"]),
        Known(known_point=["pin=1,2,3"]),
        Searching(prior=["a_2"]),
    ],
)
def test_what_is_known_badly_is_wrong_usage(known):
    import typer

    with pytest.raises(typer.BadParameter, match="expected"):
        known.keywords()
