# SPDX-License-Identifier: BSD-3-Clause
"""The reader of VTK PolyData XML: its pieces, their points and cells, and the data on them."""

from __future__ import annotations

import re
from typing import Any
from xml.etree.ElementTree import Element

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error
from bathyal.io.files import PathLike, opened, reading
from bathyal.io.formats.meshes.cells import Cells, Integers
from bathyal.io.formats.vtp.arrays import ArrayReader, whole_number
from bathyal.io.formats.vtp.polydata import Arrays, PolyData
from bathyal.io.formats.xml.safe import parse_xml

_KINDS = ("vertices", "lines", "strips", "polygons")


def read_vtp(path: PathLike) -> PolyData:
    """Read a VTK PolyData XML file.

    Parameters
    ----------
    path : path
        Numbers as ascii, inline base64, or appended raw or base64; as they are or compressed with
        zlib; either byte order; headers of 32 or 64 bits; one piece or several, which are joined.

    Returns
    -------
    PolyData
        Points in float64. Data keep the file's type; data that only some of the pieces have are
        left out, as VTK does.

    Raises
    ------
    OSError
        Where there is no such file, or it may not be read.
    Error
        For a file that is broken, of another type, compressed with lz4 or lzma, or that declares a
        document type.
    """
    with opened(path) as (stream, _), reading(path, "VTK PolyData"):
        return _read(stream.read())


def _read(content: bytes) -> PolyData:
    head, appended = _split(content)
    root = parse_xml(head)
    if root.tag != "VTKFile" or root.get("type") != "PolyData":
        raise Error(f"expected a VTKFile of type PolyData, got {root.tag} {root.get('type', '')}")
    body = root.find("PolyData")
    if body is None:
        raise Error("the element PolyData is missing")
    arrays = ArrayReader(root, appended)
    pieces = [_piece(piece, arrays) for piece in body.findall("Piece")]
    fields = {
        name: values
        for element in [root.find("FieldData"), body.find("FieldData")]
        for name, values in _section(element, arrays, None).items()
    }
    return _joined(pieces, fields)


def _split(content: bytes) -> tuple[bytes, bytes]:
    """The XML without what is appended to it (which need not be XML), and the appended bytes."""
    start = re.search(rb"<AppendedData[^>]*>\s*_", content)
    if start is None:
        return content, b""
    end = content.rfind(b"</AppendedData>")
    if end < start.end():
        raise Error("the appended data do not end: the file is cut short")
    return content[: start.end() - 1] + content[end:], content[start.end() : end]


def _piece(piece: Element, arrays: ArrayReader) -> PolyData:
    count = whole_number(piece, "NumberOfPoints", 0)
    points = _section(piece.find("Points"), arrays, count)
    table = next(iter(points.values()), np.empty((0, 3)))
    if table.shape != (count, 3):
        raise Error(f"expected points of shape ({count}, 3), got {table.shape}")
    tags = ("Verts", "Lines", "Strips", "Polys")
    vertices, lines, strips, polygons = (_cells(piece, tag, arrays, count) for tag in tags)
    cell_count = len(vertices) + len(lines) + len(strips) + len(polygons)
    return PolyData(
        table.astype(np.float64),
        vertices,
        lines,
        strips,
        polygons,
        point_data=_section(piece.find("PointData"), arrays, count),
        cell_data=_section(piece.find("CellData"), arrays, cell_count),
    )


def _cells(piece: Element, tag: str, arrays: ArrayReader, point_count: int) -> Cells:
    count = whole_number(piece, f"NumberOf{tag}", 0)
    element = piece.find(tag)
    if count == 0 or element is None:
        if count:
            raise Error(f"{count} {tag} are announced, the element is missing")
        return Cells()
    named = {item.get("Name"): item for item in element.findall("DataArray")}
    if "connectivity" not in named or "offsets" not in named:
        raise Error(f"{tag}: connectivity or offsets are missing")
    ends = arrays.read(named["offsets"], count).astype(np.int64)
    connectivity = arrays.read(named["connectivity"], max(0, int(ends[-1]))).astype(np.int64)
    cells = Cells(connectivity, ends)
    cells.check(point_count)
    return cells


def _section(element: Element | None, arrays: ArrayReader, rows: int | None) -> Arrays:
    if element is None:
        return {}
    items = [item for item in element if item.tag in ("DataArray", "Array")]
    return {item.get("Name", f"array {i}"): arrays.read(item, rows) for i, item in enumerate(items)}


def _joined(pieces: list[PolyData], fields: Arrays) -> PolyData:
    """All pieces as one; indices move on by the points of the pieces before."""
    if not pieces:
        return PolyData(np.empty((0, 3)), field_data=fields)
    first = np.cumsum([0] + [len(piece.points) for piece in pieces[:-1]])
    return PolyData(
        points=np.concatenate([piece.points for piece in pieces]),
        point_data={
            name: np.concatenate([piece.point_data[name] for piece in pieces])
            for name in _shared_names([piece.point_data for piece in pieces])
        },
        cell_data={
            name: _joined_cell_rows(pieces, name)
            for name in _shared_names([piece.cell_data for piece in pieces])
        },
        field_data=fields,
        vertices=_joined_cells([piece.vertices for piece in pieces], first),
        lines=_joined_cells([piece.lines for piece in pieces], first),
        strips=_joined_cells([piece.strips for piece in pieces], first),
        polygons=_joined_cells([piece.polygons for piece in pieces], first),
    )


def _joined_cells(parts: list[Cells], first: Integers) -> Cells:
    moved = [part.connectivity + start for part, start in zip(parts, first, strict=True)]
    ends = np.cumsum(np.concatenate([part.sizes for part in parts]))
    return Cells(np.concatenate(moved), ends)


def _joined_cell_rows(pieces: list[PolyData], name: str) -> NDArray[Any]:
    """The rows of all pieces' vertices, then of all pieces' lines, and so on."""
    rows = []
    for piece in pieces:
        ends = np.cumsum([len(getattr(piece, kind)) for kind in _KINDS])
        rows.append(np.split(piece.cell_data[name], ends[:-1]))
    return np.concatenate([part for kind in zip(*rows, strict=True) for part in kind])


def _shared_names(data: list[Arrays]) -> list[str]:
    return [name for name in data[0] if all(name in other for other in data[1:])]
