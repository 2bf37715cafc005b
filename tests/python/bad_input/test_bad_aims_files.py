# SPDX-License-Identifier: BSD-3-Clause
"""Files of aims that are broken, each case in a process of its own."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import bathyal
from bathyal import Error
from tests.support.alone import Case, check, refused
from tests.support.bad_input import ANY, BROKEN, down, written

NOISE = bytes(np.random.default_rng(7).integers(0, 256, 5000, dtype=np.uint8))

CASES: list[Case] = [
    refused(
        "read_aims: nothing there",
        "gone.csv",
        lambda: bathyal.read_aims("gone.csv"),
        (Error, OSError),
    ),
    refused(
        "read_aims: an unknown ending", "path", lambda: bathyal.read_aims(written("a.doc", ""))
    ),
    refused("read_aims: empty", "a.csv", lambda: bathyal.read_aims(written("a.csv", "")), BROKEN),
    refused(
        "read_aims: noise", "a.csv", lambda: bathyal.read_aims(written("a.csv", NOISE)), BROKEN
    ),
    refused(
        "read_aims: no header",
        "a.csv",
        lambda: bathyal.read_aims(written("a.csv", "1,2,3,0,0,-1\n")),
        BROKEN,
    ),
    refused(
        "read_aims: a word",
        "line 2",
        lambda: bathyal.read_aims(written("a.csv", "px_m,py_m,pz_m,dx,dy,dz\n1,2,three,0,0,-1\n")),
        BROKEN,
    ),
    refused(
        "read_aims: a unit there is not",
        "line 1",
        lambda: bathyal.read_aims(written("a.csv", "px_ft,py_ft,pz_ft,dx,dy,dz\n1,2,3,0,0,-1\n")),
        BROKEN,
    ),
    refused(
        "read_aims: angles without a unit",
        "unit",
        lambda: bathyal.read_aims(written("a.csv", "px_m,py_m,pz_m,pan,tilt\n1,2,3,0,-1\n")),
        BROKEN,
    ),
    refused(
        "read_aims: true as a number",
        r"a.json: `aims\[0\]\[2\]`: expected a number",
        lambda: bathyal.read_aims(written("a.json", "[[0, 0, true, 0, 0, -1]]")),
        BROKEN,
    ),
    refused(
        "read_aims: true in a pose",
        r"`world_from_vehicle\[0\]\[0\]`: expected a number",
        lambda: bathyal.read_aims(
            written(
                "a.json",
                json.dumps(
                    {
                        "aims": [down(0, 0)],
                        "world_from_vehicle": [[True, 0, 0, 0], *np.eye(4)[1:].tolist()],
                    }
                ),
            )
        ),
        BROKEN,
    ),
    refused(
        "read_aims: no direction",
        "line 2|direction",
        lambda: bathyal.read_aims(written("a.csv", "px_m,py_m,pz_m,dx,dy,dz\n1,2,3,0,0,0\n")),
        BROKEN,
    ),
    refused(
        "read_aims: JSON cut off",
        "a.json",
        lambda: bathyal.read_aims(written("a.json", '{"aims": [[1, 2')),
        BROKEN,
    ),
    refused(
        "read_aims: JSON a thousand brackets deep",
        "a.json",
        lambda: bathyal.read_aims(written("a.json", "[" * 100_000)),
        BROKEN,
    ),
    refused(
        "read_aims: JSON that is a number",
        "a.json",
        lambda: bathyal.read_aims(written("a.json", "5")),
        BROKEN,
    ),
    refused(
        "read_aims: a bad pose",
        "world_from_vehicle",
        lambda: bathyal.read_aims(
            written(
                "a.json",
                json.dumps({"aims": [down(0, 0)], "frame": "vehicle", "world_from_vehicle": [[1]]}),
            )
        ),
        ANY,
    ),
]


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_bad_input(case: Case, tmp_path: Path) -> None:
    check(case, tmp_path)
