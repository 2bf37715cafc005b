# SPDX-License-Identifier: BSD-3-Clause
"""Records so long that they are searched in some of their rows first."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np

import bathyal
from tests.support.diagnosis_record import ARM, record

ROWS, SLIP, SHIFT = 6500, 4000, 4e-4  # the tool slips by SHIFT [m] before row SLIP
GROSS = np.arange(50, ROWS, 600)  # rows, most of which no search in some rows sees
JUMP = np.array([0.003, 0.0, -0.003])  # [m]


@cache
def measured() -> bathyal.Tracked:
    q, position = record(ROWS, size=2e-4)
    axes = ARM.forward(q)[SLIP:, :3, 0]
    position[SLIP:] += SHIFT * axes
    position[GROSS] += JUMP
    return bathyal.Tracked(q, position, covariates={"time": 2.0 * np.arange(ROWS)})


@cache
def diagnosed(num_threads: int) -> Any:
    return bathyal.diagnose(ARM, measured(), num_threads=num_threads)


def test_its_causes_are_found_and_estimated_from_all_rows() -> None:
    report = diagnosed(2)
    assert report.verdict == "named"
    found = {(e.name, e.joint): e for e in report.effects}
    assert set(found) == {("joint_harmonic", 1), ("tool_slip", None), ("outliers", None)}
    low, high = found["joint_harmonic", 1].parameters["cos"].interval
    assert low < 2e-4 < high
    assert high - low < 1.2e-5  # of a third of the rows it is 1.5e-5
    assert found["tool_slip", None].parameters["moment"].value == SLIP
    low, high = found["tool_slip", None].parameters["shift_x"].interval
    assert low < SHIFT < high
    assert set(GROSS) <= set(found["outliers", None].rows)


def test_any_number_of_threads_gives_the_same_bytes() -> None:
    one, two = diagnosed(1), diagnosed(2)
    assert np.array_equal(one.residuals_after, two.residuals_after)
    assert np.array_equal(one.held_out.after, two.held_out.after, equal_nan=True)
    for a, b in zip(one.effects, two.effects, strict=True):
        assert {n: v.value for n, v in a.parameters.items()} == {
            n: v.value for n, v in b.parameters.items()
        }


def test_what_is_clean_stays_clean() -> None:
    q, position = record(ROWS, size=0.0)
    assert bathyal.diagnose(ARM, bathyal.Tracked(q, position)).verdict == "clean"
