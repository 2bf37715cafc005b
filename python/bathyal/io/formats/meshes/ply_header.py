# SPDX-License-Identifier: BSD-3-Clause
"""The header of PLY: which elements follow, of which properties, and what its comments say."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any, BinaryIO

import numpy as np

from bathyal._core import Error, check_bytes

_TYPES = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1",
    "short": "i2", "int16": "i2", "ushort": "u2", "uint16": "u2",
    "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4",
    "float": "f4", "float32": "f4", "double": "f8", "float64": "f8",
    "int64": "i8", "uint64": "u8",
}  # fmt: skip
_LONGEST_HEADER = 1 << 20  # bytes


@dataclass(frozen=True)
class Property:
    name: str
    dtype: np.dtype[Any]
    count_dtype: np.dtype[Any] | None = None  # of a list: the type of its length


@dataclass(frozen=True)
class Element:
    name: str
    count: int
    properties: list[Property] = field(default_factory=list)


def read_header(stream: BinaryIO) -> tuple[str, list[Element], dict[str, str]]:
    """The byte order ("ascii", "<" or ">"), the elements announced, and the comments."""
    start = stream.read(_LONGEST_HEADER)
    end = re.search(rb"(?:^|\n)end_header[ \t]*\r?\n", start)
    if not re.match(rb"ply\s", start) or end is None:
        raise Error("it does not start with a PLY header")
    stream.seek(end.end())
    orders = {"ascii": "ascii", "binary_little_endian": "<", "binary_big_endian": ">"}
    order = ""
    elements: list[Element] = []
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
                elements.append(Element(name, int(count)))
            case ["property", "list", count_type, item_type, name] if elements and order:
                elements[-1].properties.append(
                    Property(name, _dtype(item_type, order), _dtype(count_type, order))
                )
            case ["property", item_type, name] if elements and order:
                elements[-1].properties.append(Property(name, _dtype(item_type, order)))
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


def check_size(elements: list[Element], size: int, order: str) -> None:
    """Before memory is taken: does the file hold at least what its header announces?"""
    least = 0
    numbers = 0
    for element in elements:
        numbers += element.count * len(element.properties)
        widths = [
            2 if order == "ascii" else (p.count_dtype or p.dtype).itemsize
            for p in element.properties
        ]  # ascii: a digit and a space
        least += element.count * sum(widths)
    if least > size + (order == "ascii"):
        raise Error(f"the header announces at least {least} bytes, {size} are there")
    check_bytes("what the header announces", 8 * numbers)  # each may become a double
