# SPDX-License-Identifier: BSD-3-Clause
"""Where a scenario's arm reaches, as files: what `bathyal reach` does."""

from __future__ import annotations

from contextlib import nullcontext
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from bathyal.io.files import PathLike
from bathyal.io.json import json_text
from bathyal.io.provenance import Step
from bathyal.io.result_sets import filling
from bathyal.view.brief import Brief
from bathyal.workspace.scenario import Scenario

if TYPE_CHECKING:
    from bathyal._core import ReachMap


@dataclass(frozen=True)
class Reached:
    """A reach map and the scenario that it is of; `write` makes the files of `bathyal reach`.

    Attributes
    ----------
    scenario : Scenario
    map : ReachMap
    """

    scenario: Scenario
    map: ReachMap

    @property
    def summary(self) -> dict[str, Any]:
        """Numbers for programs, SI units in the names."""
        reached, free = np.asarray(self.map.reached), np.asarray(self.map.free)
        cube = float(self.map.voxel) ** 3
        middle = [
            self.map.origin[k] + self.map.voxel * np.argwhere(reached)[:, k] for k in range(3)
        ]
        ends = [[float(one.min()), float(one.max() + self.map.voxel)] for one in middle if len(one)]
        checks = self.scenario.workspace.check_target(self.scenario.targets)
        return {
            "format": "bathyal reach",
            "bathyal": version("bathyal"),
            "scenario": self.scenario.name,
            "voxel_m": float(self.map.voxel),
            "voxels": list(reached.shape),
            "reached_voxels": int(np.count_nonzero(reached)),
            "reached_m3": cube * int(np.count_nonzero(reached)),
            "free_m3": cube * int(np.count_nonzero(free)),
            "box_m": ends,
            "targets": dict(zip(self.scenario.target_names, map(str, checks.status), strict=True)),
            "warnings": self.scenario.warnings,
        }

    @property
    def brief(self) -> Brief:
        """The map at first sight."""
        known = self.summary
        reached, free = known["reached_m3"], known["free_m3"]
        if reached == 0:
            verdict = "Nothing: no voxel is reached."
        else:
            verdict = (
                f"Reached: {reached:.3g} m³, {free:.3g} m³ of it clear of all that may be hit."
            )
        numbers = {"voxels": f"{known['reached_voxels']:,} of {1e3 * known['voxel_m']:.3g} mm"}
        for name, ends in zip(("ahead", "port", "up"), known["box_m"], strict=False):
            numbers[name] = f"{ends[0]:.2f} to {ends[1]:.2f} m".replace("-", "−")
        states = list(known["targets"].values())
        if states:
            good = sum(state == "free" for state in states)
            numbers["targets"] = f"{good} of {len(states)} free"
        return Brief(verdict, numbers, "Look at reach.png; then plan the sample: bathyal sample.")

    def write(self, folder: PathLike, *, step: Step | None = None) -> list[Path]:
        """Write reach.npz, reach.png and reach.json; the folder gets all of them or none.

        Parameters
        ----------
        folder : path
            Made where it is missing.
        step : callable, optional
            ``with step("Writing …"):`` is put around each stage, for progress.

        Returns
        -------
        list of pathlib.Path

        Raises
        ------
        OSError
            Where a file cannot be written.
        """
        step = step or nullcontext
        with filling(folder, "reach") as aside:
            with step("Writing the map"):
                self.map.save(aside / "reach.npz")
                text = json_text(self.summary)
                (aside / "reach.json").write_text(text, encoding="utf-8")
            with step("Drawing the slices"):
                self.map.plot(aside / "reach.png")
            names = sorted(file.name for file in aside.iterdir())
        return [Path(folder) / name for name in names]


def reach_of(scenario: Scenario, **options: Any) -> Reached:
    """Map where the tip of a scenario's arm can be.

    Parameters
    ----------
    scenario : Scenario
    **options
        Of `Workspace.reach_map`.

    Returns
    -------
    Reached
    """
    return Reached(scenario, scenario.workspace.reach_map(**options))
