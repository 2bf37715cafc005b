# SPDX-License-Identifier: BSD-3-Clause
"""BAG, the Bathymetric Attributed Grid: HDF5 with its metadata in XML."""

from __future__ import annotations

import math
import os
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any
from xml.etree.ElementTree import Element

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error, check_bytes
from bathyal.io.files import PathLike, need, opened, reading
from bathyal.io.formats.crs import Units, refuse_degrees, units_of, vertical_datum_of_wkt
from bathyal.io.formats.points.soundings import Soundings, check_cells, joined_rows
from bathyal.io.formats.xml.safe import parse_xml

_NO_DATA = 1e6  # of the format, in every layer
_CELLS_AT_A_TIME = 1 << 22
_MOST_CELLS_PER_BYTE = 300  # deflate makes about 1032 bytes of one, a cell has four
_LARGEST_METADATA = 1 << 24  # bytes
# Of the format's version 1.4 and before, which name projection and datum instead of writing WKT.
_UTM_EPSG = {("wgs84", True): 32600, ("wgs84", False): 32700, ("nad83", True): 26900}


@dataclass(frozen=True)
class _Frame:
    """Where the nodes lie: the south-west one at (west, south), the next ones dx, dy apart."""

    west: float
    south: float
    dx: float
    dy: float
    crs: str
    vertical_datum: str
    units: Units


def read_bag(path: PathLike) -> Soundings:
    """Nodes row by row from the north, those without a value left out, with their uncertainty.

    The south-west corner point of the metadata is the centre of the south-west node, and nodes are
    one stated resolution apart. Where the north-east corner point disagrees with that (it does by
    one cell in files that take it for the outer edge), a warning says by how much, and it is not
    used.
    """
    h5py = need("h5py", "h5py", "reading BAG", extra="geo")
    with opened(path) as (stream, size), reading(path, "BAG"):
        if stream.read(8) != b"\x89HDF\r\n\x1a\n":
            raise Error("it is not an HDF5 file")
        # The file that was looked at, not what may have its name by now.
        with h5py.File(stream, "r") as file:
            root = _member(file, "BAG_root")
            if "varres_refinements" in root:
                raise Error(
                    "its resolution varies from cell to cell, which is not read: "
                    "export one resolution"
                )
            elevation = _layer(root, "elevation", size)
            uncertainty = _layer(root, "uncertainty", size) if "uncertainty" in root else None
            if uncertainty is not None and uncertainty.shape != elevation.shape:
                raise Error(
                    f"uncertainty has shape {uncertainty.shape}, elevation {elevation.shape}"
                )
            frame = _frame(_metadata(root), elevation.shape, path)
            return _nodes(elevation, uncertainty, frame)


def _member(group: Any, name: str) -> Any:
    """What a name refers to in this very file: HDF5 can also point into others."""
    link = group.get(name, getlink=True)
    elsewhere = link is not None and type(link).__name__ != "HardLink"
    member = None if elsewhere else group[name]  # a link is not followed even to look at it
    if elsewhere or getattr(member, "external", None) or getattr(member, "is_virtual", False):
        raise Error(f"{name} is a link to another place, which is not followed")
    return member


def _layer(root: Any, name: str, size: int) -> Any:
    layer = _member(root, name)
    if len(layer.shape) != 2 or layer.dtype.kind != "f":
        raise Error(f"{name} is no grid of real numbers")
    cells = layer.shape[0] * layer.shape[1]
    check_cells(cells, layer.dtype.itemsize, size, _MOST_CELLS_PER_BYTE)
    # A chunk is unpacked as a whole.
    check_bytes("a chunk of its grid", layer.dtype.itemsize * math.prod(layer.chunks or (0,)))
    return layer


def _nodes(elevation: Any, uncertainty: Any, frame: _Frame) -> Soundings:
    width = 3 if uncertainty is None else 4
    table = joined_rows(_blocks(elevation, uncertainty, frame), width)
    attributes = {}
    if uncertainty is not None:
        spread = table[:, 3].copy()
        spread[spread == _NO_DATA] = np.nan
        attributes["uncertainty"] = spread
    return Soundings(
        np.ascontiguousarray(table[:, :3]),
        attributes,
        frame.crs,
        frame.vertical_datum,
        units=frame.units,
    )


def _blocks(elevation: Any, uncertainty: Any, frame: _Frame) -> Iterator[NDArray[np.float64]]:
    """x y z and uncertainty of the nodes that have a value, from the north."""
    rows, columns = elevation.shape
    step = max(1, _CELLS_AT_A_TIME // max(1, columns))
    for end in range(rows, 0, -step):  # the file's first row is the southernmost
        start = max(0, end - step)
        z = elevation[start:end][::-1]
        row, column = np.nonzero((z != _NO_DATA) & np.isfinite(z))
        x = frame.west + frame.dx * column
        y = frame.south + frame.dy * (end - 1 - row)
        found = [x, y, z[row, column]]
        if uncertainty is not None:
            found.append(uncertainty[start:end][::-1][row, column])
        yield np.column_stack(found).astype(np.float64, copy=False)


def _metadata(root: Any) -> Element:
    stored = _member(root, "metadata")
    if stored.dtype.kind != "S" or stored.size * stored.dtype.itemsize > _LARGEST_METADATA:
        raise Error("its metadata are no text of a size to be read")
    return parse_xml(np.asarray(stored[()]).tobytes().rstrip(b"\0 \r\n\t"))


def _frame(metadata: Element, shape: tuple[int, int], path: PathLike) -> _Frame:
    resolution = {"row": np.nan, "column": np.nan}
    for dimension in _all(metadata, "MD_Dimension"):
        name = _text(dimension, "dimensionName").lower()
        resolution[name] = float(_text(dimension, "resolution"))
    dx, dy = resolution["column"], resolution["row"]
    corners = _text(metadata, "cornerPoints").replace(",", " ").split()
    if len(corners) != 4 or not (0 < dx < np.inf and 0 < dy < np.inf):
        raise Error(
            f"its metadata give resolutions {dx} and {dy} and {len(corners)} of four "
            "corner coordinates"
        )
    west, south, east, north = map(float, corners)
    if not np.all(np.isfinite([west, south])):
        raise Error("its corner points are not finite")
    off_x = east - (west + (shape[1] - 1) * dx)
    off_y = north - (south + (shape[0] - 1) * dy)
    if not (abs(off_x) <= 0.01 * dx and abs(off_y) <= 0.01 * dy):
        warnings.warn(
            f"{os.fspath(path)}: the north-east corner point is {off_x:+.3f} m, {off_y:+.3f} m off "
            "the one that resolution and south-west corner give; the latter are used",
            stacklevel=4,  # where read_cloud was called
        )
    return _Frame(west, south, dx, dy, *_reference(metadata))


def _reference(metadata: Element) -> tuple[str, str, Units]:
    """The coordinate reference system and the vertical datum, each "" where it is not known, and
    the units of both."""
    codes = [
        " ".join(e.itertext()).strip()
        for info in _all(metadata, "referenceSystemInfo")
        for e in _all(info, "code")
    ]
    crs = next((c for c in codes if c.upper().startswith(("PROJ", "GEOG", "COMPD", "COMPO"))), "")
    upright = next((code for code in codes if vertical_datum_of_wkt(code)), "")
    vertical = vertical_datum_of_wkt(upright)
    units = units_of(crs, upright)
    if crs:
        return crs, vertical, units
    projection = _text(metadata, "projection").lower()
    if projection.startswith("geo"):
        refuse_degrees(projection)
    datum = _text(metadata, "datum").lower().replace(" ", "")
    zone, north = _text(metadata, "zone"), _text(metadata, "falseNorthing")
    epsg = _UTM_EPSG.get((datum, float(north or "nan") == 0.0))
    if projection == "utm" and epsg and zone.isdigit() and 1 <= int(zone) <= 60:
        crs = f"EPSG:{epsg + int(zone)}"
    return crs, vertical or _text(metadata, "verticalDatum"), units


def _all(element: Element, name: str) -> list[Element]:
    return [e for e in element.iter() if e.tag.rpartition("}")[2] == name]


def _text(element: Element, name: str) -> str:
    """All text inside the first element of that name, "" where there is none."""
    found = _all(element, name)
    return " ".join(" ".join(found[0].itertext()).split()) if found else ""
