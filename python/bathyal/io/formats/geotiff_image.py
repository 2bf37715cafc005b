# SPDX-License-Identifier: BSD-3-Clause
"""GeoTIFF images, and longitudes turned into UTM, through rasterio."""

from __future__ import annotations

import os
import warnings

import numpy as np
from numpy.typing import NDArray

from bathyal.io.files import PathLike, need, replacing

Floats = NDArray[np.float64]


def write_geotiff(
    path: PathLike,
    image: NDArray[np.floating],
    *,
    west: float,
    north: float,
    spacing: float,
    crs: str | None,
    description: str,
) -> None:
    """Write one band, north up, NaN the mark of no data; deflated."""
    rasterio = need("rasterio", "rasterio", "writing GeoTIFF", extra="geo")
    rows, columns = image.shape
    with replacing(path) as aside, warnings.catch_warnings():
        warnings.simplefilter("ignore", rasterio.errors.NotGeoreferencedWarning)
        with rasterio.open(
            os.fspath(aside), "w", driver="GTiff", width=columns, height=rows, count=1,
            dtype="float32", nodata=float("nan"), crs=crs, compress="deflate", predictor=3,
            transform=rasterio.transform.from_origin(west, north, spacing, spacing),
        ) as file:  # fmt: skip
            file.write(image.astype(np.float32), 1)
            file.set_band_description(1, description)


def to_utm(longitude: Floats, latitude: Floats) -> tuple[Floats, Floats, Floats, str]:
    """Easting, northing [m], the direction of true north from grid north [rad, clockwise], and the
    zone's name, the one of the median position; WGS 84 [degrees]. NaN stays NaN.
    """
    warp = need("rasterio.warp", "rasterio", "projecting longitudes", extra="geo")
    known = np.isfinite(longitude) & np.isfinite(latitude)
    x, y, turn = (np.full(len(longitude), np.nan) for _ in range(3))
    if not known.any():
        return x, y, turn, "EPSG:4326"
    lon, lat = longitude[known], latitude[known]
    zone = int((np.median(lon) + 180.0) // 6.0) % 60 + 1
    crs = f"EPSG:{(32600 if np.median(lat) >= 0.0 else 32700) + zone}"
    east, north = (np.array(v) for v in warp.transform("EPSG:4326", crs, lon, lat))
    ahead = [np.array(v) for v in warp.transform("EPSG:4326", crs, lon, lat + 1e-4)]
    x[known], y[known] = east, north
    turn[known] = np.arctan2(ahead[0] - east, ahead[1] - north)
    return x, y, turn, crs
