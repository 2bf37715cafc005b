# SPDX-License-Identifier: BSD-3-Clause
"""Soundings from GeoTIFF grids."""

from __future__ import annotations

import numpy as np
import pytest

import bathyal
from tests.support.cloud_cases import UTM, write_tiff
from tests.support.file_cases import refusal_and_memory


def test_geotiff_gives_pixel_centres_without_the_empty_ones(tmp_path):
    spread = np.arange(6.0).reshape(2, 3)
    heights = np.array([[-51, -9999, -52.5], [-53, -54, np.nan]])
    path = write_tiff(
        tmp_path / "a.tif", bands=[spread, heights], descriptions=("Uncertainty", "elevation")
    )
    cloud = bathyal.read_cloud(path, band=2)
    expected = UTM[:2] + np.array([[1, -0.5], [5, -0.5], [1, -1.5], [3, -1.5]])
    assert np.allclose(cloud.points[:, :2], expected, rtol=0, atol=1e-6)
    assert cloud.points[:, 2].tolist() == [-51, -52.5, -53, -54]
    assert cloud.attributes["uncertainty"].tolist() == [0, 2, 3, 4]
    assert cloud.crs == "EPSG:32602"
    assert bathyal.read_cloud(path).points[:, 2].tolist() == [0, 1, 2, 3, 4, 5]
    with pytest.raises(ValueError, match="`band`: expected a number from 1 to 2, got 3"):
        bathyal.read_cloud(path, band=3)


def test_geotiff_of_whole_numbers_with_scale_and_offset(tmp_path):
    path = write_tiff(
        tmp_path / "a.tif", bands=[np.array([[100, -1]])], dtype="int16", nodata=-1,
        scales=(0.01,), offsets=(-50.0,),
    )  # fmt: skip
    assert bathyal.read_cloud(path).points[:, 2].tolist() == [-49.0]


def test_geotiff_depths_units_and_degrees_are_said_not_guessed(tmp_path):
    path = write_tiff(tmp_path / "a.tif", descriptions=("Depth",))
    with pytest.raises(ValueError, match="'Depth'"):
        bathyal.read_cloud(path)
    assert bathyal.read_cloud(path, z="down").points[0, 2] == 51
    path = write_tiff(tmp_path / "b.tif", crs="EPSG:2227")  # US survey feet
    with pytest.raises(ValueError, match="`scale`: expected metres"):
        bathyal.read_cloud(path)
    foot = bathyal.read_cloud(path, scale=(0.3048, 0.3048, 1)).points[0]
    assert foot[0] == pytest.approx((UTM[0] + 1) * 0.3048)
    path = write_tiff(tmp_path / "c.tif", crs="EPSG:4326", origin=(10.0, 60.0))
    with pytest.raises(bathyal.Error, match="longitude and latitude"):
        bathyal.read_cloud(path)


def test_geotiff_without_a_place_is_an_error(tmp_path):
    rasterio = pytest.importorskip("rasterio")
    with (
        pytest.warns(rasterio.errors.NotGeoreferencedWarning),
        rasterio.open(tmp_path / "a.tif", "w", driver="GTiff", height=1, width=1, count=1,
                      dtype="float32") as grid,
    ):  # fmt: skip
        grid.write(np.zeros((1, 1, 1), np.float32))
    with pytest.raises(bathyal.Error, match="where its pixels are"):
        bathyal.read_cloud(tmp_path / "a.tif")


def test_geotiff_sizes_are_checked(tmp_path):
    rasterio = pytest.importorskip("rasterio")
    path, transform = tmp_path / "a.tif", rasterio.Affine(1, 0, 6e5, 0, -1, 7e6)
    with rasterio.open(path, "w", driver="GTiff", height=200_000, width=200_000, count=1,
                       dtype="float32", tiled=True, sparse_ok=True, crs="EPSG:32602",
                       transform=transform, compress="zstd", blockxsize=16384,
                       blockysize=16384):  # fmt: skip
        pass
    name, grown = refusal_and_memory("read_cloud", path)
    assert name == "Error"
    assert grown < 128e6  # GDAL itself
