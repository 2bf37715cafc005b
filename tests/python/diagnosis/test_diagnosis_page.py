# SPDX-License-Identifier: BSD-3-Clause
"""The page of a diagnosis: whole, offline, and the same twice."""

from __future__ import annotations

import json
import math
import re
from html.parser import HTMLParser

import numpy as np
import pytest

import bathyal
from bathyal.diagnosis.files import write_diagnosis
from bathyal.diagnosis.report import quantities as tables
from bathyal.diagnosis.report.advice import next_steps
from bathyal.diagnosis.report.page import _poses, write_page
from bathyal.diagnosis.report.text import summary
from tests.support import diagnosis_cases as cases

ALL = pytest.mark.parametrize("name", cases.CASES)


class Outline(HTMLParser):
    """Checks that what is opened is closed; keeps pictures and links."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.sources: list[str] = []
        self.feed(text)
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.sources += [value or "" for name, value in attrs if name in ("src", "href")]
        if tag == "img":
            assert dict(attrs)["alt"]
        if tag not in ("meta", "img", "link", "br"):
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


@ALL
def test_page_is_whole_and_needs_no_network(name, tmp_path):
    report = cases.CASES[name]()
    write_page(report, tmp_path / "r.html", title="<UR10> & friends", facts={"arm": "<b>"})
    text = (tmp_path / "r.html").read_text(encoding="utf-8")
    outline = Outline(text)
    assert all(source.startswith("data:image/svg+xml;base64,") for source in outline.sources)
    assert "http" not in re.sub(r"base64,[^']*", "", text)
    assert text.index('class="verdict"') < text.index('class="tiles"') < text.index("<h2>")
    steps = [text.index(f"<h2><i>{k}</i>") for k in (1, 2, 3, 4)]
    assert steps == sorted(steps)
    for warning in report.warnings:
        assert warning.replace("'", "&#x27;") in text
    assert "<UR10>" not in text
    assert "&lt;UR10&gt; &amp; friends" in text
    assert not re.search(r"\bnan\b|\bNone\b", re.sub(r"base64,[^']*", "", text))
    assert ("Poses to measure next" in text) == (name == "ambiguous")
    assert ("error on data held out, before and after" in text) == (name != "none")
    assert len(text) < 3e6


def test_names_are_text_and_no_markup(tmp_path):
    report = cases.many()
    report.effects[0].rivals = [cases.cause("x", None, "<script>alert('ü')</script>", 0.5)]
    report.held_out.parts[0].name = "сессия <1> $\\frac"
    report.shown[0].against = "<i>$x^"
    report.warnings = ["<img src=x>", "$\\alpha"]
    write_diagnosis(report, tmp_path / "r.html")
    text = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert "<script" not in text
    assert "<img src=x>" not in text
    assert "sessions &lt;1&gt; &amp; 2" in text
    assert "Größe µ ✓" in text
    write_diagnosis(report, tmp_path / "r.png")


def test_page_and_sheet_are_the_same_bytes_twice(tmp_path):
    for name in ("a", "b"):
        write_diagnosis(cases.none(), tmp_path / f"{name}.html")
        write_diagnosis(cases.none(), tmp_path / f"{name}.png")
    assert (tmp_path / "a.html").read_bytes() == (tmp_path / "b.html").read_bytes()
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")


def test_the_next_poses_are_listed_in_degrees():
    report = cases.ambiguous()
    text = _poses(report)
    assert "Poses to measure next" in text
    assert f"<td>{math.degrees(report.next_poses[0, 0]):.2f}</td>".replace("-", "−") in text
    assert _poses(cases.named()) == ""


def test_a_page_of_many_rows_stays_small_and_says_what_it_draws(tmp_path):
    report = cases.base(count=12_000, sessions=3)
    write_diagnosis(report, tmp_path / "r.html")
    text = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert len(text) < 4e6
    assert "1,500 of 12,000 rows are drawn" in text


def test_rows_that_were_not_held_out_are_left_out(tmp_path):
    report = cases.named()
    report.held_out.before = np.where(np.arange(240) % 3 == 0, np.nan, report.held_out.before)
    report.held_out.after = np.full(240, np.nan)
    write_diagnosis(report, tmp_path / "r.html")
    write_diagnosis(report, tmp_path / "r.json")
    kept = json.loads((tmp_path / "r.json").read_text())["held_out"]
    assert kept["after_m"] == [None] * 240
    assert kept["before_m"][0] is None
    assert kept["before_m"][1] == report.held_out.before[1]


@pytest.mark.parametrize("size", [0.0, 1e-300, 5e-324, 1e6, math.inf, math.nan])
def test_odd_numbers_are_drawn_and_written(size, tmp_path):
    report = cases.named()
    effect = report.effects[0]
    effect.p_value = effect.size = effect.gain = size
    effect.parameters["cos"] = cases.Estimate(
        value=1e-4, unit="rad", std=size, interval=(-size, size)
    )
    report.shown[0].p_value = report.held_out.p_value = size
    report.leftover.size = size
    write_diagnosis(report, tmp_path / "r.json")
    assert "  " not in summary(report)
    if size in (0.0, math.inf) or math.isnan(size):
        write_diagnosis(report, tmp_path / "r.html")
    kept = json.loads((tmp_path / "r.json").read_text())["effects"][0]
    assert kept["p_value"] == (size if math.isfinite(size) else None)


def test_touches_have_positions_of_their_own(tmp_path):
    """Measured positions are those that the identified arm predicts."""
    from tests.support.touch_jobs import simulated

    made = simulated()
    fit = bathyal.identify_arm(bathyal.arms.ur10e(), made.touches)
    report = cases.named()
    report.__dict__.update(data=made.touches, fit=fit, residuals_before=fit.residuals,
                           residuals_after=fit.residuals)  # fmt: skip
    report.held_out.before = report.held_out.after = np.linalg.norm(fit.residuals, axis=1)
    place = tables.positions(report)
    assert np.abs(place - fit.points[made.touches.point]).max() < 1e-3
    write_diagnosis(report, tmp_path / "r.html")
    assert "touch each point" in next_steps(_with(report, verdict="none"))[0].lower()


def _with(report, **changes):
    report.__dict__.update(changes)
    return report


def test_a_crowd_of_dependences_is_cut_and_counted(tmp_path):
    report = cases.named()
    report.shown = [
        cases.on_joint(k, f"The residual bends along joint {k}", 1e-4, 0.1, 1e-4) for k in range(40)
    ]
    write_page(report, tmp_path / "report.html")
    text = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "25 more are listed in report.json." in text
    assert "The residual bends along joint 14" in text
    assert "The residual bends along joint 15" not in text
