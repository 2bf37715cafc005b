# SPDX-License-Identifier: BSD-3-Clause
"""Arms from URDF: one path of a robot's tree, from a root to a tip."""

from __future__ import annotations

from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Arm, Error, arm_from_chain
from bathyal.errors import argument_error
from bathyal.io.files import PathLike, reading, shown
from bathyal.io.formats.xml.robot import Joint, Link, Robot, read_robot

Pose = NDArray[np.float64]
Named = TypeVar("Named", Joint, Link)

# The joints by which `Arm.to_urdf` writes what the user set; read back as such.
BASE_JOINT = "world_from_base"
TOOL_JOINT = "flange_from_tool"
# URDF cannot say "no limit" except by `continuous`; the largest double means it.
UNLIMITED = float(np.finfo(np.float64).max)

_KINDS = {
    "revolute": "revolute",
    "continuous": "revolute",
    "prismatic": "prismatic",
    "fixed": "fixed",
    "floating": "",
    "planar": "",
}
_MOST_TIPS_LISTED = 12


def arm_from_urdf(
    path: PathLike, *, tip: str | None = None, root: str | None = None, name: str | None = None
) -> Arm:
    """Read one serial arm of a URDF; what `Arm.from_urdf` returns.

    Parameters
    ----------
    path : path
        A URDF; xacro must be expanded first. Meshes are never opened: `bathyal.mesh_path` finds
        them.
    tip : str, optional
        The link, or the joint whose child link, becomes the flange. Needed where the tree has
        several ends; one that alone has moving joints before it is taken unasked.
    root : str, optional
        The link that becomes the base; the root of the tree unless given.
    name : str, optional
        The robot's unless given.

    Returns
    -------
    Arm
        It moves as the URDF says, to rounding. Nearly parallel neighbours (sine below 0.1) have
        rows with Hayati's beta. Joints that mimic share a coordinate, also with a joint off the
        path; their limits bind each other. ``continuous`` joints have none. Links behind fixed
        joints become frames of the link that carries them, and weigh on it, as do the branches
        that leave the path, their joints taken at 0; their shapes become that link's too
        (`Link.collision`, `Link.visual`), each with the name of its own link as its `part`. What
        `to_urdf` wrote as base and tool is `base` and `tool` again.

    Raises
    ------
    ValueError
        For a tip or root that is not there, or must be given; the text lists the tips there are.
    OSError
        Where there is no such file, or it may not be read.
    Error
        For a file that is no URDF; loops, links that are missing, defined twice or apart; a type of
        joint that is not known; a planar or floating joint on the path; an axis of 0; lower above
        upper; joints that mimic in a circle.

    Examples
    --------
    >>> import bathyal, tempfile
    >>> arm = bathyal.arms.ur10e()
    >>> path = tempfile.mkdtemp() + "/arm.urdf"
    >>> _ = arm.to_urdf(path)
    >>> bathyal.Arm.from_urdf(path).size
    6
    """
    robot = read_robot(path)
    with reading(path, "URDF"):
        tree = _Tree(robot)
    base = tree.take_base() if root is None else np.eye(4)
    tool = tree.take_tool() if tip is None else None
    first = tree.root if root is None else _known_link(tree, root)
    last = tool[0] if tool else (_only_tip(tree, first) if tip is None else _known(tree, tip))
    path_joints = _path(tree, first, last)
    with reading(path, "URDF"):
        fields = _chain(tree, first, path_joints)
        fields["name"] = robot.name if name is None else name
        fields["source"] = f"URDF {shown(Path(path).name)}, from {first} to {last}"
        arm = arm_from_chain(fields)
        arm.base = base
        if tool:
            arm.tool = tool[1]
    return arm


class _Tree:
    """Links and joints by name, each link below one joint at most, all below one root."""

    def __init__(self, robot: Robot) -> None:
        self.links = _by_name(robot.links, "link")
        self.joints = _by_name(robot.joints, "joint")
        self.above: dict[str, Joint] = {}
        self.below: dict[str, list[Joint]] = {link: [] for link in self.links}
        for joint in robot.joints:
            self._add(joint)
        self.root = self._find_root()

    def _add(self, joint: Joint) -> None:
        if joint.type not in _KINDS:
            raise Error(f"joint {joint.name}: expected type {', '.join(_KINDS)}, got {joint.type}")
        for end in (joint.parent, joint.child):
            if end not in self.links:
                raise Error(f"joint {joint.name}: its link {end} is missing")
        if joint.child in self.above:
            other = self.above[joint.child].name
            raise Error(f"link {joint.child}: joints {other} and {joint.name} both end in it")
        self.above[joint.child] = joint
        self.below[joint.parent].append(joint)

    def _find_root(self) -> str:
        if not self.links:
            raise Error("it has no links")
        roots = [link for link in self.links if link not in self.above]
        if len(roots) > 1:
            raise Error(f"its links hang apart: {_listed(roots)} have no joint above them")
        reached = set(self.order(roots[0])) if roots else set()
        if len(reached) < len(self.links):
            lost = [link for link in self.links if link not in reached]
            raise Error(f"its joints form a loop through {_listed(lost)}")
        return roots[0]

    def order(self, first: str) -> list[str]:
        """`first` and the links below it, each after the one that carries it."""
        links = [first]
        for link in links:
            links.extend(joint.child for joint in self.below[link])
        return links

    def take_base(self) -> Pose:
        """world_from_base where the root is the world of `to_urdf`; the root moves to the base."""
        only = self.below[self.root]
        if len(only) != 1 or only[0].name != BASE_JOINT or only[0].type != "fixed":
            return np.eye(4)
        self.root = only[0].child
        return only[0].origin

    def take_tool(self) -> tuple[str, Pose] | None:
        """The flange and flange_from_tool, where `to_urdf` wrote them; the tool's link goes."""
        joint = self.joints.get(TOOL_JOINT)
        if joint is None or joint.type != "fixed" or self.below[joint.child]:
            return None
        self.below[joint.parent].remove(joint)
        return joint.parent, joint.origin


def _by_name(things: list[Named], what: str) -> dict[str, Named]:
    named: dict[str, Named] = {}
    for thing in things:
        if thing.name in named:
            raise Error(f"{what} {thing.name}: it is defined twice")
        named[thing.name] = thing
    return named


def _listed(names: list[str]) -> str:
    more = len(names) - _MOST_TIPS_LISTED
    return ", ".join(names[:_MOST_TIPS_LISTED]) + (f" and {more} more" if more > 0 else "")


def _known_link(tree: _Tree, link: str) -> str:
    if link not in tree.links:
        raise argument_error("root", f"one of the links {_listed([*tree.links])}", repr(link))
    return link


def _known(tree: _Tree, tip: str) -> str:
    if tip in tree.links:
        return tip
    if tip in tree.joints:
        return tree.joints[tip].child
    raise argument_error(
        "tip", f"the name of a link or joint, for instance {_listed(_tips(tree))}", repr(tip)
    )


def _tips(tree: _Tree) -> list[str]:
    return [link for link in tree.links if not tree.below[link]]


def _only_tip(tree: _Tree, first: str) -> str:
    """The end of the tree, where there is but one, or one with moving joints before it."""
    moving = {first: 0}
    order = tree.order(first)
    for link in order[1:]:
        joint = tree.above[link]
        moving[link] = moving[joint.parent] + (joint.type != "fixed")
    tips = [link for link in order if not tree.below[link]]
    if len(tips) > 1:
        tips = [link for link in tips if moving[link]] or tips
    if len(tips) == 1:
        return tips[0]
    choices = _listed(
        [f"{tip!r} ({moving[tip]} joints)" for tip in sorted(tips, key=lambda link: moving[link])]
    )
    raise argument_error("tip", f"one of {choices}, or any other link", None)


def _path(tree: _Tree, first: str, last: str) -> list[Joint]:
    joints: list[Joint] = []
    link = last
    while link != first:
        joint = tree.above.get(link)
        if joint is None:
            raise argument_error("root", f"a link that carries {last!r}", repr(first))
        joints.append(joint)
        link = joint.parent
    if all(joint.type == "fixed" for joint in joints):
        raise argument_error("tip", "a link behind moving joints", repr(last))
    return joints[::-1]


def _chain(tree: _Tree, first: str, path: list[Joint]) -> dict[str, Any]:
    coordinates: dict[str, int] = {}
    joints = [_joint(tree, joint, coordinates) for joint in path]
    path_names = {joint.name for joint in path}
    links = [first] + [joint.child for joint in path]
    return {"joints": joints, "links": [_link(tree, link, path_names) for link in links]}


def _joint(tree: _Tree, joint: Joint, coordinates: dict[str, int]) -> dict[str, Any]:
    kind = _KINDS[joint.type]
    if not kind:
        raise Error(f"joint {joint.name}: a {joint.type} joint cannot be part of an arm")
    fields: dict[str, Any] = {"name": joint.name, "type": kind, "origin": joint.origin}
    if kind == "fixed":
        return fields
    leader, multiplier, offset = _leader(tree, joint)
    lower, upper = _limits(joint)
    if leader is not joint:
        fields["follows"] = leader.name
        if multiplier == 0:
            raise Error(f"joint {joint.name}: it mimics {leader.name} with multiplier 0")
        ends = sorted(multiplier * end + offset for end in _limits(leader))
        lower, upper = max(lower, ends[0]), min(upper, ends[1])
    return fields | {
        "axis": joint.axis,
        "coordinate": coordinates.setdefault(leader.name, len(coordinates)),
        "multiplier": multiplier,
        "offset": offset,
        "lower": lower,
        "upper": upper,
        "velocity": _most(joint, "velocity"),
        "effort": _most(joint, "effort"),
    }


def _leader(tree: _Tree, joint: Joint) -> tuple[Joint, float, float]:
    """The joint that moves this one, and value = multiplier * the leader's + offset."""
    multiplier, offset = 1.0, 0.0
    seen = {joint.name}
    while joint.mimic is not None:
        offset += multiplier * joint.mimic.offset
        multiplier *= joint.mimic.multiplier
        leader = tree.joints.get(joint.mimic.joint)
        if leader is None:
            missing = joint.mimic.joint
            raise Error(f"joint {joint.name}: it mimics {missing}, which is missing")
        if _KINDS[leader.type] not in ("revolute", "prismatic"):
            raise Error(f"joint {joint.name}: it mimics {leader.name}, a {leader.type} joint")
        joint = leader
        if joint.name in seen:
            raise Error(f"joint {joint.name}: it mimics itself, through {_listed(sorted(seen))}")
        seen.add(joint.name)
    return joint, multiplier, offset


def _limits(joint: Joint) -> tuple[float, float]:
    if joint.type == "continuous":
        return -np.inf, np.inf
    limit = joint.limit
    if limit is None or (limit.lower is None and limit.upper is None):
        raise Error(f"joint {joint.name}: a {joint.type} joint needs a limit with lower and upper")
    lower, upper = limit.lower or 0.0, limit.upper or 0.0
    if lower > upper:
        raise Error(f"joint {joint.name}: its lower limit {lower} is above the upper one, {upper}")
    return (
        -np.inf if lower <= -UNLIMITED else lower,
        np.inf if upper >= UNLIMITED else upper,
    )


def _most(joint: Joint, what: str) -> float:
    value = None if joint.limit is None else getattr(joint.limit, what)
    return np.inf if value is None or value >= UNLIMITED else float(value)


def _link(tree: _Tree, link: str, path: set[str]) -> dict[str, Any]:
    """A link and what hangs on it off the path."""
    attached = []
    waiting = [(link, np.eye(4), True)]
    while waiting:
        carrier, link_from_carrier, rigid = waiting.pop()
        for joint in tree.below[carrier]:
            if joint.name in path or not _KINDS[joint.type]:
                continue  # what floats, or slides on a plane, does not hang here
            fixed = rigid and joint.type == "fixed"
            pose = link_from_carrier @ joint.origin
            body = _body(tree.links[joint.child]) | {"name": joint.child if fixed else ""}
            attached.append({"pose": pose, "body": body})
            waiting.append((joint.child, pose, fixed))
    return _body(tree.links[link]) | {"attached": attached}


def _body(link: Link) -> dict[str, Any]:
    fields: dict[str, Any] = {
        "name": link.name,
        "collision": link.collision,
        "visual": link.visual,
    }
    if link.inertial is None:
        return fields
    pose = link.inertial.origin
    turn = pose[:3, :3]
    return fields | {
        "mass": link.inertial.mass,
        "center_of_mass": pose[:3, 3],
        "inertia": turn @ link.inertial.inertia @ turn.T,
    }
