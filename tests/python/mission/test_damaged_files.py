# SPDX-License-Identifier: BSD-3-Clause
"""Mission files with damage are refused by `bathyal.Error` alone."""

from tests.support.fuzz_missions import read_damaged


def test_damaged_missions_are_missions_or_errors() -> None:
    taken = read_damaged(1000, seed=2)
    assert 0 < taken < 900
