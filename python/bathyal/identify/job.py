# SPDX-License-Identifier: BSD-3-Clause
"""An identification from end to end: a table of touches in, an arm and a report out."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from contextlib import nullcontext
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from bathyal._core import (
    Arm,
    ArmFit,
    Touches,
    Tracked,
    arm_from_parts,
    arm_parts,
    identify_arm,
)
from bathyal.arm.files import find_arm
from bathyal.errors import argument_error
from bathyal.identify.report.brief import brief_of
from bathyal.identify.report.tables import distances, groups, write_parameters, write_residuals
from bathyal.identify.report.text import next_touches
from bathyal.identify.touch_files import read_touches, read_tracked
from bathyal.io.files import PathLike, shown
from bathyal.io.provenance import Step, file_facts
from bathyal.io.result_sets import filling
from bathyal.io.tables import read_table
from bathyal.view.brief import Brief

_MOST_NAMES = 6


@dataclass(frozen=True)
class Identification:
    """An arm that was identified, with everything it was found from; `write` makes the files of
    `bathyal identify`.

    Attributes
    ----------
    nominal : Arm
        The arm before identification.
    data : Touches or Tracked
        What was read.
    fit : ArmFit
    settings : dict
        Options that were given.
    provenance : dict
        Version, arm and files.
    """

    nominal: Arm
    data: Touches | Tracked
    fit: ArmFit
    settings: dict[str, Any]
    provenance: dict[str, Any]

    @property
    def warnings(self) -> list[str]:
        """What a person should know before the arm is used."""
        return list(self.fit.warnings)

    @property
    def brief(self) -> Brief:
        """The identification at first sight."""
        return brief_of(self.fit, self.data)

    @property
    def next(self) -> list[str]:
        """What to touch next, in sentences."""
        return next_touches(self.fit, self.data)

    @property
    def arm(self) -> Arm:
        """The arm that was found; its `source` says from what."""
        files = ", ".join(file["file"] for file in self.provenance["input"])
        source = f"identified by bathyal {self.provenance['bathyal']} from {files}"
        if self.nominal.source:
            source += f"; nominal: {self.nominal.source}"
        return arm_from_parts(arm_parts(self.fit.arm) | {"source": source})

    @property
    def summary(self) -> dict[str, Any]:
        """Numbers for programs, SI units in the names."""
        fit = self.fit
        counts = {p.status: 0 for p in fit.parameters}
        for parameter in fit.parameters:
            counts[parameter.status] += 1
        return {
            "summary": fit.summary(),
            "poses": len(self.data),
            "rms_before_m": fit.rms_before,
            "rms_after_m": fit.rms_after,
            "rms_after_scaled_m": fit.rms_after_scaled,
            "pairs_before_m2": fit.pairs_before,
            "pairs_after_m2": fit.pairs_after,
            "groups": {
                group.name: {"rms_before_m": group.before, "rms_after_m": group.after}
                for group in groups(fit, self.data)
            },
            "distances": [
                {"points": [d.first, d.second], "told_m": d.given, "found_m": d.found}
                for d in distances(fit, self.data)
            ],
            "parameters": len(fit.parameters),
            "rank": fit.rank,
            "status": counts,
            "noise_m": fit.noise,
            "degrees_of_freedom": fit.degrees_of_freedom,
            "scale_source": fit.scale_source,
            "scale": fit.scale,
            "scale_std": fit.scale_std,
            "iterations": fit.iterations,
            "converged": fit.converged,
            "structure_p": fit.structure_p,
            "outliers": [
                {"row": o.row, "point": o.point, "distance_m": o.distance, "fits": o.fits}
                for o in fit.outliers
            ],
            "unseen": list(fit.unseen),
            "warnings": self.warnings,
        }

    @property
    def facts(self) -> dict[str, str]:
        """The summary in short, for pictures and people."""
        fit = self.fit
        where = groups(fit, self.data)
        arm = f"{self.nominal.name or 'arm'}, {self.nominal.size} joints"
        if isinstance(self.data, Tracked):
            data = {"poses": f"{len(self.data):,}"}
        else:
            names = ", ".join(group.name for group in where)
            points = names if len(where) <= _MOST_NAMES else f"{len(where)} points"
            data = {"touches": f"{len(self.data):,} of {points}"}
        rms = f"{1e3 * fit.rms_before:.3g} → {1e3 * fit.rms_after:.3g} mm (rms, 3-D)"
        facts = {"arm": arm, **data, "scatter": rms}
        if fit.pairs_before > 0:
            facts["J (all pairs)"] = (
                f"{1e6 * fit.pairs_before:.4g} → {1e6 * fit.pairs_after:.4g} mm²"
            )
        return {
            **facts,
            "determined": f"{fit.rank} of {len(fit.parameters)} combinations",
            "size rests on": fit.scale_source,
            "steps": f"{fit.iterations}" + ("" if fit.converged else ", not converged"),
        }

    def write(
        self,
        folder: PathLike,
        *,
        title: str = "",
        ros: bool = False,
        ur_calibration: bool = False,
        step: Step | None = None,
    ) -> list[Path]:
        """Write arm.json, arm.urdf, fit.json, parameters.csv, residuals.csv, report.html and
        report.png. All are made aside first: the folder gets either all of them or none.

        A manifest with their hashes is written last.

        Parameters
        ----------
        folder : path
            Made where it is missing; other files in it are left alone, but for those that an
            earlier run of the same job wrote and this one does not.
        title : str
        ros : bool
            Also kinematics.yaml for ROS' ur_description.
        ur_calibration : bool
            Also calibration.conf for Universal Robots' controller.
        step : callable, optional
            ``with step("Writing …"):`` is put around each stage, for progress.

        Returns
        -------
        list of pathlib.Path

        Raises
        ------
        ValueError
            For `ros` or `ur_calibration` with an arm that those files cannot hold.
        OSError
            Where a file cannot be written.
        """
        from bathyal.identify.report.figure import fit_figure
        from bathyal.identify.report.page import write_page
        from bathyal.io.json import json_text
        from bathyal.view.figure import write_png

        step = step or nullcontext
        fit, data, arm = self.fit, self.data, self.arm
        with filling(folder, "identify") as aside:
            with step("Writing the arm"):
                arm.save(aside / "arm.json")
                arm.write(aside / "arm.urdf")
                if ros:
                    arm.write(aside / "kinematics.yaml")
                if ur_calibration:
                    arm.write(aside / "calibration.conf", nominal=self.nominal)
            with step("Writing the tables"):
                write_parameters(fit, aside / "parameters.csv")
                write_residuals(fit, data, aside / "residuals.csv")
                text = json_text(self._contents())
                (aside / "fit.json").write_text(text, encoding="utf-8")
            with step("Drawing the picture"):
                write_png(fit_figure(fit, data, title=title), aside / "report.png")
            with step("Drawing the page"):
                write_page(fit, data, aside / "report.html", title=title, facts=self.facts)
            names = sorted(file.name for file in aside.iterdir())
        return [Path(folder) / name for name in names]

    def _contents(self) -> dict[str, Any]:
        """What fit.json holds."""
        fit = self.fit
        parameters = [
            {
                "name": p.name, "unit": p.unit, "nominal": p.nominal, "value": p.value,
                "std": p.std if np.isfinite(p.std) else None, "status": p.status,
                "trades": {trade.name: trade.factor for trade in p.trades},
            }
            for p in fit.parameters
        ]  # fmt: skip
        return {
            "provenance": self.provenance,
            "settings": self.settings,
            "summary": self.summary,
            "singular_values": fit.singular_values,
            "parameters": parameters,
            "covariance": fit.covariance,
        }


def identify(
    source: PathLike | Sequence[PathLike],
    arm: Arm | str,
    *,
    tracked: bool = False,
    read: Mapping[str, Any] | None = None,
    options: Mapping[str, Any] | None = None,
    step: Step | None = None,
) -> Identification:
    """Read a table, find the arm: what `bathyal identify` does.

    Parameters
    ----------
    source : path or sequence of path
        A table of touches as `read_touches` takes it, or a file for each touched point: then the
        points are called as the files are. Columns may also be called as the arm's joints are.
    arm : Arm or str
        Nominal: an arm, a name of `bathyal.arms`, or a .urdf or .json file.
    tracked : bool
        The table holds measured positions, or poses: see `read_tracked`.
    read : mapping, optional
        Keywords of `read_touches` or `read_tracked`.
    options : mapping, optional
        Keywords of `identify_arm`.
    step : callable, optional
        ``with step("Reading …"):`` is put around each stage, for progress.

    Returns
    -------
    Identification

    Raises
    ------
    ValueError, Error, OSError
        As `read_touches`, `read_tracked`, `read_arm` and `identify_arm`.

    Examples
    --------
    >>> import bathyal, pathlib, tempfile
    >>> from bathyal.identify.simulate import simulate_touches, write_touches
    >>> file = pathlib.Path(tempfile.mkdtemp()) / "touches.csv"
    >>> made = simulate_touches(bathyal.arms.ur10e())
    >>> write_touches(made.touches, file)
    >>> known = {("left", "right"): made.apart}
    >>> found = identify(file, "ur10e", read={"known_distances": known})
    >>> found.fit.rank, found.fit.scale_source
    (21, 'known distance')
    """
    step = step or nullcontext
    files = [source] if isinstance(source, (str, os.PathLike)) else list(source)
    nominal = find_arm(arm) if isinstance(arm, str) else arm
    with step("Reading"):
        data = read_data(files, nominal, tracked=tracked, read=read or {})
    with step("Identifying"):
        fit = identify_arm(nominal, data, **(options or {}))
    return Identification(
        nominal=nominal,
        data=data,
        fit=fit,
        settings={
            "tracked": tracked,
            "read": plain_settings(read or {}),
            "identify": dict(options or {}),
        },
        provenance={
            "bathyal": version("bathyal"),
            "arm": {"name": nominal.name, "source": nominal.source},
            "input": [file_facts(file) for file in files],
        },
    )


def read_data(
    files: Sequence[PathLike],
    arm: Arm,
    *,
    tracked: bool,
    read: Mapping[str, Any],
    sessions: bool = False,
) -> Touches | Tracked:
    """Touches from one table or a table for each point; tracked poses from one table.

    Parameters
    ----------
    files : sequence of path
    arm : Arm
        Columns may be called as its joints are.
    tracked : bool
    read : mapping
        Keywords of `read_touches` or `read_tracked`.
    sessions : bool
        Whether tracked poses may come in a table for each session.

    Raises
    ------
    ValueError, Error, OSError
        As `read_touches` and `read_tracked`; for arguments of touches given with tracked poses.
    """
    if not files:
        raise argument_error("source", "a file", "none")
    keywords = {**_joints(files[0], arm), **read}
    if not tracked:
        return read_touches(files[0] if len(files) == 1 else _labelled(files), **keywords)
    if len(files) > 1 and not sessions:
        raise argument_error("source", "one file of tracked poses", f"{len(files)} files")
    of_touches = sorted(set(read) & {"known_distances", "known_points", "planes", "point",
                                 "distance_std", "point_std"})  # fmt: skip
    if of_touches:
        raise argument_error(of_touches[0], "nothing: tracked poses do not take it", "a value")
    return read_tracked(files if len(files) > 1 else files[0], **keywords)


def _joints(file: PathLike, arm: Arm) -> dict[str, Any]:
    """The arm's own joints by name, where the table has columns of these names."""
    table = read_table(file)
    names = list(arm.joint_names)
    return {"joints": names} if all(table.find(name) is not None for name in names) else {}


def _labelled(files: Sequence[PathLike]) -> dict[str, PathLike]:
    """A point for each file, called by the file's name; where names are alike, with its folders as
    far as they differ: "front/hole_0", "back/hole_0"."""
    paths = [Path(file) for file in files]
    if len({path.stem for path in paths}) < len(paths):
        common = os.path.commonpath([path.absolute().parent for path in paths])
        labels = [path.absolute().relative_to(common).with_suffix("").as_posix() for path in paths]
    else:
        labels = [path.stem for path in paths]
    if len(set(labels)) < len(labels):
        raise argument_error("source", "each file once", ", ".join(map(str, files)))
    return dict(zip(map(shown, labels), files, strict=True))


def plain_settings(read: Mapping[str, Any]) -> dict[str, Any]:
    """Settings as JSON holds them: pairs of labels as one text."""
    return {
        name: {" ".join(pair): metres for pair, metres in value.items()}
        if name == "known_distances"
        else value
        for name, value in read.items()
    }
