# SPDX-License-Identifier: BSD-3-Clause
"""GeoTIFF grids, through rasterio."""

from __future__ import annotations

import math
import os
import warnings
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error, check_bytes
from bathyal.errors import argument_error
from bathyal.io.files import PathLike, need, opened, reading
from bathyal.io.formats.crs import refuse_degrees, units_of, vertical_datum_of_wkt
from bathyal.io.formats.points.soundings import Soundings, check_cells, is_metre, joined_rows

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
            for kind, block in zip(grid.dtypes, grid.block_shapes, strict=True):
                width = np.dtype(kind).itemsize
                check_cells(grid.width * grid.height, width, size, _MOST_CELLS_PER_BYTE)
                check_bytes("a block of its grid", width * math.prod(block))  # read as a whole
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
    wkt = str(grid.crs.to_wkt()) if grid.crs else ""
    units = units_of(wkt)
    if grid.crs and grid.crs.is_geographic:
        refuse_degrees(wkt)
    spread = [i for i, name in enumerate(names, 1) if "uncertainty" in name.lower() and i != band]
    wanted = [band, *spread[:1]]
    table = joined_rows(_blocks(grid, wanted), 2 + len(wanted))
    name = names[band - 1]
    return Soundings(
        np.ascontiguousarray(table[:, :3]),
        {"uncertainty": table[:, 3].copy()} if len(wanted) == 2 else {},
        _crs_text(grid.crs),
        vertical_datum_of_wkt(wkt),
        depth=name if "depth" in name.lower() else "",
        unit=_unit(grid, band),
        units=units,
    )


def _blocks(grid: Any, wanted: list[int]) -> Iterator[NDArray[np.float64]]:
    """x y and the wanted bands of the pixels that have a value in the first of these."""
    frame = grid.transform
    across = min(grid.width, _CELLS_AT_A_TIME)
    down = max(1, _CELLS_AT_A_TIME // across)
    places = ((i, j) for i in range(0, grid.height, down) for j in range(0, grid.width, across))
    for top, left in places:
        window = ((top, min(top + down, grid.height)), (left, min(left + across, grid.width)))
        values = grid.read(wanted, window=window).astype(np.float64)
        known = (grid.read_masks(wanted[0], window=window) != 0) & np.isfinite(values[0])
        row, column = np.nonzero(known)
        u, v = column + left + 0.5, row + top + 0.5
        x, y = frame.a * u + frame.b * v + frame.c, frame.d * u + frame.e * v + frame.f
        scaled = [
            values[k][known] * grid.scales[b - 1] + grid.offsets[b - 1]
            for k, b in enumerate(wanted)
        ]
        yield np.column_stack([x, y, *scaled])


def _crs_text(crs: Any) -> str:
    """ "EPSG:…" where it is one, else WKT."""
    if crs is None:
        return ""
    epsg = crs.to_epsg(confidence_threshold=100)
    return f"EPSG:{epsg}" if epsg else str(crs.to_wkt())


def _unit(grid: Any, band: int) -> str:
    """The unit that the band's values have where it is not the metre."""
    unit = grid.units[band - 1] or ""
    return "" if unit.lower() == "unknown" or is_metre(unit) else unit
