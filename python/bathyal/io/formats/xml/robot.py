# SPDX-License-Identifier: BSD-3-Clause
"""A URDF's links and joints, from files nobody vouches for.

yourdfpy reads the elements. What it would let pass (entities, broken markup that it mends by
guessing, half a vector, two parents) is refused before, and all that arms do not use (shapes,
meshes, materials, transmissions) never reaches it.
"""

from __future__ import annotations

import io
import math
from collections.abc import Iterable
from typing import Any
from xml.etree.ElementTree import Element, SubElement, tostring

from bathyal._core import Error
from bathyal.io.files import PathLike, opened, reading
from bathyal.io.formats.xml.safe import parse_xml

_MOST_BYTES = 64 << 20  # a robot of 10 000 links takes about 5 MB
_LINK_PARTS = ("inertial",)
_JOINT_PARTS = ("origin", "parent", "child", "axis", "limit", "mimic")
_VECTORS = ("xyz", "rpy")
_NUMBERS = (
    "value", "ixx", "ixy", "ixz", "iyy", "iyz", "izz",
    "lower", "upper", "velocity", "effort", "multiplier", "offset",
)  # fmt: skip
_INERTIA = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")


def read_robot(path: PathLike) -> Any:
    """The `yourdfpy.Robot` of a file, its links and joints only.

    Raises
    ------
    OSError
        Where there is no such file, or it may not be read.
    Error
        For what is no URDF: other or broken XML, a document type, xacro that is not expanded, a
        joint without parent or child, numbers that are none.
    """
    with opened(path) as (stream, size), reading(path, "URDF"):
        if size > _MOST_BYTES:
            raise Error(f"expected at most {_MOST_BYTES >> 20} MB, got {size / 2**20:.0f} MB")
        root = parse_xml(stream.read())
        if _tag(root) != "robot":
            raise Error(f"its root element is {_tag(root)}, not robot")
        if any("xacro" in element.tag for element in root.iter()):
            raise Error("it is a xacro file: expand it first (xacro FILE > arm.urdf)")
        return _parsed(_essentials(root))


def _parsed(robot: Element) -> Any:
    # Imported late: it takes a second, and few sessions read a URDF.
    from yourdfpy import URDF, filename_handler_null  # type: ignore[import-untyped]

    return URDF.load(
        io.BytesIO(tostring(robot)),
        build_scene_graph=False,
        load_meshes=False,
        filename_handler=filename_handler_null,
    ).robot


def _tag(element: Element) -> str:
    return element.tag.rpartition("}")[2]


def _essentials(root: Element) -> Element:
    """A copy with what an arm is made of, every part of it checked."""
    robot = Element("robot", name=root.get("name", ""))
    for element in root:
        match _tag(element):
            case "link":
                link = SubElement(robot, "link", name=_name(element))
                _copy_parts(element, link, _LINK_PARTS, f"link {link.get('name')}")
            case "joint":
                name = _name(element)
                joint = SubElement(robot, "joint", name=name, type=element.get("type", ""))
                _copy_parts(element, joint, _JOINT_PARTS, f"joint {name}")
                _need(joint, f"joint {name}", {"parent": "link", "child": "link"})
                if joint.find("mimic") is not None:
                    _need(joint, f"joint {name}", {"mimic": "joint"})
    return robot


def _name(element: Element) -> str:
    name = element.get("name", "").strip()
    if not name:
        raise Error(f"a {_tag(element)} has no name")
    return name


def _need(joint: Element, what: str, attributes: dict[str, str]) -> None:
    for tag, attribute in attributes.items():
        part = joint.find(tag)
        if part is None or not part.get(attribute, "").strip():
            raise Error(f"{what}: it has no {tag} {attribute}")


def _copy_parts(source: Element, target: Element, tags: Iterable[str], what: str) -> None:
    for tag in tags:
        found = [child for child in source if _tag(child) == tag]
        if len(found) > 1:
            raise Error(f"{what}: it has {len(found)} elements {tag}")
        for part in found:
            where = f"{what}, {tag}"
            copy = SubElement(target, tag, _checked(part, where))
            if tag == "inertial":
                _copy_parts(part, copy, ("origin", "mass", "inertia"), where)
                _check_inertial(copy, where)


def _check_inertial(inertial: Element, where: str) -> None:
    needed = {"mass": ("value",), "inertia": _INERTIA}
    for tag, attributes in needed.items():
        part = inertial.find(tag)
        missing = attributes if part is None else [a for a in attributes if part.get(a) is None]
        if missing:
            raise Error(f"{where}: it has no {tag} {missing[0]}")


def _checked(part: Element, where: str) -> dict[str, str]:
    """Its attributes, every number readable."""
    attributes = {key: value.strip() for key, value in part.attrib.items()}
    for key, text in attributes.items():
        if key in _VECTORS:
            numbers = [_number(word) for word in text.split()]
            if len(numbers) != 3 or not all(map(math.isfinite, numbers)):
                raise Error(f"{where} {key}: expected three finite numbers, got {text!r}")
        elif key in _NUMBERS and math.isnan(_number(text)):
            raise Error(f"{where} {key}: expected a number, got {text!r}")
    return attributes


def _number(word: str) -> float:
    """NaN for what is none; Python's own digits with underscores are none."""
    try:
        return math.nan if "_" in word else float(word)
    except ValueError:
        return math.nan
