# SPDX-License-Identifier: BSD-3-Clause
"""A diagnosis from end to end: a table of touches or tracked poses in, a report and a corrected arm
out."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from contextlib import nullcontext
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

from bathyal._core import Arm, Diagnosis, Touches, Tracked, diagnose
from bathyal.arm.files import find_arm
from bathyal.diagnosis.files import contents, write_diagnosis, write_residuals
from bathyal.diagnosis.report.advice import next_steps
from bathyal.diagnosis.report.brief import brief_of
from bathyal.diagnosis.report.text import facts_of
from bathyal.identify.job import plain_settings, read_data
from bathyal.io.files import PathLike
from bathyal.io.provenance import Step, file_facts
from bathyal.io.result_sets import filling
from bathyal.view.brief import Brief

# A number a row: of files, not of a screen.
_LONG = ("residuals_before_m", "residuals_after_m")
_BY_ROW = ("before_m", "after_m")


def _without_rows(value: Any) -> Any:
    if not isinstance(value, dict):
        return value
    return {name: one for name, one in value.items() if name not in _BY_ROW}


@dataclass(frozen=True)
class Diagnosed:
    """A diagnosis with everything it was made from; `write` makes the files of
    `bathyal diagnose`.

    Attributes
    ----------
    nominal : Arm
        The arm before identification.
    data : Touches or Tracked
        What was read.
    report : Diagnosis
    settings : dict
        Options that were given.
    provenance : dict
        Version, arm and files.
    """

    nominal: Arm
    data: Touches | Tracked
    report: Diagnosis
    settings: dict[str, Any]
    provenance: dict[str, Any]

    @property
    def warnings(self) -> list[str]:
        """What a person should know before the result is used."""
        return list(self.report.warnings)

    @property
    def brief(self) -> Brief:
        """The diagnosis at first sight."""
        return brief_of(self.report)

    @property
    def next(self) -> list[str]:
        """What to do or to measure next, in sentences."""
        return next_steps(self.report)

    @property
    def summary(self) -> dict[str, Any]:
        """Numbers for programs, SI units in the names; without those of single rows."""
        known = {name: value for name, value in contents(self.report).items() if name not in _LONG}
        held = _without_rows(known["held_out"])
        known["held_out"] = {name: _without_rows(value) for name, value in held.items()}
        return known

    @property
    def facts(self) -> dict[str, str]:
        """What was diagnosed, in short."""
        return facts_of(self.report) | {"made by": f"bathyal {version('bathyal')}"}

    def write(self, folder: PathLike, *, title: str = "", step: Step | None = None) -> list[Path]:
        """Write report.html, report.json, report.png, model.json and residuals.csv. All are made
        aside first: the folder gets either all of them or none.

        A manifest with their hashes is written last.

        Parameters
        ----------
        folder : path
            Made where it is missing; other files in it are left alone, but for those that an
            earlier run of the same job wrote and this one does not.
        title : str
        step : callable, optional
            ``with step("Writing …") as report_progress:`` is put around each stage, for
            progress; `report_progress` takes the share that is done and what is being done.

        Returns
        -------
        list of pathlib.Path

        Raises
        ------
        OSError
            Where a file cannot be written.
        """
        step = step or nullcontext
        with filling(folder, "diagnose") as aside:
            with step("Writing the arm"):
                self.report.model.write(aside / "model.json")
            with step("Writing the tables"):
                write_residuals(self.report, aside / "residuals.csv")
                write_diagnosis(
                    self.report, aside / "report.json", provenance=self.provenance,
                    settings=self.settings,
                )  # fmt: skip
            with step("Drawing the sheet"):
                write_diagnosis(self.report, aside / "report.png", title=title)
            with step("Drawing the page") as report_progress:
                write_diagnosis(
                    self.report, aside / "report.html", title=title, facts=self.facts,
                    step=report_progress if callable(report_progress) else None,
                )  # fmt: skip
            names = sorted(file.name for file in aside.iterdir())
        return [Path(folder) / name for name in names]


def diagnose_files(
    source: PathLike | Sequence[PathLike],
    arm: Arm | str,
    *,
    tracked: bool = False,
    read: Mapping[str, Any] | None = None,
    options: Mapping[str, Any] | None = None,
    step: Step | None = None,
) -> Diagnosed:
    """Read a table, say what the simulation gets wrong: what `bathyal diagnose` does.

    Parameters
    ----------
    source : path or sequence of path
        A table of touches, or a file for each touched point, as `bathyal.identify.job.identify`
        takes it; of tracked poses a table, or one for each session.
    arm : Arm or str
        Nominal: an arm, a name of `bathyal.arms`, or a .urdf or .json file.
    tracked : bool
        The table holds measured positions, or poses: see `read_tracked`.
    read : mapping, optional
        Keywords of `read_touches` or `read_tracked`.
    options : mapping, optional
        Keywords of `diagnose`.
    step : callable, optional
        As in `Diagnosed.write`.

    Returns
    -------
    Diagnosed

    Raises
    ------
    ValueError, Error, OSError
        As `read_touches`, `read_tracked`, `read_arm` and `diagnose`.
    """
    step = step or nullcontext
    files = [source] if isinstance(source, (str, os.PathLike)) else list(source)
    nominal = find_arm(arm) if isinstance(arm, str) else arm
    with step("Reading"):
        data = read_data(files, nominal, tracked=tracked, read=read or {}, sessions=True)
    with step("Diagnosing") as report_progress:
        progress = {"progress": report_progress} if callable(report_progress) else {}
        report = diagnose(nominal, data, **(options or {}), **progress)
    return Diagnosed(
        nominal=nominal,
        data=data,
        report=report,
        settings={"tracked": tracked, "read": plain_settings(read or {}),
                  "diagnose": dict(options or {})},
        provenance={
            "arm": {"name": nominal.name, "source": nominal.source},
            "input": [file_facts(file) for file in files],
        },
    )  # fmt: skip
