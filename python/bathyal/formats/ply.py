# SPDX-License-Identifier: BSD-3-Clause
"""PLY: polygons and points with named properties, ascii or binary of either byte order."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, BinaryIO
from urllib.parse import quote, unquote

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error
from bathyal.files import PathLike, opened, reading, replacing
from bathyal.formats.attributes import BYTE_ATTRIBUTES, canonical_attributes
from bathyal.formats.cells import Cells
from bathyal.formats.numbers import numbers_of_text
from bathyal.formats.polygons import triangles_of_polygons

_TYPES = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1",
    "short": "i2", "int16": "i2", "ushort": "u2", "uint16": "u2",
    "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4",
    "float": "f4", "float32": "f4", "double": "f8", "float64": "f8",
    "int64": "i8", "uint64": "u8",
}  # fmt: skip
_LONGEST_HEADER = 1 << 20  # bytes
_FACE_LISTS = ("vertex_indices", "vertex_index")


@dataclass(frozen=True)
class _Property:
    name: str
    dtype: np.dtype[Any]
    count_dtype: np.dtype[Any] | None = None  # of a list: the type of its length


@dataclass(frozen=True)
class _Element:
    name: str
    count: int
    properties: list[_Property] = field(default_factory=list)


@dataclass(frozen=True)
class Ply:
    """What a PLY file holds.

    `faces` is None where the file has no element of that name; `notes` are the comments of the
    form "name text".
    """

    points: NDArray[np.float64]
    attributes: dict[str, NDArray[np.float64]]
    faces: Cells | None
    notes: dict[str, str]

    def triangles(self) -> NDArray[np.int64]:
        """(T, 3); `Error` where the file has no faces."""
        if self.faces is None or len(self.faces) == 0:
            raise Error("it holds points and no faces; read_cloud reads it")
        self.faces.check(len(self.points))
        return triangles_of_polygons(self.faces, self.points)


def read_ply(path: PathLike) -> Ply:
    """Read the vertices of a PLY file, their properties, and its faces."""
    with opened(path) as (stream, size), reading(path, "PLY"):
        order, elements, notes = _header(stream)
        _check_size(elements, size - stream.tell(), order)
        body = stream.read()
        decoder = _Text(body) if order == "ascii" else _Binary(body)
        content = {element.name: decoder.element(element) for element in elements}
        decoder.check_end()
        return _interpreted(content, elements, notes)


def _header(stream: BinaryIO) -> tuple[str, list[_Element], dict[str, str]]:
    """The byte order ("ascii", "<" or ">"), the elements announced, and the comments."""
    start = stream.read(_LONGEST_HEADER)
    end = re.search(rb"(?:^|\n)end_header[ \t]*\r?\n", start)
    if not re.match(rb"ply\s", start) or end is None:
        raise Error("it does not start with a PLY header")
    stream.seek(end.end())
    orders = {"ascii": "ascii", "binary_little_endian": "<", "binary_big_endian": ">"}
    order = ""
    elements: list[_Element] = []
    notes: dict[str, str] = {}
    for line in start[: end.start()].decode("utf-8", "replace").splitlines()[1:]:
        words = line.split()
        match words:
            case ["format", kind, *_] if kind in orders:
                order = orders[kind]
            case ["comment" | "obj_info", name, *_]:
                notes.setdefault(name, line.split(None, 2)[2].strip() if len(words) > 2 else "")
            case ["comment" | "obj_info"] | []:
                pass
            case ["element", name, count] if count.isdigit():
                elements.append(_Element(name, int(count)))
            case ["property", "list", count_type, item_type, name] if elements and order:
                elements[-1].properties.append(
                    _Property(name, _dtype(item_type, order), _dtype(count_type, order))
                )
            case ["property", item_type, name] if elements and order:
                elements[-1].properties.append(_Property(name, _dtype(item_type, order)))
            case _:
                raise Error(f"the header's line {line.strip()[:80]!r} is not understood")
    if not order:
        raise Error("the header names no format")
    for element in elements:
        names = [p.name for p in element.properties]
        if len(set(names)) != len(names):
            raise Error(f"the header gives element {element.name} a property twice")
    return order, elements, notes


def _dtype(name: str, order: str) -> np.dtype[Any]:
    if name not in _TYPES:
        raise Error(f"the header's type {name!r} is not known")
    return np.dtype(_TYPES[name]).newbyteorder("=" if order == "ascii" else order)  # type: ignore[arg-type]


def _check_size(elements: list[_Element], size: int, order: str) -> None:
    """Before memory is taken: does the file hold at least what its header announces?"""
    least = 0
    for element in elements:
        widths = [
            2 if order == "ascii" else (p.count_dtype or p.dtype).itemsize
            for p in element.properties
        ]  # ascii: a digit and a space
        least += element.count * sum(widths)
    if least > size + (order == "ascii"):
        raise Error(f"the header announces at least {least} bytes, {size} are there")


class _Binary:
    """Takes elements from bytes, one after the other."""

    def __init__(self, body: bytes) -> None:
        self._body = body
        self._at = 0

    def element(self, element: _Element) -> dict[str, Any]:
        if all(p.count_dtype is None for p in element.properties):
            rows = self._rows(element, {})
            return {p.name: rows[p.name] for p in element.properties}
        return self._even_lists(element) or self._uneven_lists(element)

    def check_end(self) -> None:
        if self._body[self._at :].strip(b"\0 \r\n\t"):
            raise Error(f"{len(self._body) - self._at} bytes follow what the header announces")

    def _rows(self, element: _Element, lengths: Mapping[str, int]) -> NDArray[Any]:
        """All rows as one table; `lengths` says how long each list is in every row."""
        fields: list[Any] = []
        for p in element.properties:
            if p.count_dtype is not None:
                fields.append((_count_name(p), p.count_dtype))
            fields.append(
                (p.name, p.dtype, (lengths[p.name],))
                if p.count_dtype is not None
                else (p.name, p.dtype)
            )
        dtype = np.dtype(fields)
        size = dtype.itemsize * element.count
        if size > len(self._body) - self._at:
            raise Error(f"element {element.name} is cut short")
        rows = (
            np.frombuffer(self._body, dtype, element.count, self._at)
            if size
            else np.empty(element.count if dtype.itemsize else 0, dtype)
        )
        self._at += size
        return rows

    def _even_lists(self, element: _Element) -> dict[str, Any] | None:
        """The common case, every list of one length (triangles); None where it is another case."""
        if element.count == 0:
            return {
                p.name: Cells() if p.count_dtype is not None else np.empty(0)
                for p in element.properties
            }
        lengths = self._lengths_at(element, self._at)
        start = self._at
        try:
            rows = self._rows(element, lengths)
        except Error:
            return None
        lists = [p for p in element.properties if p.count_dtype is not None]
        if any(np.any(rows[_count_name(p)] != lengths[p.name]) for p in lists):
            self._at = start
            return None
        content: dict[str, Any] = {p.name: rows[p.name] for p in element.properties}
        for p in lists:
            sizes = np.full(element.count, lengths[p.name], np.int64)
            content[p.name] = _cells(rows[p.name].reshape(-1), sizes)
        return content

    def _lengths_at(self, element: _Element, at: int) -> dict[str, int]:
        lengths = {}
        for p in element.properties:
            if p.count_dtype is None:
                at += p.dtype.itemsize
                continue
            lengths[p.name] = self._length(p, at)
            at += p.count_dtype.itemsize + lengths[p.name] * p.dtype.itemsize
        return lengths

    def _length(self, p: _Property, at: int) -> int:
        assert p.count_dtype is not None
        if at + p.count_dtype.itemsize > len(self._body):
            raise Error(f"the list {p.name} is cut short")
        length = int(np.frombuffer(self._body, p.count_dtype, 1, at)[0])
        if length < 0:
            raise Error(f"the list {p.name} has a length of {length}")
        return length

    def _uneven_lists(self, element: _Element) -> dict[str, Any]:
        """Row by row, for where a row starts is known only when the one before has been seen."""
        starts: dict[str, list[int]] = {p.name: [] for p in element.properties}
        sizes: dict[str, list[int]] = {p.name: [] for p in element.properties}
        at = self._at
        for _ in range(element.count):
            for p in element.properties:
                length = 1
                if p.count_dtype is not None:
                    length = self._length(p, at)
                    at += p.count_dtype.itemsize
                starts[p.name].append(at)
                sizes[p.name].append(length)
                at += length * p.dtype.itemsize
            if at > len(self._body):
                raise Error(f"element {element.name} is cut short")
        self._at = at
        return {
            p.name: self._gathered(p, starts[p.name], sizes[p.name]) for p in element.properties
        }

    def _gathered(self, p: _Property, starts: list[int], sizes: list[int]) -> Any:
        data = np.frombuffer(self._body, np.uint8)
        width = p.dtype.itemsize
        bytes_each = np.array(sizes, np.int64) * width
        ends = np.cumsum(bytes_each)
        where = np.arange(ends[-1]) + np.repeat(np.array(starts) - (ends - bytes_each), bytes_each)
        values = data[where].view(p.dtype)
        return values if p.count_dtype is None else _cells(values, np.array(sizes, np.int64))


class _Text:
    """Takes elements from numbers in text, which the format separates by any white space."""

    def __init__(self, body: bytes) -> None:
        self._values = numbers_of_text(body)
        self._at = 0

    def element(self, element: _Element) -> dict[str, Any]:
        if all(p.count_dtype is None for p in element.properties):
            width = len(element.properties)
            table = self._take(element, element.count * width).reshape(element.count, width)
            ones = np.ones(element.count, np.int64)
            return {p.name: _typed(p, table[:, i], ones) for i, p in enumerate(element.properties)}
        return self._even_lists(element) or self._uneven_lists(element)

    def _even_lists(self, element: _Element) -> dict[str, Any] | None:
        """The common case, every list of one length (triangles); None where it is another case."""
        columns: list[tuple[_Property, int, int]] = []
        width = 0
        for p in element.properties if element.count else []:
            length = 1
            if p.count_dtype is not None:
                if self._at + width >= len(self._values):
                    return None
                length = int(self._values[self._at + width])
                width += 1
            columns.append((p, width, length))
            width += length
        if not columns or width * element.count > len(self._values) - self._at:
            return None
        table = self._values[self._at : self._at + width * element.count].reshape(-1, width)
        if any(np.any(table[:, at - 1] != n) for p, at, n in columns if p.count_dtype is not None):
            return None
        self._at += table.size
        return {
            p.name: _typed(p, table[:, at : at + n].reshape(-1), np.full(len(table), n))
            for p, at, n in columns
        }

    def _uneven_lists(self, element: _Element) -> dict[str, Any]:
        rows: dict[str, list[NDArray[np.float64]]] = {p.name: [] for p in element.properties}
        for _ in range(element.count):
            for p in element.properties:
                length = 1 if p.count_dtype is None else int(self._take(element, 1)[0])
                rows[p.name].append(self._take(element, length))
        return {
            p.name: _typed(
                p,
                np.concatenate([np.empty(0), *rows[p.name]]),
                np.array([len(row) for row in rows[p.name]], np.int64),
            )
            for p in element.properties
        }

    def check_end(self) -> None:
        if self._at < len(self._values):
            extra = len(self._values) - self._at
            raise Error(f"{extra} numbers follow what the header announces")

    def _take(self, element: _Element, count: int) -> NDArray[np.float64]:
        if not 0 <= count <= len(self._values) - self._at:
            raise Error(f"element {element.name} is cut short")
        self._at += count
        return self._values[self._at - count : self._at]


def _typed(p: _Property, values: NDArray[np.float64], sizes: NDArray[np.int64]) -> Any:
    """Numbers from text in the type that the header gives them."""
    if p.dtype.kind in "iu":
        limits = np.iinfo(p.dtype)
        if np.any((values < limits.min) | (values > limits.max) | (values != np.floor(values))):
            raise Error(f"property {p.name} holds what is no {p.dtype.name}")
    typed = values.astype(p.dtype)
    return typed if p.count_dtype is None else _cells(typed, sizes)


def _count_name(p: _Property) -> str:
    return f"{p.name} count"  # with a space, so no property can be called so


def _cells(values: NDArray[Any], sizes: NDArray[np.int64]) -> Cells:
    whole = values.astype(np.int64)
    if values.dtype.kind == "f" and np.any(whole != values):
        raise Error("an index is no whole number")
    return Cells(whole, np.cumsum(sizes))


def _interpreted(
    content: dict[str, dict[str, Any]], elements: list[_Element], notes: dict[str, str]
) -> Ply:
    vertex = content.get("vertex", {})
    missing = [axis for axis in "xyz" if not isinstance(vertex.get(axis), np.ndarray)]
    if missing:
        raise Error(f"its vertices have no {', '.join(missing)}")
    if "tristrips" in content:
        raise Error("its faces are triangle strips, which are not read: write it with polygons")
    points = np.column_stack([vertex[axis].astype(np.float64) for axis in "xyz"])
    others = {
        unquote(name): values
        for name, values in vertex.items()
        if name not in "xyz" and isinstance(values, np.ndarray)
    }
    faces = None
    if "face" in content:
        lists = [content["face"][name] for name in _FACE_LISTS if name in content["face"]]
        if not lists or not isinstance(lists[0], Cells):
            raise Error("its faces have no list vertex_indices")
        faces = lists[0]
    return Ply(points, canonical_attributes(others), faces, notes)


def write_ply(
    path: PathLike,
    points: NDArray[np.float64],
    *,
    attributes: Mapping[str, NDArray[np.float64]],
    notes: Mapping[str, str],
    triangles: NDArray[np.int32] | None = None,
) -> None:
    """Write binary PLY: coordinates and attributes as double, whole colours as bytes.

    Raises
    ------
    ValueError
        For an attribute that is called like a coordinate.
    """
    header = ["ply", "format binary_little_endian 1.0"]
    header += [f"comment {name} {' '.join(text.split())}" for name, text in notes.items() if text]
    columns: list[tuple[str, str, NDArray[Any]]] = [
        (axis, "<f8", points[:, i]) for i, axis in enumerate("xyz")
    ]
    for name, values in attributes.items():
        if name in ("x", "y", "z"):
            raise ValueError(f"attributes[{name!r}]: expected a name other than a coordinate's")
        columns.append((quote(name, safe="/()[]+:"), _stored_type(name, values), values))
    header.append(f"element vertex {len(points)}")
    words = {"<f8": "double", "u1": "uchar"}
    header += [f"property {words[kind]} {name}" for name, kind, _ in columns]
    vertices = np.empty(len(points), [(name, kind) for name, kind, _ in columns])
    for name, _, values in columns:
        vertices[name] = values
    faces = np.empty(0 if triangles is None else len(triangles), [("n", "u1"), ("v", "<i4", (3,))])
    if triangles is not None:
        header += [f"element face {len(faces)}", "property list uchar int vertex_indices"]
        faces["n"], faces["v"] = 3, triangles
    with replacing(path) as aside, open(aside, "wb") as stream:
        stream.write("\n".join([*header, "end_header", ""]).encode())
        stream.write(vertices.tobytes())
        stream.write(faces.tobytes())


def _stored_type(name: str, values: NDArray[np.float64]) -> str:
    if name not in BYTE_ATTRIBUTES:
        return "<f8"
    with np.errstate(invalid="ignore"):
        fits = np.all((values >= 0) & (values <= 255) & (values == np.floor(values)))
    return "u1" if fits else "<f8"
