# SPDX-License-Identifier: BSD-3-Clause
"""Points that are too few, wrong, not finite or odd, each case in a process of its own."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import bathyal
from bathyal import Error
from tests.support.alone import Case, check, refused, works
from tests.support.bad_input import ANY, FAR, GRID, is_grid, same

NAN = GRID.copy()
NAN[7, 1] = math.nan
INFINITE = GRID.copy()
INFINITE[3, 2] = -math.inf
COLLINEAR = np.array([[i, 2.0 * i, 0.5] for i in range(20)])
FEW = {
    "no points": np.zeros((0, 3)),
    "one point": GRID[:1],
    "two points": GRID[:2],
    "three collinear points": COLLINEAR[:3],
    "twenty collinear points": COLLINEAR,
    "collinear points far away": COLLINEAR + FAR,
    "all points equal": np.ones((50, 3)),
    "a vertical line": np.array([[1.0, 1.0, z] for z in range(30)]),
}
WRONG = {
    "None": (None, ANY),
    "a text": ("points", ANY),
    "a number": (5.0, ANY),
    "two columns": (GRID[:, :2], ANY),
    "four columns": (np.ones((5, 4)), ANY),
    "one dimension": (GRID.ravel(), ANY),
    "three dimensions": (GRID.reshape(5, 6, 3), ANY),
    "complex numbers": (GRID * 1j, ANY),
    "objects": (GRID.astype(object), ANY),
    "texts": (GRID.astype(str), ANY),
    "booleans": (GRID > 1, ANY),
    "ragged rows": ([[0, 0, 0], [1, 0]], ANY),
    "dates": (np.zeros((4, 3), dtype="datetime64[s]"), ANY),
}

CASES: list[Case] = []
for _name, _points in FEW.items():
    for _method in ("delaunay", "greedy"):
        CASES.append(
            refused(
                f"triangulate {_method}: {_name}",
                "point|cloud|PCL|_pcl",
                lambda p=_points, m=_method: bathyal.triangulate(p, method=m),
                (ValueError, Error) if _method == "greedy" else (ValueError,),
            )
        )
    if _name != "a vertical line":
        CASES.append(
            refused(f"fit_plane: {_name}", "point|cloud", lambda p=_points: bathyal.fit_plane(p))
        )
for _name, (_points, _errors) in WRONG.items():
    for _function in (bathyal.PointCloud, bathyal.triangulate, bathyal.fit_plane):
        CASES.append(
            refused(
                f"{_function.__name__}: {_name}",
                "points|cloud",
                lambda f=_function, p=_points: f(p),
                _errors,
            )
        )
for _name, _points in {"NaN": NAN, "an infinity": INFINITE}.items():
    for _function in (bathyal.triangulate, bathyal.fit_plane, bathyal.find_sheets):
        CASES.append(
            refused(
                f"{_function.__name__}: {_name}",
                "finite",
                lambda f=_function, p=_points: f(p),
            )
        )
    CASES.append(
        refused(
            f"mesh with {_name}", "vertices", lambda p=_points: bathyal.TriangleMesh(p, [[0, 1, 2]])
        )
    )


def cleans_what_is_not_finite() -> None:
    result = bathyal.clean_cloud(bathyal.PointCloud(np.vstack([NAN, INFINITE[3:4], GRID[:2]])))
    assert result.report.not_finite == 2
    assert result.report.duplicates == 2
    same(len(result.cloud), len(GRID) - 1)


def same_whatever_the_array(change: object) -> None:
    is_grid(bathyal.triangulate(change(GRID)))  # type: ignore[operator]


def read_only(points: np.ndarray) -> np.ndarray:
    points = points.copy()
    points.setflags(write=False)
    return points


CASES += [
    works("clean_cloud: NaN, infinity, duplicates", cleans_what_is_not_finite),
    works("cloud of no points", lambda: same(len(bathyal.PointCloud(np.zeros((0, 3)))), 0)),
    works("triangulate: a read-only array", lambda: same_whatever_the_array(read_only)),
    works(
        "triangulate: every second row",
        lambda: is_grid(bathyal.triangulate(np.repeat(GRID, 2, 0)[::2])),
    ),
    works("triangulate: rows turned about", lambda: same_whatever_the_array(lambda p: p[::-1])),
    works("triangulate: Fortran order", lambda: same_whatever_the_array(np.asfortranarray)),
    works("triangulate: float32", lambda: same_whatever_the_array(lambda p: p.astype("f4"))),
    works("triangulate: big-endian", lambda: same_whatever_the_array(lambda p: p.astype(">f8"))),
    works(
        "triangulate: whole numbers",
        lambda: same_whatever_the_array(lambda p: (100 * p).astype(int) / 100),
    ),
    works("triangulate: a list of lists", lambda: same_whatever_the_array(lambda p: p.tolist())),
    works("triangulate: 1e7 m from the origin", lambda: same_whatever_the_array(lambda p: p + FAR)),
    works(
        "triangulate: -1e7 m from the origin", lambda: same_whatever_the_array(lambda p: p - FAR)
    ),
    works(
        "triangulate: every point four times",
        lambda: is_grid(bathyal.triangulate(np.tile(GRID, (4, 1)))),
    ),
    works(
        "fit_plane: 1e7 m from the origin",
        lambda: same(bathyal.fit_plane(GRID * [1, 1, 0] + FAR).plane.normal, [0, 0, 1]),
    ),
    refused(
        "triangulate: points beyond reason", "points", lambda: bathyal.triangulate(GRID * 1e200)
    ),
    refused(
        "triangulate: an unknown method", "method", lambda: bathyal.triangulate(GRID, method="best")
    ),
    refused(
        "triangulate: an unknown option",
        "max_length",
        lambda: bathyal.triangulate(GRID, max_length=3),
        ANY,
    ),
    refused(
        "triangulate: max_edge of 0", "max_edge", lambda: bathyal.triangulate(GRID, max_edge=0.0)
    ),
    refused(
        "triangulate: max_edge below 0",
        "max_edge",
        lambda: bathyal.triangulate(GRID, max_edge=-1.0),
    ),
    refused(
        "triangulate: max_edge NaN",
        "max_edge",
        lambda: bathyal.triangulate(GRID, max_edge=math.nan),
    ),
    refused(
        "triangulate: threads below 0",
        "num_threads",
        lambda: bathyal.triangulate(GRID, num_threads=-1),
    ),
    refused(
        "cloud: an attribute too short",
        "uncertainty",
        lambda: bathyal.PointCloud(GRID, attributes={"uncertainty": [1.0]}),
    ),
    refused(
        "cloud: an attribute of texts",
        "name",
        lambda: bathyal.PointCloud(GRID[:1], attributes={"name": ["a"]}),
    ),
    refused(
        "clean_cloud: a voxel below 0",
        "voxel",
        lambda: bathyal.clean_cloud(bathyal.PointCloud(GRID), voxel=-1.0),
    ),
    refused(
        "clean_cloud: a voxel of NaN",
        "voxel",
        lambda: bathyal.clean_cloud(bathyal.PointCloud(GRID), voxel=math.nan),
    ),
    refused(
        "clean_cloud: a rule there is not",
        "same_place",
        lambda: bathyal.clean_cloud(bathyal.PointCloud(GRID), same_place="best"),
    ),
]


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_bad_input(case: Case, tmp_path: Path) -> None:
    check(case, tmp_path)
