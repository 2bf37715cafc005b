# SPDX-License-Identifier: BSD-3-Clause
"""A fixed part of the score card of hidden effects; `make bench` runs all of it."""

from __future__ import annotations

from math import comb

import numpy as np
import pytest

from tests.simulated_cases.score_card import card, run, text

SEEDS = range(40)
LUCK = 1e-3  # how often an engine that does just what is asked would fall through


def least_right(cases: int, rate: float) -> int:
    """How many of `cases` are right at least, of who is right at `rate`, up to chance."""
    below = 0.0
    for right in range(cases + 1):
        below += comb(cases, right) * rate**right * (1 - rate) ** (cases - right)
        if below > LUCK:
            return right
    return cases


@pytest.fixture(scope="module")
def results():
    cases = run(SEEDS, processes=2)
    print(text(card(cases)))
    return cases


def of(cases, kind, size=None):
    chosen = [c for c in cases if c.kind == kind]
    return [c for c in chosen if size is None or (c.size >= 1 if size == 1 else c.size == size)]


def test_no_case_stops_it(results):
    assert not [c.failure for c in results if c.failure]


@pytest.mark.parametrize(
    ("kind", "size", "rate"),
    [
        ("clean", None, 0.99),
        ("inside", 1, 0.97),
        ("inside", 0.5, 0.90),
        ("inside", 0.25, 0.60),
        ("outside", 1, 0.80),
        ("outside", 0.5, 0.60),
        ("confounded", None, 0.90),
    ],
)
def test_verdicts_are_right_as_often_as_asked(results, kind, size, rate):
    cases = of(results, kind, size)
    wrong = [f"{c.seed}: {c.expected or c.outside} -> {c.verdict} {c.named}" for c in cases
             if not c.exact]  # fmt: skip
    assert len(cases) - len(wrong) >= least_right(len(cases), rate), wrong


def test_what_is_outside_the_library_gets_no_false_name(results):
    cases = of(results, "outside")
    named = [c.seed for c in cases if c.verdict == "named"]
    assert len(cases) - len(named) >= least_right(len(cases), 0.95), named


def test_intervals_hold_the_truth(results):
    inside = [covered for c in results for _, _, covered in c.inside]
    assert len(inside) >= 20
    assert sum(inside) >= least_right(len(inside), 0.93)


def test_what_is_held_out_is_not_known(results):
    """A fit to the very rows that it predicts would leave less than the noise."""
    assert np.median([c.held_out for c in of(results, "clean") if c.exact]) > 1.0


def test_tips_are_predicted_nearly_as_well_as_with_given_causes(results):
    known = [c for c in results if c.kind == "inside" and c.exact]
    square = np.array([[c.error**2, c.refit_error**2] for c in known]).sum(axis=0)
    assert np.sqrt(square[0] / square[1]) <= 1.5
