# SPDX-License-Identifier: BSD-3-Clause
"""What identify and diagnose print first: a verdict, a few numbers, one next step, the folder."""

from __future__ import annotations

import re

import numpy as np
import pytest

import bathyal
from bathyal.diagnosis.report.brief import brief_of
from bathyal.identify.report import brief as identify_brief
from bathyal.identify.simulate import simulate_touches, write_touches
from bathyal.view.brief import MOST_NUMBERS, Brief, short_warnings
from tests.support import diagnosis_cases as cases
from tests.support.command import run

KNOWN = ["--known-distance", "left,right=350mm"]


def lines_of(text):
    """The verdict, the rows of numbers and what follows them."""
    verdict, *others = text.rstrip("\n").split("\n")
    rows = [line for line in others if line.startswith("  ")]
    assert others[: len(rows)] == rows
    return verdict, rows, others[len(rows) :]


@pytest.mark.parametrize("name", cases.CASES)
def test_a_diagnosis_is_a_verdict_five_numbers_and_a_step(name):
    report = cases.CASES[name]()
    verdict, rows, rest = lines_of(str(brief_of(report)))
    assert 1 <= len(rows) <= MOST_NUMBERS
    assert all(re.search(r"\d", row) for row in rows if " part of it " not in row)
    assert len(rest) == 1
    assert rest[0].startswith("Next: ")
    assert all(len(line) <= 120 for line in (verdict, *rows, *rest))
    assert not re.search(r"nan|inf\b|None|\?", str(brief_of(report)))


def test_each_verdict_says_what_matters():
    named = str(brief_of(cases.named()))
    assert named.startswith("Named: a harmonic of order 2 along joint 3.\n")
    assert "amplitude 0.0286°; moves the tip by 0.200 mm per axis" in named
    assert "0.194 mm → 0.051 mm (3-D rms; noise alone 0.052 mm)" in named
    assert "100 % of the variance above noise, p < 0.001" in named
    clean = str(brief_of(cases.clean()))
    assert clean.startswith("Clean: geometry explains the data to within noise.\n")
    assert "detectable       0.012 mm per axis, or more" in clean
    ambiguous = str(brief_of(cases.ambiguous())).splitlines()
    for cause in ("the tool slipped", "the base moved between sessions 1 and 2", "the base drifts"):
        assert cause in ambiguous[0]
    assert "measure the 5 poses of the report" in ambiguous[-1]
    unknown = str(brief_of(cases.unknown()))
    assert unknown.startswith(
        "Unknown: no cause in the library explains 0.160 mm per axis beyond noise.\n"
    )
    assert "time, period 12.1 s" in unknown
    assert "part of it may be" in unknown


def test_what_is_open_is_listed_where_a_sure_cause_leads():
    report = cases.ambiguous()
    report.effects[0].size = 2 * report.effects[1].size
    text = str(brief_of(report))
    assert text.startswith("Ambiguous: mainly a harmonic of order 2 along joint 3. A lesser")
    assert "open            the tool slipped after 120 rows, the base moved" in text
    report.next_poses = np.empty((0, 6))
    assert "no pose separates them" in str(brief_of(report))


@pytest.mark.parametrize(
    ("hide", "verdict"), [("", "Clean: "), ("joint_harmonic@3", "Named: a wave of order 1")]
)
def test_diagnose_prints_it_and_the_folder(hide, verdict, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_touches(simulate_touches(bathyal.arms.ur10e(), hide=hide).touches, "t.csv")
    code, out, err = run(capsys, "diagnose", "t.csv", "--arm", "ur10e", *KNOWN, "-o", "found")
    assert code == 0, err
    first, rows, rest = lines_of(out)
    assert first.startswith(verdict)
    assert len(rows) <= 5
    assert rest[0].startswith("Next: ")
    assert rest[1:] == [
        "Written to found: model.json report.html report.json report.png residuals.csv"
    ]
    report = bathyal.diagnose(
        bathyal.arms.ur10e(),
        bathyal.read_touches("t.csv", known_distances={("left", "right"): 0.35}),
    )
    assert str(report) == "\n".join([first, *rows, rest[0]])


def test_identify_prints_it_and_python_too(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_touches(simulate_touches(bathyal.arms.ur10e()).touches, "t.csv")
    code, out, err = run(capsys, "identify", "t.csv", "--arm", "ur10e", *KNOWN, "-o", "found")
    assert (code, err) == (0, "")
    first, rows, rest = lines_of(out)
    assert first == "Identified: the error falls from 2.06 to 0.135 mm (3-D rms)."
    assert len(rows) == MOST_NUMBERS
    assert "63 of left, right, top" in rows[0]
    assert "21 of 27 parameters; 6 redundant with base and tool" in rows[1]
    assert rest[0].startswith("Next: to check the arm, touch a point that was not used")
    assert rest[1].startswith("Written to found: arm.json arm.urdf fit.json")
    fit = bathyal.identify_arm(
        bathyal.arms.ur10e(),
        bathyal.read_touches("t.csv", known_distances={("left", "right"): 0.35}),
    )
    short = str(fit).splitlines()
    assert short[0] == first
    assert short[2:6] == rows[1:]
    assert short[-1] == "Next: check the arm on a dozen poses that were not used."
    assert str(identify_brief.brief_of(fit)) == str(fit) != fit.summary()


def test_an_arm_without_a_known_distance_asks_for_one(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_touches(simulate_touches(bathyal.arms.ur10e()).touches, "t.csv")
    _, out, err = run(capsys, "identify", "t.csv", "--arm", "ur10e", "-o", "found")
    assert out.startswith("Identified, with 1 warning: ")
    assert "Next: measure one distance between touched points, say left to right" in out
    assert err.count("\n") == 1
    assert len(err) < 180


def test_two_warnings_are_shown_short_and_the_others_counted():
    assert short_warnings([]) == []
    assert short_warnings(["One thing. And why.", "Another"]) == ["One thing.", "Another"]
    many = short_warnings(["a", 300 * "b", "c", "d", "e"])
    assert many[0] == "a"
    assert many[1].endswith("b…")
    assert len(many[1]) <= 160
    assert many[2:] == ["3 more, in report.html"]


def test_rows_are_aligned():
    brief = Brief("Clean.", {"a": "1 mm", "long": "2 mm"}, "Go on.")
    assert str(brief) == "Clean.\n  a     1 mm\n  long  2 mm\nNext: go on."
