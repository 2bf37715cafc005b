# SPDX-License-Identifier: BSD-3-Clause
"""PLY: polygons and points with named properties, ascii or binary of either byte order."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any
from urllib.parse import quote, unquote

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error
from bathyal.errors import argument_error
from bathyal.io.files import PathLike, opened, reading, replacing
from bathyal.io.formats.attributes import BYTE_ATTRIBUTES, canonical_attributes
from bathyal.io.formats.meshes.cells import Cells
from bathyal.io.formats.meshes.ply_body import Binary, Text
from bathyal.io.formats.meshes.ply_header import Element, check_size, read_header
from bathyal.io.formats.meshes.polygons import triangles_of_polygons

_FACE_LISTS = ("vertex_indices", "vertex_index")


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
        """(T, 3), none where the file has no faces."""
        if self.faces is None:
            return np.empty((0, 3), np.int64)
        self.faces.check(len(self.points))
        return triangles_of_polygons(self.faces, self.points)


def read_ply(path: PathLike) -> Ply:
    """Read the vertices of a PLY file, their properties, and its faces."""
    with opened(path) as (stream, size), reading(path, "PLY"):
        order, elements, notes = read_header(stream)
        check_size(elements, size - stream.tell(), order)
        body = stream.read()
        decoder = Text(body) if order == "ascii" else Binary(body)
        content = {element.name: decoder.element(element) for element in elements}
        decoder.check_end()
        return _interpreted(content, elements, notes)


def _interpreted(
    content: dict[str, dict[str, Any]], elements: list[Element], notes: dict[str, str]
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
            raise argument_error("attributes", "names other than those of coordinates", repr(name))
        columns.append((quote(name, safe="/()[]+:"), _stored_type(name, values), values))
    header.append(f"element vertex {len(points)}")
    types = {"<f8": "double", "u1": "uchar"}
    header += [f"property {types[kind]} {name}" for name, kind, _ in columns]
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
