# SPDX-License-Identifier: BSD-3-Clause
"""An arm as a URDF that loads again to the same arm."""

from __future__ import annotations

from typing import Any
from xml.etree.ElementTree import Element, SubElement, indent, tostring

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Arm, Shape, chain_from_arm
from bathyal.arm.urdf_reader import BASE_JOINT, TOOL_JOINT, UNLIMITED
from bathyal.io.files import PathLike, replacing

Pose = NDArray[np.float64]

_SAME_PLACE = 1e-12  # [m, 1] frames this near are one


def urdf_of_arm(arm: Arm, path: PathLike | None = None) -> str:
    """The arm as a URDF; what `Arm.to_urdf` returns.

    Parameters
    ----------
    arm : Arm
    path : path, optional
        Where to write it, too. The file appears whole or not at all.

    Returns
    -------
    str
        `Arm.from_urdf` makes the same arm of it: motion to rounding, names, limits, masses and
        inertia, joints that follow others, `base` (a fixed joint ``world_from_base``) and `tool`
        (``flange_from_tool``, which is always there and marks the tip), shapes, with the names of
        meshes as they are. Volumes and centres of buoyancy are lost: URDF has no place for them;
        `Arm.save` keeps them. A joint that follows
        one outside the arm gets that one next to it, on a link without mass. What is unlimited is
        written as the largest double.

    Raises
    ------
    OSError
        Where the file cannot be written.

    Examples
    --------
    >>> import bathyal
    >>> arm = bathyal.Arm.from_dh(a=[0.3], alpha=[0], d=[0], theta=[0], name="lever")
    >>> print(arm.to_urdf().splitlines()[1])
    <robot name="lever">
    """
    text = _Writer(arm).text()
    if path is not None:
        with replacing(path) as aside:
            aside.write_text(text, encoding="utf-8")
    return text


def rpy_of(turn: Pose) -> tuple[float, float, float]:
    """Roll, pitch, yaw [rad] with turn = Rz(yaw) Ry(pitch) Rx(roll), URDF's order.

    Roll is taken after yaw: near a pitch of 90°, where neither is known alone, the product still
    is.
    """
    yaw = np.arctan2(turn[1, 0], turn[0, 0])
    c, s = np.cos(yaw), np.sin(yaw)
    pitch = np.arctan2(-turn[2, 0], c * turn[0, 0] + s * turn[1, 0])
    roll = np.arctan2(s * turn[0, 2] - c * turn[1, 2], -s * turn[0, 1] + c * turn[1, 1])
    return float(roll), float(pitch), float(yaw)


class _Writer:
    """Links and joints are added from the foot to the tip; names are made unique as they come."""

    def __init__(self, arm: Arm) -> None:
        self._arm = arm
        self._chain = chain_from_arm(arm)
        self._moving = self._chain["joints"][:-1]
        self._robot = Element("robot", name=arm.name or "arm")
        self._links: set[str] = set()
        self._joints = {BASE_JOINT, TOOL_JOINT}
        self._joint_names = [
            _unique(joint["name"] or f"joint_{k + 1}", self._joints)
            for k, joint in enumerate(self._moving)
        ]
        self._leaders = self._leaders_inside()

    def text(self) -> str:
        links = self._chain["links"]
        carriers = [self._add_link(links[0], "base_link")]
        self._add_base(carriers[0])
        self._add_leaders_outside(carriers[0])
        for k, (joint, link) in enumerate(zip(self._moving, links[1:], strict=False)):
            carriers.append(self._add_link(link, f"link_{k + 1}"))
            element = self._add_joint(self._joint_names[k], joint, *carriers[-2:])
            self._add_mimic(element, joint)
        self._add_tip(carriers)
        indent(self._robot)
        head = '<?xml version="1.0"?>\n'
        source = f"<!-- {self._arm.source.replace('--', '- -')} -->\n" if self._arm.source else ""
        return head + source + tostring(self._robot, encoding="unicode") + "\n"

    def _leaders_inside(self) -> dict[int, str]:
        """By coordinate, the joint that has its value."""
        leaders: dict[int, str] = {}
        for name, joint in zip(self._joint_names, self._moving, strict=True):
            plain = joint["multiplier"] == 1 and joint["offset"] == 0 and not joint["follows"]
            if joint["type"] != "fixed" and plain:
                leaders.setdefault(joint["coordinate"], name)
        return leaders

    def _add_base(self, foot: str) -> None:
        if not np.array_equal(self._arm.base, np.eye(4)):
            world = self._add_link({}, "world")
            self._add_fixed(BASE_JOINT, np.asarray(self._arm.base), world, foot)

    def _add_leaders_outside(self, foot: str) -> None:
        for joint in self._moving:
            coordinate = joint["coordinate"]
            if joint["type"] == "fixed" or coordinate in self._leaders:
                continue
            name = _unique(joint["follows"] or f"coordinate_{coordinate + 1}", self._joints)
            self._leaders[coordinate] = name
            lower, upper = self._arm.lower[coordinate], self._arm.upper[coordinate]
            leader = joint | {"origin": np.eye(4), "lower": lower, "upper": upper}
            self._add_joint(name, leader, foot, self._add_link({}, f"{name}_value"))

    def _add_mimic(self, element: Element, joint: dict[str, Any]) -> None:
        if joint["type"] == "fixed" or self._leaders[joint["coordinate"]] == element.get("name"):
            return
        SubElement(
            element,
            "mimic",
            joint=self._leaders[joint["coordinate"]],
            multiplier=_text(joint["multiplier"]),
            offset=_text(joint["offset"]),
        )

    def _add_tip(self, carriers: list[str]) -> None:
        """Frames, the flange among them where there is one, and the tool."""
        flange = self._chain["joints"][-1]["origin"]
        at_flange = None
        for carrier, link in zip(carriers, self._chain["links"], strict=False):
            for attached in link["attached"]:
                frame = self._add_link(attached["body"], "frame")
                name = _unique(f"{frame}_joint", self._joints)
                self._add_fixed(name, attached["pose"], carrier, frame)
                near = np.allclose(attached["pose"], flange, rtol=0, atol=_SAME_PLACE)
                if carrier == carriers[-1] and near:
                    at_flange = frame
        if at_flange is None:
            at_flange = self._add_link({}, "flange")
            name = _unique("flange_joint", self._joints)
            self._add_fixed(name, flange, carriers[-1], at_flange)
        tool = self._add_link({}, "tool")
        self._add_fixed(TOOL_JOINT, np.asarray(self._arm.tool), at_flange, tool)

    def _add_link(self, link: dict[str, Any], name: str) -> str:
        name = _unique(link.get("name") or name, self._links)
        element = SubElement(self._robot, "link", name=name)
        if link.get("mass"):
            inertial = SubElement(element, "inertial")
            SubElement(inertial, "origin", xyz=_numbers(link["center_of_mass"]), rpy="0 0 0")
            SubElement(inertial, "mass", value=_text(link["mass"]))
            rows, columns = np.triu_indices(3)
            values = link["inertia"][rows, columns]
            keys = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
            SubElement(inertial, "inertia", dict(zip(keys, map(_text, values), strict=True)))
        for tag in ("visual", "collision"):
            for shape in link.get(tag, ()):
                _add_shape(SubElement(element, tag), shape)
        return name

    def _add_fixed(self, name: str, origin: Pose, parent: str, child: str) -> None:
        self._add_joint(name, {"type": "fixed", "origin": origin}, parent, child)

    def _add_joint(self, name: str, joint: dict[str, Any], parent: str, child: str) -> Element:
        kind = joint["type"]
        if kind == "revolute" and np.isinf([joint["lower"], joint["upper"]]).all():
            kind = "continuous"
        element = SubElement(self._robot, "joint", name=name, type=kind)
        origin = joint["origin"]
        SubElement(element, "origin", xyz=_numbers(origin[:3, 3]), rpy=_numbers(rpy_of(origin)))
        SubElement(element, "parent", link=parent)
        SubElement(element, "child", link=child)
        if kind != "fixed":
            SubElement(element, "axis", xyz=_numbers(joint["axis"]))
            ends = () if kind == "continuous" else ("lower", "upper")
            SubElement(
                element, "limit", {key: _text(joint[key]) for key in (*ends, "velocity", "effort")}
            )
        return element


def _add_shape(element: Element, shape: Shape) -> None:
    SubElement(element, "origin", xyz=_numbers(shape.pose[:3, 3]), rpy=_numbers(rpy_of(shape.pose)))
    solid = SubElement(SubElement(element, "geometry"), shape.kind)
    if shape.kind == "box":
        solid.set("size", _numbers(shape.size))
    elif shape.kind == "mesh":
        solid.set("filename", str(shape.file))
        solid.set("scale", _numbers(shape.scale))
    else:
        for key in ("radius", "length"):
            if getattr(shape, key) is not None:
                solid.set(key, _text(getattr(shape, key)))


def _unique(name: str, taken: set[str]) -> str:
    count, made = 1, name
    while made in taken:
        count += 1
        made = f"{name}_{count}"
    taken.add(made)
    return made


def _numbers(numbers: Any) -> str:
    return " ".join(map(_text, numbers))


def _text(number: float) -> str:
    """The shortest text that reads back as the same double."""
    return repr(float(np.clip(number, -UNLIMITED, UNLIMITED)) + 0.0)
