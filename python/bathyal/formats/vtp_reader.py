# SPDX-License-Identifier: BSD-3-Clause
"""The reader of VTK PolyData XML, in every encoding VTK writes but lz4 and lzma."""

from __future__ import annotations

import base64
import binascii
import re
import zlib
from typing import Any
from xml.etree.ElementTree import Element

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error
from bathyal.files import PathLike, opened, reading
from bathyal.formats.cells import Cells, Integers
from bathyal.formats.polydata import Arrays, PolyData
from bathyal.formats.safe_xml import parse_xml

TYPES = {
    "Int8": "<i1",
    "UInt8": "<u1",
    "Int16": "<i2",
    "UInt16": "<u2",
    "Int32": "<i4",
    "UInt32": "<u4",
    "Int64": "<i8",
    "UInt64": "<u8",
    "Float32": "<f4",
    "Float64": "<f8",
}
_KINDS = ("vertices", "lines", "strips", "polygons")
_MOST_PER_BYTE = 1040  # deflate makes at most about 1032 bytes of one


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
    arrays = _ArrayReader(root, appended)
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


class _ArrayReader:
    """Decodes the DataArray elements of one file."""

    def __init__(self, root: Element, appended: bytes) -> None:
        orders = {"LittleEndian": "<", "BigEndian": ">"}
        headers = {"UInt32": "u4", "UInt64": "u8"}
        self._order = _choice(root, "byte_order", orders, "LittleEndian")
        self._header = np.dtype(self._order + _choice(root, "header_type", headers, "UInt32"))
        compressors = {"": False, "vtkZLibDataCompressor": True}
        self._compressed = bool(_choice(root, "compressor", compressors, ""))
        element = root.find("AppendedData")
        encoding = "raw" if element is None else element.get("encoding", "base64")
        if encoding not in ("raw", "base64"):
            raise Error(f"appended data of encoding {encoding}: raw and base64 are read")
        self._appended_raw = encoding == "raw"
        self._appended = appended if self._appended_raw else appended.rstrip()

    def read(self, element: Element, rows: int | None) -> NDArray[Any]:
        """The numbers or texts of one element: (rows,) or (rows, components); None takes all."""
        name = element.get("Name", "")
        try:
            return self._read(element, rows)
        except Error as error:
            raise Error(f"array {name!r}: {error}") from error.__cause__

    def _read(self, element: Element, rows: int | None) -> NDArray[Any]:
        width = _whole(element, "NumberOfComponents", 1)
        if width == 0:
            raise Error("it has no components")
        kind = element.get("type", "")
        if kind not in TYPES and kind != "String":
            raise Error(f"type {kind!r} is not read")
        dtype = np.dtype(TYPES.get(kind, "<u1")).newbyteorder(self._order)
        texts = kind == "String"
        expected = None if rows is None or texts else rows * width
        if element.get("format") == "ascii":
            flat = _ascii_numbers(_inline_text(element), dtype)
        else:
            most = None if expected is None else expected * dtype.itemsize
            flat = _numbers(self._bytes(element, most), dtype)
        if expected is not None and len(flat) != expected:
            raise Error(f"expected {expected} values, got {len(flat)}")
        if texts:
            return _texts(flat, rows)
        return flat.reshape(-1, width) if width > 1 else flat

    def _bytes(self, element: Element, expected: int | None) -> bytes:
        kind = element.get("format")
        source: _Source
        if kind == "appended":
            offset = _whole(element, "offset", None)
            source = (_Raw if self._appended_raw else _Base64)(self._appended, offset)
        elif kind == "binary":
            source = _Base64("".join(_inline_text(element).split()).encode(), 0)
        else:
            raise Error(f"format {kind!r} is not known")
        if self._compressed:
            return self._inflate(source, expected)
        size = int(self._sizes(source, 1)[0])
        return source.take(size)

    def _inflate(self, source: _Source, expected: int | None) -> bytes:
        blocks, size, last = (int(n) for n in self._sizes(source, 3))
        if blocks == 0:
            return b""
        packed = [int(n) for n in self._sizes(source, blocks)]
        source.end_part()
        sizes = [size] * (blocks - 1) + [last or size]
        if expected is not None and sum(sizes) != expected:
            raise Error(f"expected {expected} bytes, its header says {sum(sizes)}")
        parts = []
        for packed_size, full_size in zip(packed, sizes, strict=True):
            if full_size > _MOST_PER_BYTE * packed_size:
                raise Error(f"a block of {packed_size} bytes cannot hold {full_size}")
            parts.append(zlib.decompressobj().decompress(source.take(packed_size), full_size))
            if len(parts[-1]) != full_size:
                raise Error(f"a block holds {len(parts[-1])} bytes, its header says {full_size}")
        return b"".join(parts)

    def _sizes(self, source: _Source, count: int) -> NDArray[Any]:
        return np.frombuffer(source.take(count * self._header.itemsize), self._header)


class _Source:
    """Bytes taken one part after the other; taking more than there are is an `Error`."""

    def take(self, count: int) -> bytes:
        raise NotImplementedError

    def end_part(self) -> None:
        """What comes next was encoded apart from what was taken last."""


class _Raw(_Source):
    def __init__(self, data: bytes, start: int) -> None:
        self._data = data
        self._at = start

    def take(self, count: int) -> bytes:
        if count > len(self._data) - self._at:
            raise Error(f"{count} bytes are announced, {len(self._data) - self._at} are there")
        self._at += count
        return self._data[self._at - count : self._at]


class _Base64(_Source):
    """Base64 made of parts that were encoded one by one, each padded or not."""

    def __init__(self, text: bytes, start: int) -> None:
        self._text = text
        self._at = start
        self._left = b""

    def take(self, count: int) -> bytes:
        missing = count - len(self._left)
        if missing > 3 * (len(self._text) - self._at) // 4:
            raise Error(f"{count} bytes are announced, the file is too short for them")
        if missing > 0:
            chars = 4 * (-(-missing // 3))
            chunk = self._text[self._at : self._at + chars]
            try:
                self._left += base64.b64decode(chunk, validate=True)
            except binascii.Error as error:
                raise Error(f"not base64: {error}") from error
            self._at += chars
        if count > len(self._left):
            raise Error(f"{count} bytes are announced, {len(self._left)} are there")
        taken, self._left = self._left[:count], self._left[count:]
        return taken

    def end_part(self) -> None:
        self._left = b""


def _numbers(data: bytes, dtype: np.dtype[Any]) -> NDArray[Any]:
    if len(data) % dtype.itemsize:
        raise Error(f"{len(data)} bytes are no whole number of {dtype.itemsize}-byte values")
    return np.frombuffer(data, dtype).astype(dtype.newbyteorder("="))


def _inline_text(element: Element) -> str:
    """An element's own text, before and behind what else stands in it (InformationKey)."""
    return (element.text or "") + "".join(child.tail or "" for child in element)


def _ascii_numbers(text: str, dtype: np.dtype[Any]) -> NDArray[Any]:
    try:
        return np.array(text.split(), dtype.newbyteorder("="))
    except (ValueError, OverflowError) as error:
        raise Error(f"not numbers of {dtype.name}: {error}") from error


def _texts(codes: NDArray[Any], rows: int | None) -> NDArray[Any]:
    texts = codes.tobytes().decode("utf-8", "replace").split("\0")
    if texts[-1] == "":
        texts.pop()
    if rows is not None and len(texts) != rows:
        raise Error(f"expected {rows} texts, got {len(texts)}")
    return np.array(texts, dtype=np.str_)


def _piece(piece: Element, arrays: _ArrayReader) -> PolyData:
    count = _whole(piece, "NumberOfPoints", 0)
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


def _cells(piece: Element, tag: str, arrays: _ArrayReader, point_count: int) -> Cells:
    count = _whole(piece, f"NumberOf{tag}", 0)
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


def _section(element: Element | None, arrays: _ArrayReader, rows: int | None) -> Arrays:
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


def _choice(element: Element, key: str, known: dict[str, Any], default: str) -> Any:
    value = element.get(key, default)
    if value not in known:
        names = ", ".join(name for name in known if name)
        raise Error(f"{key} {value} is not read, only {names}")
    return known[value]


def _whole(element: Element, key: str, default: int | None) -> int:
    text = element.get(key)
    if text is None and default is not None:
        return default
    if text is None or not text.isascii() or not text.isdigit():
        raise Error(f"{element.tag}: expected a whole number for {key}, got {text!r}")
    return int(text)
