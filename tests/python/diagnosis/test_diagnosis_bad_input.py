# SPDX-License-Identifier: BSD-3-Clause
"""Diagnosis of data that people hand in by mistake: refused by the argument's name, or a true
verdict with a warning.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import bathyal
from bathyal import Tracked
from bathyal.effects import Effect
from tests.support.diagnosis_record import (
    ARM,
    NAN,
    TIME,
    N,
    P,
    Q,
    diagnosed,
    is_right,
    record,
    refuses,
    some,
)
from tests.support.touch_cases import drawn, touched

# Covariates --------------------------------------------------------------------------------------

SAME = "is the same in all rows"
TOLD: dict[str, tuple[dict[str, Any], list[str]]] = {
    "constant": ({"temperature": np.full(N, 20.0)}, [f"`temperature` {SAME}"]),
    "constant_time": ({"time": np.zeros(N)}, [f"`time` {SAME}"]),
    "constant_direction": ({"direction": np.ones((N, 3))}, [f"`direction` {SAME}"]),
    "constant_other": ({"pressure": np.ones(N)}, [f"`pressure` {SAME}"]),
    "constant_payload": ({"payload": np.ones(N)}, [f"`payload` {SAME}"]),
    "no_news": ({"gravity": np.tile([0, 0, -9.8], (N, 1)), "session": np.zeros(N)}, []),
    "some": (
        {"temperature": some(20 + TIME / 100)},
        ["`temperature` is missing in 30 of 90 rows and was not used; what needs it was not "
         "looked for: thermal. To use it, diagnose the rows that have it by themselves."],
    ),
    "never": ({"temperature": np.full(N, NAN)}, ["missing in 90 of 90 rows"]),
    "some_other": ({"pressure": some(np.sin(TIME))}, ["`pressure` is missing in 30 of 90 rows"]),
    "some_time": ({"time": some(TIME)}, ["rows were taken in the order of the record"]),
    "some_load": ({"payload": some(TIME % 40)}, ["the arm was taken to carry nothing"]),
    "some_gravity": ({"gravity": some(np.tile([0, 0, -9.8], (N, 1)))}, ["9.80665"]),
    "some_sessions": ({"session": some(TIME > 500)}, ["all rows were taken as one session"]),
    "some_directions": ({"direction": some(np.sign(Q))}, ["not looked for: backlash"]),
    "back": ({"time": TIME[::-1].copy()}, ["`time` runs backwards 89 times, first at row 1 "]),
    "clock_set_back": ({"time": np.where(TIME > 400, TIME - 400, TIME)}, ["once, at row 41 "]),
    "clocks": (
        {"time": np.r_[TIME[:45], TIME[:45]], "session": TIME >= 450},
        ["Sessions overlap in `time`"],
    ),
    "days": ({"time": TIME, "session": TIME >= 450}, []),
    "nanoseconds": ({"time": 1.7e18 + 1e9 * TIME}, []),
    "two_rows": ({"session": np.arange(N) >= N - 2}, ["1 of 2 sessions has fewer than three rows"]),
    "one_row_each": ({"session": np.arange(N)}, ["90 of 90 sessions have fewer than three rows"]),
    "labels": ({"session": np.where(TIME > 400, -7, 10**9)}, []),
    "wide": ({"image": np.random.default_rng(0).normal(size=(N, 30))}, []),
    "load_without_masses": ({"payload": (TIME > 400) * 2.0}, []),
    "names_that_clash": ({"joint 2": TIME % 70, "position": TIME % 90, "": TIME % 110}, []),
}  # fmt: skip


@pytest.mark.parametrize("case", TOLD)
def test_unusual_covariates_are_reported_and_the_cause_is_found_all_the_same(case: str) -> None:
    covariates, texts = TOLD[case]
    covariates = {name: np.asarray(values, float) for name, values in covariates.items()}
    report = diagnosed(covariates=covariates)
    is_right(report)
    assert len(report.warnings) == len(texts), report.warnings
    for text, warning in zip(texts, report.warnings, strict=True):
        assert text in warning
        assert warning in report.summary()


def test_a_covariate_with_gaps_changes_nothing_else() -> None:
    plain, gaps = diagnosed(), diagnosed(covariates={"temperature": some(20 + TIME)})
    assert np.array_equal(plain.residuals_after, gaps.residuals_after)
    assert plain.gain == gaps.gain


def test_sessions_of_three_rows_share_the_blocks() -> None:
    report = diagnosed(session=np.arange(N) // 3)
    is_right(report)
    assert report.held_out.blocks == 10
    assert "base_shift was not tried with 174 numbers" in report.warnings[0]


def test_an_effect_that_needs_what_is_not_there_is_reported() -> None:
    effect = Effect("swell", lambda data, j: data.q[:, j], parameters={"rate": "rad"},
                    joints="each", needs=["tide"])  # fmt: skip
    report = diagnosed(options={"effects": [*bathyal.effects.list(), effect]})
    is_right(report)
    assert report.warnings == [
        "The effect swell was not looked for: it needs `tide`, which was not recorded."
    ]


# Poses and positions ------------------------------------------------------------------------------


@pytest.mark.parametrize("rows", [3, 5, 8])
def test_too_few_rows_give_no_verdict(rows: int, tmp_path: Path) -> None:
    q, position = record(rows)
    report = diagnosed(q, position)
    assert (report.verdict, report.effects, report.ambiguous) == ("none", [], [])
    assert report.held_out.how == f"{rows} poses leave hardly more equations than unknowns"
    assert report.warnings[0].startswith("Too few data to hold any out")
    assert np.isnan([report.gain, report.detectable, report.held_out.rms_after]).all()
    assert "nan" not in report.summary()
    report.write(tmp_path / "report.json")
    assert json.loads((tmp_path / "report.json").read_text())["gain"] is None
    report.write(tmp_path / "report.html")
    report.model.forward(q)


def test_two_poses_again_and_again_give_no_verdict() -> None:
    random = np.random.default_rng(2)
    for rows in (2, N):
        two = np.arange(rows) % 2
        report = diagnosed(Q[two], P[two] + random.normal(0, 1e-5, (rows, 3)))
        assert report.verdict == "none"
        assert report.held_out.how == (
            f"{rows} poses make fewer than three blocks of poses that differ"
        )


@pytest.mark.parametrize("where", ["tracker", "base", "both"])
def test_an_offset_of_a_thousand_kilometres_changes_nothing(where: str) -> None:
    far = np.array([1e6, -1e6, 1e6])
    arm = ARM.copy()
    base = np.eye(4)
    base[:3, 3] = far * (where != "tracker")
    arm.base = base
    plain = diagnosed()
    report = bathyal.diagnose(arm, Tracked(Q, P + far * (where != "base")))
    is_right(report)
    # A double counts in steps of 1e-10 m out there; noise is 5e-5 m.
    for name, known in plain.effects[0].parameters.items():
        found = report.effects[0].parameters[name]
        assert abs(found.value - known.value) <= 1e-4 * max(known.std, 1e-3), name
        assert found.std == pytest.approx(known.std, rel=1e-4), name
    np.testing.assert_allclose(report.residuals_after, plain.residuals_after, rtol=0, atol=5e-8)
    np.testing.assert_allclose(report.held_out.after, plain.held_out.after, rtol=0, atol=5e-8)
    assert report.gain == pytest.approx(plain.gain, abs=1e-6)
    assert report.noise == pytest.approx(plain.noise, rel=1e-5)


def test_copies_of_rows_count_once() -> None:
    plain = diagnosed()
    twice = np.r_[0:N, 5, 7, 7]
    report = diagnosed(Q[twice], P[twice], session=np.r_[np.zeros(N, int), 1, 1, 1])
    is_right(report)
    assert report.warnings[0].startswith(
        "3 rows are copies of others to the last digit (rows 90, 91 and 92, counted from 0)."
    )
    assert report.gain == plain.gain
    for rows in (report.residuals_after, report.residuals_before, report.fit.residuals):
        assert rows.shape == (N + 3, 3)
    assert np.array_equal(report.residuals_after, plain.residuals_after[twice])
    assert np.array_equal(report.held_out.after, plain.held_out.after[twice])


def test_a_table_of_touches_handed_in_twice_counts_once() -> None:
    touches, arm = touched(3, 25).touches(), drawn()
    q, point = touches.q, touches.point
    plain = bathyal.diagnose(arm, touches)
    report = bathyal.diagnose(arm, bathyal.Touches(np.r_[q, q], np.r_[point, point]))
    assert (report.verdict, report.gain) == (plain.verdict, plain.gain)
    assert report.warnings[-1].startswith("75 rows are copies of others to the last digit")
    assert report.residuals_after.shape == (150, 3)


def test_repeats_with_another_load_are_no_copies() -> None:
    report = diagnosed(np.r_[Q, Q], np.r_[P, P], covariates={"payload": np.repeat([0.0, 2.0], N)})
    assert report.warnings == []


def test_outliers_are_named_by_their_rows_among_copies() -> None:
    position = P.copy()
    position[40] += 0.1
    rows = np.r_[0, 0, 0:N]
    report = diagnosed(Q[rows], position[rows])
    (found,) = [effect for effect in report.effects if effect.name == "outliers"]
    assert found.rows == [42]


def test_exact_data_are_clean() -> None:
    report = diagnosed(*record(noise=0.0, size=0.0))
    assert (report.verdict, report.effects) == ("clean", [])
    assert report.warnings[0].startswith("Noise of 1e-06 mm per axis is less than any instrument")
    is_right(diagnosed(*record(noise=1e-6)))


@pytest.mark.parametrize("noise", [1.0, 1e3])
def test_noise_that_drowns_the_arm_is_no_cause_and_is_reported(noise: float) -> None:
    report = diagnosed(*record(noise=noise))
    assert (report.verdict, report.effects) == ("clean", [])
    assert "Arm and data look like different machines" in report.warnings[0]


@pytest.mark.parametrize("factor", [1e3, [1.0, 1.0, -1.0]], ids=["millimetres", "mirrored"])
def test_data_of_another_machine_are_reported(factor: Any) -> None:
    report = diagnosed(position=P * factor)
    assert report.verdict == "unknown"
    assert "Arm and data look like different machines" in report.warnings[0]
    assert report.fit.warnings[0] == report.warnings[0]


DATA: dict[str, tuple[Callable[[], Any], str]] = {
    "nan": (lambda: Tracked(Q, some(P)), "`position`: expected finite numbers, got nan at row 0"),
    "far": (lambda: Tracked(Q, P + 1e300), r"`position`: expected metres within 1e\+09 .*at row 0"),
    "dropout": (lambda: Tracked(Q, np.r_[P[:-1], [[1e12, 0, 0]]]), "`position`: .* at row 89"),
    "still_tip": (lambda: diagnosed(position=0 * P), "`position`: expected positions that differ"),
    "equal_poses": (lambda: Tracked(0 * Q, P), "`q`: expected poses that differ"),
    "one_row": (lambda: Tracked(Q[:1], P[:1]), "`q`: expected two poses or more"),
    "no_rows": (lambda: Tracked(Q[:0], P[:0]), "`q`: expected at least one row"),
    "weightless": (
        lambda: Tracked(Q, P, weights=np.r_[np.ones(N - 1), 1e-300]),
        "`weights`: expected numbers within a factor",
    ),
    "far_point": (
        lambda: bathyal.Touches(Q, np.zeros(N, int), known_points={0: (1e300, 0, 0)}),
        "`known_points`: expected metres within",
    ),
    "other_arm": (
        lambda: bathyal.diagnose(bathyal.arms.ur10(), Tracked(Q, P)),
        "`q`: expected 6 columns, the joints of UR10, got 3",
    ),
}
COVARIATES: dict[str, tuple[Any, str]] = {
    "short": ({"time": TIME[:-1]}, "`covariates time`: expected 90 rows, .* got 89 rows"),
    "columns": ({"time": np.c_[TIME, TIME]}, r"`covariates time`: expected shape \(90, 1\)"),
    "none": ({"image": np.empty((N, 0))}, "`covariates image`: expected one column or more"),
    "deep": ({"image": np.ones((N, 2, 2))}, r"`covariates image`: .* of shape \(N,\) or \(N, k\)"),
    "scalar": ({"pressure": 3.0}, "`covariates pressure`: expected real numbers"),
    "words": ({"who": ["me"] * N}, "`covariates who`: expected real numbers"),
    "inf": ({"pressure": np.where(TIME == 50, np.inf, 1)}, "`covariates pressure`.* inf at row 5"),
    "overflow": ({"pressure": 1e301 * TIME}, r"`covariates pressure`: .* 1e\+302 at row 1"),
    "negative": ({"payload": -TIME}, "`covariates payload`: .* 0 or more, got -10 at row 1"),
    "direction": ({"direction": 0.5 * np.ones((N, 3))}, "`covariates direction`: .* 0 or 1, got"),
    "one_direction": ({"direction": np.ones(N)}, r"`covariates direction`: .*\(90, 3\)"),
    "gravity": ({"gravity": [0, 0, -9.8]}, "`covariates gravity`: expected 90 rows"),
    "half": ({"session": TIME / 4}, "`covariates session`: .* whole numbers, got 2.5 at row 1"),
    "list": ([1.0] * N, "`covariates`: expected a dict"),
}


@pytest.mark.parametrize("case", DATA)
def test_data_that_are_none_are_refused(case: str) -> None:
    refuses(*DATA[case])


@pytest.mark.parametrize("case", COVARIATES)
def test_covariates_that_are_none_are_refused(case: str) -> None:
    covariates, message = COVARIATES[case]
    refuses(lambda: diagnosed(covariates=covariates), message)


def test_sessions_are_given_once_and_in_whole_numbers() -> None:
    refuses(
        lambda: diagnosed(session=np.zeros(N), covariates={"session": np.zeros(N)}),
        "`session`: expected the sessions once",
    )
    refuses(lambda: diagnosed(session=some(np.zeros(N))), "`session`: .* got nan at row 0")
    refuses(lambda: diagnosed(session=1e10 * TIME), r"`session`: .* 32 bits, got 1e\+11 at row 1")
    refuses(lambda: diagnosed(session=[0, 1]), "`covariates session`: expected 90 rows")
