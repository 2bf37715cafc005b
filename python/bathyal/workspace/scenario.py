# SPDX-License-Identifier: BSD-3-Clause
"""One YAML file with all that a workspace needs: arm, hull, keep-outs, bottom, vehicle, targets."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from bathyal._core import Arm, Hull, KeepOut, Scene, Workspace
from bathyal.errors import argument_error
from bathyal.io.files import PathLike

if TYPE_CHECKING:
    from bathyal.workspace.sections import ScenarioSections

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Scenario:
    """What a scenario's file describes.

    Attributes
    ----------
    name : str
    workspace : Workspace
        The arm on its hull among keep-outs over the bottom.
    targets : (N, 3) array
        In the world [m].
    target_names : list of str
        Of each; "1", "2" … where the file gives none.
    q_start : (n,) array
        Where the arm begins [rad] or [m]; each coordinate at 0, or amid its limits, unless given.
    sampled : int
        The row of the target that a sample is to be taken at; −1 where there is no target.
    sampling : dict
        Keywords of `bathyal.plan_sampling`.
    arm : Arm
    hull : Hull or None
    scene : Scene or None
    keepouts : list of KeepOut
    sections : ScenarioSections
        The file's own values.
    warnings : list of str
        What a person should know before anything moves.
    """

    name: str
    workspace: Workspace
    targets: Array
    target_names: list[str]
    q_start: Array
    sampled: int
    sampling: dict[str, Any]
    arm: Arm
    hull: Hull | None
    scene: Scene | None
    keepouts: list[KeepOut]
    sections: ScenarioSections
    warnings: list[str] = field(default_factory=list)

    def row_of(self, target: str | int | None) -> int:
        """The row of a target by its name or row, the file's own choice for None.

        Raises
        ------
        ValueError
            Where there is no such target.
        """
        if target is None and self.sampled >= 0:
            return self.sampled
        if isinstance(target, str) and target in self.target_names:
            return self.target_names.index(target)
        if isinstance(target, (int, np.integer)) and 0 <= target < len(self.targets):
            return int(target)
        names = ", ".join(self.target_names)
        known = f"one of {names}" if names else "a scenario with targets"
        raise argument_error("target", known, repr(target))


def read_scenario(path: PathLike, *, inside: PathLike | None = None) -> Scenario:
    """Read a scenario.

    Parameters
    ----------
    path : path
        ``.yaml``; the keys are those of `bathyal.workspace.sections.ScenarioSections`. Lengths are
        in metres; angles in radians, or in degrees where a key ends in ``_deg``.
    inside : path, optional
        A folder in which the files that it names may lie, that and all below it; that of the
        scenario unless given. Links are resolved.

    Returns
    -------
    Scenario

    Raises
    ------
    OSError
        Where there is no such file, or it may not be read.
    Error
        By file, line and column: for text that is no YAML, tags, more values than a scenario can
        have, keys that are not known or missing, values out of range, files that are missing,
        broken, or outside of `inside`.

    Examples
    --------
    >>> import bathyal, pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "scenario.yaml"
    >>> _ = path.write_text('''
    ... arm: {name: panda, q_start_deg: [0, -45, 0, -135, 0, 90, 45]}
    ... hull: {box: [1.2, 0.6, 0.4]}
    ... mount: {position: [0.7, 0, 0]}
    ... targets: [[1.2, 0, -0.3]]
    ... ''')
    >>> scenario = bathyal.read_scenario(path)
    >>> scenario.targets
    array([[ 1.2,  0. , -0.3]])
    """
    from bathyal.io.yaml_documents import read_yaml
    from bathyal.io.yaml_schema import validated
    from bathyal.workspace.build_scenario import scenario_of
    from bathyal.workspace.sections import ScenarioSections

    document = read_yaml(path)
    sections = validated(ScenarioSections, document)
    return scenario_of(sections, document, inside=inside)
