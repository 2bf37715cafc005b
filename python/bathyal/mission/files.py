# SPDX-License-Identifier: BSD-3-Clause
"""Missions from YAML files."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from bathyal.io.files import PathLike

if TYPE_CHECKING:
    from bathyal._core import MissionPlan, World
    from bathyal.mission.sections import MissionSections


@dataclass(frozen=True)
class Mission:
    """What a mission's file describes.

    Attributes
    ----------
    name : str
    plan : MissionPlan
        What the engine runs.
    world : World
    sections : MissionSections
        The file's own values.
    text : str
        The file.
    commands : list of dict
        As the engine takes them, in the order of the file.
    """

    name: str
    plan: MissionPlan = field(repr=False)
    world: World = field(repr=False)
    sections: MissionSections = field(repr=False)
    text: str = field(repr=False)
    commands: list[dict[str, Any]] = field(repr=False)


def read_mission(path: PathLike, *, inside: PathLike | None = None) -> Mission:
    """Read a mission.

    Parameters
    ----------
    path : path
        ``.yaml``; the keys are those of `bathyal.mission.sections.MissionSections`. Numbers are SI
        or carry a unit.
    inside : path, optional
        A folder in which the files that it names may lie, that and all below it; that of the
        mission's file unless given. Links are resolved.

    Returns
    -------
    Mission

    Raises
    ------
    OSError
        Where there is no such file, or it may not be read.
    Error
        By file, line and column: for text that is no YAML, tags, keys that are not known or
        missing, values out of range, conditions that are not understood, devices that are not
        there.

    Examples
    --------
    >>> import bathyal, pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "mission.yaml"
    >>> _ = path.write_text('''
    ... world: {water: {surface: 0}, terrain: {seabed: {size: [40, 40], spacing: 1, depth: 10}}}
    ... vehicle: {preset: bluerov2_heavy}
    ... mission: [dive: {depth: 3 m}, surface]
    ... ''')
    >>> bathyal.read_mission(path)
    Mission(name='mission')
    """
    from pathlib import Path

    from bathyal.io.yaml_documents import read_yaml
    from bathyal.io.yaml_schema import validated
    from bathyal.mission import sections as own
    from bathyal.mission.build import MissionBuilder

    document = read_yaml(path)
    sections = validated(own.MissionSections, document)
    builder = MissionBuilder(document, inside)
    plan, world = builder.plan(sections)
    text = Path(path).read_text(encoding="utf-8-sig")
    return Mission(sections.name, plan, world, sections, text, builder.commands)


def mission_schema() -> dict[str, Any]:
    """The JSON Schema of a mission's file, for editors."""
    from bathyal.mission.sections import MissionSections

    return MissionSections.model_json_schema()
