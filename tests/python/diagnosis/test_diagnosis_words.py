# SPDX-License-Identifier: BSD-3-Clause
"""What the report of a diagnosis says: its numbers and its sentences."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bathyal
from bathyal.diagnosis.files import write_diagnosis
from bathyal.diagnosis.report import numbers
from bathyal.diagnosis.report.advice import next_steps
from bathyal.diagnosis.report.text import groups_of, headline, summary
from tests.support import diagnosis_cases as cases

ALL = pytest.mark.parametrize("name", cases.CASES)


@pytest.mark.parametrize(
    ("metres", "text"),
    [(0.312e-3, "0.312 mm"), (0.0302e-3, "0.030 mm"), (0.2e-3, "0.200 mm"), (0.0125, "12.5 mm"),
     (3e-6, "3.00 µm"), (-1.5e-3, "−1.50 mm"), (1.25, "1.25 m"), (1e-12, "under 1 nm"),
     (0.0, "0 mm"), (math.nan, "?")],
)  # fmt: skip
def test_lengths_are_shown_in_the_unit_that_suits(metres, text):
    assert numbers.length_text(metres) == text


@pytest.mark.parametrize(
    ("name", "value", "unit", "std", "text"),
    [
        ("cos", 4.8e-4, "rad", 1e-5, "0.0275° (0.0264 … 0.0286)"),
        ("scale", 0.0012, "1", 2e-5, "0.1200 % (0.1161 … 0.1239)"),
        ("expansion", 2.3e-5, "1/K", 1e-6, "23.0 µm/(m K) (21.0 … 25.0)"),
        ("rate_x", 1e-3 / 3600, "m/s", 0.0, "1.00 mm/h"),
        ("compliance", 1e-6, "rad/(N m)", 1e-7, "0.057 °/(kN m) (0.046 … 0.069)"),
        ("delay", 0.012, "s", math.inf, "12.0 ms (nothing bounds it)"),
        ("rate", 2e-4, "m/m", 1e-5, "0.200 mm/m (0.180 … 0.220)"),
        ("pull", 5.0, "lux", 0.4, "5.00 lux (4.22 … 5.78)"),
    ],
)
def test_estimates_carry_their_interval_and_no_more_figures(name, value, unit, std, text):
    assert numbers.estimate_text(name, cases.estimate(value, unit, std)) == text


@given(
    st.floats(-1e6, 1e6), st.floats(0, 1e6),
    st.sampled_from(["rad", "m", "1/K", "", "rad/(N m)", "odd"]),
)  # fmt: skip
@settings(max_examples=200, deadline=None)
def test_any_estimate_is_shown_within_its_interval(value, std, unit):
    text = numbers.estimate_text("x", cases.estimate(value, unit, std))
    assert "nan" not in text
    found = [float(n.replace("−", "-")) for n in re.findall(r"−?\d+(?:\.\d+)?(?:e[+−]?\d+)?", text)]
    if "…" in text:
        assert found[1] <= found[0] <= found[2]


@pytest.mark.parametrize(
    ("p", "text"),
    [(0.034, "p = 0.034"), (1e-300, "p < 0.001"), (0.0, "p < 0.001"), (1.0, "p = 1"),
     (math.nan, "p not known")],
)  # fmt: skip
def test_chances(p, text):
    assert numbers.chance_text(p) == text


def test_a_named_cause_comes_with_its_evidence():
    text = summary(cases.named())
    for words in (
        "Named: a harmonic of order 2 along joint 3 with amplitude 0.0286°, cosine 0.01719° (0.016",
        "(moves the tip by 0.200 mm per axis)",
        "the error falls from 0.194 mm to 0.051 mm (3-D rms; noise alone 0.052 mm)",
        "100 % of the variance above noise is explained (p < 0.001)",
        "Nothing beyond noise remains unexplained",
        "4.8 to 1 against it", "Warning: The arm's masses are not known",
    ):  # fmt: skip
        assert words in text
    assert "Warning" not in summary(cases.named(), warnings=False)


def test_what_is_unexplained_is_reported():
    report = cases.named()
    report.leftover = cases.on_joint(5, "The residual bends along joint 5", 3e-5, 0.1, 1e-4)
    text = "Unexplained: The residual bends along joint 5 (0.030 mm per axis, p < 0.001)."
    assert text in summary(report)


def test_clean_says_what_would_have_been_seen():
    text = summary(cases.clean())
    assert text.startswith("Clean: geometry explains 240 poses to within noise")
    assert "the strongest dependence, on joint 1, has p = 0.1." in text
    assert (
        "An effect that moves the tip by 0.012 mm or more per axis would have been detected" in text
    )
    assert "noise is 0.030 mm per axis, by exact repeats of 12 poses" in text
    report = cases.clean()
    report.shown = []
    assert "no dependence has a p-value below 0.002" in summary(report)


def test_ambiguous_lists_all_and_asks_for_poses():
    report = cases.ambiguous()
    text = summary(report)
    assert text.startswith(
        "Ambiguous, these data cannot distinguish: the tool slipped after 120 rows, the base moved "
        "between sessions 1 and 2 (as likely) or the base drifts (9 to 1 against it). Certain "
        "is: a harmonic of order 2 along joint 3 with amplitude"
    )
    assert "Measure the 5 poses of report.next_poses" in next_steps(report)[0]
    report.next_poses = np.empty((0, 6))
    assert "No pose distinguishes them" in next_steps(report)[0]


def test_what_is_sure_leads_where_it_does_more_than_what_is_open():
    report = cases.ambiguous()
    report.effects[0].size = 2 * report.effects[1].size
    text = summary(report)
    assert text.startswith(
        "Ambiguous, but mainly: a harmonic of order 2 along joint 3 with amplitude"
    )
    assert "Among lesser causes these data cannot distinguish: the tool slipped after 120" in text
    assert headline(report) == (
        "Ambiguous: mainly a harmonic of order 2 along joint 3. A lesser choice is open."
    )


def test_groups_of_causes_that_cannot_be_distinguished_stay_apart():
    report = cases.ambiguous()
    report.ambiguous += [
        cases.cause("joint_harmonic", 2, report.effects[0].words),
        cases.cause("joint_coupling", 2, "joint 3 moved along by joint 2", 1.0),
    ]
    assert headline(report) == (
        "Ambiguous: the tool slipped after 120 rows, the base moved between sessions 1 and 2 or "
        "the base drifts; and a harmonic of order 2 along joint 3 or joint 3 moved along by "
        "joint 2."
    )
    assert "Certain is" not in summary(report)


def test_a_crowd_of_alternatives_does_not_flood_the_page():
    report = cases.ambiguous()
    report.ambiguous += [cases.cause("x", None, f"alternative {k}", 0.2) for k in range(60)]
    assert headline(report).endswith(", the base drifts or any of 60 others.")
    assert len(summary(report)) < 2000
    assert len(groups_of(report)[0]) == 63


def test_causes_of_the_noise_are_described_by_their_likelihood(tmp_path):
    report = cases.named()
    report.effects.append(
        cases.effect(
            "range_noise", None, "noise that grows with distance", gain=31.2, p_value=1.0,
            parameters={"rate": cases.estimate(2e-4, "m/m", 1e-5)},
        )
    )  # fmt: skip
    text = summary(report)
    assert "noise that grows with distance with rate 0.200 mm/m (0.180 … 0.220)." in text
    write_diagnosis(report, tmp_path / "r.html")
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert "the log likelihood of data held out gains 31.2" in page


def test_unknown_says_what_it_looks_like_and_pretends_no_name():
    report = cases.unknown()
    assert "harmonic" not in headline(report)
    text = summary(report)
    assert "The residual swings with time, period 12.1 s (0.160 mm per axis, 80 %" in text
    assert "A part of it may be: a harmonic" in text
    assert "The residuals depend on time" in text
    report.effects = []
    assert "A part of it" not in summary(report)


def test_none_says_why():
    text = summary(cases.none())
    assert text.startswith("No verdict, no data could be held out: 40 poses make fewer than four")
    assert "twice" in text
    assert "nan" not in text


def test_what_was_not_recorded_is_reported():
    report = cases.clean()
    assert "Record payload and direction as well" in next_steps(report)[-1]
    data = report.data
    report.data = bathyal.Tracked(
        data.q, data.position, session=data.covariates["session"].ravel(),
        covariates={"time": np.arange(240.0), "temperature": np.ones(240), "payload": np.ones(240),
                    "direction": np.ones((240, 6))},
    )  # fmt: skip
    assert not any("Record" in step for step in next_steps(report))


@ALL
def test_every_verdict_is_one_paragraph_of_sentences(name):
    text = summary(cases.CASES[name]())
    assert "\n" not in text
    assert not re.search(r"nan|inf\b|\.\.|,\.| {2}|\( |\bNone\b", text)
    assert text.endswith(".")
    assert len(text) < 2000


def test_a_share_of_what_is_above_noise_is_reported_where_noise_is_measured() -> None:
    report = cases.named()
    assert "100 % of the variance above noise is explained" in summary(report)
    report.noise_is_measured = False
    report.noise_source = "what the model leaves"
    text = summary(report)
    assert "above noise is explained" not in text
    assert "93 % of the held-out variance is explained" in text
    assert numbers.gained_share_text(report, 0.5) == "46 % of the held-out variance"
