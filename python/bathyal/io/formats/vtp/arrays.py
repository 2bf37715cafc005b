# SPDX-License-Identifier: BSD-3-Clause
"""The arrays of a VTK XML file: numbers and texts in every encoding VTK writes but lz4 and lzma."""

from __future__ import annotations

import base64
import binascii
import zlib
from typing import Any
from xml.etree.ElementTree import Element

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error, check_bytes

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
_MOST_PER_BYTE = 1040  # deflate makes at most about 1032 bytes of one
_DOUBLE = 8  # bytes: every number may become one


class ArrayReader:
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
        self._bytes_read = 0  # arrays may share what is stored once

    def read(self, element: Element, rows: int | None) -> NDArray[Any]:
        """The numbers or texts of one element: (rows,) or (rows, components); None takes all."""
        name = element.get("Name", "")
        try:
            return self._read(element, rows)
        except Error as error:
            raise Error(f"array {name!r}: {error}") from error.__cause__

    def _read(self, element: Element, rows: int | None) -> NDArray[Any]:
        width = whole_number(element, "NumberOfComponents", 1)
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
            flat = _numbers(self._bytes(element, expected, dtype.itemsize), dtype)
        if expected is not None and len(flat) != expected:
            raise Error(f"expected {expected} values, got {len(flat)}")
        if texts:
            return self._texts(flat, rows)
        return flat.reshape(-1, width) if width > 1 else flat

    def _bytes(self, element: Element, expected: int | None, width: int) -> bytes:
        """What an element stores, of so many expected values of `width` bytes."""
        kind = element.get("format")
        source: _Source
        if kind == "appended":
            offset = whole_number(element, "offset", None)
            source = (_Raw if self._appended_raw else _Base64)(self._appended, offset)
        elif kind == "binary":
            source = _Base64("".join(_inline_text(element).split()).encode(), 0)
        else:
            raise Error(f"format {kind!r} is not known")
        if self._compressed:
            return self._inflate(source, expected, width)
        size = int(self._sizes(source, 1)[0])
        stored = source.take(size)
        self._reserve(size, width)
        return stored

    def _reserve(self, size: int, width: int) -> None:
        """Raise `Error` where all arrays up to this one take too much, before it is unpacked."""
        self._bytes_read += size // width * max(width, _DOUBLE)
        check_bytes("what its arrays unpack to", self._bytes_read)

    def _inflate(self, source: _Source, expected: int | None, width: int) -> bytes:
        blocks, size, last = (int(n) for n in self._sizes(source, 3))
        if blocks == 0:
            return b""
        packed = [int(n) for n in self._sizes(source, blocks)]
        source.end_part()
        sizes = [size] * (blocks - 1) + [last or size]
        if expected is not None and sum(sizes) != expected * width:
            raise Error(f"expected {expected * width} bytes, its header says {sum(sizes)}")
        for packed_size, full_size in zip(packed, sizes, strict=True):
            if full_size > _MOST_PER_BYTE * packed_size:
                raise Error(f"a block of {packed_size} bytes cannot hold {full_size}")
        self._reserve(sum(sizes), width)
        parts = []
        for packed_size, full_size in zip(packed, sizes, strict=True):
            parts.append(zlib.decompressobj().decompress(source.take(packed_size), full_size))
            if len(parts[-1]) != full_size:
                raise Error(f"a block holds {len(parts[-1])} bytes, its header says {full_size}")
        return b"".join(parts)

    def _texts(self, codes: NDArray[Any], rows: int | None) -> NDArray[Any]:
        texts = codes.tobytes().decode("utf-8", "replace").split("\0")
        if texts[-1] == "":
            texts.pop()
        if rows is not None and len(texts) != rows:
            raise Error(f"expected {rows} texts, got {len(texts)}")
        self._reserve(len(texts) * max(map(len, texts), default=0), 1)  # all as wide as the widest
        return np.array(texts, dtype=np.str_)

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
    """An element's own text, before and behind what else is in it (InformationKey)."""
    return (element.text or "") + "".join(child.tail or "" for child in element)


def _ascii_numbers(text: str, dtype: np.dtype[Any]) -> NDArray[Any]:
    try:
        return np.array(text.split(), dtype.newbyteorder("="))
    except (ValueError, OverflowError) as error:
        raise Error(f"not numbers of {dtype.name}: {error}") from error


def _choice(element: Element, key: str, known: dict[str, Any], default: str) -> Any:
    value = element.get(key, default)
    if value not in known:
        names = ", ".join(name for name in known if name)
        raise Error(f"{key} {value} is not read, only {names}")
    return known[value]


def whole_number(element: Element, key: str, default: int | None) -> int:
    text = element.get(key)
    if text is None and default is not None:
        return default
    if text is None or not text.isascii() or not text.isdigit():
        raise Error(f"{element.tag}: expected a whole number for {key}, got {text!r}")
    return int(text)
