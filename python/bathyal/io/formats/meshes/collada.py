# SPDX-License-Identifier: BSD-3-Clause
"""COLLADA (`.dae`): every geometry that the scene shows, in its place, in double."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from xml.etree.ElementTree import Element

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error, check_bytes
from bathyal.io.files import PathLike, opened, reading
from bathyal.io.formats.meshes.cells import Cells, Integers
from bathyal.io.formats.meshes.polygons import triangles_of_polygons, triangles_of_strips
from bathyal.io.formats.meshes.transforms import TRANSFORMS
from bathyal.io.formats.numbers import numbers_of_text
from bathyal.io.formats.xml.safe import parse_xml

# A few nodes that instance one another can expand to more than any machine holds.
_MOST_NODES = 100_000
_POLYGONS = ("triangles", "polylist", "polygons", "tristrips", "trifans")

Matrix = NDArray[np.float64]


@dataclass(frozen=True)
class Collada:
    """Corners (N, 3) in the file's unit and axes, triangles (T, 3), the unit [m], the up axis.

    Corners are not joined across geometries.
    """

    points: NDArray[np.float64]
    triangles: Integers
    unit: float
    up_axis: str


def read_collada(path: PathLike) -> Collada:
    """Read the triangles, polygons, strips and fans of the scene; lines are left out.

    A part that a transform mirrors is turned round, so that it faces outward as before. Skinned
    and spline geometry and polygons with holes are an `Error`.
    """
    with opened(path) as (stream, _), reading(path, "COLLADA"):
        root = parse_xml(stream.read())
        if _tag(root) != "COLLADA":
            raise Error(f"its root element is {_tag(root)}, not COLLADA")
        file = _File(root)
        parts = list(file.parts())
        if not parts:
            raise Error("its scene shows no triangles and no polygons")
        first = np.cumsum([0] + [len(points) for points, _ in parts[:-1]])
        triangles = [part[1] + start for part, start in zip(parts, first, strict=True)]
        points = np.concatenate([part[0] for part in parts])
        return Collada(points, np.concatenate(triangles), *file.unit_and_up_axis())


def _tag(element: Element) -> str:
    return element.tag.rpartition("}")[2]


def _children(element: Element, *tags: str) -> list[Element]:
    return [child for child in element if _tag(child) in tags]


def _child(element: Element, tag: str) -> Element:
    found = _children(element, tag)
    if not found:
        raise Error(f"{_tag(element)} has no {tag}")
    return found[0]


class _File:
    def __init__(self, root: Element) -> None:
        self._root = root
        self._by_id = {element.get("id"): element for element in root.iter() if element.get("id")}
        self._decoded: dict[int, tuple[NDArray[np.float64], Integers]] = {}
        self._nodes_seen = 0
        self._bytes_seen = 0

    def unit_and_up_axis(self) -> tuple[float, str]:
        asset = next(iter(_children(self._root, "asset")), Element("asset"))
        units, axes = _children(asset, "unit"), _children(asset, "up_axis")
        unit = float(units[0].get("meter", "1")) if units else 1.0
        up_axis = (axes[0].text or "").strip() if axes else "Y_UP"
        if not 0 < unit < np.inf:
            raise Error(f"its unit of {unit} m is no length")
        if up_axis not in ("X_UP", "Y_UP", "Z_UP"):
            raise Error(f"its up axis {up_axis!r} is not known")
        return unit, up_axis

    def parts(self) -> Iterator[tuple[NDArray[np.float64], Integers]]:
        """Points and triangles of each primitive of the scene, or of every geometry without one."""
        scenes = _children(self._root, "scene")
        if scenes:
            for instance in _children(scenes[0], "instance_visual_scene"):
                for node in _children(self._target(instance), "node"):
                    yield from self._node(node, np.eye(4))
            return
        for library in _children(self._root, "library_geometries"):
            for geometry in _children(library, "geometry"):
                yield from self._geometry(geometry, np.eye(4))

    def _target(self, element: Element, key: str = "url") -> Element:
        name = element.get(key, "")
        if name[1:] not in self._by_id or not name.startswith("#"):
            raise Error(f"{_tag(element)} refers to {name!r}, which is not in the file")
        return self._by_id[name[1:]]

    def _node(
        self, node: Element, world_from_parent: Matrix
    ) -> Iterator[tuple[NDArray[np.float64], Integers]]:
        self._nodes_seen += 1
        if self._nodes_seen > _MOST_NODES:
            raise Error(f"its scene has more than {_MOST_NODES} nodes")
        world_from_node = world_from_parent
        for child in node:
            if (transform := TRANSFORMS.get(_tag(child))) is not None:
                numbers = numbers_of_text(child.text or "")
                world_from_node = world_from_node @ transform(numbers)
        for child in node:
            match _tag(child):
                case "node":
                    yield from self._node(child, world_from_node)
                case "instance_node":
                    yield from self._node(self._target(child), world_from_node)
                case "instance_geometry":
                    yield from self._geometry(self._target(child), world_from_node)
                case "instance_controller":
                    raise Error("its scene shows skinned geometry, which is not read")

    def _geometry(
        self, geometry: Element, world_from_node: Matrix
    ) -> Iterator[tuple[NDArray[np.float64], Integers]]:
        mesh = _child(geometry, "mesh")
        for primitive in _children(mesh, *_POLYGONS):
            if id(primitive) not in self._decoded:
                self._decoded[id(primitive)] = self._primitive(primitive)
            local, triangles = self._decoded[id(primitive)]
            self._bytes_seen += local.nbytes + triangles.nbytes
            check_bytes("what its scene shows", self._bytes_seen)
            points = local @ world_from_node[:3, :3].T + world_from_node[:3, 3]
            mirrored = np.linalg.det(world_from_node[:3, :3]) < 0
            yield points, triangles[:, ::-1] if mirrored else triangles

    def _primitive(self, primitive: Element) -> tuple[NDArray[np.float64], Integers]:
        inputs = _children(primitive, "input")
        width = max((int(i.get("offset", "0")) for i in inputs), default=0) + 1
        vertex = next((i for i in inputs if i.get("semantic") == "VERTEX"), None)
        if vertex is None:
            raise Error(f"{_tag(primitive)} has no input VERTEX")
        if _children(primitive, "ph"):
            raise Error("its polygons have holes, which are not read")
        points = self._positions(self._target(vertex, "source"))
        lists = [
            _whole_rows(p.text or "", width)[:, int(vertex.get("offset", "0"))]
            for p in _children(primitive, "p")
        ]
        cells = _cells(primitive, lists)
        cells.check(len(points))
        if _tag(primitive) == "tristrips":
            return points, triangles_of_strips(cells)
        return points, triangles_of_polygons(cells, points)

    def _positions(self, vertices: Element) -> NDArray[np.float64]:
        inputs = _children(vertices, "input")
        position = next((i for i in inputs if i.get("semantic") == "POSITION"), None)
        if position is None:
            raise Error("its vertices have no input POSITION")
        source = self._target(position, "source")
        accessor = _child(_child(source, "technique_common"), "accessor")
        numbers = numbers_of_text(self._target(accessor, "source").text or "")
        count, stride = int(accessor.get("count", "0")), int(accessor.get("stride", "1"))
        names = [param.get("name", "") for param in _children(accessor, "param")]
        columns = [names.index(axis) for axis in "XYZ"] if {*"XYZ"} <= {*names} else [0, 1, 2]
        start = int(accessor.get("offset", "0"))
        wanted = numbers[start : start + count * stride]
        if stride < 3 or count < 0 or start < 0 or len(wanted) != count * stride:
            raise Error(
                f"{count} points of {stride} numbers are announced, {len(numbers)} numbers "
                "are there"
            )
        return wanted.reshape(count, stride)[:, columns]


def _whole_rows(text: str, width: int) -> Integers:
    numbers = numbers_of_text(text)
    if len(numbers) % width or np.any(numbers != np.floor(numbers)):
        raise Error(f"{len(numbers)} indices are no whole number of rows of {width} whole numbers")
    return numbers.astype(np.int64).reshape(-1, width)


def _cells(primitive: Element, lists: list[Integers]) -> Cells:
    """The corner lists of a primitive: its triangles and polylists come in one list."""
    indices = np.concatenate(lists) if lists else np.empty(0, np.int64)
    kind = _tag(primitive)
    if kind == "triangles":
        if len(indices) % 3:
            raise Error(f"{len(indices)} corners are no whole number of triangles")
        sizes = np.full(len(indices) // 3, 3)
    elif kind == "polylist":
        sizes = _whole_rows(_child(primitive, "vcount").text or "", 1)[:, 0]
        if np.any(sizes < 0) or sizes.sum() != len(indices):
            raise Error(f"{sizes.sum()} corners are announced, {len(indices)} are there")
    else:
        sizes = np.array([len(corners) for corners in lists], np.int64)
    return Cells(indices, np.cumsum(sizes))
