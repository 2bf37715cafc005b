# SPDX-License-Identifier: BSD-3-Clause
"""Files of meshes that are none, cut short, lie, or are asked for wrongly, in every format."""

from __future__ import annotations

import contextlib
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bathyal
from tests.support.file_cases import refusal_and_memory
from tests.support.mesh_cases import cube, dae, write_text

SUFFIXES = [".ply", ".stl", ".obj", ".dae", ".vtp"]


@pytest.mark.parametrize("suffix", SUFFIXES)
@pytest.mark.parametrize(
    "content",
    [b"", b"\0" * 200, bytes(range(256)) * 40, b"depth 1 2 3\n", b"\x89HDF\r\n\x1a\n" + b"\0" * 99],
    ids=["empty", "zeros", "bytes", "words", "HDF"],
)
def test_content_of_another_kind_is_an_error(tmp_path, suffix, content):
    path = tmp_path / f"a{suffix}"
    path.write_bytes(content)
    with pytest.raises(bathyal.Error, match=re.escape(str(path))):
        bathyal.read_mesh(path)


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_a_suffix_that_lies_is_an_error(tmp_path, suffix):
    written = {".ply": ".stl", ".stl": ".ply", ".obj": ".ply", ".dae": ".vtp", ".vtp": ".obj"}
    bathyal.write_mesh(cube(), tmp_path / f"a{written[suffix]}")
    (tmp_path / f"a{written[suffix]}").rename(tmp_path / f"b{suffix}")
    with pytest.raises(bathyal.Error):
        bathyal.read_mesh(tmp_path / f"b{suffix}")


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_cut_files_are_errors(tmp_path, suffix):
    path = tmp_path / f"a{suffix}"
    if suffix == ".dae":
        write_text(path, dae())
    else:
        bathyal.write_mesh(cube(crs="EPSG:32602"), path)
    whole = path.read_bytes()
    for tenth in range(10):
        path.write_bytes(whole[: len(whole) * tenth // 10])
        if suffix == ".obj" and b"\nf " in path.read_bytes():
            continue  # OBJ has no end: a cut between its faces cannot be seen
        with pytest.raises(bathyal.Error):
            bathyal.read_mesh(path)


@given(data=st.data(), suffix=st.sampled_from(SUFFIXES))
@settings(max_examples=200, deadline=None)
def test_changed_bytes_are_read_or_refused(tmp_path_factory, data, suffix):
    path = tmp_path_factory.getbasetemp() / f"changed{suffix}"
    if suffix == ".dae":
        write_text(path, dae())
    else:
        bathyal.write_mesh(cube(crs="EPSG:32602"), path)
    content = bytearray(path.read_bytes())
    for _ in range(data.draw(st.integers(1, 3))):
        content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    path.write_bytes(content)
    with contextlib.suppress(bathyal.Error):
        bathyal.read_mesh(path)


def test_huge_headers_take_no_memory(tmp_path):
    header = (
        "ply\nformat binary_little_endian 1.0\nelement vertex 1000000000\nproperty double x\n"
        "property double y\nproperty double z\nelement face {}\n"
        "property list uint int vertex_indices\nend_header\n"
    )
    path = write_text(tmp_path / "a.ply", header.format(1) + "0" * 100)
    assert refusal_and_memory("read_mesh", path)[0] == "Error"
    one_list = header.replace("1000000000", "0").format(1) + "\xff\xff\xff\x7f"
    for suffix, content in (
        (".ply", one_list),
        (".ply", header.replace("property", "propert")),
        (".stl", "\0" * 80 + "\xff\xff\xff\xff" + "\0" * 50),
        (".dae", dae().replace('count="4"', 'count="5000000000"')),
    ):
        path = write_text(tmp_path / f"a{suffix}", content)
        name, grown = refusal_and_memory("read_mesh", path)
        assert name == "Error"
        assert grown < 64e6


def test_arguments_are_named(tmp_path):
    path = tmp_path / "a.obj"
    bathyal.write_mesh(cube(), path)
    with pytest.raises(
        ValueError, match=r"`path`: expected a mesh file \(.3ds .dae .glb .gltf .obj .ply .stl .vtp"
    ):
        bathyal.read_mesh("a.xyz")
    with pytest.raises(ValueError, match="`path`: expected a mesh file"):
        bathyal.write_mesh(cube(), "a.dae")
    for scale in (0, -1, np.nan, np.inf):
        with pytest.raises(ValueError, match="`scale`: expected"):
            bathyal.read_mesh(path, scale=scale)
    with pytest.raises(ValueError, match="`up`: expected"):
        bathyal.read_mesh(path, up="down")
    with pytest.raises(FileNotFoundError):
        bathyal.read_mesh(tmp_path / "none.ply")
    with pytest.raises(FileNotFoundError, match="cannot write"):
        bathyal.write_mesh(cube(), tmp_path / "no" / "a.ply")
    with pytest.raises(ValueError, match="`attributes`: expected names other"):
        bathyal.write_mesh(cube(attributes={"x": np.zeros(8)}), tmp_path / "x.ply")
