# SPDX-License-Identifier: BSD-3-Clause
"""Triangle meshes from and to files."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error, TriangleMesh
from bathyal.errors import argument_error
from bathyal.io.files import PathLike, known_suffix, reading
from bathyal.io.formats.attributes import canonical_attributes, columns_of
from bathyal.io.formats.crs import check_scale, units_of
from bathyal.io.formats.meshes.assimp import read_assimp
from bathyal.io.formats.meshes.collada import read_collada
from bathyal.io.formats.meshes.obj import read_obj, write_obj
from bathyal.io.formats.meshes.ply import read_ply, write_ply
from bathyal.io.formats.meshes.stl import read_stl, write_stl
from bathyal.io.formats.notes import notes_of, notes_of_fields
from bathyal.io.formats.vtp.reader import read_vtp
from bathyal.io.formats.vtp.writer import write_vtp

# The first axis of the file's right-handed frame that points up, turned to z.
_Z_UP_FROM = {
    "x": np.array([[0.0, -1, 0], [0, 0, -1], [1, 0, 0]]),
    "y": np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]]),
    "z": np.eye(3),
}


@dataclass(frozen=True)
class _Surface:
    """What a file says of a mesh; unit and up axis only where it says them."""

    vertices: NDArray[np.float64]
    triangles: NDArray[Any]
    attributes: dict[str, NDArray[np.float64]] = field(default_factory=dict)
    notes: dict[str, str] = field(default_factory=dict)
    unit: float = 1.0
    up: str = "z"


def read_mesh(path: PathLike, *, scale: float | None = None, up: str | None = None) -> TriangleMesh:
    """Read a triangle mesh.

    Parameters
    ----------
    path : path
        ``.ply``, ``.stl``, ``.obj``, ``.dae`` (COLLADA) or ``.vtp``; with the extra ``meshes``
        also ``.glb``, ``.gltf`` and ``.3ds``.
    scale : float, optional
        Metres in one unit of the file. COLLADA says its unit; the others are taken as metres. To be
        said where the file's reference system has another unit, and that system is not kept then.
    up : {"x", "y", "z"}, optional
        The axis of the file that points up. COLLADA says it, in glTF it is y; the others are taken
        as z up.

    Returns
    -------
    TriangleMesh
        [m], z up. Polygons are cut into triangles. Vertices are those of the file, row for row; in
        STL, COLLADA, glTF and 3DS, where neighbours do not share vertices, equal ones are merged.
        Of the last three all meshes of the scene become one, each in its place. Properties
        of the vertices, colours (0 to 255), the coordinate reference system and the vertical datum
        ride along where the file has them; properties of faces, normals and textures do not.

    Raises
    ------
    ValueError
        For a suffix that is not read, a `scale` or `up` that is none, or a reference system that
        is not in metres and no `scale`.
    OSError
        Where there is no such file, or it may not be read.
    Error
        For a file that is broken, empty, of another format than its suffix says, or without faces,
        for positions in longitude and latitude, and where the extra is missing.

    Examples
    --------
    >>> import bathyal, tempfile
    >>> path = tempfile.mkdtemp() + "/step.obj"
    >>> mesh = bathyal.TriangleMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> bathyal.write_mesh(mesh, path)
    >>> bathyal.read_mesh(path, scale=0.001).vertices[1].tolist()
    [0.001, 0.0, 0.0]
    """
    read = _READERS[known_suffix(path, _READERS, "mesh")]
    if scale is not None and not 0 < scale < np.inf:
        raise argument_error("scale", "a finite number above 0", scale)
    if up is not None and up not in _Z_UP_FROM:
        raise argument_error("up", '"x", "y" or "z"', repr(up))
    surface = read(path)
    crs, vertical_datum = (surface.notes.get(name, "") for name in ("crs", "vertical_datum"))
    with reading(path, "mesh"):
        units = units_of(crs, vertical_datum)
    check_scale(units, scale)
    unit = surface.unit if scale is None else scale
    turn = _Z_UP_FROM[surface.up if up is None else up]
    with reading(path, "mesh"):
        if len(surface.triangles) == 0:
            raise Error("it holds no faces; read_cloud reads points")
        vertices, attributes = surface.vertices, surface.attributes
        if unit != 1.0:
            vertices = vertices * unit
        if turn is not _Z_UP_FROM["z"]:
            vertices, attributes = _turned(vertices, attributes, turn)
        return TriangleMesh(
            vertices,
            np.ascontiguousarray(surface.triangles, np.int32),
            attributes=attributes,
            crs=crs if units.metric else "",
            vertical_datum=vertical_datum,
        )


def write_mesh(mesh: TriangleMesh, path: PathLike) -> None:
    """Write a triangle mesh.

    Parameters
    ----------
    mesh : TriangleMesh
    path : path
        ``.vtp`` and ``.ply`` keep everything, in double; ``.obj`` keeps the coordinates in full,
        colours, the coordinate reference system and the vertical datum; ``.stl`` keeps the
        triangles only (binary where float32 keeps 0.01 mm, else ascii). The file appears whole or
        not at all.

    Raises
    ------
    ValueError
        For a suffix that is not written.
    OSError
        Where the file cannot be written.

    Examples
    --------
    >>> import bathyal, tempfile
    >>> path = tempfile.mkdtemp() + "/step.ply"
    >>> mesh = bathyal.TriangleMesh(
    ...     [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], crs="EPSG:32602"
    ... )
    >>> bathyal.write_mesh(mesh, path)
    >>> bathyal.read_mesh(path).crs
    'EPSG:32602'
    """
    _WRITERS[known_suffix(path, _WRITERS, "mesh")](mesh, path)


def merged(
    points: NDArray[np.float64], triangles: NDArray[Any]
) -> tuple[NDArray[np.float64], NDArray[Any]]:
    """Equal points made one, in the order of their first appearance; unused ones left out."""
    used = np.ascontiguousarray(points[triangles.reshape(-1)]) + 0.0  # -0 and 0 are equal
    keys = used.view(np.dtype((np.void, used.dtype.itemsize * 3))).reshape(-1)
    _, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
    order = np.argsort(first)
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    return used[first[order]], rank[inverse].reshape(-1, 3)


def _turned(
    vertices: NDArray[np.float64],
    attributes: dict[str, NDArray[np.float64]],
    turn: NDArray[np.float64],
) -> tuple[NDArray[np.float64], dict[str, NDArray[np.float64]]]:
    """Vertices in other axes, and their normals with them."""
    names = ("nx", "ny", "nz")
    if all(name in attributes for name in names):
        normals = np.column_stack([attributes[name] for name in names]) @ turn.T
        attributes = {**attributes, **dict(zip(names, normals.T.copy(), strict=True))}
    return vertices @ turn.T + 0.0, attributes  # no negative zeros


def _read_ply(path: PathLike) -> _Surface:
    ply = read_ply(path)
    with reading(path, "PLY"):
        return _Surface(ply.points, ply.triangles(), ply.attributes, ply.notes)


def _read_stl(path: PathLike) -> _Surface:
    corners = read_stl(path)
    triangles = np.arange(3 * len(corners)).reshape(-1, 3)
    return _Surface(*merged(corners.reshape(-1, 3), triangles))


def _read_obj(path: PathLike) -> _Surface:
    obj = read_obj(path)
    return _Surface(obj.vertices, obj.triangles, obj.attributes, obj.notes)


def _read_collada(path: PathLike) -> _Surface:
    scene = read_collada(path)
    surface = merged(scene.points, scene.triangles)
    return _Surface(*surface, unit=scene.unit, up=scene.up_axis[0].lower())


def _read_3ds(path: PathLike) -> _Surface:
    return _Surface(*merged(*read_assimp(path)))


def _read_gltf(path: PathLike) -> _Surface:
    return _Surface(*merged(*read_assimp(path)), up="y")


def _read_vtp(path: PathLike) -> _Surface:
    data = read_vtp(path)
    with reading(path, "VTK PolyData"):
        attributes = canonical_attributes(columns_of(data.point_data))
        notes = notes_of_fields(data.field_data)
        return _Surface(data.points, data.triangles(), attributes, notes)


_READERS: dict[str, Callable[[PathLike], _Surface]] = {
    ".3ds": _read_3ds,
    ".dae": _read_collada,
    ".glb": _read_gltf,
    ".gltf": _read_gltf,
    ".obj": _read_obj,
    ".ply": _read_ply,
    ".stl": _read_stl,
    ".vtp": _read_vtp,
}


def _write_ply(mesh: TriangleMesh, path: PathLike) -> None:
    write_ply(
        path,
        mesh.vertices,
        attributes=mesh.attributes,
        notes=notes_of(mesh),
        triangles=mesh.triangles,
    )


def _write_vtp(mesh: TriangleMesh, path: PathLike) -> None:
    write_vtp(
        path,
        mesh.vertices,
        polygons=mesh.triangles,
        point_data=mesh.attributes,
        field_data=notes_of(mesh),
    )


def _write_obj(mesh: TriangleMesh, path: PathLike) -> None:
    write_obj(path, mesh.vertices, mesh.triangles, attributes=mesh.attributes, notes=notes_of(mesh))


def _write_stl(mesh: TriangleMesh, path: PathLike) -> None:
    write_stl(path, mesh.vertices, mesh.triangles)


_WRITERS: dict[str, Callable[[TriangleMesh, PathLike], None]] = {
    ".obj": _write_obj,
    ".ply": _write_ply,
    ".stl": _write_stl,
    ".vtp": _write_vtp,
}
