# SPDX-License-Identifier: BSD-3-Clause
"""The harness that runs cases of bad input sees what goes wrong, and there are enough cases.

What people hand in by mistake is in `test_bad_*.py`. What is valid, however unusual, works and is
checked; the rest is refused with an error that names the argument or the file. A signal, a silent
wrong answer, a raw error of some library or a minute's wait fails.
"""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tests.python.bad_input import (
    test_bad_aims_files,
    test_bad_files,
    test_bad_meshes,
    test_bad_plans,
    test_bad_points,
    test_bad_writing,
)
from tests.support.alone import refused, run_alone

ROOMS = (
    test_bad_points,
    test_bad_meshes,
    test_bad_plans,
    test_bad_files,
    test_bad_aims_files,
    test_bad_writing,
)


def test_names_differ_and_there_are_enough() -> None:
    names = [case.name for room in ROOMS for case in room.CASES]
    assert len(names) == len(set(names)) >= 244


@pytest.mark.parametrize(
    ("body", "wrong"),
    [
        (lambda: os.kill(os.getpid(), 11), "signal SIGSEGV"),
        (lambda: 5, "no error"),
        (lambda: {}["x"], "KeyError"),
        (lambda: (_ for _ in ()).throw(ValueError("oh")), "does not say"),
    ],
)
def test_the_harness_sees_what_goes_wrong(body: object, wrong: str, tmp_path: Path) -> None:
    assert wrong in run_alone(refused("harness", "points", body), tmp_path)  # type: ignore[arg-type]
