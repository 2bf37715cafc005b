# SPDX-License-Identifier: BSD-3-Clause
"""Meshes from PLY."""

from __future__ import annotations

import re

import numpy as np
import pytest

import bathyal
from tests.support.mesh_cases import CUBE_VERTICES, write_text

SQUARE = """ply
format ascii 1.0
comment made by hand
element vertex 4
property float x
property float y
property float z
property uchar red
element face 2
property uchar quality
property list uchar int vertex_indices
end_header
0 0 0 1
1 0 0 2
1 1 0 3
0 1 0 255
{faces}
"""


def test_ply_ascii_with_even_and_uneven_faces(tmp_path):
    even = SQUARE.format(faces="7 3 0 1 2\n7 3 0 2 3")
    uneven = SQUARE.format(faces="7 4 0 1 2 3\n7 3 0 2 3")
    mesh = bathyal.read_mesh(write_text(tmp_path / "a.ply", even))
    assert mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert mesh.attributes["red"].tolist() == [1, 2, 3, 255]
    mesh = bathyal.read_mesh(write_text(tmp_path / "b.ply", uneven.replace("\n", "\r\n")))
    assert mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3], [0, 2, 3]]


@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize("sizes", [[3, 3, 3], [4, 3, 5]])
def test_ply_binary_of_either_byte_order(tmp_path, order, sizes):
    name = {"<": "little", ">": "big"}[order]
    header = (
        f"ply\nformat binary_{name}_endian 1.0\nelement vertex 5\nproperty double x\n"
        f"property float y\nproperty short z\nelement face 3\n"
        f"property list ushort uint vertex_index\nproperty float quality\n"
        f"element edge 1\nproperty int a\nend_header\n"
    )
    body = b""
    for i in range(5):
        body += np.array([i / 3], order + "f8").tobytes() + np.array([i], order + "f4").tobytes()
        body += np.array([-i], order + "i2").tobytes()
    for size in sizes:
        body += np.array([size], order + "u2").tobytes()
        body += np.arange(size).astype(order + "u4").tobytes()
        body += np.array([0.5], order + "f4").tobytes()
    body += np.array([4], order + "i4").tobytes()
    path = tmp_path / "a.ply"
    path.write_bytes(header.encode() + body)
    mesh = bathyal.read_mesh(path)
    assert np.array_equal(mesh.vertices, [[i / 3, i, -i] for i in range(5)])
    fans = [[0, k + 1, k + 2] for size in sizes for k in range(size - 2)]
    assert mesh.triangles.tolist() == fans
    for cut in range(len(header), len(header) + len(body)):
        path.write_bytes((header.encode() + body)[:cut])
        with pytest.raises(bathyal.Error):
            bathyal.read_mesh(path)


PLY_FAULTS = {
    "no ply": ("ply\n", "plx\n"),
    "no format": ("format ascii 1.0\n", ""),
    "unknown format": ("ascii", "utf16"),
    "unknown type": ("float x", "quad x"),
    "a property twice": ("float y", "float x"),
    "no z": ("float z", "float w"),
    "no end": ("end_header\n", ""),
    "negative count": ("vertex 4", "vertex -4"),
    "a billion vertices": ("vertex 4", "vertex 1000000000"),
    "a billion faces": ("face 2", "face 1000000000"),
    "more vertices than there are": ("vertex 4", "vertex 5"),
    "fewer faces than there are": ("face 2", "face 1"),
    "index of no vertex": ("0 2 3", "0 2 4"),
    "negative index": ("0 2 3", "0 2 -1"),
    "half an index": ("0 2 3", "0 2 1.5"),
    "a face of two": ("3 0 2 3", "2 0 2"),
    "a negative length": ("3 0 2 3", "-3 0 2 3"),
    "a word": ("1 0 0 2", "one 0 0 2"),
    "not a number": ("1 0 0 2", "nan 0 0 2"),
    "infinite": ("1 0 0 2", "inf 0 0 2"),
    "a colour above a byte": ("0 1 0 255", "0 1 0 256"),
    "no list": ("property list uchar int vertex_indices", "property int vertex_indices"),
    "strips": ("element face 2", "element tristrips 2"),
}


@pytest.mark.parametrize("fault", PLY_FAULTS)
def test_ply_faults_are_errors(tmp_path, fault):
    old, new = PLY_FAULTS[fault]
    text = SQUARE.format(faces="7 3 0 1 2\n7 3 0 2 3")
    assert old in text
    path = write_text(tmp_path / "a.ply", text.replace(old, new, 1))
    reason = "announces at least" if "billion" in fault else ""
    with pytest.raises(bathyal.Error, match=f"{re.escape(str(path))}: .*{reason}"):
        bathyal.read_mesh(path)


@pytest.mark.parametrize("suffix", [".ply", ".vtp", ".stl"])
def test_files_without_faces_name_the_other_reader(tmp_path, suffix):
    empty = bathyal.TriangleMesh(CUBE_VERTICES, np.empty((0, 3), int))
    bathyal.write_mesh(empty, tmp_path / f"a{suffix}")
    with pytest.raises(bathyal.Error, match="no faces; read_cloud"):
        bathyal.read_mesh(tmp_path / f"a{suffix}")
    if suffix != ".stl":
        bathyal.write_cloud(bathyal.PointCloud(CUBE_VERTICES), tmp_path / f"b{suffix}")
        with pytest.raises(bathyal.Error, match="no faces; read_cloud"):
            bathyal.read_mesh(tmp_path / f"b{suffix}")
