# SPDX-License-Identifier: BSD-3-Clause
"""The elements of PLY, taken from bytes or from text one after the other."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error
from bathyal.io.formats.meshes.cells import Cells
from bathyal.io.formats.meshes.ply_header import Element, Property
from bathyal.io.formats.numbers import numbers_of_text


class Binary:
    """Takes elements from bytes, one after the other."""

    def __init__(self, body: bytes) -> None:
        self._body = body
        self._at = 0

    def element(self, element: Element) -> dict[str, Any]:
        if all(p.count_dtype is None for p in element.properties):
            rows = self._rows(element, {})
            return {p.name: rows[p.name] for p in element.properties}
        return self._even_lists(element) or self._uneven_lists(element)

    def check_end(self) -> None:
        if self._body[self._at :].strip(b"\0 \r\n\t"):
            raise Error(f"{len(self._body) - self._at} bytes follow what the header announces")

    def _rows(self, element: Element, lengths: Mapping[str, int]) -> NDArray[Any]:
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

    def _even_lists(self, element: Element) -> dict[str, Any] | None:
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

    def _lengths_at(self, element: Element, at: int) -> dict[str, int]:
        lengths = {}
        for p in element.properties:
            if p.count_dtype is None:
                at += p.dtype.itemsize
                continue
            lengths[p.name] = self._length(p, at)
            at += p.count_dtype.itemsize + lengths[p.name] * p.dtype.itemsize
        return lengths

    def _length(self, p: Property, at: int) -> int:
        assert p.count_dtype is not None
        if at + p.count_dtype.itemsize > len(self._body):
            raise Error(f"the list {p.name} is cut short")
        length = int(np.frombuffer(self._body, p.count_dtype, 1, at)[0])
        if length < 0:
            raise Error(f"the list {p.name} has a length of {length}")
        return length

    def _uneven_lists(self, element: Element) -> dict[str, Any]:
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

    def _gathered(self, p: Property, starts: list[int], sizes: list[int]) -> Any:
        data = np.frombuffer(self._body, np.uint8)
        width = p.dtype.itemsize
        bytes_each = np.array(sizes, np.int64) * width
        ends = np.cumsum(bytes_each)
        where = np.arange(ends[-1]) + np.repeat(np.array(starts) - (ends - bytes_each), bytes_each)
        values = data[where].view(p.dtype)
        return values if p.count_dtype is None else _cells(values, np.array(sizes, np.int64))


class Text:
    """Takes elements from numbers in text, which the format separates by any white space."""

    def __init__(self, body: bytes) -> None:
        self._values = numbers_of_text(body)
        self._at = 0

    def element(self, element: Element) -> dict[str, Any]:
        if all(p.count_dtype is None for p in element.properties):
            width = len(element.properties)
            table = self._take(element, element.count * width).reshape(element.count, width)
            return {p.name: _typed(p, table[:, i]) for i, p in enumerate(element.properties)}
        return self._even_lists(element) or self._uneven_lists(element)

    def _even_lists(self, element: Element) -> dict[str, Any] | None:
        """The common case, every list of one length (triangles); None where it is another case."""
        columns: list[tuple[Property, int, int]] = []
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

    def _uneven_lists(self, element: Element) -> dict[str, Any]:
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

    def _take(self, element: Element, count: int) -> NDArray[np.float64]:
        if not 0 <= count <= len(self._values) - self._at:
            raise Error(f"element {element.name} is cut short")
        self._at += count
        return self._values[self._at - count : self._at]


def _typed(p: Property, values: NDArray[np.float64], sizes: NDArray[np.int64] | None = None) -> Any:
    """Numbers from text in the type that the header gives them; `sizes` are those of lists."""
    if p.dtype.kind in "iu":
        limits = np.iinfo(p.dtype)
        if np.any((values < limits.min) | (values > limits.max) | (values != np.floor(values))):
            raise Error(f"property {p.name} holds what is no {p.dtype.name}")
    typed = values.astype(p.dtype)
    return typed if p.count_dtype is None or sizes is None else _cells(typed, sizes)


def _count_name(p: Property) -> str:
    return f"{p.name} count"  # with a space, so no property can be called so


def _cells(values: NDArray[Any], sizes: NDArray[np.int64]) -> Cells:
    whole = values.astype(np.int64)
    if values.dtype.kind == "f" and np.any(whole != values):
        raise Error("an index is no whole number")
    return Cells(whole, np.cumsum(sizes))
