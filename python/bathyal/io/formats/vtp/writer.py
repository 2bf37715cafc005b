# SPDX-License-Identifier: BSD-3-Clause
"""VTK PolyData XML (`.vtp`): points, lines and polygons with named data, for ParaView and back."""

from __future__ import annotations

import base64
import zlib
from collections.abc import Mapping
from typing import Any
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bathyal.arrays import unmasked
from bathyal.errors import argument_error
from bathyal.io.files import PathLike, replacing
from bathyal.io.formats.meshes.cells import Cells, cells_of
from bathyal.io.formats.vtp.arrays import TYPES
from bathyal.io.formats.vtp.polydata import PolyData

__all__ = ["PolyData", "write_vtp"]

_BLOCK = 1 << 20  # bytes compressed at a time: a reader can open one without the others
_LEVEL = 1  # of zlib: three times as fast as its default, and no more than a third larger
_NAMES = {np.dtype(dtype): name for name, dtype in TYPES.items()}


def write_vtp(
    path: PathLike,
    points: ArrayLike,
    *,
    lines: Any = None,
    polygons: Any = None,
    vertices: Any = None,
    point_data: Mapping[str, ArrayLike] | None = None,
    cell_data: Mapping[str, ArrayLike] | None = None,
    field_data: Mapping[str, ArrayLike] | None = None,
    encoding: str = "raw",
    compressed: bool = True,
) -> None:
    """Write a VTK PolyData XML file.

    Parameters
    ----------
    path : path
        The file to make or replace; it appears whole or not at all.
    points : (N, 3) array
        [m], kept as float64: millimetres at survey coordinates.
    lines, polygons : (n, k) array or list of lists, optional
        Rows of `points`, one list a polyline or polygon.
    vertices : (n,) array, optional
        Rows of `points` to draw as points. ParaView shows nothing of a file without any cell.
    point_data, cell_data : dict of arrays, optional
        One row a point, or a cell in the order vertices, lines, polygons; numbers (n,) or (n, k),
        truth values (kept as 0 and 1) or texts (n,).
    field_data : dict of arrays or texts, optional
        What belongs to the file as a whole.
    encoding : {"raw", "base64"}
        How the numbers are appended: as bytes, or as text that survives any transport.
    compressed : bool
        With zlib, without loss.

    Raises
    ------
    ValueError
        For an index that names no row of `points`, data that is not one row a point or cell, or
        data that is neither numbers nor texts.
    OSError
        Where the file cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> path = tempfile.mkdtemp() + "/line.vtp"
    >>> from bathyal.io.formats.vtp.reader import read_vtp
    >>> write_vtp(path, [[0, 0, 0], [1, 0, 0]], lines=[[0, 1]], field_data={"crs": "EPSG:32602"})
    >>> read_vtp(path).field_data["crs"].item()
    'EPSG:32602'
    """
    if encoding not in ("raw", "base64"):
        raise argument_error("encoding", '"raw" or "base64"', repr(encoding))
    table = unmasked("points", points).astype(np.float64, copy=False)
    if table.ndim != 2 or table.shape[1] != 3:
        raise argument_error("points", "shape (N, 3)", f"shape {table.shape}")
    cells = {
        name: _checked_cells(key, lists, len(table))
        for name, key, lists in (
            ("Verts", "vertices", vertices),
            ("Lines", "lines", lines),
            ("Polys", "polygons", polygons),
        )
    }
    cell_count = sum(len(group) for group in cells.values())
    data = _Appended(encoding, compressed)
    body = [
        data.section("FieldData", _rows("field_data", field_data, None), tuples=True),
        f'<Piece NumberOfPoints="{len(table)}" NumberOfVerts="{len(cells["Verts"])}" '
        f'NumberOfLines="{len(cells["Lines"])}" NumberOfStrips="0" '
        f'NumberOfPolys="{len(cells["Polys"])}">',
        data.section("PointData", _rows("point_data", point_data, len(table))),
        data.section("CellData", _rows("cell_data", cell_data, cell_count)),
        data.section("Points", {"Points": table}),
        *(
            data.section(name, {"connectivity": group.connectivity, "offsets": group.ends})
            for name, group in cells.items()
        ),
        "</Piece>",
    ]
    compressor = ' compressor="vtkZLibDataCompressor"' if compressed else ""
    head = (
        '<?xml version="1.0"?>\n<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" '
        f'header_type="UInt64"{compressor}>\n<PolyData>\n'
    )
    tail = f'\n</PolyData>\n<AppendedData encoding="{encoding}">\n_'
    with replacing(path) as aside, open(aside, "wb") as stream:
        stream.write((head + "\n".join(body) + tail).encode())
        stream.writelines(data.blobs)
        stream.write(b"\n</AppendedData>\n</VTKFile>\n")


def _checked_cells(key: str, lists: Any, point_count: int) -> Cells:
    cells = Cells() if lists is None else cells_of(lists)
    if len(cells.connectivity):
        low, high = int(cells.connectivity.min()), int(cells.connectivity.max())
        if low < 0 or high >= point_count:
            expected = f"rows of points from 0 to {point_count - 1}"
            raise argument_error(key, expected, low if low < 0 else high)
    return cells


def _rows(
    key: str, data: Mapping[str, ArrayLike] | None, count: int | None
) -> dict[str, NDArray[Any]]:
    """The arrays of one section, each of a kind that the format knows and of `count` rows."""
    arrays = {}
    for name, values in (data or {}).items():
        array = np.atleast_1d(unmasked(f"{key}[{name!r}]", values))
        if array.dtype == bool:
            array = array.astype(np.uint8)
        if array.dtype.kind != "U" and array.dtype.newbyteorder("<") not in _NAMES:
            raise argument_error(f"{key}[{name!r}]", "numbers or texts", array.dtype)
        if array.ndim > 2 or (array.ndim == 2 and array.dtype.kind == "U"):
            raise argument_error(f"{key}[{name!r}]", "shape (n,) or (n, k)", f"shape {array.shape}")
        if count is not None and len(array) != count:
            raise argument_error(f"{key}[{name!r}]", f"{count} rows", len(array))
        arrays[name] = array
    return arrays


class _Appended:
    """The data section of a file: blobs one after the other, and the elements that point there."""

    def __init__(self, encoding: str, compressed: bool) -> None:
        self.blobs: list[bytes] = []
        self._offset = 0
        self._encoding = encoding
        self._compressed = compressed

    def section(self, tag: str, arrays: Mapping[str, NDArray[Any]], *, tuples: bool = False) -> str:
        elements = [self._element(name, array, tuples) for name, array in arrays.items()]
        return "\n".join([f"<{tag}>", *elements, f"</{tag}>"])

    def _element(self, name: str, array: NDArray[Any], tuples: bool) -> str:
        if array.dtype.kind == "U":
            kind, raw = "String", b"".join(str(text).encode() + b"\0" for text in array)
        else:
            little = np.ascontiguousarray(array, array.dtype.newbyteorder("<"))
            kind, raw = _NAMES[little.dtype], little.tobytes()
        width = f' NumberOfComponents="{array.shape[1]}"' if array.ndim == 2 else ""
        count = f' NumberOfTuples="{len(array)}"' if tuples else ""
        element = (
            f'<DataArray type="{kind}" Name={quoteattr(name)}{width}{count} '
            f'format="appended" offset="{self._offset}"/>'
        )
        parts = _compressed_parts(raw) if self._compressed else [_sizes(len(raw)) + raw]
        if self._encoding == "base64":
            parts = [base64.b64encode(part) for part in parts]
        self.blobs += parts
        self._offset += sum(map(len, parts))
        return element


def _compressed_parts(raw: bytes) -> list[bytes]:
    """A table of sizes and the blocks it speaks of, which the format encodes apart."""
    blocks = [zlib.compress(raw[i : i + _BLOCK], _LEVEL) for i in range(0, len(raw), _BLOCK)]
    last = len(raw) % _BLOCK
    return [_sizes(len(blocks), _BLOCK, last, *map(len, blocks)), b"".join(blocks)]


def _sizes(*sizes: int) -> bytes:
    return np.array(sizes, "<u8").tobytes()
