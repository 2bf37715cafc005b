# SPDX-License-Identifier: BSD-3-Clause
"""Soundings from LAS and LAZ."""

from __future__ import annotations

import struct

import numpy as np
import pytest

import bathyal
from tests.support.cloud_cases import write_las
from tests.support.file_cases import refusal_and_memory


@pytest.mark.parametrize("suffix", [".las", ".laz"])
@pytest.mark.parametrize(("version", "point_format"), [("1.2", 3), ("1.4", 7), ("1.4", 6)])
def test_las(tmp_path, suffix, version, point_format):
    if suffix == ".laz":
        pytest.importorskip("lazrs")
    las = write_las(tmp_path / f"a{suffix}", version, point_format)
    cloud = bathyal.read_cloud(tmp_path / f"a{suffix}")
    assert np.array_equal(cloud.points, np.column_stack([las.x, las.y, las.z]))
    assert np.array_equal(cloud.attributes["uncertainty"], las.uncertainty)
    assert np.array_equal(cloud.attributes["intensity"], np.arange(100))
    assert np.array_equal(cloud.attributes["classification"], np.arange(100) % 30)
    if point_format != 6:
        assert set(cloud.attributes["red"]) == {255.0}
        assert set(cloud.attributes["green"]) == {1.0}


def test_las_reference_systems(tmp_path):
    path = tmp_path / "a.las"
    wkt = b'COMPD_CS["both",PROJCS["UTM 2N"],VERT_CS["MSL height"]]\0'
    write_las(path, records=[(2112, wkt)])
    cloud = bathyal.read_cloud(path)
    assert cloud.crs == wkt.rstrip(b"\0").decode()
    assert cloud.vertical_datum == "MSL height"
    keys = struct.pack("<12H", 1, 1, 0, 2, 3072, 0, 1, 32602, 4096, 0, 1, 5714)
    write_las(path, "1.2", 3, records=[(34735, keys)])
    cloud = bathyal.read_cloud(path)
    assert (cloud.crs, cloud.vertical_datum) == ("EPSG:32602", "EPSG:5714")
    degrees = struct.pack("<8H", 1, 1, 0, 1, 2048, 0, 1, 4326)
    write_las(path, "1.2", 3, records=[(34735, degrees)])
    with pytest.raises(bathyal.Error, match="longitude and latitude"):
        bathyal.read_cloud(path)


def test_las_headers_are_checked(tmp_path):
    path = tmp_path / "a.las"
    write_las(path, "1.2", 3)
    whole = path.read_bytes()
    for place, form, value in ((107, "<I", 30_000_000), (100, "<I", 2**32 - 1), (96, "<I", 2**31),
                               (105, "<H", 3), (104, "<B", 99)):  # fmt: skip
        content = bytearray(whole)
        struct.pack_into(form, content, place, value)
        path.write_bytes(content)
        name, grown = refusal_and_memory("read_cloud", path)
        assert name == "Error", place
        assert grown < 64e6
    struct.pack_into("<I", content := bytearray(whole), 107, 30_000_000)
    path.write_bytes(content)
    with pytest.raises(bathyal.Error, match="header announces 30000000 points"):
        bathyal.read_cloud(path)


def test_laz_chunks_are_checked(tmp_path):
    pytest.importorskip("lazrs")
    path = tmp_path / "a.laz"
    las = write_las(path)
    whole = path.read_bytes()
    points = struct.unpack_from("<I", whole, 96)[0]
    table = struct.unpack_from("<q", whole, points)[0]
    layers = points + 8 + las.point_format.size + 4
    for place, value, reason in (
        (table + 4, b"\xff\xff\xff\xff", "4294967295 chunks"),
        (table + 4, b"\0\0\0\0", "hold fewer than the 100 points"),
        (points, b"\xff\xff\xff\x7f\0\0\0\0", "table of its chunks is not in the file"),
        (layers, b"\xff\xff\xff\xff", "layers of the chunk"),
    ):
        content = bytearray(whole)
        content[place : place + len(value)] = value
        path.write_bytes(content)
        with pytest.raises(bathyal.Error, match=reason):
            bathyal.read_cloud(path)
