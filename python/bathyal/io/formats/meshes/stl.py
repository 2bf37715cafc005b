# SPDX-License-Identifier: BSD-3-Clause
"""STL: triangles one by one, binary or ascii."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error
from bathyal.io.files import PathLike, opened, reading, replacing
from bathyal.io.formats.numbers import numbers_of_text

_FACET = np.dtype([("normal", "<f4", (3,)), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_BINARY_LOSS = 1e-5  # m
_HEADER = 84  # bytes: 80 of anything and the number of facets
# What a facet is made of and how often; a keyword comes before those that are part of it.
_KEYWORDS = {
    b"endfacet": 1, b"endloop": 1, b"facet": 1, b"normal": 1, b"outer": 1, b"loop": 1, b"vertex": 3,
}  # fmt: skip


def read_stl(path: PathLike) -> NDArray[np.float64]:
    """(T, 3, 3) corners of the triangles; their stored normals are not used."""
    with opened(path) as (stream, _), reading(path, "STL"):
        content = stream.read()
        count = int.from_bytes(content[80:_HEADER], "little")
        expected = _HEADER + count * _FACET.itemsize
        if len(content) == expected:
            return np.frombuffer(content, _FACET, count, _HEADER)["corners"].astype(np.float64)
        if content.lstrip()[:5].lower() == b"solid":
            return _ascii_corners(content.lower())
        if len(content) < _HEADER:
            raise Error(f"it has {len(content)} bytes, less than the header of a binary STL")
        raise Error(
            f"its header announces {count} triangles, {expected} bytes; {len(content)} are there"
        )


def _ascii_corners(content: bytes) -> NDArray[np.float64]:
    body, solids = re.subn(rb"(?m)^[ \t]*solid\b[^\n]*", b" ", content)
    body, ends = re.subn(rb"(?m)^[ \t]*endsolid\b[^\n]*", b" ", body)
    if solids != ends:
        raise Error(f"{solids} solids begin and {ends} end: the file is cut short")
    counts = {}
    for keyword in _KEYWORDS:
        counts[keyword] = body.count(keyword)
        body = body.replace(keyword, b" ")
    facets = counts[b"facet"]
    numbers = numbers_of_text(body)
    if any(counts[k] != facets * n for k, n in _KEYWORDS.items()) or len(numbers) != 12 * facets:
        raise Error("a facet is not one normal and one loop of three vertices")
    return numbers.reshape(-1, 4, 3)[:, 1:]


def write_stl(path: PathLike, vertices: NDArray[np.float64], triangles: NDArray[np.int32]) -> None:
    """Write binary STL where its float32 keeps every coordinate to 0.01 mm, else ascii.

    At survey coordinates (10⁶ m) float32 would lose decimetres; ascii keeps the doubles.
    """
    corners = vertices[triangles]
    edges = corners[:, 1:] - corners[:, :1]
    normals = np.cross(edges[:, 0], edges[:, 1])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0)
    if np.all(np.abs(corners - corners.astype(np.float32)) <= _BINARY_LOSS):
        _write_binary(path, normals, corners)
    else:
        _write_ascii(path, normals, corners)


def _write_binary(path: PathLike, normals: NDArray[Any], corners: NDArray[Any]) -> None:
    facets = np.zeros(len(corners), _FACET)
    facets["normal"], facets["corners"] = normals, corners
    header = b"binary STL, metres, z up".ljust(80) + len(facets).to_bytes(4, "little")
    with replacing(path) as aside, open(aside, "wb") as stream:
        stream.write(header)
        stream.write(facets.tobytes())


def _write_ascii(path: PathLike, normals: NDArray[Any], corners: NDArray[Any]) -> None:
    form = (
        "facet normal %r %r %r\nouter loop\nvertex %r %r %r\nvertex %r %r %r\n"
        "vertex %r %r %r\nendloop\nendfacet\n"
    )
    rows = np.concatenate([normals[:, None], corners], axis=1).reshape(-1, 12)
    with replacing(path) as aside, open(aside, "w", encoding="ascii", newline="\n") as stream:
        stream.write("solid metres, z up\n")
        for start in range(0, len(rows), 10_000):
            chunk = rows[start : start + 10_000].tolist()
            stream.write("".join([form % tuple(row) for row in chunk]))
        stream.write("endsolid metres, z up\n")
