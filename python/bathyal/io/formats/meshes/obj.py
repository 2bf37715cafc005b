# SPDX-License-Identifier: BSD-3-Clause
"""Wavefront OBJ: vertices and polygons in text."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error
from bathyal.io.files import PathLike, opened, reading, replacing
from bathyal.io.formats.attributes import COLOURS
from bathyal.io.formats.meshes.cells import Cells, Integers
from bathyal.io.formats.meshes.polygons import triangles_of_polygons
from bathyal.io.formats.numbers import lines_of_rows, numbers_of_text

# What says nothing about the surface: normals, textures, groups, materials, points, lines.
_IGNORED = {
    "vn", "vt", "vp", "g", "o", "s", "mg", "usemtl", "mtllib", "usemap", "maplib", "p", "l", "lod",
    "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj",
}  # fmt: skip


@dataclass(frozen=True)
class Obj:
    """The vertices of a file row for row, its faces as triangles, and the comments "name text"."""

    vertices: NDArray[np.float64]
    triangles: Integers
    attributes: dict[str, NDArray[np.float64]]
    notes: dict[str, str]


def read_obj(path: PathLike) -> Obj:
    """Read vertices (with colours where they have them) and faces.

    Free-form curves and surfaces, and any keyword that is not of the format, are an `Error`.
    """
    with opened(path) as (stream, _), reading(path, "OBJ"):
        content = stream.read().decode("latin-1").replace("\r\n", "\n").replace("\\\n", " \v")
        _check_keywords(content)
        vertex_lines = list(re.finditer(r"(?m)^[ \t]*v[ \t]+([^\n#]*)", content))
        face_lines = list(re.finditer(r"(?m)^[ \t]*f[ \t]+([^\n#]*)", content))
        if not vertex_lines or not face_lines:
            raise Error(f"it holds {len(vertex_lines)} vertices and {len(face_lines)} faces")
        vertices, attributes = _vertices([line[1] for line in vertex_lines])
        faces = _faces(vertex_lines, face_lines)
        faces.check(len(vertices))
        notes = dict(re.findall(r"(?m)^#[ \t]*(crs|vertical_datum)[ \t]+(.*\S)", content))
        return Obj(vertices, triangles_of_polygons(faces, vertices), attributes, notes)


def _check_keywords(content: str) -> None:
    words = set(re.findall(r"(?m)^[ \t]*([^\s#]\S*)", content)) - _IGNORED - {"v", "f"}
    if words:
        word = min(words)
        before = re.split(rf"(?m)^[ \t]*{re.escape(word)}(?!\S)", content)[0]
        line = 1 + before.count("\n") + before.count("\v")  # which marks a continued line
        raise Error(f"line {line}: {word[:40]!r} is not read")


def _vertices(lines: list[str]) -> tuple[NDArray[np.float64], dict[str, NDArray[np.float64]]]:
    """x y z, with a weight that must be 1 or with red green blue from 0 to 1 after them."""
    widths = {len(line.split()) for line in lines}
    width = widths.pop()
    if widths or width not in (3, 4, 6):
        raise Error("its vertices have not all three numbers, or all six with their colour")
    table = numbers_of_text(" ".join(lines)).reshape(len(lines), width)
    if width == 4 and np.any(table[:, 3] != 1):
        raise Error("its vertices have weights, which are of rational curves and not read")
    # Nine decimals of a byte's fraction: a whole number comes back as one.
    colours = np.round(table[:, 3:] * 255, 9).T if width == 6 else np.empty((0, len(table)))
    return table[:, :3].copy(), dict(zip(COLOURS, colours, strict=False))


def _faces(vertex_lines: list[re.Match[str]], face_lines: list[re.Match[str]]) -> Cells:
    """Indices count from 1; below 0 they count back from the last vertex before the face."""
    lists = [re.sub(r"/\S*", "", line[1]) for line in face_lines]
    indices = numbers_of_text(" ".join(lists))
    sizes = np.array([len(words.split()) for words in lists], np.int64)
    if np.any(indices != np.floor(indices)) or np.any(indices == 0):
        raise Error("an index of a face is 0 or no whole number")
    positions = [line.start() for line in vertex_lines]
    before = np.searchsorted(positions, [line.start() for line in face_lines])
    whole = np.where(indices < 0, indices + np.repeat(before, sizes), indices - 1)
    return Cells(whole.astype(np.int64), np.cumsum(sizes))


def write_obj(
    path: PathLike,
    vertices: NDArray[np.float64],
    triangles: NDArray[np.int32],
    *,
    attributes: Mapping[str, NDArray[np.float64]],
    notes: Mapping[str, str],
) -> None:
    """Write vertices as text that reads back equal, with colours where there are all three."""
    table = vertices
    if all(colour in attributes for colour in COLOURS):
        colours = np.column_stack([attributes[colour] for colour in COLOURS])
        table = np.column_stack([vertices, colours / 255])
    with replacing(path) as aside, open(aside, "w", encoding="utf-8", newline="\n") as stream:
        stream.write("# metres, z up\n")
        stream.writelines(f"# {name} {' '.join(t.split())}\n" for name, t in notes.items() if t)
        stream.writelines(lines_of_rows(table, prefix="v "))
        stream.writelines(lines_of_rows(triangles + 1, prefix="f "))
