# SPDX-License-Identifier: BSD-3-Clause
"""A URDF's links and joints, from files nobody vouches for.

Every number is checked as it is read. Materials, transmissions, sensors and whatever else a URDF
holds are not looked at; meshes are kept by name and never opened.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from xml.etree.ElementTree import Element

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error, Shape
from bathyal.io.files import PathLike, read_document, reading
from bathyal.io.formats.xml.robot_shapes import shapes_of
from bathyal.io.formats.xml.robot_values import (
    name_of,
    needed_number,
    number_value,
    only_part,
    origin_of,
    tag_of,
    text_value,
    vector_value,
)
from bathyal.io.formats.xml.safe import parse_xml

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Inertial:
    """What a link weighs; `inertia` about the origin of `origin`, along its axes."""

    origin: Array
    mass: float
    inertia: Array


@dataclass(frozen=True)
class Link:
    """A body of the robot."""

    name: str
    inertial: Inertial | None
    collision: list[Shape]
    visual: list[Shape]


@dataclass(frozen=True)
class Limit:
    """What a joint may do; None where the file does not say."""

    lower: float | None = None
    upper: float | None = None
    velocity: float | None = None
    effort: float | None = None


@dataclass(frozen=True)
class Mimic:
    """value = multiplier * that of `joint` + offset."""

    joint: str
    multiplier: float
    offset: float


@dataclass(frozen=True)
class Joint:
    """How two links hang together; `origin` is parent_from_child at the value 0."""

    name: str
    type: str
    parent: str
    child: str
    origin: Array
    axis: Array
    limit: Limit | None
    mimic: Mimic | None


@dataclass(frozen=True)
class Robot:
    """A URDF's links and joints, each in the file's order."""

    name: str
    links: list[Link]
    joints: list[Joint]


def read_robot(path: PathLike) -> Robot:
    """The links and joints of a file.

    Raises
    ------
    OSError
        Where there is no such file, or it may not be read.
    Error
        For what is no URDF: other or broken XML, a document type, xacro that is not expanded, a
        joint without parent or child, numbers that are none.
    """
    content = read_document(path)
    with reading(path, "URDF"):
        root = parse_xml(content)
        if tag_of(root) != "robot":
            raise Error(f"its root element is {tag_of(root)}, not robot")
        folder = os.path.dirname(os.path.abspath(path))
        if any("xacro" in element.tag for element in root.iter()):
            raise Error("it is a xacro file: expand it first (xacro FILE > arm.urdf)")
        return Robot(
            root.get("name", ""),
            [_link(element, folder) for element in root if tag_of(element) == "link"],
            [_joint(element) for element in root if tag_of(element) == "joint"],
        )


def _link(element: Element, folder: str) -> Link:
    name = name_of(element)
    inertial = only_part(element, "inertial", f"link {name}")
    return Link(
        name,
        None if inertial is None else _inertial(inertial, f"link {name}, inertial"),
        shapes_of(element, "collision", name, folder),
        shapes_of(element, "visual", name, folder),
    )


def _inertial(element: Element, where: str) -> Inertial:
    mass = only_part(element, "mass", where)
    inertia = only_part(element, "inertia", where)
    keys = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    value = needed_number(mass, "mass", "value", where)
    xx, xy, xz, yy, yz, zz = (needed_number(inertia, "inertia", key, where) for key in keys)
    return Inertial(
        origin_of(element, where), value, np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    )


def _joint(element: Element) -> Joint:
    name = name_of(element)
    where = f"joint {name}"
    parts = {
        tag: only_part(element, tag, where)
        for tag in ("origin", "parent", "child", "axis", "limit", "mimic")
    }
    axis = None if parts["axis"] is None else vector_value(parts["axis"], "xyz", f"{where}, axis")
    return Joint(
        name,
        element.get("type", "").strip(),
        text_value(parts["parent"], "parent", "link", where),
        text_value(parts["child"], "child", "link", where),
        origin_of(element, where),
        np.array([1.0, 0.0, 0.0]) if axis is None else axis,
        None if parts["limit"] is None else _limit(parts["limit"], f"{where}, limit"),
        None if parts["mimic"] is None else _mimic(parts["mimic"], where),
    )


def _limit(element: Element, where: str) -> Limit:
    return Limit(
        *(number_value(element, key, where) for key in ("lower", "upper", "velocity", "effort"))
    )


def _mimic(element: Element, where: str) -> Mimic:
    multiplier = number_value(element, "multiplier", f"{where}, mimic")
    offset = number_value(element, "offset", f"{where}, mimic")
    return Mimic(
        text_value(element, "mimic", "joint", where),
        1.0 if multiplier is None else multiplier,
        0.0 if offset is None else offset,
    )
