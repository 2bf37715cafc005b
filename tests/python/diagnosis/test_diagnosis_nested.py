# SPDX-License-Identifier: BSD-3-Clause
"""Nested cross-validation: the whole diagnosis without the rows that it predicts."""

from __future__ import annotations

import json
import warnings
from pathlib import Path

import numpy as np
import pytest

import bathyal
from bathyal import Tracked
from tests.support.diagnosis_record import ARM, N, P, Q, diagnosed, is_right, refuses

PART = np.arange(N) % 3
FARM = np.array(["north", "south", "west"])[PART]


def test_each_part_is_predicted_by_a_diagnosis_of_the_others() -> None:
    spoiled = P.copy()
    spoiled[7] += 0.05
    report = diagnosed(position=spoiled, options={"groups": FARM, "nested": 2})
    nested = report.held_out.nested
    assert nested.folds == 3  # the given groups
    assert list(report.effects[0].rows) == [7] or list(report.effects[1].rows) == [7]
    errors, verdicts = np.empty(N), []
    for part in range(3):
        own = part == PART
        others = bathyal.diagnose(ARM, Tracked(Q[~own], spoiled[~own]), groups=FARM[~own])
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", bathyal.SupportWarning)
            tips = others.model.forward(Q[own])[:, :3, 3]
        errors[own] = np.linalg.norm(tips - spoiled[own], axis=1)
        verdicts.append(others.verdict)
    assert nested.verdicts == verdicts
    known = np.arange(N) != 7
    assert np.isnan(nested.after[7])
    np.testing.assert_allclose(nested.after[known], errors[known], atol=1e-9)
    assert nested.rms_after == pytest.approx(np.sqrt(np.mean(errors[known] ** 2)))


def test_causes_are_counted_in_the_parts_that_found_them() -> None:
    report = diagnosed(options={"nested": 5})
    is_right(report)
    assert report.effects[0].nested_folds == 5
    assert report.held_out.nested.folds == 5
    assert report.held_out.nested.verdicts == ["named"] * 5
    # About as good as in folds of values alone: one cause, and the same each time.
    assert report.held_out.nested.rms_after == pytest.approx(report.held_out.rms_after, rel=0.1)


def test_rows_by_a_tool_that_one_part_alone_has_are_not_predicted() -> None:
    tool = (PART == 2).astype(int)
    report = diagnosed(tool=tool, options={"groups": FARM, "nested": 2})
    assert np.array_equal(np.isnan(report.held_out.nested.after), tool == 1)


def test_many_names_in_noise_are_seen_through() -> None:
    # Ten waves of one joint in few poses: names fit, and predict worse than their values did.
    random = np.random.default_rng(3)
    q = random.uniform(-2, 2, (70, 3))
    wrong = q.copy()
    for order in (3.3, 5.1, 7.7, 9.2, 11.9, 14.3):
        wrong[:, 1] += 2e-4 * np.cos(order * q[:, 1] + random.uniform(0, 6))
    seen = ARM.forward(wrong)[:, :3, 3] + random.normal(0, 5e-5, (70, 3))
    held = bathyal.diagnose(ARM, Tracked(q, seen), nested=5).held_out
    assert held.nested.rms_after > 1.2 * held.rms_after


def test_it_is_on_the_page_and_in_the_files(tmp_path: Path) -> None:
    report = diagnosed(options={"nested": 3})
    report.write(tmp_path / "report.json")
    report.write(tmp_path / "report.html")
    kept = json.loads((tmp_path / "report.json").read_text("utf-8"))
    nested = kept["held_out"]["nested"]
    assert nested["folds"] == 3
    assert nested["rms_after_m"] == report.held_out.nested.rms_after
    assert len(nested["after_m"]) == N
    assert kept["effects"][0]["nested_folds"] == 3
    assert "chosen anew" in report.summary()
    assert "causes chosen anew for each of 3 parts" in (tmp_path / "report.html").read_text("utf-8")


def test_unasked_it_is_not_made() -> None:
    report = diagnosed()
    assert report.held_out.nested is None
    assert "chosen anew" not in report.summary()


def test_progress_runs_on_over_all_diagnoses() -> None:
    seen: list[float] = []
    diagnosed(options={"nested": 2, "progress": lambda done, _: seen.append(done)})
    assert seen == sorted(seen)
    assert seen[-1] == 1.0


@pytest.mark.parametrize("nested", [1, -1, 51])
def test_numbers_of_folds_that_make_no_sense(nested: int) -> None:
    refuses(lambda: diagnosed(options={"nested": nested}), "`nested`: expected")


def test_touches_are_refused() -> None:
    touches = bathyal.Touches(Q[:40], np.repeat(np.arange(8), 5))
    refuses(lambda: bathyal.diagnose(ARM, touches, nested=5), "`nested`: expected 0 for touches")
