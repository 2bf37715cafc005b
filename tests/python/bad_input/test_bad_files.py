# SPDX-License-Identifier: BSD-3-Clause
"""Files that are broken, cut short or lie, each case in a process of its own."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
import pytest

import bathyal
from bathyal import Error
from tests.support.alone import Case, check, refused
from tests.support.bad_input import ANY, BROKEN, GRID, bottom, written

CLOUDS = (".xyz", ".txt", ".csv", ".asc", ".ply", ".pcd", ".las", ".laz", ".bag", ".tif", ".vtp")
MESHES = (".ply", ".stl", ".obj", ".dae", ".vtp", ".glb", ".gltf", ".3ds")
NOISE = bytes(np.random.default_rng(7).integers(0, 256, 5000, dtype=np.uint8))
TEXT = "".join(f"{x} {y} {z}\n" for x, y, z in GRID.tolist())

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


CASES: list[Case] = []
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
        "read_cloud: a scale that is a word",
        "scale",
        lambda: bathyal.read_cloud(written("a.xyz", TEXT), scale="two"),
    ),
    refused(
        "read_cloud: a keyword there is not",
        "seperator",
        lambda: bathyal.read_cloud(written("a.xyz", TEXT), seperator=","),
    ),
    refused(
        "read_cloud: a band of a text",
        "band",
        lambda: bathyal.read_cloud(written("a.xyz", TEXT), band=1),
    ),
    refused(
        "read_mesh: an axis there is not",
        "up",
        lambda: bathyal.read_mesh(written("a.obj", "v 0 0 0\n"), up="w"),
    ),
    refused(
        "read_mesh: a scale below 0",
        "scale",
        lambda: bathyal.read_mesh(written("a.obj", "v 0 0 0\n"), scale=-1.0),
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
]


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_bad_input(case: Case, tmp_path: Path) -> None:
    check(case, tmp_path)
