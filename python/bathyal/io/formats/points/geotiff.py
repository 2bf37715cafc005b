# SPDX-License-Identifier: BSD-3-Clause
"""GeoTIFF grids, through rasterio."""

from __future__ import annotations

import os
import warnings
from typing import Any

import numpy as np

from bathyal._core import Error
from bathyal.errors import argument_error
from bathyal.io.files import PathLike, need, opened, reading
from bathyal.io.formats.points.soundings import (
    Soundings,
    check_cells,
    check_projected,
    is_metre,
    vertical_datum_of_wkt,
)

_CELLS_AT_A_TIME = 1 << 22
_MOST_CELLS_PER_BYTE = 10_000  # the compressors of TIFF make more of a constant grid than deflate


def read_geotiff(path: PathLike, band: int | None) -> Soundings:
    """Pixel centres row by row, those without a value left out; a band of uncertainty rides along.

    `band` counts from 1; None takes the first, and a band described as uncertainty with it.
    """
    rasterio = need("rasterio", "rasterio", "reading GeoTIFF", extra="geo")
    with opened(path) as (stream, size):
        if stream.read(4) not in (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"):
            raise Error(f"{os.fspath(path)}: it is not a TIFF file")
    with warnings.catch_warnings():
        # rasterio warns of a missing frame, which is an error here
        warnings.simplefilter("ignore", rasterio.errors.NotGeoreferencedWarning)
        with reading(path, "GeoTIFF"), rasterio.open(os.fspath(path), driver="GTiff") as grid:
            check_cells(grid.width * grid.height, size, _MOST_CELLS_PER_BYTE)
            names = [(text or "").strip() for text in grid.descriptions]
            if band is None or 1 <= band <= grid.count:
                return _pixels(grid, band or 1, names)
            count = grid.count
    raise argument_error("band", f"a number from 1 to {count}", band)


def _pixels(grid: Any, band: int, names: list[str]) -> Soundings:
    frame = grid.transform
    if frame.is_identity and grid.crs is None:
        raise Error("it does not say where its pixels are (no transform and no reference system)")
    if np.dtype(grid.dtypes[band - 1]).kind not in "iuf":
        raise Error(f"band {band} holds {grid.dtypes[band - 1]}, not real numbers")
    crs = _crs_text(grid.crs)
    spread = [i for i, name in enumerate(names, 1) if "uncertainty" in name.lower() and i != band]
    wanted = [band, *spread[:1]]
    step = max(1, _CELLS_AT_A_TIME // grid.width)
    blocks = [np.empty((0, 2 + len(wanted)))]
    for start in range(0, grid.height, step):
        window = ((start, min(start + step, grid.height)), (0, grid.width))
        values = grid.read(wanted, window=window).astype(np.float64)
        known = (grid.read_masks(band, window=window) != 0) & np.isfinite(values[0])
        row, column = np.nonzero(known)
        u, v = column + 0.5, row + start + 0.5
        x, y = frame.a * u + frame.b * v + frame.c, frame.d * u + frame.e * v + frame.f
        scaled = [
            values[k][known] * grid.scales[b - 1] + grid.offsets[b - 1]
            for k, b in enumerate(wanted)
        ]
        blocks.append(np.column_stack([x, y, *scaled]))
    table = np.concatenate(blocks)
    attributes = {"uncertainty": table[:, 3].copy()} if len(wanted) == 2 else {}
    name = names[band - 1]
    return Soundings(
        np.ascontiguousarray(table[:, :3]),
        attributes,
        crs,
        vertical_datum_of_wkt(crs) or vertical_datum_of_wkt(grid.crs.to_wkt() if grid.crs else ""),
        depth=name if "depth" in name.lower() else "",
        unit=_unit(grid, band),
    )


def _crs_text(crs: Any) -> str:
    """ "EPSG:…" where it is one, else WKT."""
    if crs is None:
        return ""
    wkt = str(crs.to_wkt())
    check_projected(wkt)
    if crs.is_geographic:
        check_projected("GEOGCS")
    epsg = crs.to_epsg(confidence_threshold=100)
    return f"EPSG:{epsg}" if epsg else wkt


def _unit(grid: Any, band: int) -> str:
    """The unit that positions or values have where it is not the metre."""
    horizontal = str(grid.crs.linear_units) if grid.crs else ""
    for unit in (horizontal, grid.units[band - 1] or ""):
        if unit and unit.lower() != "unknown" and not is_metre(unit):
            return unit
    return ""
