# SPDX-License-Identifier: BSD-3-Clause
"""SRDF: the pairs of links that are not compared, as ROS' MoveIt keeps them."""

from __future__ import annotations

from collections.abc import Sequence
from xml.sax.saxutils import quoteattr

from bathyal._core import Error, Workspace
from bathyal.errors import argument_error
from bathyal.io.files import PathLike, read_document, reading, replacing
from bathyal.io.formats.xml.robot_values import tag_of
from bathyal.io.formats.xml.safe import parse_xml

_REASONS = {
    "neighbours": "Adjacent",
    "allowed": "User",
    "touch in every posture": "Default",
}


def read_srdf(path: PathLike) -> list[tuple[str, str]]:
    """Pairs of links that a SRDF says need not be compared: `allowed` of a `Workspace`.

    Parameters
    ----------
    path : path
        ``.srdf``; groups, states and whatever else it holds are not looked at.

    Returns
    -------
    list of (str, str)
        By name, in the file's order, each pair once.

    Raises
    ------
    OSError
        Where there is no such file, or it may not be read.
    Error
        For what is no SRDF: other or broken XML, a document type, a pair that lacks a link or has
        one twice.

    Examples
    --------
    >>> import bathyal, pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "arm.srdf"
    >>> _ = path.write_text(
    ...     '<robot name="arm"><disable_collisions link1="hand" link2="cup" reason="User"/></robot>'
    ... )
    >>> bathyal.read_srdf(path)
    [('hand', 'cup')]
    """
    content = read_document(path)
    pairs: dict[tuple[str, str], None] = {}
    with reading(path, "SRDF"):
        root = parse_xml(content)
        if tag_of(root) != "robot":
            raise Error(f"its root element is {tag_of(root)}, not robot")
        for number, element in enumerate(root, start=1):
            if tag_of(element) != "disable_collisions":
                continue
            one, other = (element.get(key, "").strip() for key in ("link1", "link2"))
            if not one or not other or one == other:
                raise Error(
                    f"element {number}, disable_collisions: expected link1 and link2, two links, "
                    f"got {one!r} and {other!r}"
                )
            if (other, one) not in pairs:
                pairs[one, other] = None
    return list(pairs)


def write_srdf(workspace: Workspace, path: PathLike, *, name: str = "") -> None:
    """Write the pairs of links that a workspace does not compare.

    Parameters
    ----------
    workspace : Workspace
        Its `excluded` pairs of links; those of a link with an obstacle, of which SRDF knows none,
        stay out.
    path : path
        The file appears whole or not at all.
    name : str
        Of the robot, as its URDF calls it; that of the arm unless given.

    Raises
    ------
    ValueError
        Where a link has no name.
    OSError
        Where the file cannot be written.
    """
    text = srdf_text(link_pairs(workspace), name or workspace.arm.name or "arm")
    with replacing(path) as aside:
        aside.write_text(text, encoding="utf-8")


def link_pairs(workspace: Workspace) -> list[tuple[str, str, str]]:
    """(link, other link, reason) of a workspace's `excluded`, obstacles left out."""
    obstacles = set(workspace.obstacles)
    return [
        (one, other, reason)
        for one, other, reason in workspace.excluded
        if reason in _REASONS and other not in obstacles
    ]


def srdf_text(pairs: Sequence[tuple[str, str, str]], name: str) -> str:
    """A SRDF of (link, other link, reason)."""
    lines = ['<?xml version="1.0" encoding="utf-8"?>', f"<robot name={quoteattr(name)}>"]
    for one, other, reason in pairs:
        if not one or not other:
            raise argument_error("workspace", "an arm whose links have names", "one without")
        why = _REASONS.get(reason, reason)
        lines.append(
            f"  <disable_collisions link1={quoteattr(one)} link2={quoteattr(other)} "
            f"reason={quoteattr(why)}/>"
        )
    return "\n".join([*lines, "</robot>"]) + "\n"
