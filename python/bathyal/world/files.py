# SPDX-License-Identifier: BSD-3-Clause
"""Worlds from YAML files."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bathyal.io.files import PathLike

if TYPE_CHECKING:
    from bathyal._core import World


def read_world(path: PathLike, *, inside: PathLike | None = None) -> World:
    """Read a world.

    Parameters
    ----------
    path : path
        ``.yaml``; the keys are those of `bathyal.world.sections.WorldSections`, at the top or under
        ``world``. Lengths are in metres; angles in radians, or in degrees where a key ends in
        ``_deg``.
    inside : path, optional
        A folder in which the files that it names may lie, that and all below it; that of the
        world's file unless given. Links are resolved.

    Returns
    -------
    World

    Raises
    ------
    OSError
        Where there is no such file, or it may not be read.
    Error
        By file, line and column: for text that is no YAML, tags, keys that are not known or
        missing, values out of range, files that are missing, broken, or outside of `inside`.

    Examples
    --------
    >>> import bathyal, pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "world.yaml"
    >>> _ = path.write_text('''
    ... terrain: {seabed: {size: [40, 40], spacing: 0.5, seed: 1, ripple_height: 0.05}}
    ... objects:
    ...   - {name: wreck, wreck: {length: 20}, on_ground: true, pose: {position: [5, 3, -0.3]}}
    ... clones:
    ...   - {name: boulder, boulder: {radius: 0.4}, count: 20}
    ... ''')
    >>> bathyal.read_world(path)
    World(22 objects)
    """
    from bathyal.io.yaml_documents import read_yaml
    from bathyal.io.yaml_schema import validated
    from bathyal.world import sections as own
    from bathyal.world.build import WorldBuilder

    document = read_yaml(path)
    builder = WorldBuilder(document, inside)
    if own.is_section(document.value):
        builder.root = ("world",)
        return builder.world(validated(own.WorldDocument, document).world)
    return builder.world(validated(own.WorldSections, document))
