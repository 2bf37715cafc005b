# SPDX-License-Identifier: BSD-3-Clause
"""Soundings to files and back, in every format that is written."""

from __future__ import annotations

import pathlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bathyal
from tests.support.cloud_cases import PCD, UTM, survey, write_text

WRITTEN = [".xyz", ".txt", ".csv", ".ply", ".vtp"]


@pytest.mark.parametrize("suffix", WRITTEN)
def test_what_rides_along_comes_back(tmp_path, suffix):
    attributes = {
        "uncertainty": np.linspace(0.27, 0.66, 50),
        "red": np.arange(50.0),
        "a b,c%": np.random.default_rng(5).normal(size=50),
        "gap": np.where(np.arange(50) % 7, 1.5, np.nan),
    }
    wkt = 'PROJCS["UTM 2N",\n  AUTHORITY["EPSG","32602"]]'
    cloud = survey(attributes=attributes, crs=wkt, vertical_datum="Mean Sea Level")
    cloud.write(tmp_path / f"a{suffix}")
    assert [path.name for path in tmp_path.iterdir()] == [f"a{suffix}"]
    back = bathyal.read_cloud(tmp_path / f"a{suffix}")
    assert np.array_equal(back.points, cloud.points)
    assert set(back.attributes) == set(attributes)
    for name, values in attributes.items():
        assert np.array_equal(back.attributes[name], values, equal_nan=True), name
    assert back.crs.split() == wkt.split()
    assert back.vertical_datum == "Mean Sea Level"


@given(
    points=st.lists(st.tuples(*[st.floats()] * 3), min_size=1, max_size=20),
    suffix=st.sampled_from(WRITTEN),
)
@settings(max_examples=100, deadline=None)
def test_any_cloud_comes_back_bit_for_bit(tmp_path_factory, points, suffix):
    path = tmp_path_factory.getbasetemp() / f"any{suffix}"
    cloud = bathyal.PointCloud(np.array(points))
    bathyal.write_cloud(cloud, path)
    assert np.array_equal(bathyal.read_cloud(path).points, cloud.points, equal_nan=True)


def test_an_empty_cloud_is_written(tmp_path):
    empty = bathyal.PointCloud(np.empty((0, 3)), crs="EPSG:32602")
    for suffix in (".ply", ".vtp"):
        empty.write(tmp_path / f"a{suffix}")
        assert len(bathyal.read_cloud(tmp_path / f"a{suffix}")) == 0


@pytest.mark.parametrize("suffix", WRITTEN)
def test_a_disk_without_room_is_reported(tmp_path, suffix):
    full = pathlib.Path("/dev/full")
    if not full.exists():
        pytest.skip("no /dev/full here")
    (tmp_path / f"a{suffix}").symlink_to(full)
    with pytest.raises((OSError, bathyal.Error), match="No space left"):
        survey(2000).write(tmp_path / f"a{suffix}")


def test_vtk_opens_the_cloud(tmp_path):
    vtk = pytest.importorskip("vtk")
    survey().write(tmp_path / "a.vtp")
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(tmp_path / "a.vtp"))
    reader.Update()
    assert reader.GetOutput().GetNumberOfVerts() == 50


def test_pcd(tmp_path):
    cloud = bathyal.read_cloud(write_text(tmp_path / "a.pcd", PCD.format(count=1)))
    assert np.array_equal(cloud.points, UTM[None])
    attributes = {name: values.tolist() for name, values in cloud.attributes.items()}
    assert attributes == {"intensity": [12], "red": [255], "green": [0], "blue": [255]}
    with pytest.raises(bathyal.Error):
        bathyal.read_cloud(write_text(tmp_path / "b.pcd", PCD.format(count=10**9)))


def test_ply_of_points_with_float_colours(tmp_path):
    text = ("ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\nproperty double y\n"
            "property double z\nproperty float red\nproperty ushort green\nend_header\n"
            "1 2 3 0.5 65535\n")  # fmt: skip
    cloud = bathyal.read_cloud(write_text(tmp_path / "a.ply", text), z="down")
    assert cloud.points.tolist() == [[1, 2, -3]]
    assert cloud.attributes["red"].tolist() == [127.5]
    assert cloud.attributes["green"].tolist() == [255]
