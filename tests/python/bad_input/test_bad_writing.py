# SPDX-License-Identifier: BSD-3-Clause
"""Places that cannot be written, and far coordinates written and read back, each case alone."""

from __future__ import annotations

from pathlib import Path

import pytest

import bathyal
from bathyal import Error
from tests.support.alone import Case, check, refused, works
from tests.support.bad_input import FAR, GRID, TWO, bottom, same, scene


def round_trip(name: str) -> None:
    bathyal.write_cloud(bathyal.PointCloud(GRID + FAR), name)
    same(bathyal.read_cloud(name).points, GRID + FAR, 5e-4)


CASES: list[Case] = [
    *(
        works(f"write and read {s}, 1e7 m away", lambda s=s: round_trip("a" + s))
        for s in (".xyz", ".csv", ".ply", ".vtp")
    ),
    refused(
        "write_mesh: no such folder",
        "none",
        lambda: bathyal.write_mesh(bottom(), "none/a.vtp"),
        (Error, OSError),
    ),
    refused(
        "write_mesh: over a folder",
        "a.vtp",
        lambda: (Path("a.vtp").mkdir(), bathyal.write_mesh(bottom(), "a.vtp")),
        (Error, OSError),
    ),
    refused("write_mesh: an unknown ending", "path", lambda: bathyal.write_mesh(bottom(), "a.doc")),
    refused(
        "write_cloud: no such folder",
        "none",
        lambda: bathyal.write_cloud(bathyal.PointCloud(GRID), "none/a.xyz"),
        (Error, OSError),
    ),
    refused(
        "path.write: no such folder",
        "none",
        lambda: bathyal.plan_toolpath(scene(), TWO).write("none/path.csv"),
        (Error, OSError),
    ),
    refused(
        "path.write: an unknown ending",
        "path",
        lambda: bathyal.plan_toolpath(scene(), TWO).write("path.doc"),
    ),
]


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_bad_input(case: Case, tmp_path: Path) -> None:
    check(case, tmp_path)
