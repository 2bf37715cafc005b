# SPDX-License-Identifier: BSD-3-Clause
"""bathyal touches plan."""

from __future__ import annotations

import json

import numpy as np
import pytest

import bathyal
from tests.support.command import run

SMALL = ["touches", "plan", "--arm", "ur10e", "--count", 12]


def test_plan_as_in_the_readme(tmp_path, capsys):
    files = tmp_path / "plan.csv", tmp_path / "plan.png"
    code, text, err = run(
        capsys, "touches", "plan", "--arm", "ur10e", "--count", 63, "--points", 3,
        "--known-distance", "0,1", "--out", files[0], "--picture", files[1],
    )  # fmt: skip
    assert code == 0, err
    assert "Touch 3 points in 63 poses" in " ".join(text.split())
    touches = bathyal.read_touches(files[0])
    assert touches.q.shape == (63, 6)
    assert files[1].stat().st_size > 50_000
    assert "no tool" in err


def test_json_and_every_option(tmp_path, capsys):
    arm = bathyal.arms.ur10e()
    arm.save(tmp_path / "arm.json")
    code, text, err = run(
        capsys, "touches", "plan", "--arm", tmp_path / "arm.json", "--count", 10,
        "--at", "700,200,100mm", "--at", "0.8,-0.2,0.3m", "--tool", "0,0,150mm",
        "--known-distance", "0,1", "--criterion", "d_optimal", "--noise", "0.2mm",
        "--length-prior", "2mm", "--angle-prior", "0.1deg", "--seed", 4, "--floor", "-500mm",
        "-o", tmp_path / "plan.csv", "--json",
    )  # fmt: skip
    assert code == 0, err
    summary = json.loads(text)
    np.testing.assert_allclose(summary["points_m"], [[0.7, 0.2, 0.1], [0.8, -0.2, 0.3]], atol=1e-12)
    assert summary["touches"] == sum(summary["touches_by_point"]) == 10
    tool = np.eye(4)
    tool[2, 3] = 0.15
    arm.tool = tool
    same = bathyal.plan_touches(
        arm, 10, points=summary["points_m"], known_distances=[(0, 1)], criterion="d_optimal",
        noise=2e-4, length_prior=2e-3, angle_prior=np.radians(0.1), seed=4, floor=-0.5,
    )  # fmt: skip
    assert summary["worst_tip_std_m"] == pytest.approx(same.worst_tip_std)
    assert summary["value"] == pytest.approx(same.forecast.log_det)
    assert summary["warnings"] == same.warnings


def test_quiet_says_warnings_only(tmp_path, capsys):
    code, text, err = run(capsys, *SMALL, "-o", tmp_path / "plan.csv", "-q")
    assert (code, text) == (0, "")
    assert "do not determine" in err


@pytest.mark.parametrize(
    ("options", "code", "text"),
    [
        (["--at", "1,2"], 2, "three coordinates"),
        (["--at", "1,2,3"], 2, "unit"),
        (["--at", "0,0,0mm", "--points", 2], 2, "not both"),
        (["--known-distance", "left,right"], 2, "two points"),
        (["--tool", "far"], 2, "three coordinates"),
        (["--known-distance", "0,5"], 1, "known_distances"),
        (["--at", "9,0,0m"], 1, "point 0 at (9, 0, 0)"),
        (["--arm", "no_such_arm"], 1, "ur10e"),
        (["--count", 1], 1, "count"),
        (["--out", "plan.txt"], 1, "csv"),
    ],
)
def test_refusals(tmp_path, capsys, options, code, text):
    out = ["-o", tmp_path / "plan.csv"]
    found, _, err = run(capsys, *SMALL, *out, *options)
    assert found == code
    assert text in " ".join(err.replace("│", " ").split())
    assert list(tmp_path.iterdir()) == []


def test_help(capsys):
    code, text, _ = run(capsys, "touches", "plan", "--help")
    assert code == 0
    assert "bathyal touches plan --arm ur10e" in " ".join(text.split())
    assert text.count("default:") >= 5
