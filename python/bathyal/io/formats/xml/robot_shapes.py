# SPDX-License-Identifier: BSD-3-Clause
"""The outlines of a URDF's links: boxes, cylinders, spheres, and meshes by name."""

from __future__ import annotations

from xml.etree.ElementTree import Element

from bathyal._core import Error, Shape
from bathyal.io.formats.xml.robot_values import (
    all_parts,
    needed_number,
    only_part,
    origin_of,
    tag_of,
    text_value,
    vector_value,
)

_KINDS = ("box", "cylinder", "sphere", "mesh")


def shapes_of(link: Element, tag: str, name: str, folder: str) -> list[Shape]:
    """The shapes that a link has as `tag`, "collision" or "visual", in the file's order.

    `name` is the link's; `folder` is where relative names of meshes start.
    """
    where = f"link {name}, {tag}"
    return [_shape(element, where, name, folder) for element in all_parts(link, tag)]


def _shape(element: Element, where: str, part: str, folder: str) -> Shape:
    geometry = only_part(element, "geometry", where)
    if geometry is None or len(geometry) != 1 or tag_of(geometry[0]) not in _KINDS:
        found = "nothing" if geometry is None else ", ".join(map(tag_of, geometry)) or "nothing"
        raise Error(f"{where}: expected a geometry with one of {', '.join(_KINDS)}, got {found}")
    solid = geometry[0]
    pose = origin_of(element, where)
    try:
        match tag_of(solid):
            case "box":
                size = vector_value(solid, "size", f"{where}, box")
                return Shape("box", size=size, pose=pose, part=part)
            case "cylinder":
                radius = needed_number(solid, "cylinder", "radius", where)
                length = needed_number(solid, "cylinder", "length", where)
                return Shape("cylinder", radius=radius, length=length, pose=pose, part=part)
            case "sphere":
                radius = needed_number(solid, "sphere", "radius", where)
                return Shape("sphere", radius=radius, pose=pose, part=part)
            case _:
                file = text_value(solid, "mesh", "filename", where)
                scale = vector_value(solid, "scale", f"{where}, mesh")
                return Shape("mesh", file=file, folder=folder, scale=scale, pose=pose, part=part)
    except ValueError as error:
        raise Error(f"{where}: {error}") from None
