# SPDX-License-Identifier: BSD-3-Clause
"""What people hand in by mistake, each case in a process of its own.

What is valid, however odd, works and is checked; the rest is refused with an error that names the
argument or the file. A signal, a silent wrong answer, a raw error of some library or a minute's
wait fails.
"""

import json
import math
import os
import struct
import warnings
from pathlib import Path

import numpy as np
import pytest

import bathyal
from alone import Case, refused, run_alone, works
from bathyal import Error

FAR = 1e7
GRID = np.array([[x, y, 0.01 * x * y] for x in range(6) for y in range(5)], dtype=float)
BROKEN = (Error,)
ANY = (ValueError, TypeError, Error, OSError)


def same(left: object, right: object, tolerance: float = 1e-9) -> None:
    np.testing.assert_allclose(np.asarray(left), np.asarray(right), rtol=0, atol=tolerance)


def bottom(offset: float = 0.0) -> bathyal.TriangleMesh:
    return bathyal.triangulate(GRID + offset)


def scene(offset: float = 0.0) -> bathyal.Scene:
    return bathyal.Scene(bottom(offset))


def down(x: float, y: float, z: float = 5.0) -> list[float]:
    return [x, y, z, 0.0, 0.0, -1.0]


def is_grid(mesh: bathyal.TriangleMesh) -> None:
    assert len(mesh.triangles) == 2 * 5 * 4
    report = bathyal.mesh_report(mesh)
    assert abs(report.planar_area - 20.0) < 1e-6, report.planar_area


def written(name: str, content: str | bytes) -> Path:
    path = Path(name)
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return path


# Points -------------------------------------------------------------------------------------------

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

# Meshes, rays, planes -----------------------------------------------------------------------------

FLAT = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])


def degenerate() -> None:
    mesh = bathyal.TriangleMesh(FLAT, [[0, 0, 1], [1, 1, 1], [0, 1, 2], [0, 1, 2]])
    hits = bathyal.Scene(mesh).cast([[0.2, 0.2, 1.0]], [[0.0, 0, -1]])
    same(hits.range, [1.0])
    assert hits.triangle.tolist() == [2]


def never_hit() -> None:
    empty = bathyal.Scene(bathyal.TriangleMesh(FLAT, np.zeros((0, 3), dtype=int)))
    hits = empty.cast(np.zeros((3, 3)), np.eye(3))
    assert np.isinf(hits.range).all()
    assert (hits.triangle == -1).all()
    assert not empty.contains(np.zeros((2, 3))).any()
    assert empty.section(bathyal.Plane([1, 0, 0], 0.5)) == []


def hits_far_away() -> None:
    hits = scene(FAR).cast([[2.3 + FAR, 2.2 + FAR, FAR + 5]], [[0, 0, -7.0]])
    assert hits.triangle[0] >= 0
    same(hits.point[0, :2], [2.3 + FAR, 2.2 + FAR])


CASES += [
    refused(
        "mesh: an index below 0", "triangles", lambda: bathyal.TriangleMesh(FLAT, [[0, 1, -1]])
    ),
    refused(
        "mesh: an index too large", "triangles", lambda: bathyal.TriangleMesh(FLAT, [[0, 1, 3]])
    ),
    refused(
        "mesh: an index beyond 32 bits",
        "triangles",
        lambda: bathyal.TriangleMesh(FLAT, [[0, 1, 2**40]]),
    ),
    refused(
        "mesh: indices that are not whole",
        "triangles",
        lambda: bathyal.TriangleMesh(FLAT, [[0, 1, 1.5]]),
    ),
    refused("mesh: four corners", "triangles", lambda: bathyal.TriangleMesh(FLAT, [[0, 1, 2, 0]])),
    refused("mesh: no triangles argument", "triangles", lambda: bathyal.TriangleMesh(FLAT, None)),
    works("mesh: triangles without area, and twice", degenerate),
    works("scene: no triangles", never_hit),
    works(
        "scene: unsigned indices",
        lambda: bathyal.Scene(bathyal.TriangleMesh(FLAT, np.array([[0, 1, 2]], dtype="u8"))),
    ),
    refused("scene: no mesh", "mesh", lambda: bathyal.Scene([]), ANY),
    refused("scene: not a mesh", "mesh", lambda: bathyal.Scene(GRID), ANY),
    refused("scene: None", "mesh", lambda: bathyal.Scene(None), ANY),
    works(
        "cast: no rays",
        lambda: same(len(scene().cast(np.zeros((0, 3)), np.zeros((0, 3))).range), 0),
    ),
    works(
        "cast: one origin, many directions",
        lambda: same(len(scene().cast([2.3, 2.2, 5], [[0, 0, -1.0]] * 4).range), 4),
    ),
    works("cast: 1e7 m away", hits_far_away),
    works(
        "cast: float32 and strided",
        lambda: same(
            scene()
            .cast(np.array([[1.2, 1.1, 5.0], [0, 0, 0]], "f4")[::2], np.array([[0, 0, -1]], "f4"))
            .triangle
            >= 0,
            [True],
        ),
    ),
    works(
        "cast: a tiny direction",
        lambda: same(scene().cast([[2.5, 2.5, 5]], [[0, 0, -1e-300]]).triangle >= 0, [True]),
    ),
    works(
        "cast: a huge direction",
        lambda: same(scene().cast([[2.5, 2.5, 5]], [[0, 0, -1e300]]).triangle >= 0, [True]),
    ),
    refused("cast: a zero direction", "directions", lambda: scene().cast([[0, 0, 1]], [[0, 0, 0]])),
    refused(
        "cast: a NaN direction", "directions", lambda: scene().cast([[0, 0, 1]], [[0, math.nan, 0]])
    ),
    refused(
        "cast: an infinite origin",
        "origins",
        lambda: scene().cast([[0, math.inf, 1]], [[0, 0, -1]]),
    ),
    refused(
        "cast: two origins, three directions",
        "origins|directions",
        lambda: scene().cast(np.zeros((2, 3)), np.ones((3, 3))),
    ),
    refused("cast: a wrong shape", "directions", lambda: scene().cast([[0, 0, 1]], [[0, 0]])),
    refused("nearest: NaN", "points", lambda: scene().nearest([[math.nan, 0, 0]])),
    refused("contains: a wrong shape", "points", lambda: scene().contains([1.0, 2.0])),
    refused("section: two equal points", "b|up", lambda: scene().section([1, 1, 0], [1, 1, 0])),
    refused(
        "section: two points over each other", "b|up", lambda: scene().section([1, 1, 0], [1, 1, 4])
    ),
    refused("section: no plane", "plane|`a`", lambda: scene().section(None), ANY),
    refused("plane: a zero normal", "normal", lambda: bathyal.Plane([0, 0, 0], 1.0)),
    refused("plane: a NaN normal", "normal", lambda: bathyal.Plane([0, math.nan, 1], 1.0)),
    refused("plane: an infinite offset", "offset", lambda: bathyal.Plane([0, 0, 1], math.inf)),
    refused("mesh_report: not a mesh", "mesh", lambda: bathyal.mesh_report(GRID), ANY),
]

# Aims and paths -----------------------------------------------------------------------------------

TWO = [down(1.1, 1.2), down(4.1, 3.3)]


def ten_thousand_aims() -> None:
    t = np.linspace(0.0, 1.0, 10_000)
    aims = np.column_stack(
        [0.5 + 4 * t, 2.2 + 1.7 * np.sin(40 * t), 5 + 0 * t, 0 * t, 0 * t, 0 * t - 1]
    )
    path = bathyal.plan_toolpath(scene(), aims)
    assert len(path.targets) == 10_000
    assert not path.gap.any()
    assert np.isfinite(path.position).all()


def missing_targets_are_told() -> None:
    targets = bathyal.find_targets(scene(), [*TWO, down(100, 100)])
    assert targets.status.tolist() == ["hit", "hit", "miss"]
    assert np.isnan(targets.point[2]).all()


def one_aim() -> None:
    path = bathyal.plan_toolpath(scene(), TWO[:1])
    assert np.isfinite(path.position).all()
    same(path.arc_length[-1], 0.0)


CASES += [
    works("plan: 10 000 aims", ten_thousand_aims),
    works("plan: one aim", one_aim),
    works(
        "plan: 1e7 m away",
        lambda: same(
            np.isfinite(
                bathyal.plan_toolpath(scene(FAR), np.add(TWO, [FAR, FAR, FAR, 0, 0, 0])).position
            ).all(),
            True,
        ),
    ),
    works(
        "find_targets: no aims",
        lambda: same(len(bathyal.find_targets(scene(), np.zeros((0, 6)))), 0),
    ),
    works("find_targets: one that misses", missing_targets_are_told),
    refused("plan: no aims", "aims", lambda: bathyal.plan_toolpath(scene(), np.zeros((0, 6)))),
    refused(
        "plan: nothing hit",
        "aims",
        lambda: bathyal.plan_toolpath(scene(), [down(99, 99), down(98, 99)]),
        ANY,
    ),
    refused(
        "plan: five columns", "aims", lambda: bathyal.plan_toolpath(scene(), [[0, 0, 5, 0, 0]])
    ),
    refused(
        "plan: a zero direction",
        "aims",
        lambda: bathyal.plan_toolpath(scene(), [[1, 1, 5, 0, 0, 0]]),
    ),
    refused(
        "plan: a NaN aim",
        "aims",
        lambda: bathyal.plan_toolpath(scene(), [[1, math.nan, 5, 0, 0, -1]]),
    ),
    refused(
        "plan: a mesh for a scene", "surface", lambda: bathyal.plan_toolpath(bottom(), TWO), ANY
    ),
    refused("plan: speed of 0", "speed", lambda: bathyal.plan_toolpath(scene(), TWO, speed=0.0)),
    refused(
        "plan: speed below 0", "speed", lambda: bathyal.plan_toolpath(scene(), TWO, speed=-1.0)
    ),
    refused(
        "plan: acceleration NaN",
        "acceleration",
        lambda: bathyal.plan_toolpath(scene(), TWO, acceleration=math.nan),
    ),
    refused("plan: step below 0", "step", lambda: bathyal.plan_toolpath(scene(), TWO, step=-0.1)),
    refused(
        "plan: standoff infinite",
        "standoff",
        lambda: bathyal.plan_toolpath(scene(), TWO, standoff=math.inf),
    ),
    refused(
        "plan: angular rate of 0",
        "angular_rate",
        lambda: bathyal.plan_toolpath(scene(), TWO, angular_rate=0.0),
    ),
    refused(
        "plan: an unknown orientation",
        "orientation",
        lambda: bathyal.plan_toolpath(scene(), TWO, orientation="up"),
    ),
    refused(
        "plan: an unknown vertical",
        "vertical",
        lambda: bathyal.plan_toolpath(scene(), TWO, vertical="north"),
    ),
    refused(
        "plan: a pose that is none",
        "world_from_vehicle",
        lambda: bathyal.plan_toolpath(scene(), TWO, world_from_vehicle=np.ones((4, 4))),
    ),
    refused(
        "plan: a pose of the wrong shape",
        "world_from_vehicle",
        lambda: bathyal.plan_toolpath(scene(), TWO, world_from_vehicle=np.eye(3)),
    ),
    refused(
        "cover: two corners",
        "polygon",
        lambda: bathyal.cover_polygon(scene(), [[0, 0], [1, 1]], 0.5),
    ),
    refused(
        "cover: a polygon that crosses itself",
        "polygon",
        lambda: bathyal.cover_polygon(scene(), [[0, 0], [2, 2], [2, 0], [0, 2]], 0.5),
    ),
    refused(
        "cover: a spacing of 0",
        "spacing",
        lambda: bathyal.cover_polygon(scene(), [[0, 0], [2, 0], [2, 2]], 0.0),
    ),
    refused(
        "cover: a spacing of a micrometre",
        "spacing",
        lambda: bathyal.cover_polygon(scene(), [[0, 0], [5, 0], [5, 5]], 1e-9),
    ),
]

# Files --------------------------------------------------------------------------------------------

CLOUDS = (".xyz", ".txt", ".csv", ".asc", ".ply", ".pcd", ".las", ".laz", ".bag", ".tif", ".vtp")
MESHES = (".ply", ".stl", ".obj", ".dae", ".vtp")
NOISE = bytes(np.random.default_rng(7).integers(0, 256, 5000, dtype=np.uint8))
TEXT = "".join(f"{x} {y} {z}\n" for x, y, z in GRID.tolist())

for _read, _suffixes in ((bathyal.read_cloud, CLOUDS), (bathyal.read_mesh, MESHES)):
    for _suffix in _suffixes:
        for _name, _content in {"empty": b"", "noise": NOISE}.items():
            CASES.append(
                refused(
                    f"{_read.__name__}: {_name} {_suffix}",
                    "file\\" + _suffix,
                    lambda r=_read, s=_suffix, c=_content: r(written("file" + s, c)),
                    BROKEN,
                )
            )

PLY_HUGE = (
    "ply\nformat binary_little_endian 1.0\nelement vertex 1000000000\n"
    "property float x\nproperty float y\nproperty float z\nend_header\n"
)
PCD_HUGE = (
    "VERSION 0.7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1000000000\nHEIGHT 1\n"
    "POINTS 1000000000\nDATA binary\n"
)
ASC_HUGE = "ncols 100000\nnrows 100000\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n"
STL_HUGE = b"\0" * 80 + struct.pack("<I", 2_000_000_000) + b"\0" * 50
LAS_HEAD = b"LASF" + b"\0" * 100
BOMB = (
    '<?xml version="1.0"?><!DOCTYPE a [<!ENTITY a "aaaaaaaaaa">'
    '<!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">'
    '<!ENTITY c "&b;&b;&b;&b;&b;&b;&b;&b;"><!ENTITY d "&c;&c;&c;&c;&c;&c;&c;&c;">]><{0}>&d;</{0}>'
)


def truncated(cloud: bool, suffix: str) -> None:
    path = Path("whole" + suffix)
    if cloud:
        bathyal.write_cloud(bathyal.PointCloud(GRID), path)
    else:
        bathyal.write_mesh(bottom(), path)
    whole = path.read_bytes()
    part = written("part" + suffix, whole[: len(whole) * 6 // 10])
    (bathyal.read_cloud if cloud else bathyal.read_mesh)(part)


def round_trip(name: str) -> None:
    bathyal.write_cloud(bathyal.PointCloud(GRID + FAR), name)
    same(bathyal.read_cloud(name).points, GRID + FAR, 5e-4)


CASES += [
    refused(
        "read_cloud: nothing there",
        "gone.xyz",
        lambda: bathyal.read_cloud("gone.xyz"),
        (Error, OSError),
    ),
    refused(
        "read_mesh: nothing there",
        "gone.ply",
        lambda: bathyal.read_mesh("gone.ply"),
        (Error, OSError),
    ),
    refused(
        "read_cloud: an unknown ending", "path", lambda: bathyal.read_cloud(written("a.doc", TEXT))
    ),
    refused(
        "read_mesh: an unknown ending", "path", lambda: bathyal.read_mesh(written("a.doc", TEXT))
    ),
    refused(
        "read_cloud: a folder",
        "x.xyz",
        lambda: (Path("x.xyz").mkdir(), bathyal.read_cloud("x.xyz")),
        (Error, OSError),
    ),
    refused(
        "read_cloud: text with a word",
        "a.xyz:3:",
        lambda: bathyal.read_cloud(written("a.xyz", "1 2 3\n4 5 6\n7 eight 9\n")),
        BROKEN,
    ),
    refused(
        "read_cloud: a short line",
        "a.xyz:2:",
        lambda: bathyal.read_cloud(written("a.xyz", "1 2 3\n4 5\n7 8 9\n")),
        BROKEN,
    ),
    refused(
        "read_cloud: two columns",
        "column|expected",
        lambda: bathyal.read_cloud(written("a.xyz", "1 2\n3 4\n")),
        ANY,
    ),
    refused(
        "read_cloud: comments only",
        "a.xyz",
        lambda: bathyal.read_cloud(written("a.xyz", "# nothing\n# here\n")),
        BROKEN,
    ),
    refused(
        "read_cloud: one line of 64 MB",
        "a.xyz",
        lambda: bathyal.read_cloud(written("a.xyz", b"1" * (64 << 20))),
        BROKEN,
    ),
    refused(
        "read_cloud: a depth nobody explained",
        "z",
        lambda: bathyal.read_cloud(written("a.csv", "x,y,depth\n1,2,3\n4,5,6\n")),
    ),
    refused(
        "read_cloud: z sideways", "z", lambda: bathyal.read_cloud(written("a.xyz", TEXT), z="left")
    ),
    refused(
        "read_cloud: a scale of 0",
        "scale",
        lambda: bathyal.read_cloud(written("a.xyz", TEXT), scale=0.0),
    ),
    refused(
        "read_cloud: a column that is not there",
        "column",
        lambda: bathyal.read_cloud(
            written("a.csv", "x,y,z\n1,2,3\n"), columns=["x", "y", "height"]
        ),
        ANY,
    ),
    refused(
        "read_cloud: a picture as text",
        "a.csv",
        lambda: bathyal.read_cloud(written("a.csv", b"\x89PNG\r\n\x1a\n" + NOISE)),
        BROKEN,
    ),
    refused(
        "read_cloud: text as LAS",
        "a.las",
        lambda: bathyal.read_cloud(written("a.las", TEXT)),
        BROKEN,
    ),
    refused(
        "read_cloud: PLY as BAG",
        "a.bag",
        lambda: bathyal.read_cloud(written("a.bag", PLY_HUGE)),
        BROKEN,
    ),
    refused(
        "read_cloud: a PLY of 10⁹ points",
        "a.ply",
        lambda: bathyal.read_cloud(written("a.ply", PLY_HUGE)),
        BROKEN,
    ),
    refused(
        "read_mesh: a PLY of 10⁹ points",
        "a.ply",
        lambda: bathyal.read_mesh(written("a.ply", PLY_HUGE)),
        BROKEN,
    ),
    refused(
        "read_cloud: a PCD of 10⁹ points",
        "a.pcd",
        lambda: bathyal.read_cloud(written("a.pcd", PCD_HUGE)),
        BROKEN,
    ),
    refused(
        "read_cloud: a grid of 10¹⁰ nodes",
        "a.asc",
        lambda: bathyal.read_cloud(written("a.asc", ASC_HUGE)),
        BROKEN,
    ),
    refused(
        "read_mesh: an STL of 2·10⁹ facets",
        "a.stl",
        lambda: bathyal.read_mesh(written("a.stl", STL_HUGE)),
        BROKEN,
    ),
    refused(
        "read_cloud: a LAS header cut off",
        "a.las",
        lambda: bathyal.read_cloud(written("a.las", LAS_HEAD)),
        BROKEN,
    ),
    refused(
        "read_mesh: an entity bomb in COLLADA",
        "a.dae",
        lambda: bathyal.read_mesh(written("a.dae", BOMB.format("COLLADA"))),
        BROKEN,
    ),
    refused(
        "read_mesh: an entity bomb in VTP",
        "a.vtp",
        lambda: bathyal.read_mesh(written("a.vtp", BOMB.format("VTKFile"))),
        BROKEN,
    ),
    refused(
        "read_mesh: a PLY of points only",
        "a.ply",
        lambda: (
            bathyal.write_cloud(bathyal.PointCloud(GRID), "a.ply"),
            bathyal.read_mesh("a.ply"),
        ),
        BROKEN,
    ),
    refused(
        "read_mesh: an OBJ with an index beyond",
        "a.obj",
        lambda: bathyal.read_mesh(written("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n")),
        BROKEN,
    ),
    *(
        refused(f"read_cloud: {s} cut off", "part", lambda s=s: truncated(True, s), BROKEN)
        for s in (".ply", ".vtp")
    ),
    *(
        refused(f"read_mesh: {s} cut off", "part", lambda s=s: truncated(False, s), BROKEN)
        for s in (".ply", ".vtp", ".stl")
    ),
    *(
        works(f"write and read {s}, 1e7 m away", lambda s=s: round_trip("a" + s))
        for s in (".xyz", ".csv", ".ply", ".vtp")
    ),
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


def test_names_differ_and_there_are_enough() -> None:
    names = [case.name for case in CASES]
    assert len(names) == len(set(names)) >= 120


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_bad_input(case: Case, tmp_path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of fork beside the pool's threads, which the child leaves
        wrong = run_alone(case, tmp_path)
    assert not wrong, wrong
    left_aside = [p.name for p in tmp_path.rglob("*") if p.name.startswith(".")]
    assert left_aside == []


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
