# SPDX-License-Identifier: BSD-3-Clause
"""Files of soundings that are none, cut short, lie, or are asked for wrongly, in every format."""

from __future__ import annotations

import contextlib
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bathyal
from tests.support.cloud_cases import example, survey, write_text

SUFFIXES = [".xyz", ".csv", ".ply", ".pcd", ".las", ".laz", ".bag", ".tif", ".vtp"]


@pytest.mark.parametrize("suffix", SUFFIXES)
@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"\0" * 400,
        bytes(range(256)) * 40,
        b"no numbers here\n",
        b"\x89HDF\r\n\x1a\n" + b"\0" * 99,
    ],
    ids=["empty", "zeros", "bytes", "words", "HDF"],
)
def test_content_of_another_kind_is_an_error(tmp_path, suffix, content):
    path = tmp_path / f"a{suffix}"
    path.write_bytes(content)
    with pytest.raises(bathyal.Error, match=re.escape(str(path))):
        bathyal.read_cloud(path)


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_a_suffix_that_lies_is_an_error(tmp_path, suffix):
    other = example(tmp_path / f"a{'.ply' if suffix in ('.bag', '.tif') else '.bag'}")
    other.rename(tmp_path / f"b{suffix}")
    with pytest.raises(bathyal.Error):
        bathyal.read_cloud(tmp_path / f"b{suffix}")


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_cut_files_are_errors(tmp_path, suffix):
    path = example(tmp_path / f"a{suffix}")
    whole = path.read_bytes()
    for tenth in range(10):
        path.write_bytes(whole[: len(whole) * tenth // 10])
        try:
            cut = bathyal.read_cloud(path)
        except bathyal.Error:
            continue
        # columns of text have no end: a cut between two lines, or in a last number, cannot be seen
        assert suffix in (".xyz", ".csv")
        assert len(cut) < 50


@given(data=st.data(), suffix=st.sampled_from([".ply", ".pcd", ".vtp", ".xyz", ".las"]))
@settings(max_examples=150, deadline=None)
def test_changed_bytes_are_read_or_refused(tmp_path_factory, data, suffix):
    path = example(tmp_path_factory.getbasetemp() / f"changed{suffix}")
    content = bytearray(path.read_bytes())
    for _ in range(data.draw(st.integers(1, 3))):
        content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    path.write_bytes(content)
    with contextlib.suppress(bathyal.Error):
        bathyal.read_cloud(path, z="up", scale=1.0)


def test_arguments_are_named(tmp_path):
    path = example(tmp_path / "a.ply")
    with pytest.raises(ValueError, match=r"`path`: expected a point file \(\.asc \.bag \.csv"):
        bathyal.read_cloud("a.dae")
    with pytest.raises(ValueError, match="`path`: expected a point file"):
        bathyal.write_cloud(survey(), "a.las")
    for scale in (0, -1, np.nan, [1, 2], [1, 1, 0], "two"):
        with pytest.raises(ValueError, match="`scale`: expected"):
            bathyal.read_cloud(path, scale=scale)
    with pytest.raises(ValueError, match='`z`: expected "up" or "down"'):
        bathyal.read_cloud(path, z="north")
    with pytest.raises(
        ValueError, match=r"`columns`: expected with text files only, got it with \.ply"
    ):
        bathyal.read_cloud(path, columns=[0, 1, 2])
    with pytest.raises(ValueError, match="`decimal`: expected with text files only"):
        bathyal.read_cloud(path, decimal=",")
    with pytest.raises(ValueError, match="`band`: expected with GeoTIFF only"):
        bathyal.read_cloud(path, band=1)
    text = write_text(tmp_path / "a.xyz", "1 2 3\n")
    for columns in ([0, 1], "xyz", {"x": 0, "y": 1}, [0, 1, 2, 2, 2], [0, 1, 9], ["x", "y", "z"]):
        with pytest.raises(ValueError, match="column"):
            bathyal.read_cloud(text, columns=columns)
    with pytest.raises(ValueError, match="`seperator`: expected a keyword of read_cloud"):
        bathyal.read_cloud(text, seperator=",")
    with pytest.raises(FileNotFoundError):
        bathyal.read_cloud(tmp_path / "none.xyz")
    with pytest.raises(FileNotFoundError, match="cannot write"):
        bathyal.write_cloud(survey(), tmp_path / "no" / "a.xyz")


def test_a_missing_library_is_named(tmp_path, monkeypatch):
    import sys

    for suffix, module, extra in ((".las", "laspy", ""), (".laz", "lazrs", ""),
                                  (".bag", "h5py", r"extra \[geo\]"),
                                  (".tif", "rasterio", r"extra \[geo\]")):  # fmt: skip
        path = example(tmp_path / f"a{suffix}")
        with monkeypatch.context() as patch:
            patch.setitem(sys.modules, module, None)
            with pytest.raises(
                bathyal.Error, match=rf"needs the Python package .* pip install.*{extra}"
            ):
                bathyal.read_cloud(path)
