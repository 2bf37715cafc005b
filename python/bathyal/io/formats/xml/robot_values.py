# SPDX-License-Identifier: BSD-3-Clause
"""Elements, numbers and poses of a URDF, each refused by name where it is none."""

from __future__ import annotations

import math
from xml.etree.ElementTree import Element

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Error
from bathyal.io.poses import rotation_of

Array = NDArray[np.float64]


def tag_of(element: Element) -> str:
    """Its name without a namespace."""
    return element.tag.rpartition("}")[2]


def name_of(element: Element) -> str:
    """Its attribute `name`, which must be there."""
    name = element.get("name", "").strip()
    if not name:
        raise Error(f"a {tag_of(element)} has no name")
    return name


def all_parts(element: Element, tag: str) -> list[Element]:
    """Its children of that name."""
    return [child for child in element if tag_of(child) == tag]


def only_part(element: Element, tag: str, where: str) -> Element | None:
    """Its one child of that name, or None."""
    found = all_parts(element, tag)
    if len(found) > 1:
        raise Error(f"{where}: it has {len(found)} elements {tag}")
    return found[0] if found else None


def text_value(element: Element | None, tag: str, key: str, where: str) -> str:
    """An attribute that must be there, and its element `tag` with it."""
    text = "" if element is None else element.get(key, "").strip()
    if not text:
        raise Error(f"{where}: it has no {tag} {key}")
    return text


def number_value(element: Element, key: str, where: str) -> float | None:
    """An attribute as a number, ±inf among them; None where it is not there."""
    text = element.get(key)
    if text is None:
        return None
    value = _number(text)
    if math.isnan(value):
        raise Error(f"{where} {key}: expected a number, got {text.strip()!r}")
    return value


def needed_number(element: Element | None, tag: str, key: str, where: str) -> float:
    """An attribute as a number; it and its element `tag` must be there."""
    value = None if element is None else number_value(element, key, f"{where}, {tag}")
    if value is None:
        raise Error(f"{where}: it has no {tag} {key}")
    return value


def vector_value(element: Element, key: str, where: str) -> Array | None:
    """An attribute as three finite numbers; None where it is not there."""
    text = element.get(key)
    if text is None:
        return None
    numbers = [_number(word) for word in text.split()]
    if len(numbers) != 3 or not all(map(math.isfinite, numbers)):
        raise Error(f"{where} {key}: expected three finite numbers, got {text.strip()!r}")
    return np.array(numbers)


def origin_of(element: Element, where: str) -> Array:
    """The (4, 4) pose of its child `origin`; the identity where it has none.

    rpy are turns about the fixed x, y, z in this order: Rz(yaw) Ry(pitch) Rx(roll).
    """
    pose = np.eye(4)
    part = only_part(element, "origin", where)
    if part is None:
        return pose
    place = vector_value(part, "xyz", f"{where}, origin")
    angles = vector_value(part, "rpy", f"{where}, origin")
    if place is not None:
        pose[:3, 3] = place
    if angles is not None:
        pose[:3, :3] = rotation_of(angles)
    return pose


def _number(word: str) -> float:
    """NaN for what is none; Python's own digits with underscores are none."""
    try:
        return math.nan if "_" in word else float(word)
    except ValueError:
        return math.nan
